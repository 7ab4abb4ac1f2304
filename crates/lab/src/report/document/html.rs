//! A report as one HTML file: it contains style, script and pictures, and fetches nothing.
//!
//! All content is visible without the script, which adds sorting, copying and the slider. The template escapes all text. Markup is inserted
//! unescaped only if a template produced it or [`super::prose`] sanitised it.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Cell, Grid, ReportBlock, ReportDocument, gallery, stretches, width};

const PAGE_STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Cells longer than this may be broken into lines.
const LONG_CELL: usize = 60;

/// The report as a page.
pub(crate) fn html(document: &ReportDocument) -> String {
    let mut writer = HtmlWriter::of(&document.blocks);
    let body = writer.all(&document.blocks);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                link rel="icon" href="data:,";
                title { (document.title) }
                style { (PreEscaped(PAGE_STYLE)) }
            }
            body id="top" {
                nav.sections aria-label="sections" { (writer.sections()) }
                header { h1 { (document.title) } }
                main { (body) }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// A heading with its anchor.
struct Anchor {
    level: u8,
    id: String,
    text: String,
}

/// Unique anchors for all headings of some blocks, in order.
fn anchors(blocks: &[ReportBlock], found: &mut Vec<Anchor>) {
    for block in blocks {
        match block {
            ReportBlock::Heading(level, text) => {
                let words: Vec<String> = text
                    .split(|c: char| !c.is_ascii_alphanumeric())
                    .filter(|w| !w.is_empty())
                    .map(str::to_lowercase)
                    .collect();
                let base = format!("s-{}", words.join("-"));
                let is_taken = |id: &str| found.iter().any(|a| a.id == id);
                let id = (0..)
                    .map(|n| match n {
                        0 => base.clone(),
                        n => format!("{base}-{n}"),
                    })
                    .find(|id| !is_taken(id))
                    .unwrap_or(base);
                found.push(Anchor {
                    level: *level,
                    id,
                    text: text.clone(),
                });
            }
            ReportBlock::Folded { blocks, .. } => anchors(blocks, found),
            ReportBlock::Cards(cards) => cards.iter().for_each(|c| anchors(c, found)),
            _ => {}
        }
    }
}

/// Writes blocks in their order.
struct HtmlWriter {
    /// Anchors of all headings.
    anchors: Vec<Anchor>,
    /// Number of headings written so far.
    headings: usize,
    /// Number of galleries written so far.
    galleries: usize,
}

impl HtmlWriter {
    fn of(blocks: &[ReportBlock]) -> Self {
        let mut found = Vec::new();
        anchors(blocks, &mut found);
        Self {
            anchors: found,
            headings: 0,
            galleries: 0,
        }
    }

    /// Links to the top of the page and to the sections.
    fn sections(&self) -> Markup {
        html! {
            a href="#top" { "↑ top" } "\n"
            @for anchor in self.anchors.iter().filter(|a| a.level == 2) {
                a href={ "#" (anchor.id) } { (anchor.text) } "\n"
            }
        }
    }

    fn all(&mut self, blocks: &[ReportBlock]) -> Markup {
        html! {
            @for block in blocks { (self.one(block)) "\n" }
        }
    }

    fn heading(&mut self, level: u8, text: &str) -> Markup {
        let place = self.headings;
        self.headings += 1;
        let (id, text) = (&self.anchors[place].id, inline(text));
        let below = self.anchors[place + 1..].iter();
        let below = below.take_while(|a| level == 2 && a.level > 2);
        let below: Vec<&Anchor> = below.filter(|a| a.level == 3).collect();
        html! {
            @match level {
                2 => { h2 id=(id) { (text) } }
                3 => { h3 id=(id) { (text) } }
                4 => { h4 id=(id) { (text) } }
                _ => { h5 id=(id) { (text) } }
            }
            @if below.len() > 1 {
                nav.below aria-label="in this section" {
                    @for anchor in below { a href={ "#" (anchor.id) } { (anchor.text) } "\n" }
                }
            }
        }
    }

    fn one(&mut self, block: &ReportBlock) -> Markup {
        match block {
            ReportBlock::Heading(level, text) => self.heading(*level, text),
            ReportBlock::Gallery(gallery) => {
                self.galleries += 1;
                gallery.html(self.galleries)
            }
            ReportBlock::Cards(cards) => html! {
                div.cards {
                    @for card in cards { div.card { (self.all(card)) } }
                }
            },
            ReportBlock::Folded {
                summary,
                open,
                blocks,
            } => html! {
                details open[*open] {
                    summary { (inline(summary)) }
                    (self.all(blocks))
                }
            },
            other => plain(other),
        }
    }
}

/// Writes a block that contains no other blocks and needs no number.
fn plain(block: &ReportBlock) -> Markup {
    match block {
        ReportBlock::Text(text) => html! { p { (inline(text)) } },
        ReportBlock::Prose(text) => html! { div.prose { (PreEscaped(super::prose::prose(text))) } },
        ReportBlock::Grid(table) => html! {
            @for piece in width::pieces(table) { (grid(&piece)) }
        },
        ReportBlock::Notice(tone, text) => {
            html! { p class={ "notice " (tone.name()) } { (inline(text)) } }
        }
        ReportBlock::Command(text) => html! { div.command { pre { (text) } } },
        ReportBlock::Chart(chart) => html! {
            figure.chart {
                figcaption { (inline(&chart.title)) }
                (chart.html())
                @if let Some(note) = &chart.note { p { (inline(note)) } }
            }
        },
        ReportBlock::Ranking(ranking) => ranking.html(),
        ReportBlock::Bars(bars) => bars.html(),
        ReportBlock::Swatches(all) => gallery::swatches(all),
        ReportBlock::Heading(..)
        | ReportBlock::Gallery(_)
        | ReportBlock::Cards(_)
        | ReportBlock::Folded { .. } => Markup::default(),
    }
}

/// Plain text in which stretches between backticks are code.
fn inline(text: &str) -> Markup {
    html! {
        @for (is_code, piece) in stretches(text) {
            @if is_code { code { (piece) } } @else { (piece) }
        }
    }
}

fn grid(grid: &Grid) -> Markup {
    // In a column with numbers, all cells are aligned like numbers, including the heading and empty cells.
    let is_number = |column: usize| grid.rows.iter().any(|row| row[column].key.is_some());
    html! {
        div.scroll tabindex="0" role="region" aria-label=(grid.label) {
            table.grid {
                thead {
                    tr {
                        @for (column, cell) in grid.heading.iter().enumerate() {
                            @let class = is_number(column).then_some("number");
                            th scope="col" class=[class] title=[&cell.title] { (breakable(&cell.text)) }
                        }
                    }
                }
                tbody {
                    @for cells in &grid.rows { (row(cells)) "\n" }
                }
            }
        }
    }
}

/// Text that may break into lines after a `+`, `@` or `,`, as in method names.
pub(super) fn breakable(text: &str) -> Markup {
    html! {
        @for (index, piece) in width::breaks(text).enumerate() {
            @if index > 0 { wbr; }
            (inline(piece))
        }
    }
}

fn row(cells: &[Cell]) -> Markup {
    let class = |cell: &Cell| match cell.key {
        Some(_) => format!("{} number", cell.tone.name()),
        None if cell.text.chars().count() > LONG_CELL => format!("{} words", cell.tone.name()),
        None => cell.tone.name().to_owned(),
    };
    html! {
        tr {
            @for (i, cell) in cells.iter().enumerate() {
                @let key = cell.key.filter(|k| k.is_finite());
                @if i == 0 {
                    th scope="row" class=(class(cell)) data-key=[key] title=[&cell.title] { (inline(&cell.text)) }
                } @else {
                    td class=(class(cell)) data-key=[key] title=[&cell.title] { (inline(&cell.text)) }
                }
            }
        }
    }
}
