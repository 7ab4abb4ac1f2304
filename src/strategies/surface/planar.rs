//! `planar`: the section of each part by each plane, sliced and triangulated on the CPU and drawn as what is inside.
//!
//! The list of crossings of planes in closed form clips the mesh as it does for every inside test. Whether a crossing is inside a
//! part is then not asked of the part's fragments but of the part's section by that plane: a fragment of the section flips the bit of
//! its plane's crossing in the part's lane of the mask, and the same resolve as that of `mask` shades. So any number of planes,
//! parts, priorities and filters goes, and the mesh is drawn once without any atomics.
//!
//! The sections are of the same f32 vertices that are drawn, so both are of one solid. But which fragments stay and what is inside are
//! decided by different numbers here: where the rasteriser rounds them apart, at a rim or in a face in the plane that is seen from
//! along it, a pixel may look past both, which `mask` rules out.
//!
//! Per cut: slicing and triangulating what the planes meet, on all cores; bytes in proportion to it. Per frame: the mesh once, the
//! sections once, one resolve; 2 to 32 bits per pixel and cut part. A camera that moves slices nothing.
//!
//! Cannot: cut by reliefs; cap at the near plane; follow a large mesh that moves as fast as others do, for it is posed on the CPU and
//! its slicer made anew in each step. It refuses where the near plane, which goes on beyond the picture, meets the box of a part that
//! is cut, though nothing of that be seen.
//!
//! Open meshes are capped as far as their sections close, for what is closed says by itself what it encloses. Where a section does not
//! close, nothing says how far it would have reached but the box of the part: pixels whose ray enters the part's half of space through
//! the plane within that box are marked. So are those with an odd total of a part's fragments, as `mask` marks them. A ray that enters
//! beyond the box has all fragments behind its crossing, so that parity caps nothing there that the total does not tell. Marked are
//! thus all pixels that parity would draw otherwise, and many that are right: also those where something nearer hides the plane. An
//! open mesh whose sections close is drawn unmarked, for they are known; what its holes let through to is what there is.

use crate::passes::Refusal;
use crate::passes::{Crossings, Inside, Obstacle, Rasteriser, Recorder, Sections, Store, counted};
use crate::plan::{
    Binding, Capacities, Clock, DepthCompare, DepthTarget, Format, Pass, Resource, ResourceId,
    Vertices, Work,
};
use crate::strategies::row::{Abilities, CapSurface, CapSurfaceRow, Caps, Facts};
use crate::strategies::surface;

/// The row of the table.
pub static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: Facts {
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
fn record(
    recorder: &mut Recorder<'_>,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), Refusal> {
    near_plane_is_free(recorder)?;
    let sections = recorder.sections();
    let is_doubtful = sections.as_ref().is_some_and(|s| !s.doubts.is_empty());
    let capacity = surface::capacity(recorder, capacities);
    recorder.lay_lanes(capacity);
    let mask = match is_doubtful {
        true => recorder.reduced_mask(),
        false => recorder.mask(),
    };
    let emptied = Store::nothing(vec![Binding::write("mask", mask)]);
    let crossings = surface::list(
        recorder,
        CapSurface::RAYCAST,
        capacity,
        &emptied,
        capacities,
    )?;
    let store = if is_doubtful {
        Store {
            file: "lib/store/total.wgsl",
            bindings: vec![Binding::update("mask", mask)],
        }
    } else {
        Store::nothing(Vec::new())
    };
    recorder.over_mesh(rasteriser, &store, &crossings)?;
    if let Some(sections) = sections {
        draw(recorder, rasteriser, &sections, mask, &crossings);
    }
    recorder.resolve(rasteriser, Inside::mask(mask), &crossings);
    Ok(())
}

fn draw(
    recorder: &mut Recorder<'_>,
    rasteriser: Rasteriser,
    sections: &Sections,
    mask: ResourceId,
    crossings: &Crossings,
) {
    // A pass must have an attachment, though nothing is tested and nothing written.
    let (depth, clear) = match rasteriser {
        Rasteriser::Hardware => (recorder.targets().depth, false),
        Rasteriser::Compute => {
            let size = recorder.view.size_px;
            let depth = recorder.once("section depth", |_| {
                Resource::texture("section depth", size, 1, Format::Depth32Float, Clock::Frame)
            });
            (depth, true)
        }
    };
    let bindings = vec![
        recorder.frame(),
        recorder.cut_table(),
        recorder.parts(),
        Binding::update("mask", mask),
        Binding::read("crossing_heads", crossings.heads),
        Binding::read("crossing_surface", crossings.surfaces),
    ];
    let found = counted(sections.draws.len(), "section");
    let open = counted(sections.doubts.len(), "section");
    let passes = [
        (
            "sections",
            format!("{found}: where one is, the crossing of its plane is inside its part"),
            "strategies/surface/planar/section.wgsl",
            &sections.draws,
        ),
        (
            "doubts",
            format!(
                "{open} not whole: whether a crossing of the plane is inside the part cannot be told"
            ),
            "strategies/surface/planar/doubt.wgsl",
            &sections.doubts,
        ),
    ];
    for (name, reason, shader, draws) in passes {
        if draws.is_empty() {
            continue;
        }
        recorder.plan.add_pass(Pass {
            name: name.to_owned(),
            clock: Clock::Frame,
            reason,
            shader: shader.into(),
            bindings: bindings.clone(),
            constants: Vec::new(),
            work: Work::Draw {
                color: None,
                depth: DepthTarget {
                    resource: depth,
                    layer: 0,
                    clear,
                    compare: DepthCompare::Always,
                    stencil: None,
                },
                vertices: Vertices::Mesh(sections.vertices),
                indices: sections.indices,
                draws: draws.clone(),
            },
        });
    }
}

/// Refuses a near plane that opens what is cut.
fn near_plane_is_free(recorder: &Recorder<'_>) -> Result<(), Refusal> {
    let (prepared, view) = (&recorder.model.prepared, recorder.view);
    let cut = recorder.relevance.cut_parts();
    let mut parts = cut.iter().map(|r| &prepared.parts[*r]);
    match parts.find(|p| view.near_cap && view.near_plane_meets(&p.bounds)) {
        None => Ok(()),
        Some(met) => Err(Refusal::new(
            Obstacle::NearPlane,
            format!(
                "the near plane meets `{}`: its cap is no section that planar makes",
                met.name
            ),
        )),
    }
}
