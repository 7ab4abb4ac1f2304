//! A report as Markdown, in the dialect of code hosting sites.

use super::{Cell, Gallery, Grid, ReportBlock, ReportDocument, Swatch, gallery, stretches, width};

/// The report as text.
pub(crate) fn markdown(document: &ReportDocument) -> String {
    let mut text = format!("# {}\n", words(&document.title));
    write(&mut text, &document.blocks);
    text
}

fn write(text: &mut String, blocks: &[ReportBlock]) {
    for block in blocks {
        text.push('\n');
        match block {
            ReportBlock::Heading(level, heading) => {
                let marks = "#".repeat(usize::from(*level));
                text.push_str(&format!("{marks} {}\n", words(heading)));
            }
            ReportBlock::Text(paragraph) => text.push_str(&format!("{}\n", words(paragraph))),
            ReportBlock::Prose(prose) => {
                let prose = super::prose::without_html(prose.trim());
                text.push_str(&format!("{prose}\n"));
            }
            ReportBlock::Grid(grid) => {
                let pieces = width::pieces(grid);
                let tables: Vec<String> = pieces.iter().map(table).collect();
                text.push_str(&tables.join("\n"));
            }
            ReportBlock::Notice(tone, notice) => {
                text.push_str(&format!("> **{}**: {}\n", mood(*tone), words(notice)));
            }
            ReportBlock::Command(command) => text.push_str(&fenced(command)),
            ReportBlock::Chart(chart) => {
                let note = chart.note.as_deref().unwrap_or_default();
                text.push_str(&format!(
                    "**{}** (drawn in the HTML report: {} against {}) {}\n",
                    words(&chart.title),
                    words(&chart.y.label),
                    words(&chart.x.label),
                    words(note)
                ));
            }
            ReportBlock::Ranking(ranking) => {
                text.push_str(&format!(
                    "**{}**: {}\n\n",
                    words(&ranking.title),
                    words(&ranking.axis)
                ));
                text.push_str(&table(&ranking.grid()));
            }
            ReportBlock::Swatches(swatches) => {
                for swatch in swatches {
                    let Swatch {
                        color,
                        name,
                        meaning,
                    } = swatch;
                    text.push_str(&format!(
                        "- {} (`{color}`): {}\n",
                        words(name),
                        words(meaning)
                    ));
                }
            }
            ReportBlock::Cards(cards) => cards.iter().for_each(|blocks| write(text, blocks)),
            ReportBlock::Bars(bars) => text.push_str(&table(&bars.grid())),
            ReportBlock::Gallery(gallery) => pictures(text, gallery),
            ReportBlock::Folded {
                summary, blocks, ..
            } => {
                text.push_str(&format!("**{}**\n", words(summary)));
                write(text, blocks);
            }
        }
    }
}

/// Escapes text so that nothing in it is markup except the code between backticks.
fn words(text: &str) -> String {
    stretches(text)
        .map(|(is_code, piece)| match is_code {
            true => format!("`{piece}`"),
            false => escaped(piece),
        })
        .collect()
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => escaped.push_str("&lt;"),
            '&' => escaped.push_str("&amp;"),
            '\\' | '*' | '[' | ']' | '`' => {
                escaped.push('\\');
                escaped.push(c);
            }
            '\n' => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

/// A table in GitHub's Markdown: the first column is aligned left, the others right.
fn table(grid: &Grid) -> String {
    let line = |cells: &[Cell]| {
        let cells = cells.iter().map(|c| words(&c.text).replace('|', "\\|"));
        format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
    };
    let others = "---:|".repeat(grid.heading.len().saturating_sub(1));
    let rows: String = grid.rows.iter().map(|row| line(row)).collect();
    format!("{}|---|{others}\n{rows}", line(&grid.heading))
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
        let errors = shot.errors.as_ref();
        let errors = errors.map_or_else(String::new, |e| {
            format!(", [errors]({})", gallery::encoded(&e.link))
        });
        text.push_str(&format!(
            "- [{}]({}){errors}: {}\n",
            words(&shot.name),
            gallery::encoded(&shot.picture.link),
            words(&shot.caption.text)
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_no_markup() {
        assert_eq!(words("a <b> *c* `d<e`"), "a &lt;b> \\*c\\* `d<e`");
        assert_eq!(words("one ` alone"), "one \\` alone");
        assert_eq!(words("&lt; \\*"), "&amp;lt; \\\\\\*");
    }

    #[test]
    fn columns_are_kept_apart() {
        let mut grid = Grid::new("", ["name", "µ"]);
        grid.row(["a|<b", "1"]);
        grid.row(["longer"]);
        assert_eq!(
            table(&grid),
            "| name | µ |\n|---|---:|\n| a\\|&lt;b | 1 |\n| longer |  |\n"
        );
    }

    #[test]
    fn commands_stay_in_their_fence() {
        assert_eq!(fenced("a ``` b"), "````sh\na ``` b\n````\n");
    }
}
