//! `[relief.NAME]`.

use std::path::PathBuf;

use cutaway::scene::Wrap;
use cutaway::scene::describe::{Described, joined};
use cutaway::scene::relief::{BlendOp, Procedure};

use super::ByHand;

/// Kinds of relief that are not procedural.
const OTHER_KINDS: [&str; 4] = ["image", "blend", "profile", "layers"];

/// Words of `kind`.
const KINDS: [&str; Procedure::NAMES.len() + OTHER_KINDS.len()] =
    joined(&Procedure::NAMES, &OTHER_KINDS);

/// A relief as stored in a file. The parameters of procedural reliefs are declared by [`Procedure`].
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct ReliefDesc {
    /// Source of the heights.
    #[value(choice = KINDS, example = "fractal")]
    pub(crate) kind: Option<String>,
    /// Height-map image.
    #[value(example = "rock.png")]
    pub(crate) image: Option<PathBuf>,
    /// Names of the reliefs to combine, in order.
    #[value(example = ["a", "b"])]
    pub(crate) blend: Vec<String>,
    /// Operator that combines the blended reliefs (blend).
    #[value(choice = BlendOp::NAMES, example = "add")]
    pub(crate) op: Option<String>,
    /// Weight of each relief relative to the result of the reliefs before it (blend, mix).
    #[value(range = 0.0..=1.0, example = 0.5)]
    pub(crate) share: Option<f64>,
    /// Heights at equal steps along U (profile).
    #[value(example = [0, 0.2, 1])]
    pub(crate) heights: ByHand,
    /// Names of the reliefs used as layers (layers).
    #[value(example = ["a", "b"])]
    pub(crate) of: Vec<String>,
    /// Numbered images used as layers (layers).
    #[value(example = "frames/%03d.png")]
    pub(crate) images: Option<PathBuf>,
    /// Number of the first image (layers).
    #[value(fixed, example = 1)]
    pub(crate) first: Option<u32>,
    /// Position between layers, where layer 0 is at 0 and layer 1 at 1 (layers).
    #[value(example = 0.5)]
    pub(crate) at: f64,
    /// Wrap mode for positions beyond the last layer (layers).
    #[value(example = "repeat")]
    pub(crate) wrap: Wrap,
}
