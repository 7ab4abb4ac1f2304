//! Background behind the model.

use crate::scene::style::Paper;

/// Path of the file that fills the open module `cutaway::backdrop`.
pub(super) fn backdrop(paper: Paper) -> &'static str {
    match paper {
        Paper::Gradient => "lib/backdrop/gradient.wgsl",
        Paper::Color(_) | Paper::None => "lib/backdrop/paper.wgsl",
    }
}
