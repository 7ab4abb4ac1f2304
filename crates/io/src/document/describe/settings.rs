//! Top-level values, and `[strategy]`.

use cutaway::scene::HeightFilter;
use cutaway::scene::describe::{Described, OrWord, ValueType, words};
use cutaway::scene::style::Paper;
use cutaway::strategies::Rasteriser;
use glam::Vec3;

/// Settings of a document that are not part of the scene itself. A setting that the document lacks is `None`.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub struct Settings {
    /// Width and height of the picture.
    #[value(key = "resolution", range = 1.0..=16384.0, unit = "px", fixed, example = [1024, 768])]
    pub size_px: Option<[u32; 2]>,
    /// Background of the picture, where "paper" is the style's background.
    #[value(words = ["paper"], example = "#ffffff")]
    pub background: Option<OrWord<Paper>>,
    /// Colour that hatches caps where several solids overlap.
    #[value(example = "#ff00aa")]
    pub interference: Option<Vec3>,
    /// Filter used when a height map is sampled at a point.
    #[value(example = "exact")]
    pub height_filter: Option<HeightFilter>,
    /// Number of samples per pixel along each side.
    #[value(range = 1.0..=4.0, fixed, example = 2)]
    pub supersample: Option<u32>,
    /// Time that the picture shows.
    #[value(range = 0.0.., unit = "s", fixed, example = 0.5)]
    pub time_s: Option<f64>,
    /// Animation to play, by name or number.
    #[value(takes = ValueType::Name, example = "walk")]
    pub clip: Option<String>,
    /// Drawing method.
    #[value(table)]
    pub strategy: StrategySettings,
}

/// The drawing method of a document. The renderer checks the names of strategy and rasteriser.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub struct StrategySettings {
    /// Capping strategy; `cutaway render --help` lists them.
    #[value(example = "auto")]
    pub name: Option<String>,
    /// Rasteriser of the meshes.
    #[value(choice = words(&Rasteriser::ALL), example = "compute")]
    pub rasteriser: Option<String>,
}

/// Default picture size.
const DEFAULT_SIZE_PX: [u32; 2] = [1024, 768];

impl Settings {
    /// Width and height of the picture in pixels, as set by the document or by default.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px.unwrap_or(DEFAULT_SIZE_PX)
    }
}
