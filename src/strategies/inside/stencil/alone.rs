//! `stencil` by itself: the classic way to cap a plane, back faces minus front faces (Gradinari, *Advanced clipping techniques*).
//!
//! One plane, no list of crossings: each solid is drawn less what the plane removes, and every fragment that is kept counts in
//! the stencil, back faces up and front faces down, hidden or not. Seen from the removed side these are the fragments behind the plane,
//! so the stencil ends with the winding number of the section at each pixel. Then the plane is drawn where that is inside, by parity or
//! nonzero as the part is filled, and sets the stencil back for the next part. Seen from the kept side the plane shows its back, and
//! nothing is drawn. Side of a fragment and place of the plane come from the same few operations, so no crack can open between them.
//!
//! Per frame: each cut part once and the picture once for each of them; 5 bytes a pixel for depth and stencil, no mask, no list.
//! It is the cheapest of all where it can be used.
//!
//! Cannot: cut by reliefs or by several clip-surfaces; cap at the near plane, or count what lies before it; tell an open mesh, of
//! which it draws streaks unmarked; count beyond 255 shells. It refuses where the near plane, which goes on beyond the picture, meets the box of a part that is cut, though nothing
//! of that be seen.

use super::full_screen;
use crate::passes::Refusal;
use crate::passes::{DrawPass, Obstacle, Rasteriser, Recorder};
use crate::plan::{Capacities, Stencil, StencilStep, Vertices};
use crate::scene::Fill;
use crate::strategies::row::{Abilities, CapSurfaceRow, Caps, Facts};

/// The row of the table.
pub static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: Facts {
        name: "stencil",
        parameter: None,
        about: "the plane, where back faces minus front faces of what is kept say that it is inside: the classic way",
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
fn record(recorder: &mut Recorder<'_>, _: Rasteriser, _: &Capacities) -> Result<(), Refusal> {
    near_plane_is_free(recorder)?;
    recorder.targets_with_stencil();
    for rank in recorder.relevance.cut_parts().to_vec() {
        let part = &recorder.model.prepared.parts[rank];
        let (name, fill) = (part.name.clone(), part.fill);
        let place = recorder.relevance.place_of(rank) as u32;
        let (vertices, indices) = recorder.mesh();
        let solid = DrawPass {
            name: format!("solid {place}"),
            reason: format!("what the plane leaves of `{name}`; back faces minus front faces"),
            shader: "strategies/inside/stencil/solid.wgsl".into(),
            bindings: vec![recorder.frame(), recorder.parts(), recorder.ray_table()],
            constants: Vec::new(),
            vertices,
            indices,
            draws: recorder.draws_of_rest(&[rank]),
        };
        let counts = Stencil {
            clear: place == 0,
            step: StencilStep::WindAll,
        };
        let groups = recorder.draws_of_groups(&[rank]);
        let settled = (!groups.is_empty()).then(|| DrawPass {
            name: format!("solid {place} settled"),
            reason: format!("faces of `{name}` in the plane or just beside it, on the side on which they are known to lie"),
            shader: "strategies/inside/stencil/solid_settled.wgsl".into(),
            bindings: vec![
                recorder.frame(),
                recorder.parts(),
                recorder.ray_table(),
                recorder.settled(),
            ],
            constants: Vec::new(),
            vertices,
            indices,
            draws: groups,
        });
        recorder.draw_with(solid, Some(counts));
        if let Some(settled) = settled {
            let counts = Stencil {
                clear: false,
                ..counts
            };
            recorder.draw_with(settled, Some(counts));
        }

        let (indices, draws) = full_screen(recorder, place);
        let cap = DrawPass {
            name: format!("cap {place}"),
            reason: format!("the plane, where it is inside `{name}`"),
            shader: "strategies/inside/stencil/cap.wgsl".into(),
            bindings: vec![
                recorder.frame(),
                recorder.cut_table(),
                recorder.parts(),
                recorder.ray_table(),
            ],
            constants: Vec::new(),
            vertices: Vertices::None,
            indices,
            draws,
        };
        let takes = Stencil {
            clear: false,
            step: StencilStep::Take {
                bits: match fill {
                    Fill::EvenOdd => 1,
                    Fill::Nonzero => 0xff,
                },
            },
        };
        recorder.draw_with(cap, Some(takes));
    }
    recorder.draw_plain_parts(false);
    recorder.gather();
    Ok(())
}

/// Refuses a near plane that meets what is cut.
fn near_plane_is_free(recorder: &Recorder<'_>) -> Result<(), Refusal> {
    let parts = &recorder.model.prepared.parts;
    let mut cut = recorder.relevance.cut_parts().iter().map(|r| &parts[*r]);
    match cut.find(|p| recorder.view.near_plane_meets(&p.bounds)) {
        None => Ok(()),
        Some(met) => Err(Refusal::new(
            Obstacle::NearPlane,
            format!(
                "the near plane meets `{}`: what lies before it is not drawn, and the stencil cannot count it",
                met.name
            ),
        )),
    }
}
