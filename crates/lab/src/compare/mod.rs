//! Compares layers with the exact reference: how many pixels are wrong, in which way, and how large the errors of right pixels are.
//!
//! # Classes
//!
//! A pixel is *wrong* if its kind, its part or, for a cap, its clip-surface differs from exact, or if it is a crack. A
//! wrong pixel is counted in either `interior_wrong_px` or `edge_wrong_px`. It is also counted in every class below that
//! fits, so that each number can be read by itself:
//!
//! | class | exact | the strategy |
//! |---|---|---|
//! | missed cap | cap | anything else |
//! | leaked cap | anything else | cap |
//! | wrong part | surface or cap | same kind; another part, or another clip-surface |
//! | crack | surface or cap, not a back face; decided | a back face; or background where exact has none within a pixel |
//! | outline | the same | background where exact has background within a pixel |
//!
//! A crack is a hole: the inside of a shell shows, or the background shows through a solid. If exact has background in a pixel's
//! 3 x 3 block, background at the pixel is not a crack but a displaced outline, as tessellated caps have; a back face is always a
//! crack. Cracks are counted among decided pixels only: the number must be 0, but a sample on an outline may rightly show
//! the background. The other classes count all pixels.
//!
//! A pixel that fits no class (a surface where exact has background, an exact back face drawn as background) is still wrong.
//!
//! Depth and normal errors are measured where the pixel is right, and both its answer and its depth are decided: where
//! sampling is ambiguous, two answers with very different depths may both be right.

mod doubt;
mod frame_counts;
mod heatmap;

pub use doubt::may_be_wrong;
pub use frame_counts::FrameCounts;
pub use heatmap::{Class, LegendEntry, heatmap, heatmap_overlay, legend};

use cutaway::layers::{Kind, Layer, Layers};
use cutaway::scene::View;
use serde::{Deserialize, Serialize};

use crate::exact::Exact;

/// Errors of one frame compared with exact. `cutaway compare` writes the same fields as JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Exact has a cap, the strategy does not.
    pub missed_cap_px: usize,
    /// The strategy has a cap, exact does not.
    pub leaked_cap_px: usize,
    /// The kind is right, but the part or, for a cap, the clip-surface is wrong.
    pub wrong_part_px: usize,
    /// Pixels where exact is sure of a cap or a front face, but the strategy shows a back face, or shows background although exact has
    /// no background within one pixel.
    pub crack_px: usize,
    /// Background where exact is sure of a front face or a cap, but has background within one pixel. This is a displaced outline, as
    /// triangulated caps have, and not a hole.
    pub outline_px: usize,
    /// Wrong pixels farther than one pixel from every boundary of the exact image.
    pub interior_wrong_px: usize,
    /// Wrong pixels within one pixel of a boundary of the exact image.
    pub edge_wrong_px: usize,
    /// Wrong pixels where exact is decided. An exact strategy has none.
    pub decided_wrong_px: usize,
    /// Decided wrong pixels that the strategy does not mark: it is wrong there without a warning.
    pub unmarked_wrong_px: usize,
    /// Pixels that the strategy marks because their crossing count is odd or a buffer overflowed.
    pub odd_parity_px: usize,
    /// Pixels where the strategy reports that several solids share the cap; strategies look for such pixels only if
    /// [`Scene::interference`](cutaway::scene::Scene::interference) has a colour.
    pub overlap_px: usize,
    /// Largest depth error in world units.
    pub depth_error_max: f64,
    /// Mean depth error in world units.
    pub depth_error_mean: f64,
    /// Largest depth error, divided by the edge length of a pixel at that depth.
    pub depth_error_px_max: f64,
    /// Mean depth error, divided by the edge length of a pixel at that depth.
    pub depth_error_px_mean: f64,
    /// Largest angle between the cap normals of the strategy and of exact, in degrees.
    pub normal_error_deg_max: f64,
    /// Mean angle between the cap normals of the strategy and of exact, in degrees.
    pub normal_error_deg_mean: f64,
}

impl Comparison {
    /// All wrong pixels.
    pub fn wrong_px(&self) -> usize {
        self.interior_wrong_px + self.edge_wrong_px
    }
}

