//! Periodic noise from integer hashes: the same seed gives the same texels on every machine.
//!
//! Lattice coordinates are taken modulo the period before they are hashed, so noise with a whole number of lattice cells
//! across the map has no seam under [`Wrap::Repeat`](crate::scene::Wrap::Repeat). Gradients come from the hash's bits,
//! not from sines, whose last digits differ between platforms.

use glam::DVec2;

/// Hash of a lattice point and a seed (the finaliser of MurmurHash3, applied after each input).
pub(super) fn hash(x: i64, y: i64, seed: u64) -> u64 {
    let mut h = seed ^ 0x9E37_79B9_7F4A_7C15;
    for word in [x, y] {
        h ^= word.cast_unsigned().wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        h = (h ^ (h >> 33)).wrapping_mul(0xFF51_AFD7_ED55_8CCD);
        h = (h ^ (h >> 33)).wrapping_mul(0xC4CE_B9FE_1A85_EC53);
        h ^= h >> 33;
    }
    h
}

/// Two numbers in 0..1 from the two halves of a hash.
pub(super) fn pair(hash: u64) -> DVec2 {
    let unit = |bits: u64| f64::from((bits & 0xFFFF_FFFF) as u32) / 4_294_967_296.0;
    DVec2::new(unit(hash >> 32), unit(hash))
}

/// Gradient noise of about -1..1 with one lattice point per unit, repeating after `period` units on each axis.
pub(super) fn gradient(p: DVec2, period: [u32; 2], seed: u64) -> f64 {
    let [nx, ny] = period.map(i64::from);
    let cell = p.floor();
    let l = p - cell;
    let (x, y) = (cell.x as i64, cell.y as i64);
    let corner = |i: i64, j: i64| {
        let slope = pair(hash((x + i).rem_euclid(nx), (y + j).rem_euclid(ny), seed)) * 2.0 - 1.0;
        slope.dot(l - DVec2::new(i as f64, j as f64))
    };
    // Perlin's quintic: its second derivative vanishes at lattice points, so they do not show as creases.
    let fade = l * l * l * (l * (l * 6.0 - 15.0) + 10.0);
    let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
    lerp(
        lerp(corner(0, 0), corner(1, 0), fade.x),
        lerp(corner(0, 1), corner(1, 1), fade.x),
        fade.y,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_noise_repeats_after_its_period_and_depends_on_the_seed() {
        for i in 0..200 {
            let p = pair(hash(i, 1, 5)) * 7.0;
            let here = gradient(p, [7, 5], 3);
            for shift in [DVec2::new(7.0, 0.0), DVec2::new(-7.0, 10.0)] {
                let there = gradient(p + shift, [7, 5], 3);
                assert!((here - there).abs() < 1e-12, "{here} is not {there} at {p}");
            }
            assert!(here.abs() <= 1.5, "{here} at {p}");
        }
        let p = DVec2::new(0.3, 0.6);
        assert!(
            (gradient(p, [7, 5], 3) - gradient(p, [7, 5], 4)).abs() > 1e-6,
            "the seed does nothing"
        );
    }
}
