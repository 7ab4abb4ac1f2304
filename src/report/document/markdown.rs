//! A report as Markdown, as code forges show it.

use super::{Block, Document, Gallery, gallery};
use crate::report::markdown::words;

/// The report as text.
pub(crate) fn markdown(document: &Document) -> String {
    let mut text = format!("# {}\n", words(&document.title));
    write(&mut text, &document.blocks);
    text
}

fn write(text: &mut String, blocks: &[Block]) {
    for block in blocks {
        text.push('\n');
        match block {
            Block::Heading(level, heading) => {
                let marks = "#".repeat(usize::from(*level));
                text.push_str(&format!("{marks} {}\n", words(heading)));
            }
            Block::Text(paragraph) => text.push_str(&format!("{}\n", words(paragraph))),
            Block::Prose(prose) => {
                let prose = super::prose::without_html(prose.trim());
                text.push_str(&format!("{prose}\n"));
            }
            Block::Grid(grid) => text.push_str(&grid.to_table().to_markdown()),
            Block::Notice(tone, notice) => {
                text.push_str(&format!("> **{}**: {}\n", mood(*tone), words(notice)));
            }
            Block::Command(command) => text.push_str(&fenced(command)),
            Block::Chart(chart) => {
                let note = chart.note.as_deref().unwrap_or_default();
                text.push_str(&format!(
                    "**{}** (drawn in the HTML report: {} against {}) {}\n",
                    words(&chart.title),
                    words(&chart.y.label),
                    words(&chart.x.label),
                    words(note)
                ));
            }
            Block::Bars(bars) => text.push_str(&bars.grid().to_table().to_markdown()),
            Block::Gallery(gallery) => pictures(text, gallery),
            Block::Folded {
                summary, blocks, ..
            } => {
                text.push_str(&format!("**{}**\n", words(summary)));
                write(text, blocks);
            }
        }
    }
}

fn mood(tone: super::Tone) -> &'static str {
    match tone {
        super::Tone::Bad => "Wrong",
        super::Tone::Good => "Right",
        _ => "Note",
    }
}

fn fenced(command: &str) -> String {
    let mut fence = "```".to_owned();
    while command.contains(&fence) {
        fence.push('`');
    }
    format!("{fence}sh\n{command}\n{fence}\n")
}

fn pictures(text: &mut String, gallery: &Gallery) {
    for shot in &gallery.shots {
        text.push_str(&format!(
            "- [{}]({}): {}\n",
            words(&shot.name),
            gallery::encoded(&shot.link),
            words(&shot.caption)
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_stay_in_their_fence() {
        assert_eq!(fenced("a ``` b"), "````sh\na ``` b\n````\n");
    }
}
