//! The report on recorded runs, in all its formats.

use cutaway::Result;

use super::chapters::{PictureOptions, document, method_document};
use super::document::{html, markdown};
use super::export::{csv, json};
use super::recorded::RecordedFolders;

/// The formats of a report, each as the text of a file.
#[derive(Clone, Debug)]
pub struct Pages {
    /// One page with everything in it.
    pub html: String,
    /// The same content as Markdown.
    pub markdown: String,
    /// One row for each point and strategy, with every figure.
    pub csv: String,
    /// All records, and the values derived from them.
    pub json: String,
}

/// Makes the report on some folders of runs.
pub fn pages(recorded: &RecordedFolders, pictures: &PictureOptions) -> Pages {
    let document = document(recorded, pictures);
    Pages {
        html: html(&document),
        markdown: markdown(&document),
        csv: csv(recorded),
        json: json(recorded),
    }
}

/// Report on one method, as an HTML page and as Markdown.
#[derive(Clone, Debug)]
pub struct MethodPages {
    /// One page with everything in it.
    pub html: String,
    /// The same content as Markdown.
    pub markdown: String,
}

/// Makes the report on one method over all points of some folders: its errors, times, memory, and what it refuses and why.
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
