//! Compares the areas and times of other tools on the same cuts with ours.
//!
//! Times of different tools cover different work, which each row states, so no ratio of times is computed.

use crate::report::chapters::figures::timed;
use crate::report::document::{Cell, Grid, ReportBlock, Tone};
use crate::report::number::significant;
use crate::report::recorded::{PeerCheck, PeerRecord, PeerRow, RecordedFolders};

pub(in crate::report::chapters) fn chapter(recorded: &RecordedFolders) -> Vec<ReportBlock> {
    let mut blocks = Vec::new();
    for folder in &recorded.folders {
        for record in &folder.peers {
            let title = match record.what.as_str() {
                "planar" => "Planar cuts".to_owned(),
                "relief" => "Cuts by a relief, as Booleans with a height-field solid".to_owned(),
                what => what.to_owned(),
            };
            let place = match recorded.folders.len() {
                1 => String::new(),
                _ => format!(" · {}", folder.path.display()),
            };
            blocks.push(ReportBlock::Heading(4, format!("{title}{place}")));
            blocks.push(ReportBlock::Text(versions(record)));
            let missed = record.checks.iter().filter(|c| !c.holds);
            blocks.extend(missed.map(|c| {
                let text = format!(
                    "{}, {}: the area of {} is {}.",
                    c.mesh,
                    c.cut,
                    c.tool,
                    describe(c)
                );
                ReportBlock::Notice(Tone::Bad, text)
            }));
            blocks.push(ReportBlock::Grid(table(record)));
            if !record.command.is_empty() {
                blocks.push(ReportBlock::Command(record.command.clone()));
            }
        }
    }
    if !blocks.is_empty() {
        blocks.insert(
            0,
            ReportBlock::Text(
                "The same cuts by other tools on the same machine. Each row states what its time covers, which is not the same work for all tools: \
                 areas can be compared, times only with care. The difference is relative to our first row for the same mesh and cut."
                    .to_owned(),
            ),
        );
    }
    blocks
}

fn versions(record: &PeerRecord) -> String {
    let others = record
        .versions
        .iter()
        .map(|(name, v)| format!("{name} {v}"));
    let ours = record.cutaway.iter();
    let ours = ours.filter_map(|(name, v)| Some(format!("cutaway {name} {}", v.as_ref()?)));
    let words: Vec<String> = others.chain(ours).collect();
    format!("Versions: {}.", words.join(", "))
}

fn table(record: &PeerRecord) -> Grid {
    let heading = [
        "mesh",
        "triangles",
        "cut",
        "tool",
        "area",
        "difference to ours",
        "time, ms",
        "what the time covers",
        "outcome",
    ];
    let mut grid = Grid::new("outside baselines", heading);
    for row in &record.rows {
        let triangles = row
            .triangles
            .map_or_else(Cell::default, |t| Cell::number(t.to_string(), t as f64));
        let area = row.area.map_or_else(Cell::default, |a| {
            let cell = Cell::number(format!("{a:.6}"), a);
            let cell = match &row.area_unit {
                Some(unit) => cell.titled(unit.as_str()),
                None => cell,
            };
            let is_of_it =
                |c: &&PeerCheck| c.tool == row.tool && c.mesh == row.mesh && c.cut == row.cut;
            let checks: Vec<&PeerCheck> = record.checks.iter().filter(is_of_it).collect();
            match checks.iter().find(|c| !c.holds) {
                Some(missed) => Cell {
                    text: format!("{} (missed)", cell.text),
                    ..cell.toned(Tone::Bad).titled(describe(missed))
                },
                None if checks.is_empty() => cell,
                None => cell.toned(Tone::Good),
            }
        });
        let difference = difference(row, &record.rows).map_or_else(Cell::default, |d| {
            Cell::number(format!("{:+.4} %", d * 100.0), d.abs())
        });
        let outcome = match &row.reason {
            Some(reason) => Cell::from(format!("{}: {reason}", row.outcome)),
            None => Cell::from(row.outcome.as_str()),
        };
        grid.row([
            Cell::from(row.mesh.as_str()),
            triangles,
            Cell::from(row.cut.as_str()),
            Cell::from(row.tool.as_str()),
            area,
            difference,
            row.time_ms.as_ref().map_or_else(Cell::default, timed),
            Cell::from(row.clock.clone().unwrap_or_default()),
            outcome.toned(match row.outcome.as_str() {
                "done" => Tone::Plain,
                "refused" => Tone::Faint,
                _ => Tone::Fair,
            }),
        ]);
    }
    grid
}

/// Describes the error of an area in words.
fn describe(check: &PeerCheck) -> String {
    let PeerCheck {
        off,
        bound,
        bound_is,
        ..
    } = check;
    format!(
        "off by {}, where {} is allowed ({bound_is})",
        significant(*off),
        significant(*bound)
    )
}

fn is_ours(row: &PeerRow) -> bool {
    row.tool.starts_with("cutaway")
}

/// Relative difference of a row's area from the area in our first row for the same cut; `None` for our first row itself.
fn difference(row: &PeerRow, rows: &[PeerRow]) -> Option<f64> {
    let ours = rows
        .iter()
        .find(|r| is_ours(r) && r.area.is_some() && r.mesh == row.mesh && r.cut == row.cut)?;
    if std::ptr::eq(ours, row) {
        return None;
    }
    let (area, ours) = (row.area?, ours.area?);
    (ours > 0.0).then_some(area / ours - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_compared_with_ours_of_the_same_cut() {
        let row = |tool: &str, cut: &str, area: f64| PeerRow {
            mesh: "torus".to_owned(),
            triangles: None,
            cut: cut.to_owned(),
            tool: tool.to_owned(),
            area: Some(area),
            area_unit: None,
            time_ms: None,
            clock: None,
            outcome: "done".to_owned(),
            reason: None,
            command: None,
        };
        let rows = [
            row("vtk", "x", 2.2),
            row("cutaway section", "x", 2.0),
            row("vtk", "y", 5.0),
            row("cutaway exact", "x", 1.0),
        ];
        let found = [0, 1, 2, 3].map(|i| difference(&rows[i], &rows));
        assert!((found[0].unwrap() - 0.1).abs() < 1e-12, "{found:?}");
        assert_eq!(found[1..], [None, None, Some(-0.5)]);
    }
}
