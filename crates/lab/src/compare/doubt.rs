//! Search for the marked pixels of a frame that may be wrong.
//!
//! A strategy marks pixels where the crossings of ray and mesh do not tell inside from outside. Only caps depend on inside and outside:
//! whether a surface is kept is decided by the clip-surfaces alone. So a marked pixel **may be wrong** if its ray passes from
//! the removed to the kept side within the bounds of a cut part, no farther away than what the pixel shows, or if the ray
//! starts within these bounds at a near plane that makes caps. Any other marked pixel shows the same whatever counts as inside.
//!
//! The test is conservative: it replaces a relief by the slab between its lowest and highest heights, and a cutter by its
//! bounds, so that every pixel that may be wrong is found.

use cutaway::layers::{Layer, Layers};
use cutaway::scene::{Bounds, Prepared, PreparedPart, PreparedSurface, View};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Relative tolerance of depth comparisons: the depths of frames are f32.
const SLACK: f64 = 1e-4;

/// Interval of depths along a ray; empty where the first is greater than the second.
type Stretch = [f64; 2];

const EVERYWHERE: Stretch = [f64::NEG_INFINITY, f64::INFINITY];
const NOWHERE: Stretch = [f64::INFINITY, f64::NEG_INFINITY];

fn both(a: Stretch, b: Stretch) -> Stretch {
    [a[0].max(b[0]), a[1].min(b[1])]
}

fn is_nowhere(stretch: Stretch) -> bool {
    stretch[0] > stretch[1]
}

/// For each pixel, true if it is marked and may be wrong.
pub fn may_be_wrong(layers: &Layers, prepared: &Prepared, view: &View) -> Vec<bool> {
    let width = layers.size_px[0] as usize;
    let pixels = layers.pixels.par_iter().enumerate();
    let doubted = pixels.map(|(i, pixel)| {
        let at = DVec2::new((i % width) as f64, (i / width) as f64) + 0.5;
        pixel.unreliable && depends_on_inside(pixel, view.ray(at), prepared, view)
    });
    doubted.collect()
}

fn depends_on_inside(pixel: &Layer, ray: (DVec3, DVec3), prepared: &Prepared, view: &View) -> bool {
    let limit = pixel.depth * (1.0 + SLACK);
    prepared.parts.iter().any(|part| {
        let within = through(&part.bounds, ray);
        let seen = both(within, [view.near, limit]);
        if is_nowhere(seen) {
            return false;
        }
        let begins_within = view.near_cap && within[0] < view.near;
        begins_within || leaves_what_is_removed(part, ray, prepared, seen)
    })
}

fn leaves_what_is_removed(
    part: &PreparedPart,
    ray: (DVec3, DVec3),
    prepared: &Prepared,
    seen: Stretch,
) -> bool {
    part.cuts.iter().any(|cut| {
        let (mut perhaps, mut surely) = (EVERYWHERE, EVERYWHERE);
        for surface in &prepared.cuts[*cut].surfaces {
            let [p, s] = removed(&prepared.surfaces[*surface], ray);
            perhaps = both(perhaps, p);
            surely = both(surely, s);
        }
        if is_nowhere(perhaps) {
            return false;
        }
        if is_nowhere(surely) {
            return !is_nowhere(both(perhaps, seen));
        }
        // Where the ray enters a relief's slab, it may already pass through one of the relief's bumps.
        let bumps = [perhaps[0], surely[0]];
        let passes_bumps = bumps[0] < bumps[1] && !is_nowhere(both(bumps, seen));
        passes_bumps || !is_nowhere(both([surely[1], perhaps[1]], seen))
    })
}

/// Two intervals of a ray: where it may be, and where it certainly is, on the removed side of a clip-surface.
fn removed(surface: &PreparedSurface, (origin, direction): (DVec3, DVec3)) -> [Stretch; 2] {
    if surface.volume.is_some() {
        return [EVERYWHERE, NOWHERE];
    }
    let at_eye = (origin - surface.origin).dot(surface.frame.normal);
    let step = direction.dot(surface.frame.normal);
    surface.slab().map(|height| {
        let at_eye = at_eye + height;
        if step > 0.0 {
            [f64::NEG_INFINITY, -at_eye / step]
        } else if step < 0.0 {
            [-at_eye / step, f64::INFINITY]
        } else if at_eye < 0.0 {
            EVERYWHERE
        } else {
            NOWHERE
        }
    })
}

/// Interval of a ray within a box.
fn through(bounds: &Bounds, (origin, direction): (DVec3, DVec3)) -> Stretch {
    (0..3).fold(EVERYWHERE, |stretch, axis| {
        let (at, step) = (origin[axis], direction[axis]);
        let [low, high] = [bounds.min[axis], bounds.max[axis]];
        if step == 0.0 {
            let is_beside = at < low || at > high;
            return if is_beside { NOWHERE } else { stretch };
        }
        let [a, b] = [low, high].map(|bound| (bound - at) / step);
        both(stretch, [a.min(b), a.max(b)])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hard_cases::scenes;
    use cutaway::layers::Kind;

    /// Marks every pixel of a row through the middle of a cube; for each, true if it may be wrong. `shown` is the depth of all pixels.
    fn row(sections: &[&str], shown: Option<f64>) -> Vec<bool> {
        let mut scene = scenes::sectioned("cube", sections);
        scene.camera = scenes::parallel(DVec3::Z * 4.0, DVec3::ZERO, 0.2);
        let prepared = Prepared::new(&scene);
        let view = prepared.view([10, 1]);
        let mut layers = Layers::background([10, 1]);
        for pixel in &mut layers.pixels {
            pixel.unreliable = true;
            if let Some(depth) = shown {
                pixel.kind = Kind::Surface;
                pixel.depth = depth * prepared.scale;
            }
        }
        layers.pixels[9].unreliable = false;
        may_be_wrong(&layers, &prepared, &view)
    }

    fn count(of: &[bool]) -> usize {
        of.iter().filter(|w| **w).count()
    }

    #[test]
    fn only_what_a_cap_could_cover_counts() {
        // The picture is 2 units wide, the cube 1 unit. Of its columns 4 lie within, and 2 and 7 lie on its edges. One pixel is not marked.
        let behind = row(&["-z=0"], None);
        assert_eq!(
            count(&behind),
            4 + usize::from(behind[2]) + usize::from(behind[7])
        );
        assert!(behind[4] && !behind[0] && !behind[9], "{behind:?}");
        // A cap at the section can hide only what is behind the section: nothing shown at depth 3.6, everything shown at depth 4.4.
        assert_eq!(count(&row(&["-z=0"], Some(3.6))), 0);
        assert_eq!(row(&["-z=0"], Some(4.4)), behind);
        // Seen from the kept side, no ray passes from removed to kept. Where the section misses the cube, no ray does either.
        assert_eq!(count(&row(&["z=0"], None)), 0);
        assert_eq!(count(&row(&["-z=0.7"], None)), 0);
        // Half of the cube is removed along these rays.
        assert!(count(&row(&["-z=0", "x=0"], None)) < count(&behind));
    }
}
