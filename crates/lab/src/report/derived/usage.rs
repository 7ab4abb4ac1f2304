//! Command line of a recorded strategy, and its limits.
//!
//! Records use the names of `cutaway compare`, which accepts more than `cutaway render`: `winding` draws no picture, and the draw
//! options after an `@` are separate options of `cutaway render`.

use cutaway::passes::{Rasteriser, ReliefWalk};
use cutaway::scene::HeightFilter;
use cutaway::strategies::Method;

/// What follows `cutaway render --strategy` to select a strategy, and the strategy's limit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Usage {
    /// The strategy's name, and its draw options as further options.
    pub words: String,
    /// Limit of the strategy.
    pub limit: Option<&'static str>,
}

/// The usage of a strategy, given its name in records; `None` if `cutaway render` cannot draw with it.
///
/// How rays walk through a relief is not an option of `cutaway render`, which chooses it automatically; so the limit names it.
pub(crate) fn usage(name: &str) -> Option<Usage> {
    let Ok(Method { strategy, options }) = name.parse() else {
        return None;
    };
    if options.wide_atomics == Some(false) || options.list == Some(true) {
        return None;
    }
    let mut words = strategy.to_string();
    if options.rasteriser == Some(Rasteriser::Compute) {
        words.push_str(" --rasteriser compute");
    }
    if options.height_filter == Some(HeightFilter::Hardware) {
        words.push_str(" --height-filter hardware");
    }
    let limit = match options.relief_walk {
        Some(ReliefWalk::Cells) => Some("cell by cell, chosen automatically where that pays off"),
        Some(ReliefWalk::Pyramid) => {
            Some("over the pyramid, chosen automatically where that pays off")
        }
        None => Some(strategy.limit()).filter(|limit| !limit.is_empty()),
    };
    Some(Usage { words, limit })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_records_become_words_of_render() {
        for (name, words, limit) in [
            ("raycast+mask", "raycast+mask", None),
            (
                "raycast+mask@compute",
                "raycast+mask --rasteriser compute",
                None,
            ),
            ("stencil", "stencil", Some("one plane, eye outside the cut")),
            ("planar", "planar", Some("planes only")),
            (
                "raycast+mask@pyramid",
                "raycast+mask",
                Some("over the pyramid, chosen automatically where that pays off"),
            ),
            (
                "grid:64+vds:512@hardware-filter",
                "grid:64+vds:512 --height-filter hardware",
                None,
            ),
        ] {
            let words = words.to_owned();
            assert_eq!(usage(name), Some(Usage { words, limit }), "{name}");
        }
        for name in ["winding", "raycast+mask@compute,32-bit", "no such thing"] {
            assert_eq!(usage(name), None, "{name}");
        }
    }
}
