//! A report as one HTML file: style, script and pictures are in it, and nothing is fetched.
//!
//! Everything is there without the script, which adds sorting, copying and the slider. All words are escaped here or by whoever draws a
//! block; none are trusted.

use super::{Block, Cell, Document, Grid, stretches};

const PAGE_STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Cells longer than this may be broken into lines.
const LONG_CELL: usize = 60;

/// The report as a page.
pub(crate) fn html(document: &Document) -> String {
    let mut anchors = Anchors::default();
    let mut body = String::new();
    for block in &document.blocks {
        write(&mut body, block, &mut anchors);
    }
    let title = escape(&document.title);
    let links: String = anchors.links();
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <link rel=\"icon\" href=\"data:,\">\n\
         <title>{title}</title>\n<style>\n{PAGE_STYLE}</style>\n</head>\n<body>\n\
         <header><h1>{title}</h1>\n<nav aria-label=\"sections\">\n{links}</nav></header>\n<main>\n{body}</main>\n\
         <script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    )
}

pub(in crate::report) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
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
    fn links(&self) -> String {
        let shown = self.0.iter().filter(|(level, ..)| *level <= 3);
        shown
            .map(|(level, id, text)| {
                let class = if *level > 2 { " class=\"deep\"" } else { "" };
                format!("<a{class} href=\"#{id}\">{}</a>\n", escape(text))
            })
            .collect()
    }
}

fn write(page: &mut String, block: &Block, anchors: &mut Anchors) {
    match block {
        Block::Heading(level, text) => {
            let id = anchors.add(*level, text);
            page.push_str(&format!(
                "<h{level} id=\"{id}\">{}</h{level}>\n",
                inline(text)
            ));
        }
        Block::Text(text) => page.push_str(&format!("<p>{}</p>\n", inline(text))),
        Block::Prose(text) => {
            let prose = super::prose::prose(text);
            page.push_str(&format!("<div class=\"prose\">\n{prose}</div>\n"));
        }
        Block::Grid(table) => page.push_str(&grid(table)),
        Block::Notice(tone, text) => {
            let (tone, text) = (tone.name(), inline(text));
            page.push_str(&format!("<p class=\"notice {tone}\">{text}</p>\n"));
        }
        Block::Command(text) => {
            let text = escape(text);
            page.push_str(&format!("<div class=\"command\"><pre>{text}</pre></div>\n"));
        }
        Block::Chart(chart) => {
            let note = chart
                .note
                .as_ref()
                .map(|n| format!("<p>{}</p>\n", inline(n)));
            page.push_str(&format!(
                "<figure class=\"chart\">\n<figcaption>{}</figcaption>\n\
                 <div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"chart\">\n{}</div>\n{}{}</figure>\n",
                inline(&chart.title),
                chart.svg(),
                chart.legend(),
                note.unwrap_or_default()
            ));
        }
        Block::Bars(bars) => page.push_str(&bars.html()),
        Block::Gallery(gallery) => page.push_str(&gallery.html()),
        Block::Folded {
            summary,
            open,
            blocks,
        } => {
            let open = if *open { " open" } else { "" };
            let summary = inline(summary);
            page.push_str(&format!("<details{open}><summary>{summary}</summary>\n"));
            for block in blocks {
                write(page, block, anchors);
            }
            page.push_str("</details>\n");
        }
    }
}

/// Escaped words with code between backticks.
fn inline(text: &str) -> String {
    stretches(text)
        .map(|(is_code, piece)| match is_code {
            true => format!("<code>{}</code>", escape(piece)),
            false => escape(piece),
        })
        .collect()
}

fn grid(grid: &Grid) -> String {
    // A column of numbers is aligned as such, heading and gaps included.
    let is_number = |column: usize| grid.rows.iter().any(|row| row[column].key.is_some());
    let headings: String = (grid.heading.iter().enumerate())
        .map(|(column, cell)| {
            let class = if is_number(column) {
                " class=\"number\""
            } else {
                ""
            };
            format!(
                "<th scope=\"col\"{class}{}>{}</th>",
                title(cell),
                inline(&cell.text)
            )
        })
        .collect();
    let rows: String = grid.rows.iter().map(|row| self::row(row)).collect();
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table class=\"grid\">\n\
         <thead><tr>{headings}</tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        escape(&grid.label)
    )
}

fn title(cell: &Cell) -> String {
    let title = cell.title.as_ref();
    title.map_or_else(String::new, |t| format!(" title=\"{}\"", escape(t)))
}

fn row(cells: &[Cell]) -> String {
    let cells = cells.iter().enumerate().map(|(i, cell)| {
        let key = cell.key.filter(|k| k.is_finite());
        let key = key.map_or_else(String::new, |k| format!(" data-key=\"{k}\""));
        let words = match cell.key {
            Some(_) => " number",
            None if cell.text.chars().count() > LONG_CELL => " words",
            None => "",
        };
        let tag = if i == 0 { "th scope=\"row\"" } else { "td" };
        format!(
            "<{tag} class=\"{}{words}\"{key}{}>{}</{}>",
            cell.tone.name(),
            title(cell),
            inline(&cell.text),
            if i == 0 { "th" } else { "td" }
        )
    });
    format!("<tr>{}</tr>\n", cells.collect::<String>())
}
