//! A report as Markdown.

use super::Figure;
use super::text::{errors, shortfalls, times};
use crate::experiment::{Measurement, Timing};

/// The report as a page; the figures are referred to by their file names.
pub fn markdown(title: &str, report: &Measurement, figures: &[Figure<'_>]) -> String {
    let mut page = format!("# {title}\n\n");
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
        page.push_str(&format!("\n- {line}"));
    }
    if !figures.is_empty() {
        page.push_str("\n## Pictures\n");
    }
    for figure in figures {
        page.push_str(&format!(
            "\n### {}\n\n![{}]({})\n\n{}\n",
            figure.title, figure.title, figure.file, figure.caption
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
        format!("cutaway {}, `{}`", report.version, report.command),
    ];
    lines.iter().map(|l| format!("- {l}\n")).collect()
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
        ] {
            assert!(page.contains(said), "{said} is missing from\n{page}");
        }
    }
}
