//! Range of the numbers in a scene within which no computation overflows.
//!
//! Volumes and exact signs multiply three coordinates, in f64. Devices compute in f32, in units of the model's radius.

use crate::scene::Bounds;

/// Largest magnitude of coordinates and other numbers in a scene: the product of three is still finite.
pub const LARGEST: f64 = 1e100;

/// Smallest nonzero length, for the same reason.
pub const SMALLEST: f64 = 1e-100;

/// Greatest distance in radii of the model: farther away, coordinates overflow f32 in the model's space.
pub const MOST_RADII: f64 = 1e30;

/// Returns an error text if a box is too large or too small to compute with.
pub fn defect(of: &Bounds) -> Option<String> {
    if of.is_empty() {
        return None;
    }
    let farthest = of.min.abs().max(of.max.abs()).max_element();
    let widest = of.size().max_element();
    // NaN is in no range.
    if !(0.0..=LARGEST).contains(&farthest) {
        return Some(format!("reaches to {farthest:.0e}, beyond {LARGEST:.0e}"));
    }
    (widest > 0.0 && widest < SMALLEST)
        .then(|| format!("is {widest:.0e} wide, less than {SMALLEST:.0e}"))
}

/// Returns an error text if a length in the world is out of range relative to a model with these bounds.
pub fn beside(length: f64, model: &Bounds) -> Option<String> {
    let radius = model.radius();
    let radii = length.abs() / if radius > 0.0 { radius } else { 1.0 };
    // NaN is in no range.
    (!(0.0..=MOST_RADII).contains(&radii))
        .then(|| format!("{radii:.0e} radii of the model, more than {MOST_RADII:.0e}"))
}
