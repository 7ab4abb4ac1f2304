//! A report as a list of blocks, and the two forms it is written in.
//!
//! Sections define the content; [`html`] and [`markdown`] define its form. Both are made from the same blocks, so that they have the same
//! content, except what text cannot show: there the tables around a chart replace it.
//!
//! Words of a block are plain: each output form escapes the text of records in one place, where it is written. A stretch
//! between backticks is code.

mod axis;
mod bars;
mod chart;
mod ends;
mod gallery;
mod grid;
mod html;
mod markdown;
mod marker;
mod prose;
mod ranking;
mod width;

pub(super) use bars::{Bar, Bars, Segment};
pub(super) use chart::{Chart, ChartAxis, Mark, Panel, Series};
pub(super) use gallery::{Gallery, GalleryImage, PictureLocation, Shot, Swatch};
pub(super) use grid::{Cell, Grid, Tone};
pub(super) use html::html;
pub(super) use markdown::markdown;
pub(super) use ranking::{Line, Ranking};

/// A report.
///
/// Its sections are headings of level 2, in a row of links that stays visible; below them are headings of
/// level 3, which each section lists at its beginning.
#[derive(Clone, Debug, Default)]
pub(super) struct ReportDocument {
    pub title: String,
    /// Contents, in order.
    pub blocks: Vec<ReportBlock>,
}

/// A block of a report.
#[derive(Clone, Debug)]
pub(super) enum ReportBlock {
    /// A heading of a level from 2 to 5.
    Heading(u8, String),
    /// A paragraph.
    Text(String),
    /// Markdown that people wrote.
    Prose(String),
    /// A table.
    Grid(Grid),
    /// A highlighted notice.
    Notice(Tone, String),
    /// A command line to copy.
    Command(String),
    Chart(Chart),
    /// A list of methods with their costs.
    Ranking(Ranking),
    /// Time of each strategy, by clock and pass.
    Bars(Bars),
    /// Pictures of one frame.
    Gallery(Gallery),
    /// Legend of the colours of pictures.
    Swatches(Vec<Swatch>),
    /// Blocks of equal width, side by side if there is room.
    Cards(Vec<Vec<Self>>),
    /// Content shown on demand.
    Folded {
        /// The line that is always shown.
        summary: String,
        /// True if it is open from the start.
        open: bool,
        /// Content.
        blocks: Vec<Self>,
    },
}

/// Stretches of a text: code or not.
pub(super) fn stretches(text: &str) -> impl Iterator<Item = (bool, &str)> {
    // A lone backtick is one.
    let is_paired = text.matches('`').count().is_multiple_of(2);
    let pieces: Vec<&str> = if is_paired {
        text.split('`').collect()
    } else {
        vec![text]
    };
    pieces
        .into_iter()
        .enumerate()
        .map(|(i, piece)| (i % 2 == 1, piece))
        .filter(|(_, piece)| !piece.is_empty())
}