/// Compares a frame with exact. `scale` is [`Prepared::scale`](cutaway::scene::Prepared::scale): scene units per world unit.
///
/// # Panics
///
/// If the two frames or the view differ in size, and so do not show the same pixels.
pub fn compare(exact: &Exact, layers: &Layers, view: &View, scale: f64) -> Comparison {
    assert_eq!(
        exact.layers.size_px, layers.size_px,
        "frames of different size cannot be compared"
    );
    let mut result = Comparison {
        overlap_px: layers.overlap_px(),
        ..Comparison::default()
    };
    let (mut depth, mut depth_px, mut normal) = (
        ErrorSummary::default(),
        ErrorSummary::default(),
        ErrorSummary::default(),
    );
    for (index, (truth, found)) in exact.layers.pixels.iter().zip(&layers.pixels).enumerate() {
        let verdict = PixelErrors::of(&exact.layers, index, found);
        result.missed_cap_px += usize::from(verdict.missed_cap);
        result.leaked_cap_px += usize::from(verdict.leaked_cap);
        result.wrong_part_px += usize::from(verdict.wrong_part);
        let decided = !exact.undecided[index];
        result.crack_px += usize::from(verdict.crack && decided);
        result.outline_px += usize::from(verdict.outline && decided);
        result.odd_parity_px += usize::from(found.unreliable);
        if verdict.wrong {
            let edge = near_boundary(&exact.layers, index);
            result.edge_wrong_px += usize::from(edge);
            result.interior_wrong_px += usize::from(!edge);
            result.decided_wrong_px += usize::from(decided);
            result.unmarked_wrong_px += usize::from(decided && !found.unreliable);
        } else if decided && !exact.depth_open[index] && truth.kind != Kind::Background {
            let off = (found.depth - truth.depth).abs();
            depth.add(off / scale);
            depth_px.add(off / view.pixel_size(truth.depth).abs());
            if truth.kind == Kind::Cap {
                normal.add(angle_deg(truth, found));
            }
        }
    }
    (result.depth_error_max, result.depth_error_mean) = (depth.max, depth.mean());
    (result.depth_error_px_max, result.depth_error_px_mean) = (depth_px.max, depth_px.mean());
    (result.normal_error_deg_max, result.normal_error_deg_mean) = (normal.max, normal.mean());
    result
}

/// Errors of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct PixelErrors {
    missed_cap: bool,
    leaked_cap: bool,
    wrong_part: bool,
    crack: bool,
    outline: bool,
    wrong: bool,
}

impl PixelErrors {
    /// Judges a pixel, by its index in the exact image.
    fn of(exact: &Layers, index: usize, found: &Layer) -> Self {
        let truth = &exact.pixels[index];
        let same_kind = truth.kind == found.kind;
        let wrong_part = same_kind && label(truth) != label(found);
        let solid = truth.kind != Kind::Background && !truth.back_face;
        let is_sky = |l: &Layer| l.kind == Kind::Background;
        let see_through = solid && is_sky(found);
        let outline = see_through && block(exact, index).any(is_sky);
        let inside_out = solid && found.back_face;
        Self {
            missed_cap: truth.kind == Kind::Cap && !same_kind,
            leaked_cap: found.kind == Kind::Cap && !same_kind,
            wrong_part,
            crack: (see_through && !outline) || inside_out,
            outline,
            wrong: !same_kind || wrong_part || inside_out,
        }
    }
}

/// Label that is equal for two pixels exactly if they show the same kind, part and clip-surface.
fn label(layer: &Layer) -> (Kind, u16, u8) {
    match layer.kind {
        Kind::Background => (Kind::Background, 0, 0),
        Kind::Surface => (Kind::Surface, layer.part, 0),
        Kind::Cap => (Kind::Cap, layer.part, layer.clip_surface),
    }
}

/// The pixel and those of its eight neighbours that lie in the picture.
fn block(exact: &Layers, index: usize) -> impl Iterator<Item = &Layer> {
    around(exact.size_px, index, 1).map(|i| &exact.pixels[i])
}

/// Indices of the pixels within `reach` rows and columns of a pixel, which is included. The square ends at the picture's borders.
pub(crate) fn around(
    size_px: [u32; 2],
    index: usize,
    reach_px: usize,
) -> impl Iterator<Item = usize> {
    let [width, height] = size_px.map(|s| s as usize);
    let near = move |at: usize, end: usize| at.saturating_sub(reach_px)..end.min(at + reach_px + 1);
    let (x, y) = (index % width, index / width);
    near(y, height).flat_map(move |j| near(x, width).map(move |i| j * width + i))
}

/// Returns true if the pixel is within one pixel of a boundary of the exact image: the pixels of its 3 x 3 block do not all have
/// the same kind, part and clip-surface.
fn near_boundary(exact: &Layers, index: usize) -> bool {
    let own = label(&exact.pixels[index]);
    block(exact, index).any(|l| label(l) != own)
}

/// Angle between two normals, from the tangent of half the angle, which is accurate for small angles, unlike the cosine.
fn angle_deg(truth: &Layer, found: &Layer) -> f64 {
    let unit = |l: &Layer| l.normal.as_dvec3().normalize_or_zero();
    let (a, b) = (unit(truth), unit(found));
    (2.0 * (a - b).length().atan2((a + b).length())).to_degrees()
}

/// Maximum and mean of errors.
#[derive(Default)]
struct ErrorSummary {
    max: f64,
    sum: f64,
    count: usize,
}

impl ErrorSummary {
    fn add(&mut self, error: f64) {
        // A NaN in the frame must show, not vanish in `max`; JSON has no infinity.
        let error = if error.is_finite() { error } else { f64::MAX };
        self.max = self.max.max(error);
        self.sum += error;
        self.count += 1;
    }

    fn mean(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }
}
