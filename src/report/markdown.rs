//! A report as Markdown, and how words get into Markdown: text between backticks is code, and nothing else in it is markup.

use super::Figure;
use super::document::stretches;
use super::text::{errors, shortfalls, times};
use crate::experiment::{Measurement, Timing};

/// Words in which nothing is markup but the code between backticks.
pub(super) fn words(text: &str) -> String {
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

/// Text as code, whatever backticks it has.
fn code(text: &str) -> String {
    let mut fence = "`".to_owned();
    while text.contains(&fence) {
        fence.push('`');
    }
    match fence.len() {
        1 => format!("`{text}`"),
        _ => format!("{fence} {text} {fence}"),
    }
}

/// The report as a page; the figures are referred to by their file names.
pub fn markdown(title: &str, report: &Measurement, figures: &[Figure<'_>]) -> String {
    let mut page = format!("# {}\n\n", words(title));
    page.push_str(&facts(report));
    page.push_str("\n## Error against exact\n\n");
    page.push_str(&errors(report).to_markdown());
    page.push_str("\n## Time and memory\n\n");
    page.push_str(&times(report).to_markdown());
    page.push_str(&format!(
        "\nTimes are medians of {} interleaved rounds in milliseconds, by {}. \"Draw only\" is the same scene with nothing cut.\n",
        report.rounds, timing(report)
    ));
    for line in shortfalls(report) {
        page.push_str(&format!("\n- {}", words(&line)));
    }
    if !figures.is_empty() {
        page.push_str("\n## Pictures\n");
    }
    for figure in figures {
        page.push_str(&format!(
            "\n### {}\n\n![{}]({})\n\n{}\n",
            words(figure.title),
            words(figure.title),
            figure.file,
            words(figure.caption)
        ));
    }
    page
}

fn facts(report: &Measurement) -> String {
    let adapter = &report.adapter;
    let exact = &report.exact;
    let lines = [
        format!("scene: {}, {} triangles", report.scene, report.triangles),
        format!(
            "picture: {} x {} pixels",
            report.resolution[0], report.resolution[1]
        ),
        format!(
            "exact: {} cap, {} surface, {} undecided pixels, {:.0} ms on the CPU",
            exact.cap_px, exact.surface_px, exact.undecided_px, exact.time_ms
        ),
        format!(
            "adapter: {}, {}, {}{}",
            adapter.name,
            adapter.backend,
            adapter.driver,
            if adapter.software { " (software)" } else { "" }
        ),
    ];
    let lines = lines.iter().map(|l| format!("- {}\n", words(l)));
    let made = format!("- cutaway {}, {}\n", report.version, code(&report.command));
    lines.chain([made]).collect()
}

/// How time was taken, in words.
pub(super) fn timing(report: &Measurement) -> &'static str {
    match report.timing {
        Timing::Timestamps => "timestamps of the device",
        Timing::Wall => "wall time, for the device has no timestamps",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;

    #[test]
    fn words_are_no_markup() {
        assert_eq!(words("a <b> *c* `d<e`"), "a &lt;b> \\*c\\* `d<e`");
        assert_eq!(words("one ` alone"), "one \\` alone");
        assert_eq!(words("&lt; \\*"), "&amp;lt; \\\\\\*");
        assert_eq!(code("a <b>"), "`a <b>`");
        assert_eq!(code("a ` b"), "`` a ` b ``");
    }

    #[test]
    fn the_page_has_tables_and_figures() {
        let figure = Figure {
            title: "Exact",
            file: "exact.png",
            caption: "The truth.",
            png: &[],
        };
        let page = markdown("Demo", &example(), &[figure]);
        for said in [
            "# Demo",
            "| raycast+mask | 0 | 3 |",
            "![Exact](exact.png)",
            "refused: a relief | is no plane",
            "planar+&lt;mask>",
        ] {
            assert!(page.contains(said), "{said} is missing from\n{page}");
        }
    }
}
