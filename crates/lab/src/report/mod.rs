//! Results of measurements, in human-readable forms.
//!
//! [`text`] makes a table of a [`Measurement`](crate::experiment::Measurement) for a terminal. Of recorded runs [`pages`] makes a report:
//! `recorded` reads them, `derived` works out what no record has, `sections` say it, and `document` writes it down as a page, which
//! opens from disk and asks no network, and as Markdown; `export` is for machines.

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
