//! `planar`: the section of each part by each plane, sliced and triangulated on the CPU and drawn as the inside test.
//!
//! The list of plane crossings in closed form clips the mesh as for every inside test. The inside test of a crossing then does not use the
//! part's fragments but the part's section by that plane: a fragment of the section flips the bit of its plane's crossing in the part's
//! mask lane, and the same resolve as that of `mask` shades. So it supports any number of planes, parts, priorities and filters, and the
//! mesh is drawn once without any atomics.
//!
//! The sections use the same f32 vertices that are drawn, so both describe one solid. But different numbers decide which fragments are kept
//! and what is inside: where the rasteriser rounds them apart, at a rim or in a coplanar face seen edge-on, a pixel may show neither
//! surface nor cap. With `mask` this cannot happen.
//!
//! Per cut: slicing and triangulating what the planes meet, on all cores, with memory in proportion. Per frame: the mesh once, the sections
//! once, one resolve; 2 to 32 bits per pixel and cut part. A camera move causes no slicing.
//!
//! Cannot: cut by reliefs; cap at the near plane; animate a large mesh as fast as other strategies do, because the mesh is posed on the CPU
//! and its slicer is rebuilt in each step. Scenes in which the near plane, which continues beyond the picture, meets the box of a cut part
//! are refused, even if none of that is visible.
//!
//! Open meshes are capped as far as their sections close, because a closed outline defines what it encloses. Where a section does not
//! close, only the part's box limits how far it would have reached: pixels whose ray enters the part's half-space through the plane within
//! that box are marked. So are those with an odd total of a part's fragments, as in `mask`. A ray that enters outside the box has all
//! fragments behind its crossing, so parity caps nothing there without an odd total. Thus every pixel that parity would draw differently is
//! marked, and many correct ones, including those where something nearer hides the plane. An open mesh with closed sections is drawn
//! unmarked, because its sections are known; what shows through its holes is real.

use crate::effects::{FrameOutput, finish};
use crate::passes::{
    Crossings, Input, Inside, LISTED, Lanes, NearestKept, Refusal, SceneBuffers, Sections, Store,
    Unsupported, counted, over_mesh, resolve,
};
use crate::plan::{Binding, CpuWork, DepthTarget, Pass, Plan, ResourceId, Vertices, Work};
use crate::shader::Shader;
use crate::strategies::row::{Abilities, CapSurface, CapSurfaceRow, Caps, StrategyInfo};
use crate::strategies::surface;

/// The cap surface's row in the strategy table.
pub(crate) static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: StrategyInfo {
        name: "planar",
        parameter: None,
        about: "the section of each part by each plane, triangulated on the CPU",
        limit: "planes only",
        rebuilds: "the section, sliced again",
        can: Abilities {
            nonzero: true,
            overlaps: true,
            cutters: false,
            reliefs: false,
            surfaces: true,
            compute: true,
        },
        hard_cases: &[("planar", true), ("planar@compute", false)],
    },
    exact_heights: "",
    usual_tests: |_| false,
    caps: Caps::Alone(record),
};

/// Records the frame of `planar`.
fn record(plan: &mut Plan, input: &Input<'_>) -> Result<(FrameOutput, Vec<CpuWork>), Refusal> {
    near_plane_is_free(input)?;
    let capacity = surface::capacity(input);
    let scene = SceneBuffers::upload(plan, input, Lanes::of_bits(input, capacity))?;
    let (sections, on_cpu) = Sections::slice(plan, input);
    let is_doubtful = sections.as_ref().is_some_and(|s| !s.doubts.is_empty());
    let mask = match is_doubtful {
        true => scene.lanes.reduced_mask(plan, input),
        false => scene.lanes.mask(plan, input, 0),
    };
    let emptied = Store::nothing(vec![Binding::write("mask", mask)]);
    let crossings = surface::list(plan, &scene, CapSurface::RAYCAST, capacity, &emptied)?;
    let store = if is_doubtful {
        Store {
            file: "lib/store/total.wgsl",
            bindings: vec![Binding::update("mask", mask)],
            rounds: 0,
        }
    } else {
        Store::nothing(Vec::new())
    };
    let nearest = over_mesh(plan, &scene, &store, &crossings.asked())?;
    if let Some(sections) = sections {
        draw(plan, &scene, &nearest, &sections, mask, &crossings);
    }
    let inside = Inside::mask(mask);
    let layered = resolve(plan, &scene, nearest, inside, &crossings.asked());
    let picture = finish(plan, &scene, layered);
    Ok((picture, on_cpu))
}

fn draw(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    nearest: &NearestKept,
    sections: &Sections,
    mask: ResourceId,
    crossings: &Crossings,
) {
    let depth = DepthTarget {
        // The surface depths are read later.
        clear: matches!(nearest, NearestKept::Swept(_)),
        ..DepthTarget::untouched(scene.depth)
    };
    let bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
        Binding::update("mask", mask),
        Binding::read("crossing_heads", crossings.heads),
        Binding::read("crossing_surface", crossings.surfaces),
    ];
    let found = counted(sections.draws.len(), "section");
    let open = counted(sections.doubts.len(), "section");
    let passes = [
        (
            "sections",
            format!("{found}: under a section, the crossing of its plane is inside the part"),
            Shader::from("strategies/surface/planar/section.wgsl").with_all(&LISTED),
            &sections.draws,
        ),
        (
            "doubts",
            format!(
                "{open} not whole: whether a crossing of the plane is inside the part cannot be known"
            ),
            Shader::from("strategies/surface/planar/doubt.wgsl").with_all(&LISTED),
            &sections.doubts,
        ),
    ];
    for (name, reason, shader, draws) in passes {
        if draws.is_empty() {
            continue;
        }
        let work = Work::Draw {
            color: None,
            depth,
            vertices: Vertices::Mesh(sections.vertices),
            indices: sections.indices,
            draws: draws.clone(),
        };
        plan.add_pass(Pass::new(name, reason, shader, bindings.clone(), work));
    }
}

/// Refuses a near plane that opens a cut part.
fn near_plane_is_free(input: &Input<'_>) -> Result<(), Refusal> {
    match input
        .cut_part_in_near_plane()
        .filter(|_| input.view.near_cap)
    {
        None => Ok(()),
        Some(met) => Err(Refusal::new(
            Unsupported::NearPlane,
            format!(
                "the near plane meets `{}`: planar cannot make its cap",
                met.name
            ),
        )),
    }
}
