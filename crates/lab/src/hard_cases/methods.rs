//! The methods that draw the hard cases.
//!
//! One method per family, with parameters suited to pictures of a few hundred pixels. All methods draw the small pictures. The large
//! pictures are drawn by few methods, where results do not depend on the size.

use cutaway::strategies::Method;
use cutaway::strategies::table::{CAP_SURFACES, INSIDE_TESTS};

/// Maximum side length, in pixels, of pictures that all methods draw.
const SMALL_PX: u32 = 64;

/// Side length, in pixels, of the larger pictures.
const LARGE_PX: u32 = 256;

/// All methods that draw pictures of `size_px` pixels along a side.
pub fn usual_methods(size_px: u32) -> Vec<Method> {
    names()
        .filter(|(_, is_large)| size_px <= SMALL_PX || *is_large)
        .filter_map(|(name, _)| name.parse().ok())
        .collect()
}

/// The names of all methods; each has true if the method also draws large pictures.
fn names() -> impl Iterator<Item = (&'static str, bool)> {
    let surfaces = CAP_SURFACES.iter().map(|row| &row.facts);
    let tests = INSIDE_TESTS.iter().map(|row| &row.facts);
    let cases = tests.chain(surfaces).flat_map(|facts| facts.hard_cases);
    cases.copied()
}

/// Side lengths of the pictures that a method usually draws.
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
