//! A report as one HTML file: no network, no script, pictures inside.
//!
//! Pictures are shown one at a time under tabs, in the same place, so that switching between two of them shows every
//! pixel that differs. The tabs are radio buttons and CSS.

use super::Table;
use super::markdown::timing;
use super::text::{errors, shortfalls, times};
use crate::experiment::Measurement;

/// A picture of a report.
#[derive(Clone, Copy, Debug)]
pub struct Figure<'a> {
    /// Name of the tab.
    pub title: &'a str,
    /// Name of the file beside the report.
    pub file: &'a str,
    /// What can be seen.
    pub caption: &'a str,
    /// The file's contents.
    pub png: &'a [u8],
}

const STYLE: &str = "
:root { color-scheme: light dark; --line: #8884; --soft: #8882; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 74rem; margin: 2rem auto; padding: 0 1rem; }
h1, h2 { line-height: 1.2; font-weight: 600; }
dl { display: grid; grid-template-columns: max-content auto; gap: .1rem 1rem; }
dt { opacity: .65; } dd { margin: 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; white-space: nowrap; }
th, td { padding: .3rem .7rem; text-align: right; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; }
code { background: var(--soft); padding: .1em .35em; border-radius: .2em; }
.tabs { display: flex; flex-wrap: wrap; gap: .3rem; }
.tabs > input { position: absolute; opacity: 0; }
.tabs > label { padding: .3rem .8rem; border: 1px solid var(--line); border-radius: .4rem; cursor: pointer; }
.tabs > input:checked + label { background: #2563eb; border-color: #2563eb; color: #fff; }
.tabs > input:focus-visible + label { outline: 2px solid #93c5fd; }
figure { display: none; order: 1; width: 100%; margin: .6rem 0 0; }
figure img { width: 100%; border-radius: .4rem; }
figcaption { opacity: .75; }
";

/// The report as a page with the figures in it.
pub fn html(title: &str, report: &Measurement, figures: &[Figure<'_>]) -> String {
    let title = escape(title);
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n<style>{STYLE}{}</style>\n\
         <h1>{title}</h1>\n",
        tab_rules(figures.len())
    );
    page.push_str(&tabs(figures));
    page.push_str("<h2>Error against exact</h2>\n");
    page.push_str(&table(&errors(report)));
    page.push_str("<h2>Time and memory</h2>\n");
    page.push_str(&table(&times(report)));
    page.push_str(&format!(
        "<p>Times are medians of {} interleaved rounds in milliseconds, by {}. Draw only is the same scene with \
         nothing cut.</p>\n",
        report.rounds,
        timing(report)
    ));
    for line in shortfalls(report) {
        page.push_str(&format!("<p>{}</p>\n", escape(&line)));
    }
    page.push_str("<h2>Made by</h2>\n");
    page.push_str(&facts(report));
    page.push_str("</html>\n");
    page
}

fn facts(report: &Measurement) -> String {
    let (adapter, exact) = (&report.adapter, &report.exact);
    let software = if adapter.software { ", software" } else { "" };
    let facts = [
        (
            "command",
            format!("<code>{}</code>", escape(&report.command)),
        ),
        ("version", escape(&report.version)),
        (
            "adapter",
            escape(&format!(
                "{}, {}, {}{software}",
                adapter.name, adapter.backend, adapter.driver
            )),
        ),
        (
            "scene",
            escape(&format!("{}, {} triangles", report.scene, report.triangles)),
        ),
        (
            "picture",
            format!("{} × {} pixels", report.resolution[0], report.resolution[1]),
        ),
        (
            "exact",
            format!(
                "{} cap, {} surface, {} undecided pixels; {:.0} ms on the CPU",
                exact.cap_px, exact.surface_px, exact.undecided_px, exact.time_ms
            ),
        ),
    ];
    let rows: String = facts
        .iter()
        .map(|(name, value)| format!("<dt>{name}</dt><dd>{value}</dd>\n"))
        .collect();
    format!("<dl>\n{rows}</dl>\n")
}

fn table(table: &Table) -> String {
    let row = |cells: &[String], tag: &str| -> String {
        let cells: String = cells
            .iter()
            .map(|c| format!("<{tag}>{}</{tag}>", escape(c)))
            .collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows().iter().map(|r| row(r, "td")).collect();
    format!(
        "<div class=\"scroll\"><table>\n{}{rows}</table></div>\n",
        row(table.heading(), "th")
    )
}

fn tabs(figures: &[Figure<'_>]) -> String {
    let mut out = String::from("<div class=\"tabs\">\n");
    for (i, figure) in figures.iter().enumerate() {
        let checked = if i == 0 { " checked" } else { "" };
        out.push_str(&format!(
            "<input type=\"radio\" name=\"figure\" id=\"t{i}\"{checked}><label for=\"t{i}\">{}</label>\n",
            escape(figure.title)
        ));
    }
    for (i, figure) in figures.iter().enumerate() {
        out.push_str(&format!(
            "<figure class=\"f{i}\"><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
            escape(figure.title),
            base64(figure.png),
            escape(figure.caption)
        ));
    }
    out + "</div>\n"
}

/// One rule per tab: CSS has no other way to tie a button to its picture.
fn tab_rules(count: usize) -> String {
    (0..count)
        .map(|i| format!("#t{i}:checked ~ .f{i} {{ display: block; }}\n"))
        .collect()
}

pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// RFC 4648.
pub(super) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |i: usize| group.get(i).copied().map_or(0, u32::from);
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            if i <= group.len() {
                text.push(char::from(DIGITS[(word >> (18 - 6 * i) & 63) as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;

    #[test]
    fn base64_is_that_of_the_rfc() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn the_page_stands_alone_and_escapes_what_it_is_told() {
        let figures = [0, 1].map(|_| Figure {
            title: "Exact",
            file: "exact.png",
            caption: "<truth>",
            png: b"foo",
        });
        let page = html("Demo & more", &example(), &figures);
        for said in [
            "<h1>Demo &amp; more</h1>",
            "data:image/png;base64,Zm9v",
            "&lt;truth&gt;",
            "planar+&lt;mask&gt;",
            "#t1:checked ~ .f1",
        ] {
            assert!(page.contains(said), "{said} is missing");
        }
        assert!(!page.contains("http"), "nothing is fetched");
        assert!(!page.contains("<script"), "nothing runs");
    }
}
