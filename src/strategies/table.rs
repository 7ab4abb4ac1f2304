//! The table of strategies: all cap surfaces and all inside tests.
//!
//! Adding one is a file with its row and its passes, a folder of shaders, and a line here.

use super::row::{Abilities, CapSurfaceRow, InsideTestRow, SelectedRow, StrategyInfo};
use super::{Strategy, inside, surface};

/// All cap surfaces.
pub static CAP_SURFACES: &[&CapSurfaceRow] = &[
    &surface::raycast::ROW,
    &inside::stencil::alone::ROW,
    &surface::planar::ROW,
    &surface::adaptive::ROW,
    &surface::grid::ROW,
];

/// All inside tests.
pub static INSIDE_TESTS: &[&InsideTestRow] = &[
    &inside::mask::ROW,
    &inside::winding::ROW,
    &inside::stencil::ROW,
    &inside::abuffer::ROW,
    &inside::kbuffer::ROW,
    &inside::ldi::ROW,
    &inside::vds::ROW,
];

/// One strategy of each kind, with default parameters: the meaning of `all`. Tessellated cap surfaces are also combined with the other
/// inside tests.
pub fn all() -> Vec<Strategy> {
    let with_tests = |surface: &'static CapSurfaceRow| {
        let usual = (INSIDE_TESTS.iter()).filter(|test| (surface.usual_tests)(test));
        let tests = usual.map(|test| Some(SelectedRow::usual(*test)));
        let alone = surface.is_alone().then_some(None);
        let pair = move |inside| Strategy {
            surface: SelectedRow::usual(surface),
            inside,
        };
        alone.into_iter().chain(tests).map(pair).collect::<Vec<_>>()
    };
    CAP_SURFACES
        .iter()
        .flat_map(|row| with_tests(row))
        .collect()
}

/// The names of all strategies, for help texts.
pub fn names() -> String {
    let (alone, listed): (Vec<&CapSurfaceRow>, Vec<&CapSurfaceRow>) =
        CAP_SURFACES.iter().partition(|row| row.is_alone());
    let mut listed = listed.iter().map(|row| row.facts.pattern());
    let first = listed.next().unwrap_or_default();
    let others: Vec<String> = listed.collect();
    let tests: Vec<String> = (INSIDE_TESTS.iter())
        .map(|row| row.facts.pattern())
        .collect();
    let alone: Vec<String> = (alone.iter())
        .map(|row| format!("{} ({})", row.facts.name, row.facts.limit))
        .collect();
    format!(
        "{first}+{}; {} with all of these; {}",
        tests.join(", +"),
        others.join(" and "),
        alone.join("; "),
    )
}

/// Both tables as Markdown: the facts about each row.
pub fn markdown() -> String {
    let surfaces = CAP_SURFACES.iter().map(|row| &row.facts);
    let tests = INSIDE_TESTS.iter().map(|row| &row.facts);
    format!(
        "{}\n{}",
        rows_as_markdown("cap surface", surfaces),
        rows_as_markdown("inside test", tests)
    )
}

fn rows_as_markdown(what: &str, rows: impl Iterator<Item = &'static StrategyInfo>) -> String {
    let mut text =
        format!("| {what} | what it is | when a mesh changes | cannot |\n|---|---|---|---|\n");
    for facts in rows {
        let pattern = facts.pattern();
        let name = match &facts.parameter {
            Some(p) => format!("`{pattern}`, {}, usually {}", p.about, p.number(p.usual)),
            None => format!("`{pattern}`"),
        };
        let rebuilds = match facts.rebuilds {
            "" => "nothing is rebuilt",
            rebuilds => rebuilds,
        };
        let cannot = lacks(facts.can).join(", ");
        text.push_str(&format!(
            "| {name} | {} | {rebuilds} | {cannot} |\n",
            facts.about
        ));
    }
    text
}

/// Missing abilities, in words.
fn lacks(can: Abilities) -> Vec<&'static str> {
    let all = [
        (can.nonzero, "nonzero parts"),
        (can.overlaps, "overlaps"),
        (can.cutters, "cutters"),
        (can.reliefs, "reliefs"),
        (can.surfaces, "several clip-surfaces"),
        (can.compute, "the compute rasteriser"),
    ];
    let lacking = all.into_iter().filter(|(can, _)| !can);
    lacking.map(|(_, what)| what).collect()
}
