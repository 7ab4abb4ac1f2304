//! `grid:N`: the paper's tessellation, a quad refined N x N and displaced by the offset map in the vertex stage.
//!
//! Its resolution is the same everywhere: between vertices it is flat where the clip-surface bends, with an error of up to a quarter of a
//! texel's twist if cells are texels, and up to the relief's height if they are much larger. By the paper's rule that opens gaps; with a
//! per-pixel list of crossings it shifts the cap and its rim.
//!
//! Per cut: a quad of 64 bytes and N² x 24 bytes of indices. Per frame: (N + 1)² vertices for each drawn clip-surface.

use crate::strategies::row::{
    Abilities, CapSurfaceRow, Caps, InsideTestKind, StrategyInfo, StrategyParameter,
};
use glam::DVec3;

use super::tessellation::{Facets, Tessellation, beyond_box, rounding, span};
use crate::passes::{Input, SceneBuffers};
use crate::plan::pack::Quad;
use crate::plan::{Binding, BufferRole, Clock, Contents, Plan, Resource};
use crate::scene::PreparedSurface;

/// The cap surface's row in the strategy table.
pub(crate) static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: StrategyInfo {
        name: "grid",
        parameter: Some(StrategyParameter {
            letter: "N",
            about: "cells along a side",
            usual: 256,
            least: 1,
            most: 2048,
            steps_per_unit: 1,
        }),
        about: "the paper's quad, refined into N x N cells and displaced",
        limit: "",
        rebuilds: "",
        can: Abilities::ALL,
        hard_cases: &[],
    },
    exact_heights: "",
    usual_tests: |test| {
        test.facts.name == "mask" || matches!(test.answers, InsideTestKind::Points(_))
    },
    caps: Caps::Triangles(|plan, scene, cells, _| Ok(tessellation(plan, scene, cells))),
};

/// All clip-surfaces as grids of `cells` cells along each side.
fn tessellation(plan: &mut Plan, scene: &SceneBuffers<'_>, cells: u32) -> Tessellation {
    let input = scene.input;
    let kept = &input.model.grid_indices;
    let contents = kept.get_or_make(cells, |_| indices_of_grid(cells));
    let indices = Resource::own_upload("grid indices", BufferRole::Index, contents, Clock::Cut);
    let indices = plan.add_resource(indices);
    let facets = |surface| Facets {
        surface,
        indices,
        range: 0..cells * cells * 6,
        arguments: None,
    };
    let count = input.active_cuts.surfaces.len() as u32;
    let quads = Contents::from_values(&quads(input, cells));
    let quads = Resource::own_upload("quads", BufferRole::Storage, quads, Clock::Cut);
    let quads = Binding::read("quads", plan.add_resource(quads));
    let filter = input.height_filter_file();
    Tessellation {
        files: vec!["lib/tessellation/grid.wgsl", filter],
        heights: scene.filtered_heights.clone(),
        bindings: vec![quads.clone()],
        side: vec!["lib/sheet_side/grid.wgsl", filter],
        side_bindings: vec![quads],
        beside: rounding(input),
        facets: (0..count).map(facets).collect(),
    }
}

/// Two triangles per cell, the diagonal from the first to the last corner.
fn indices_of_grid(cells: u32) -> Contents {
    let row = cells + 1;
    let indices: Vec<u32> = (0..cells * cells)
        .flat_map(|cell| {
            let a = cell / cells * row + cell % cells;
            [a, a + 1, a + row + 1, a, a + row + 1, a + row]
        })
        .collect();
    Contents::from_values(&indices)
}

fn quads(input: &Input<'_>, cells: u32) -> Vec<Quad> {
    let surfaces = input.active_cuts.surfaces.iter();
    surfaces
        .map(|s| {
            let surface = &input.model.prepared.surfaces[*s];
            quad(surface, input, cells)
        })
        .collect()
}

/// The rectangle on the plane, along `U` and `V`, that covers the box of the cut solids.
fn quad(surface: &PreparedSurface, input: &Input<'_>, cells: u32) -> Quad {
    let range = |axis: DVec3| {
        let [low, high] = span(surface, input, axis);
        let margin = beyond_box(input.view) * (high - low).max(1.0);
        (low - margin, (high - low + 2.0 * margin) / f64::from(cells))
    };
    let (u_hat, v_hat) = (surface.frame.u_hat, surface.frame.v_hat);
    let ((u, u_step), (v, v_step)) = (range(u_hat), range(v_hat));
    let row = |p: DVec3| p.as_vec3().extend(0.0).to_array();
    // A flat map is a plane, which the vertex shader does not displace: its height is added to the corner.
    let lift = surface.frame.normal * -surface.flat_height().unwrap_or(0.0);
    Quad {
        corner: row(surface.origin + lift + u_hat * u + v_hat * v),
        step_u: row(u_hat * u_step),
        step_v: row(v_hat * v_step),
        cells: [cells, 0, 0, 0],
    }
}
