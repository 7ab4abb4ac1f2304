//! Resolving: what each pixel shows, decided from its crossings, the inside test and the nearest kept surface.
//!
//! The decision is the same for every inside test and both rasterisers; files that fill open modules supply what differs. Time is
//! proportional to pixels and, where they have crossings, to cut parts. After the GPU's own rasteriser it is one pass; the compute
//! rasteriser uses `decide` and `paint` instead.

use super::layers::{Layered, layers};
use super::rasterise::decide_and_paint;
use super::solid::NearestKept;
use super::surface::Surfaces;
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::CrossingSource;
use crate::passes::frame::input::Input;
use crate::plan::{Binding, Pass, Plan, ResourceId, Work};
use crate::shader::Shader;

/// Implementation of the inside test.
#[derive(Clone, Debug)]
pub(crate) struct Inside {
    /// File that fills `cutaway::inside`, and those that it needs.
    pub files: Vec<&'static str>,
    /// Bindings of the files.
    pub bindings: Vec<Binding>,
}

impl Inside {
    /// Placeholder inside test for frames without cut parts; it is never evaluated.
    pub(crate) fn unasked() -> Self {
        Self {
            files: vec!["lib/inside/nothing.wgsl"],
            bindings: Vec::new(),
        }
    }

    /// Inside test that reads a mask in which every lane holds bits.
    pub(crate) fn mask(mask: ResourceId) -> Self {
        Self {
            files: vec!["lib/inside/mask.wgsl"],
            bindings: vec![Binding::read("mask", mask)],
        }
    }

    /// Inside test that reads a mask in which some lanes hold counts, and behind them the numbers of closing triangles if there are any.
    pub(crate) fn winding(input: &Input<'_>, mask: ResourceId) -> Self {
        let numbers = match input.closings {
            Some(_) => "lib/closing_numbers/squares.wgsl",
            None => "lib/closing_numbers/none.wgsl",
        };
        Self {
            files: vec!["lib/inside/winding.wgsl", numbers],
            ..Self::mask(mask)
        }
    }
}

/// Records the deciding passes.
pub(crate) fn resolve(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    nearest: NearestKept,
    inside: Inside,
    crossings: &CrossingSource,
) -> Layered {
    match nearest {
        NearestKept::Drawn(surfaces) => resolve_drawn(plan, scene, &surfaces, inside, crossings),
        NearestKept::Swept(swept) => decide_and_paint(plan, scene, swept, inside, crossings),
    }
}

fn resolve_drawn(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    surfaces: &Surfaces,
    inside: Inside,
    crossings: &CrossingSource,
) -> Layered {
    let layers = layers(plan, scene.input);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
    ];
    bindings.extend(surfaces.bindings());
    bindings.push(Binding::write("layers", layers));
    bindings.extend(inside.bindings);
    bindings.extend(crossings.bindings.iter().cloned());
    let cap_normal = cap_normal(scene, &mut bindings);
    let pass = Pass::new(
        "resolve",
        "the nearest crossing that is inside a part and enters it is a cap, unless a surface is in front of it",
        Shader::from("passes/resolve.wgsl")
            .with_all(&inside.files)
            .with_all(crossings.files())
            .with(cap_normal),
        bindings,
        Work::over(scene.input.view.size_px),
    );
    plan.add_pass(pass.with_constants(constants_of_decision(scene)));
    Layered {
        layers,
        picture: None,
    }
}

/// Override constants of a deciding pass.
pub(crate) fn constants_of_decision(scene: &SceneBuffers<'_>) -> Vec<(&'static str, f64)> {
    let active_cuts = &scene.input.active_cuts;
    let mut constants = vec![
        scene.lanes.constant(),
        ("lane_count", active_cuts.lanes as f64),
        ("near_inside", f64::from(u8::from(active_cuts.near_inside))),
    ];
    if scene.input.shows_overlaps() {
        constants.push(("overlaps", 1.0));
    }
    constants
}

/// The file that fills `cutaway::cap_normal`; adds the bindings that it needs.
pub(crate) fn cap_normal(scene: &SceneBuffers<'_>, bindings: &mut Vec<Binding>) -> &'static str {
    let reliefs = scene.input.has_reliefs();
    if reliefs {
        bindings.push(scene.heights.clone());
    }
    match (scene.input.has_cutters(), reliefs) {
        (false, false) => "lib/cap_normal/planes.wgsl",
        (false, true) => "lib/cap_normal/reliefs.wgsl",
        (true, false) => "lib/cap_normal/cutters.wgsl",
        (true, true) => "lib/cap_normal/cutters_reliefs.wgsl",
    }
}
