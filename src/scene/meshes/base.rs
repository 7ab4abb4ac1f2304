//! Finds the up axis of a mesh whose file does not state it: the axis along which it stands on a flat base.
//!
//! The measure is the area of downward faces in the lowest plane perpendicular to an axis. A printed or machined part has such a base
//! along the up axis of its design, and usually none, or a smaller one, along other axes. A mesh without a base, such as a scan, keeps
//! its format's default. Cannot: recognise a part that lies on its side. Cost: one pass over the triangles.

use glam::DVec3;

use crate::scene::{Bounds, Part, Up};

/// Greatest distance of a base face from the lowest plane, as a share of the diagonal.
const THIN: f64 = 1e-3;

/// Smallest base area that counts, as a share of the box's cross-section perpendicular to the axis.
const LEAST_BASE: f64 = 0.02;

/// The other axis is chosen if its base is at least this many times as large as that of the default axis.
const CLEARLY: f64 = 2.5;

/// Up axis found from the parts' base; the default `habit` if no axis stands out.
pub fn standing_up(parts: &[Part], habit: Up) -> Up {
    let bounds = parts.iter().map(Part::bounds_in_world);
    let bounds = bounds.fold(Bounds::EMPTY, Bounds::union);
    let [y, z] = [1, 2].map(|axis| base(parts, &bounds, axis));
    let [by_habit, other] = match habit {
        Up::PlusY => [y, z],
        Up::PlusZ => [z, y],
    };
    let is_other = other > CLEARLY * by_habit;
    match (habit, is_other) {
        (Up::PlusY, true) | (Up::PlusZ, false) => Up::PlusZ,
        (Up::PlusZ, true) | (Up::PlusY, false) => Up::PlusY,
    }
}

/// Area of the base perpendicular to an axis, or 0 if it is negligible.
fn base(parts: &[Part], bounds: &Bounds, axis: usize) -> f64 {
    let most = bounds.min[axis] + THIN * bounds.size().length();
    let mut area = 0.0;
    for part in parts {
        area += part.mesh.sum_of_triangles(|corners| {
            let place = |p: DVec3| part.world_from_part.transform_point3(p);
            // One high corner rules a triangle out, as it does most of them.
            if !corners.iter().all(|p| place(*p)[axis] <= most) {
                return 0.0;
            }
            let [a, b, c] = corners.map(place);
            (-0.5 * (b - a).cross(c - a)[axis]).max(0.0)
        });
    }
    let size = bounds.size();
    let across = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    if area < LEAST_BASE * across {
        0.0
    } else {
        area
    }
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;
    use crate::generate::shapes::shape;

    /// A shape with its y axis rotated to another axis.
    fn turned(name: &str, by: DAffine3) -> Vec<Part> {
        let mut parts = shape(name).expect(name);
        for part in &mut parts {
            part.world_from_part = by * part.world_from_part;
        }
        parts
    }

    #[test]
    fn what_stands_on_a_flat_base_stands_upright() {
        let habits = [Up::PlusY, Up::PlusZ];
        // A slab lies on its large face, whatever the default.
        for habit in habits {
            for (size, expected) in [
                (DVec3::new(3.0, 0.2, 2.0), Up::PlusY),
                (DVec3::new(3.0, 2.0, 0.2), Up::PlusZ),
            ] {
                let slab = turned("cube", DAffine3::from_scale(size));
                assert_eq!(standing_up(&slab, habit), expected, "{size}, {habit:?}");
            }
            // Without a base, or with equally large ones along both axes, the default is used.
            assert_eq!(
                standing_up(&turned("cube", DAffine3::IDENTITY), habit),
                habit
            );
            assert_eq!(
                standing_up(&turned("sphere", DAffine3::IDENTITY), habit),
                habit
            );
            assert_eq!(standing_up(&[], habit), habit);
        }
    }
}
