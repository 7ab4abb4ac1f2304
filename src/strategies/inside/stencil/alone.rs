//! `stencil` by itself: the classic way to cap a plane, back faces minus front faces (Gradinari, *Advanced clipping techniques*).
//!
//! One plane, no list of crossings: each solid is drawn without what the plane removes, and every kept fragment changes the stencil, hidden
//! or not: back faces add 1, front faces subtract 1. Seen from the removed side these are the fragments behind the plane, so the stencil
//! ends with the section's winding number at each pixel. Then the plane is drawn where the part's fill rule counts that number as inside,
//! and resets the stencil for the next part. Seen from the kept side the plane shows its back, and nothing is drawn. The side of a fragment
//! and the plane's depth come from the same few operations, so no crack can open between them.
//!
//! Per frame: each cut part once and the picture once per cut part; 5 bytes a pixel for depth and stencil, no mask, no list. Where it
//! applies, it is the cheapest method with the hardware rasteriser in most measurements.
//!
//! Cannot: cut by reliefs or by several clip-surfaces; cap at the near plane, or count fragments in front of it; detect an open mesh, which
//! gives unmarked streaks; count beyond 255 shells. It refuses where the near plane, which continues beyond the picture, meets the box of a
//! cut part, even if none of that is visible.

use crate::effects::{FrameOutput, finish};
use crate::passes::{DrawPass, Input, Lanes, Refusal, SceneBuffers, Surfaces, Unsupported, gather};
use crate::plan::{CpuWork, Draw, Plan, Stencil, StencilStep, Vertices};
use crate::scene::Fill;
use crate::strategies::row::{Abilities, CapSurfaceRow, Caps, StrategyInfo};

/// The cap surface's row in the strategy table.
pub(crate) static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: StrategyInfo {
        name: "stencil",
        parameter: None,
        about: "the plane, where back faces minus front faces among the kept fragments give inside: the classic way",
        limit: "one plane, eye outside the cut",
        rebuilds: "",
        can: Abilities {
            nonzero: true,
            overlaps: false,
            cutters: false,
            reliefs: false,
            surfaces: false,
            compute: false,
        },
        hard_cases: &[("stencil", true)],
    },
    exact_heights: "",
    usual_tests: |_| false,
    caps: Caps::Alone(record),
};

/// Records the frame of `stencil`.
fn record(plan: &mut Plan, input: &Input<'_>) -> Result<(FrameOutput, Vec<CpuWork>), Refusal> {
    near_plane_is_free(input)?;
    let scene = SceneBuffers::upload(plan, input, Lanes::none())?;
    let mut surfaces = Surfaces::with_stencil(plan, &scene);
    for rank in input.active_cuts.cut_parts() {
        draw_part(plan, &scene, &mut surfaces, *rank);
    }
    surfaces.draw_plain_parts(plan, &scene, false);
    let layered = gather(plan, &scene, &surfaces);
    Ok((finish(plan, &scene, layered), Vec::new()))
}

/// Draws what the plane leaves of a part, and its cap; parts are given by rank.
fn draw_part(plan: &mut Plan, scene: &SceneBuffers<'_>, surfaces: &mut Surfaces, rank: usize) {
    let input = scene.input;
    let part = &input.model.prepared.parts[rank];
    let name = &part.name;
    let place = input.active_cuts.place_of(rank) as u32;
    let (vertices, indices) = scene.mesh();
    let solid = DrawPass {
        name: format!("solid {place}"),
        reason: format!("kept part of `{name}`: back faces add 1, front faces subtract 1"),
        shader: "strategies/inside/stencil/solid.wgsl".into(),
        bindings: vec![
            scene.frame.clone(),
            scene.parts.clone(),
            scene.ray_table.clone(),
        ],
        constants: Vec::new(),
        vertices,
        indices,
        draws: input.draws_of_rest(&[rank]),
    };
    let preclassified = scene.preclassified.as_ref().map(|preclassified| {
        let mut pass = DrawPass {
            name: format!("solid {place} preclassified"),
            reason: format!("faces of `{name}` in the plane or just beside it, on the side on which they are known to lie"),
            shader: "strategies/inside/stencil/solid_preclassified.wgsl".into(),
            draws: input.draws_of_groups(&[rank]),
            ..solid.clone()
        };
        pass.bindings.push(preclassified.clone());
        pass
    });
    let counts = Stencil {
        clear: place == 0,
        step: StencilStep::WindAll,
    };
    surfaces.draw_with(plan, solid, Some(counts));
    if let Some(preclassified) = preclassified.filter(|s| !s.draws.is_empty()) {
        let counts = Stencil {
            clear: false,
            ..counts
        };
        surfaces.draw_with(plan, preclassified, Some(counts));
    }

    let cap = DrawPass {
        name: format!("cap {place}"),
        reason: format!("the plane, where it is inside `{name}`"),
        shader: "strategies/inside/stencil/cap.wgsl".into(),
        bindings: vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            scene.parts.clone(),
            scene.ray_table.clone(),
        ],
        constants: Vec::new(),
        vertices: Vertices::None,
        indices: scene.screen_indices,
        draws: vec![Draw::full_screen(place)],
    };
    let takes = Stencil {
        clear: false,
        step: StencilStep::Take {
            bits: match part.fill {
                Fill::EvenOdd => 1,
                Fill::Nonzero => 0xff,
            },
        },
    };
    surfaces.draw_with(plan, cap, Some(takes));
}

/// Refuses a near plane that meets a cut part.
fn near_plane_is_free(input: &Input<'_>) -> Result<(), Refusal> {
    match input.cut_part_in_near_plane() {
        None => Ok(()),
        Some(met) => Err(Refusal::new(
            Unsupported::NearPlane,
            format!(
                "the near plane meets `{}`: fragments in front of it are not drawn, and the stencil cannot count them",
                met.name
            ),
        )),
    }
}
