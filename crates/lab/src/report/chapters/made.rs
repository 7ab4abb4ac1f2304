//! Section on how the report was made: commands, limits, and biases of the measurements.

use super::pictures::Galleries;
use crate::report::document::{Cell, Grid, ReportBlock};
use crate::report::recorded::RecordedFolders;

/// Biases to consider before trusting a figure.
const BIAS: &str = "\
- Errors are counted at pixel centres of the views that were chosen; a strategy that is exact there may be wrong in another view. Hard cases and the property search look for such views.
- `decided` leaves out pixels where sampling is ambiguous within f32 rounding errors: no result there can be called wrong.
- Ratios refer to drawing the uncut scene by the GPU's own rasteriser on the same adapter. On a software adapter that rasteriser is slow, which flatters every ratio.
- All strategies are ours. The paper's method is implemented from the paper's text, not from its authors' code; any tuning that the paper does not describe is missing.
- The spread of a time or a ratio is that over the rounds of one run. It does not cover how runs differ: compare two runs before relying on a small difference.
- Medians of interleaved rounds hide rare hitches. If several clocks run, their times are added; work that a driver overlaps is counted twice.
- The shapes are few and most are our own. Real meshes enter only where an experiment names their files.
";

pub(super) fn chapter(recorded: &RecordedFolders, pictures: &Galleries) -> Vec<ReportBlock> {
    let mut blocks = vec![ReportBlock::Prose(BIAS.to_owned())];
    let [shown, left_out] = pictures.counts();
    if shown + left_out > 0 {
        blocks.push(ReportBlock::Text(format!(
            "{shown} pictures are shown and {left_out} left out."
        )));
    }
    for (folder, run) in (recorded.folders.iter()).filter_map(|f| Some((f, f.run.as_ref()?))) {
        blocks.push(ReportBlock::Text(format!(
            "`{}` was measured by",
            folder.path.display()
        )));
        let commands = folder.invocations().into_iter();
        blocks.extend(commands.map(|(invocation, _)| ReportBlock::Command(invocation.command)));
        let mut limits = Grid::new("limits", ["device limit that plans must respect", "value"]);
        for (name, value) in &run.limits {
            let value = Cell::number(value.to_string(), *value as f64);
            limits.row([Cell::from(name.as_str()), value]);
        }
        blocks.push(ReportBlock::Folded {
            summary: "Limits of its device".to_owned(),
            open: false,
            blocks: vec![ReportBlock::Grid(limits)],
        });
    }
    blocks.push(ReportBlock::Text(
        "Every figure is in `report.json`, with all records, and in `report.csv`, one row for each point and strategy. \
         Cells of the CSV that a spreadsheet could take for a formula begin with an apostrophe. Times differ from run to run, errors do not."
            .to_owned(),
    ));
    blocks
}
