//! A report as a list of blocks, and the two formats in which it is written.
//!
//! Sections define the content; [`html`] and [`markdown`] define its format. Both formats are made from the same blocks, so that they have
//! the same content, except where text cannot show it: in Markdown, the tables around a chart replace the chart.
//!
//! The text of blocks is plain: each output format escapes it in one place, where it is written. A stretch between
//! backticks is code.

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
/// Its sections begin with headings of level 2, to which a row of links, always visible, leads. Each section lists its
/// headings of level 3 at its beginning.
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
    /// Markdown written by people, not generated.
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
    /// Time of each strategy, broken down by clock and pass.
    Bars(Bars),
    /// Pictures of one frame.
    Gallery(Gallery),
    /// Legend of the heat map colours.
    Swatches(Vec<Swatch>),
    /// Blocks of equal width, side by side if there is room.
    Cards(Vec<Vec<Self>>),
    /// Content shown on demand.
    Folded {
        /// The line that is always shown.
        summary: String,
        /// True if the content is shown initially.
        open: bool,
        /// Content.
        blocks: Vec<Self>,
    },
}

/// Splits a text into stretches, each with a flag that is true for code.
pub(super) fn stretches(text: &str) -> impl Iterator<Item = (bool, &str)> {
    // An unpaired backtick is an ordinary character.
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
