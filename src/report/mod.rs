//! What a measurement found, in the forms people read it in.
//!
//! [`text`] makes a table of a [`Measurement`](crate::experiment::Measurement) for a terminal, [`markdown`] one for a page, and
//! [`html`] one file with the pictures in it, which opens from disk and asks no network.

mod html;
mod markdown;
mod section;
mod svg;
mod table;
mod text;

pub use html::{Figure, html};
pub use markdown::markdown;
pub use section::{Curve, Drawn, PartReport, PlaneReport, SectionReport};
pub use svg::{Unit, svg};
pub use table::Table;
pub use text::text;
