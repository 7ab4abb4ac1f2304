//! The methods that hard cases are drawn by.
//!
//! One of each family, with parameters that a picture of a few hundred pixels calls for. What does not depend on the size of a picture is
//! drawn at the smaller one by all, at the larger one by a few.

use cutaway::strategies::Method;
use cutaway::strategies::table::{CAP_SURFACES, INSIDE_TESTS};

/// Largest side, in pixels, of pictures that all methods draw.
const SMALL_PX: u32 = 64;

/// Side, in pixels, of the pictures that the others draw.
const LARGE_PX: u32 = 256;

/// All methods that draw pictures of `size_px` pixels along a side.
pub fn usual_methods(size_px: u32) -> Vec<Method> {
    names()
        .filter(|(_, is_large)| size_px <= SMALL_PX || *is_large)
        .filter_map(|(name, _)| name.parse().ok())
        .collect()
}

/// The names of all methods, and whether they draw large pictures too.
fn names() -> impl Iterator<Item = (&'static str, bool)> {
    let surfaces = CAP_SURFACES.iter().map(|row| &row.facts);
    let tests = INSIDE_TESTS.iter().map(|row| &row.facts);
    let cases = tests.chain(surfaces).flat_map(|facts| facts.hard_cases);
    cases.copied()
}

/// Sides of the pictures that the table usually has of a method.
pub(super) fn usual_sizes_px(method: &Method) -> &'static [u32] {
    let draws = |size_px| usual_methods(size_px).contains(method);
    match draws(SMALL_PX) && !draws(LARGE_PX) {
        true => &[SMALL_PX],
        false => &[SMALL_PX, LARGE_PX],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_that_of_a_method() {
        let all = usual_methods(SMALL_PX);
        assert_eq!(all.len(), names().count(), "a name is misspelt");
        for (method, (name, _)) in all.iter().zip(names()) {
            assert_eq!(method.to_string(), name);
        }
        let large = usual_methods(SMALL_PX + 1).len();
        assert!(large < all.len(), "{large} draw large pictures");
    }
}
