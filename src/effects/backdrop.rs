//! Background behind the model.

use crate::scene::style::Paper;

/// The file that fills `cutaway::backdrop`.
pub(super) fn backdrop(paper: Paper) -> &'static str {
    match paper {
        Paper::Gradient => "lib/backdrop/gradient.wgsl",
        Paper::Color(_) | Paper::None => "lib/backdrop/paper.wgsl",
    }
}
