//! A report as one HTML file: style, script and pictures are in it, and nothing is fetched.
//!
//! Everything is there without the script, which adds sorting, copying and the slider. The template escapes all words; what goes in as it
//! is was made of words by a template, or tamed by [`super::prose`].

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Block, Cell, Document, Grid, stretches};

const PAGE_STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Cells longer than this may be broken into lines.
const LONG_CELL: usize = 60;

/// The report as a page.
pub(crate) fn html(document: &Document) -> String {
    let mut anchors = Anchors::default();
    let body = all(&document.blocks, &mut anchors);
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
            body {
                header {
                    h1 { (document.title) }
                    nav aria-label="sections" { (anchors.links()) }
                }
                main { (body) }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// Headings so far, with their anchors.
#[derive(Default)]
struct Anchors(Vec<(u8, String, String)>);

impl Anchors {
    /// An anchor that no other heading has.
    fn add(&mut self, level: u8, text: &str) -> String {
        let words: Vec<String> = text
            .split(|c: char| !c.is_ascii_alphanumeric())
            .filter(|w| !w.is_empty())
            .map(str::to_lowercase)
            .collect();
        let base = format!("s-{}", words.join("-"));
        let is_taken = |id: &str| self.0.iter().any(|(_, taken, _)| taken == id);
        let id = (0..)
            .map(|n| match n {
                0 => base.clone(),
                n => format!("{base}-{n}"),
            })
            .find(|id| !is_taken(id))
            .unwrap_or(base);
        self.0.push((level, id.clone(), text.to_owned()));
        id
    }

    /// Links to the sections and to what is right below them.
    fn links(&self) -> Markup {
        html! {
            @for (level, id, text) in self.0.iter().filter(|(level, ..)| *level <= 3) {
                a class=[(*level > 2).then_some("deep")] href={ "#" (id) } { (text) } "\n"
            }
        }
    }
}

fn all(blocks: &[Block], anchors: &mut Anchors) -> Markup {
    html! {
        @for block in blocks { (one(block, anchors)) "\n" }
    }
}

fn one(block: &Block, anchors: &mut Anchors) -> Markup {
    match block {
        Block::Heading(level, text) => {
            let (id, text) = (anchors.add(*level, text), inline(text));
            html! {
                @match level {
                    2 => { h2 id=(id) { (text) } }
                    3 => { h3 id=(id) { (text) } }
                    4 => { h4 id=(id) { (text) } }
                    _ => { h5 id=(id) { (text) } }
                }
            }
        }
        Block::Text(text) => html! { p { (inline(text)) } },
        Block::Prose(text) => html! { div.prose { (PreEscaped(super::prose::prose(text))) } },
        Block::Grid(table) => grid(table),
        Block::Notice(tone, text) => {
            html! { p class={ "notice " (tone.name()) } { (inline(text)) } }
        }
        Block::Command(text) => html! { div.command { pre { (text) } } },
        Block::Chart(chart) => html! {
            figure.chart {
                figcaption { (inline(&chart.title)) }
                div.scroll tabindex="0" role="region" aria-label="chart" { (chart.svg()) }
                (chart.legend())
                @if let Some(note) = &chart.note { p { (inline(note)) } }
            }
        },
        Block::Bars(bars) => bars.html(),
        Block::Gallery(gallery) => gallery.html(),
        Block::Folded {
            summary,
            open,
            blocks,
        } => html! {
            details open[*open] {
                summary { (inline(summary)) }
                (all(blocks, anchors))
            }
        },
    }
}

/// Words with code between backticks.
fn inline(text: &str) -> Markup {
    html! {
        @for (is_code, piece) in stretches(text) {
            @if is_code { code { (piece) } } @else { (piece) }
        }
    }
}

fn grid(grid: &Grid) -> Markup {
    // A column of numbers is aligned as such, heading and gaps included.
    let is_number = |column: usize| grid.rows.iter().any(|row| row[column].key.is_some());
    html! {
        div.scroll tabindex="0" role="region" aria-label=(grid.label) {
            table.grid {
                thead {
                    tr {
                        @for (column, cell) in grid.heading.iter().enumerate() {
                            @let class = is_number(column).then_some("number");
                            th scope="col" class=[class] title=[&cell.title] { (inline(&cell.text)) }
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
