//! Groups the marks of a chart into series, and names the series.

use super::charts::PlottedStrategy;
use crate::experiment::ChartSynopsis;
use crate::report::derived::Row;

/// Figures of the scene. Along such an x axis, varied scene parameters do not separate series, as they already change x.
const OF_SCENE: [&str; 2] = ["triangles", "pixels"];

/// A series has one strategy and one value of each varied parameter, except those that vary along the series: the parameter on the x axis,
/// or the strategy's own parameters if x is a figure. All strategies share a drawing; each combination of the other values has its own.
/// If there is only one strategy, the values of the last varied parameter share a drawing, with a series for each.
pub(super) fn name_series(asked: &ChartSynopsis, placed: &mut [PlottedStrategy<'_>]) {
    let is_of_scene = OF_SCENE.contains(&asked.x.as_str());
    let mut names: Vec<&String> = placed
        .iter()
        .flat_map(|p| p.row.record.parameters.keys())
        .filter(|name| **name != asked.x && !is_of_scene)
        .collect();
    names.sort();
    names.dedup();
    let varies = |name: &&String| {
        let first = placed[0].row.record.parameters.get(*name);
        placed
            .iter()
            .any(|p| p.row.record.parameters.get(*name) != first)
    };
    let names: Vec<String> = names.into_iter().filter(|n| varies(n)).cloned().collect();
    let has_runs = placed
        .iter()
        .any(|p| p.row.record.run != placed[0].row.record.run);
    let only = |p: &PlottedStrategy<'_>| p.row.found().name == placed[0].row.found().name;
    let is_alone = placed.iter().all(only);
    for p in placed {
        let mut words = Vec::new();
        if has_runs {
            words.push(p.row.record.run.clone());
        }
        for name in &names {
            if let Some(value) = p.row.record.parameters.get(name) {
                words.push(format!("{name} = {value}"));
            }
        }
        p.series = match is_alone {
            true => words.pop(),
            false => None,
        }
        .unwrap_or_else(|| method_of(asked, &p.row, is_of_scene));
        p.panel = words.join(", ");
    }
}

/// Name of a series' strategy.
fn method_of(asked: &ChartSynopsis, row: &Row<'_>, is_of_scene: bool) -> String {
    let own = &row.member.parameters;
    let runs_along = own.contains_key(&asked.x);
    let is_figure = row.parameter(&asked.x).is_none() && !is_of_scene;
    let others = own.iter().filter(|(name, _)| **name != asked.x);
    match (runs_along, is_figure) {
        (false, true) => unbraced(&row.member.family),
        (false, false) => row.found().name.clone(),
        (true, _) => unbraced(
            &others.fold(row.member.family.clone(), |family, (name, value)| {
                family.replace(&format!("{{{name}}}"), &value.to_string())
            }),
        ),
    }
}

/// A strategy text without braces: `grid:cells+vds:1024`.
fn unbraced(family: &str) -> String {
    family.replace(['{', '}'], "")
}
