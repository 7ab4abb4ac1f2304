//! Contents of a report, one file for each section; [`super::document`] does the layout.

mod advice;
mod broken;
mod cases;
mod charts;
mod costs;
mod expectations;
mod experiments;
mod figures;
mod fronts;
mod glossary;
mod head;
mod made;
mod matrix;
mod method;
mod pictures;
mod point;
mod series;
mod styles;
mod warnings;

pub(super) use method::method_document;
pub use pictures::PictureOptions;

use super::document::{ReportBlock, ReportDocument};
use super::recorded::RecordedFolders;
use point::Points;

/// Makes the content of the report on some folders.
pub(super) fn document(recorded: &RecordedFolders, options: &PictureOptions) -> ReportDocument {
    let points = Points::of(recorded);
    let pictures = pictures::Galleries::of(&points, options);
    let mut blocks = head::notices(recorded, &points, &pictures);
    for (heading, section) in [
        ("What should I use?", advice::answers::chapter(&points)),
        ("Strategies by scenes", matrix::chapter(&points)),
        (
            "Experiments",
            experiments::chapter(recorded, &points, &pictures),
        ),
        ("Hard cases", cases::chapter(recorded)),
        ("Outside baselines", advice::outside::chapter(recorded)),
        ("What the words mean", glossary::chapter(recorded)),
        ("What was run", head::chapter(recorded)),
        ("How it was made", made::chapter(recorded, &pictures)),
    ] {
        if !section.is_empty() {
            blocks.push(ReportBlock::Heading(2, heading.to_owned()));
            blocks.extend(section);
        }
    }
    ReportDocument {
        title: "What accuracy costs".to_owned(),
        blocks,
    }
}
