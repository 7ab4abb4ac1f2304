//! The report of recorded runs in all its forms.

use super::chapters::{PictureOptions, document};
use super::document::{html, markdown};
use super::export::{csv, json};
use super::recorded::Recorded;

/// The forms of a report, each the text of a file.
#[derive(Clone, Debug)]
pub struct Pages {
    /// One page with everything in it.
    pub html: String,
    /// The same tables as text.
    pub markdown: String,
    /// One row for each point and strategy, with every figure.
    pub csv: String,
    /// All records joined, and what is worked out of them.
    pub json: String,
}

/// Makes the report of some folders.
pub fn pages(recorded: &Recorded, pictures: &PictureOptions) -> Pages {
    let document = document(recorded, pictures);
    Pages {
        html: html(&document),
        markdown: markdown(&document),
        csv: csv(recorded),
        json: json(recorded),
    }
}
