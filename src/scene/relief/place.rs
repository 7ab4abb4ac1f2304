//! Places a height map on a section.
//!
//! The section plane runs through the middle of the height range: the surface stays within half its amplitude on either side of
//! the plane, and a flat map gives the plane itself. The map's centre lies over the centre of the bounds. Height 1 of the map
//! rises from the kept side, so grooves in the map are grooves in the solid.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::scene::describe::Described;
use crate::scene::units::amount::Amount;
use crate::scene::units::range::{self, SMALLEST};
use crate::scene::{Bounds, ClipSurface, OffsetMap, Wrap};

/// Placement of a map on a section.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Placement {
    /// Height from the lowest to the highest point of the relief.
    ///
    /// Percentages refer to the bounds' diagonal.
    #[value(unit = "units", example = "6%")]
    pub amplitude: Amount,
    /// Length of one repeat of the relief.
    ///
    /// Along `U`. `None` selects a share of the diagonal that suits the relief.
    #[value(range = SMALLEST.., unit = "units", example = "40%")]
    pub period: Option<Amount>,
    /// Wrap mode of the relief.
    #[value(example = "mirror")]
    pub wrap: Wrap,
}

impl Default for Placement {
    fn default() -> Self {
        Self {
            amplitude: Amount::Percent(6.0),
            period: None,
            wrap: Wrap::Repeat,
        }
    }
}

/// Default period in percent of the diagonal. It gives one clamped map over the whole model, about ten teeth of a sawtooth (a 2 x 2 map),
/// or little more than one repeat of any other map.
fn usual_period(map: &OffsetMap, wrap: Wrap) -> f64 {
    match (wrap, map.size()) {
        (Wrap::Clamp, _) => 100.0,
        (_, [2, 2]) => 10.0,
        _ => 60.0,
    }
}

impl ClipSurface {
    /// The same surface with a map on it, scaled by a placement; percentages refer to the diagonal of `bounds`, the box of the
    /// cut geometry. Texels of images that have both a width and a height keep their aspect ratio.
    ///
    /// # Errors
    ///
    /// If the placement has a zero length, or is out of the range that can be computed for a model of this size.
    pub fn with_relief(
        self,
        map: impl Into<Arc<OffsetMap>>,
        placement: &Placement,
        bounds: &Bounds,
    ) -> Result<Self> {
        place_map(self, map.into(), placement, bounds).map_err(|what| {
            let help = "choose an amplitude and a period of about a tenth of the model";
            Error::input("relief", what, help)
        })
    }
}

/// Puts a map on a plane; an error text if the placement has a zero length. Texels of images that have both a width and a
/// height keep their aspect ratio: `|V|` follows from the period, `|U|`.
pub fn place_map(
    surface: ClipSurface,
    map: Arc<OffsetMap>,
    placement: &Placement,
    bounds: &Bounds,
) -> Result<ClipSurface, String> {
    let diagonal = bounds.size().length();
    let of_diagonal = |amount: Amount| match amount {
        Amount::Units(v) => v,
        Amount::Percent(p) => diagonal * p / 100.0,
    };
    let amplitude = of_diagonal(placement.amplitude);
    let usual = Amount::Percent(usual_period(&map, placement.wrap));
    let period = of_diagonal(placement.period.unwrap_or(usual));
    let [w, h] = map.size().map(f64::from);
    let lengths = [
        period,
        if w > 1.0 && h > 1.0 {
            period * h / w
        } else {
            period
        },
    ];
    if !(amplitude.is_finite() && lengths.iter().all(|l| l.is_finite() && *l > 0.0)) {
        return Err(format!(
            "amplitude {amplitude} and period {period} make no relief"
        ));
    }
    let shortest = lengths[0].min(lengths[1]);
    if let Some(what) = range::beside(amplitude, bounds) {
        return Err(format!("the amplitude {amplitude:.2e} is {what}"));
    }
    // The diagonal divided by the period is the number of map repeats across the model.
    if diagonal > 0.0 && shortest < diagonal / range::MOST_RADII {
        let (most, shortest) = (range::MOST_RADII, shortest);
        return Err(format!(
            "the period {shortest:.2e} is less than 1/{most:.0e} of the bounds' diagonal"
        ));
    }
    let [lo, hi] = map.range().map(f64::from);
    let frame = surface.frame();
    let (u, v) = (frame.u_hat * lengths[0], frame.v_hat * lengths[1]);
    let to_centre = bounds.centre() - surface.origin;
    let middle = surface.origin
        + frame.u_hat * to_centre.dot(frame.u_hat)
        + frame.v_hat * to_centre.dot(frame.v_hat);
    let height = if hi > lo {
        amplitude / (hi - lo)
    } else {
        amplitude
    };
    let surface = ClipSurface {
        // The surface lies at -f.Sz along N: the middle height must come to lie on the plane.
        origin: middle - (u + v) * 0.5 + frame.normal * (height * (lo + hi) * 0.5),
        u,
        v,
        scale: glam::DVec3::new(1.0, 1.0, height),
        relief: Some(map),
        wrap: placement.wrap,
    };
    match surface.defect_beside(bounds) {
        Some(what) => Err(what),
        None => Ok(surface),
    }
}
