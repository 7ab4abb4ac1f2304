//! The report of recorded runs in all its forms.

use cutaway::Result;

use super::chapters::{PictureOptions, document, method_document};
use super::document::{html, markdown};
use super::export::{csv, json};
use super::recorded::RecordedFolders;

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
pub fn pages(recorded: &RecordedFolders, pictures: &PictureOptions) -> Pages {
    let document = document(recorded, pictures);
    Pages {
        html: html(&document),
        markdown: markdown(&document),
        csv: csv(recorded),
        json: json(recorded),
    }
}

/// Report on one method, as a page and as text.
#[derive(Clone, Debug)]
pub struct MethodPages {
    /// One page with everything in it.
    pub html: String,
    /// The same tables as text.
    pub markdown: String,
}

/// Makes the page of one method at all points of some folders: its errors, its times, its memory, and what it refuses and why.
///
/// # Errors
///
/// Fails if no point used the method; the error names the methods that were used.
pub fn method_pages(recorded: &RecordedFolders, name: &str) -> Result<MethodPages> {
    let document = method_document(recorded, name)?;
    Ok(MethodPages {
        html: html(&document),
        markdown: markdown(&document),
    })
}
