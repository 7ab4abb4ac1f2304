//! Results of measurements, in human-readable forms.
//!
//! [`text`] formats a [`Measurement`](crate::experiment::Measurement) as a table for a terminal. [`pages`] makes a report of recorded runs:
//! `recorded` reads the runs, `derived` computes what no record holds, `chapters` define the content, and `document` writes the content
//! as Markdown and as an HTML page, which opens from disk without network access; `export` writes machine-readable files.

mod chapters;
mod derived;
mod document;
mod errors;
mod export;
mod look;
mod number;
mod pages;
mod recorded;
mod table;
mod text;

pub use chapters::PictureOptions;
pub use pages::{MethodPages, Pages, method_pages, pages};
pub use recorded::{Experiment, Folder, PeerCheck, PeerRecord, PeerRow, RecordedFolders};
pub use table::TextTable;
pub use text::text;
