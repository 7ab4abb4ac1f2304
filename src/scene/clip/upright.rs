//! The directions `U` and `V` in a plane, determined by its normal's direction alone.
//!
//! Seen from the removed side, as `render` and `section` show it, an image on the plane is upright and not mirrored: `U`
//! points right, and `V`, along which the rows of an image follow each other, points down. In a level plane, right is
//! the world's x axis.
//!
//! Notation: `N` normal, `P` up axis, `h = N.P`. Upright means `U = N x P`. As `N` approaches `P`, this has no limit, so `U` is blended
//! into the projection of the x axis while `|h|` grows from [`UPRIGHT`] to [`LEVEL`]. No tangent direction field on the sphere is
//! continuous everywhere (Poincaré 1885, Hopf 1927). This field is continuous except at one normal per hemisphere, neither of which lies in
//! a plane spanned by two axes: turning a normal through an axis, or from one axis to another, does not make the relief jump. The common
//! construction of Duff et al. 2017, *Building an orthonormal basis, revisited* (JCGT 6.1), jumps where `N.z` changes sign, even between
//! the two signed zeros.

use glam::DVec3;

use crate::scene::Up;

/// Up to this `|N.P|` planes are upright.
const UPRIGHT: f64 = 0.85;
/// From this `|N.P|` on planes are level.
const LEVEL: f64 = 0.98;

/// The unit vectors `U` and `V` of a plane with the unit normal `n`; exact if `n` is an axis.
pub(in crate::scene) fn directions(n: DVec3, up: Up) -> [DVec3; 2] {
    // Adding zero turns -0 into 0: the sign of a zero has no meaning here.
    let n = n + DVec3::ZERO;
    let up = up.axis();
    let upright = n.cross(up);
    let share = ((n.dot(up).abs() - UPRIGHT) / (LEVEL - UPRIGHT)).clamp(0.0, 1.0);
    let share = share * share * (3.0 - 2.0 * share);
    let u = if share > 0.0 {
        let level = DVec3::X - n * n.x;
        // Where the two directions are opposite, the third term keeps the sum away from 0, even for a normal between two axes.
        let aside = n.cross(upright);
        upright * (1.0 - share) + level * share + aside * (share * (1.0 - share))
    } else {
        upright
    };
    let u = u
        .try_normalize()
        .unwrap_or_else(|| n.any_orthonormal_vector());
    let v = n.cross(u).normalize_or(DVec3::Y);
    [u, v].map(|d| d + DVec3::ZERO)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const UPS: [Up; 2] = [Up::PlusY, Up::PlusZ];

    #[test]
    fn on_every_axis_it_is_upright_from_the_removed_side() {
        // A camera that sees the removed side looks along the normal: right is N x up.
        for (up, n, right, down) in [
            (Up::PlusY, DVec3::X, DVec3::Z, DVec3::NEG_Y),
            (Up::PlusY, DVec3::NEG_X, DVec3::NEG_Z, DVec3::NEG_Y),
            (Up::PlusY, DVec3::Y, DVec3::X, DVec3::NEG_Z),
            (Up::PlusY, DVec3::NEG_Y, DVec3::X, DVec3::Z),
            (Up::PlusY, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y),
            (Up::PlusY, DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y),
            (Up::PlusZ, DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z),
            (Up::PlusZ, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z),
            (Up::PlusZ, DVec3::Y, DVec3::X, DVec3::NEG_Z),
            (Up::PlusZ, DVec3::NEG_Y, DVec3::NEG_X, DVec3::NEG_Z),
            (Up::PlusZ, DVec3::Z, DVec3::X, DVec3::Y),
            (Up::PlusZ, DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y),
        ] {
            let [u, v] = directions(n, up);
            assert_eq!([u, v], [right, down], "{n}, {up:?}");
            assert_eq!(u.cross(v), n, "{n}, {up:?}");
        }
    }

    #[test]
    fn the_sign_of_a_zero_says_nothing() {
        for up in UPS {
            for axis in 0..3 {
                for sign in [1.0, -1.0] {
                    let plain = DVec3::AXES[axis] * sign + DVec3::ZERO;
                    let signed =
                        DVec3::from_array(std::array::from_fn(
                            |i| {
                                if i == axis { sign } else { -0.0 }
                            },
                        ));
                    let bits = |n| directions(n, up).map(|d| d.to_array().map(f64::to_bits));
                    assert_eq!(bits(plain), bits(signed), "{plain}, {up:?}");
                }
            }
        }
    }

    #[test]
    fn a_normal_that_turns_through_the_axes_does_not_make_it_jump() {
        const STEPS: u32 = 20_000;
        for up in UPS {
            for axis in 0..3 {
                let [a, b] = [1, 2].map(|i| DVec3::AXES[(axis + i) % 3]);
                let at = |step: u32| {
                    let turn = TAU * f64::from(step) / f64::from(STEPS);
                    directions((a * turn.cos() + b * turn.sin()).normalize(), up)
                };
                let most = (0..STEPS)
                    .map(|i| (at(i)[0] - at(i + 1)[0]).length())
                    .fold(0.0, f64::max);
                assert!(
                    most < 100.0 * TAU / f64::from(STEPS),
                    "{up:?}, around axis {axis}: it jumps by {most}"
                );
            }
        }
    }

    #[test]
    fn every_normal_has_a_frame() {
        let step = DVec3::new(0.754_877_666, 0.569_840_291, 0.322_185_355);
        for i in 1..20_000 {
            let n = ((step * f64::from(i)).fract() - 0.5).normalize();
            for up in UPS {
                let [u, v] = directions(n, up);
                let off = (u.cross(v) - n).length() + u.dot(n).abs() + u.dot(v).abs();
                assert!(off < 1e-12, "{n}, {up:?}: off by {off}");
                let tilt = n.dot(up.axis()).abs();
                assert!(
                    tilt > UPRIGHT || v.dot(up.axis()) < 0.0,
                    "{n}, {up:?}: not upright"
                );
            }
        }
    }
}
