//! `stencil`: parity in the stencil buffer, by fixed-function hardware alone.
//!
//! With a cap surface: the depth of crossing i of every pixel is laid down in the depth buffer, the solid is drawn with the depth test,
//! and what lies behind inverts a bit of the stencil, both faces alike (Carmack's reverse for one surface per pixel). The 8 bits
//! of a stencil serve 8 pairs of part and crossing before it is taken into the words of the mask, where the same resolve
//! as that of `mask` finds the same bits. A part filled nonzero has the stencil to itself: back faces add 1, front faces take 1.
//! Ancestors: Heidmann's and Carmack's shadow volumes; capping with the clip plane laid into the depth buffer is old practice.
//!
//! Per frame: the mesh once for its surfaces, and each cut part once more for each crossing a pixel may have and once for the total;
//! a pass over the picture for each crossing and each 8 pairs; 5 bytes a pixel beside the mask. No atomics.
//!
//! On the adapter of the tests the mask is that of `mask` bit for bit. Elsewhere a depth test may round a depth otherwise than the
//! shader that ranks the surfaces sees it; then samples within such a rounding of a crossing may differ.
//!
//! Cannot: see more than 255 shells of a part filled nonzero, where the stencil runs over unseen; draw by the compute rasteriser.
//! `stencil` by itself is [`alone`].

pub mod alone;

use crate::passes::Refusal;
use crate::passes::{Crossings, Inside, Rasteriser, Recorder, Store};
use crate::plan::{
    Binding, Capacities, Clock, Contents, DepthCompare, DepthTarget, Draw, Format, Pass, Resource,
    ResourceId, Role, Stencil, StencilStep, Vertices, Work,
};
use crate::scene::Fill;
use crate::shader::Shader;
use crate::strategies::row::{Abilities, Answers, CapSurface, Facts, InsideTestRow};
use crate::strategies::surface;

/// Pairs that fit a stencil.
const BITS: usize = 8;
/// Passes beyond which a frame is refused: a device times so many in one go.
const MOST_PASSES: usize = 2000;

/// One draw of one part.
#[derive(Clone, Copy)]
struct Mark {
    rank: usize,
    /// Counts what is behind this crossing; all fragments where there is none.
    crossing: Option<u32>,
}

/// The row of the table.
pub static ROW: InsideTestRow = InsideTestRow {
    facts: Facts {
        name: "stencil",
        parameter: None,
        about: "the stencil: each crossing laid into the depth buffer and the mesh drawn against it, without atomics",
        limit: "",
        rebuilds: "",
        can: Abilities {
            compute: false,
            ..Abilities::ALL
        },
        hard_cases: &[("raycast+stencil", true)],
    },
    answers: Answers::Rays(record),
};

/// Records the frame of a cap surface with `stencil`.
fn record(
    recorder: &mut Recorder<'_>,
    surface: CapSurface,
    _: u32,
    _: Rasteriser,
    capacities: &Capacities,
) -> Result<(), Refusal> {
    let parts = recorder.relevance.lanes;
    // Lists of one word refuse the frame where they are too many passes, longer ones are held shorter.
    let most = (MOST_PASSES / (parts + 2)) as u32;
    let most = most.saturating_sub(1).max(Capacities::CROSSINGS_OF_A_WORD);
    let capacity = surface::capacity(recorder, capacities).min(most);
    recorder.lay_lanes(capacity);
    let passes = (capacity as usize + 1) * (parts + 2);
    if passes > MOST_PASSES {
        return Err(Refusal::amount(format!(
            "{parts} cut parts with {capacity} crossings each are {passes} passes for the stencil; {MOST_PASSES} are the most"
        )));
    }
    let mask = recorder.mask();
    let stencil = recorder.once("stencil", |r| {
        let format = Format::Depth32FloatStencil8;
        Resource::texture("stencil", r.view.size_px, 1, format, Clock::Frame)
    });
    let emptied = Store::nothing(vec![Binding::write("mask", mask)]);
    let crossings = surface::list(recorder, surface, capacity, &emptied, capacities)?;
    let nothing = Store::nothing(Vec::new());
    recorder.over_mesh(Rasteriser::Hardware, &nothing, &crossings)?;

    let mut marks = Marks {
        stencil,
        mask,
        crossings,
        laid: None,
        batches: 0,
    };
    for (fill, most) in [(Fill::EvenOdd, BITS), (Fill::Nonzero, 1)] {
        let is_filled = |r: &&usize| recorder.model.prepared.parts[**r].fill == fill;
        let ranks: Vec<usize> = (recorder.relevance.cut_parts().iter())
            .filter(is_filled)
            .copied()
            .collect();
        let crossings = (0..capacity).map(Some).chain([None]);
        let all: Vec<Mark> = crossings
            .flat_map(|crossing| {
                ranks.iter().map(move |rank| Mark {
                    rank: *rank,
                    crossing,
                })
            })
            .collect();
        for batch in all.chunks(most) {
            marks.record(recorder, fill, batch);
        }
    }
    recorder.resolve(Rasteriser::Hardware, Inside::mask(mask), &crossings);
    Ok(())
}

/// What the batches share.
struct Marks {
    stencil: ResourceId,
    mask: ResourceId,
    crossings: Crossings,
    /// The crossing whose depth lies in the buffer.
    laid: Option<u32>,
    batches: u32,
}

impl Marks {
    /// Draws that fill the stencil, and the pass that takes it.
    fn record(&mut self, recorder: &mut Recorder<'_>, fill: Fill, batch: &[Mark]) {
        let (vertices, indices) = recorder.mesh();
        let lanes = recorder.lane_table().places;
        let mut constants = vec![("used", batch.len() as f64)];
        for (bit, mark) in batch.iter().enumerate() {
            if let Some(crossing) = mark.crossing
                && self.laid != Some(crossing)
            {
                self.lay(recorder, fill, crossing);
            }
            let place = recorder.relevance.place_of(mark.rank);
            let name = &recorder.model.prepared.parts[mark.rank].name;
            let (to, what, reason) = match mark.crossing {
                Some(i) => (
                    i,
                    format!("crossing {i}"),
                    format!("what of `{name}` is behind crossing {i} counts in the stencil"),
                ),
                None => (
                    recorder.lane_bits - 1,
                    "in all".to_owned(),
                    format!("all of `{name}` counts: whether the mesh is closed along the ray"),
                ),
            };
            let [word, shift] = lanes[place];
            constants.push((TO[bit], f64::from(32 * word + shift + to)));
            let step = match fill {
                Fill::EvenOdd => StencilStep::Flip { bits: 1 << bit },
                Fill::Nonzero => StencilStep::Wind,
            };
            let pass = Pass {
                name: format!("mark {place} {what}"),
                clock: Clock::Frame,
                reason,
                shader: "strategies/inside/stencil/mark.wgsl".into(),
                bindings: vec![recorder.frame()],
                constants: Vec::new(),
                work: Work::Draw {
                    color: None,
                    depth: DepthTarget {
                        resource: self.stencil,
                        layer: 0,
                        clear: false,
                        compare: match mark.crossing {
                            Some(_) => DepthCompare::Behind,
                            None => DepthCompare::Always,
                        },
                        stencil: Some(Stencil {
                            clear: bit == 0,
                            step,
                        }),
                    },
                    vertices,
                    indices,
                    draws: recorder.draws_of_rest(&[mark.rank]),
                },
            };
            let settled = self.settled(recorder, &pass, mark.rank);
            recorder.plan.add_pass(pass);
            if let Some(pass) = settled {
                recorder.plan.add_pass(pass);
            }
        }
        if fill == Fill::Nonzero {
            constants.push(("winds", 1.0));
        }
        let bindings = vec![
            recorder.frame(),
            Binding::read("stencil", self.stencil),
            Binding::update("mask", self.mask),
        ];
        recorder.compute(
            format!("take {}", self.batches),
            Clock::Frame,
            "the stencil becomes bits of the mask, and is free for others",
            "strategies/inside/stencil/take.wgsl",
            bindings,
            constants,
            recorder.view.size_px,
        );
        self.batches += 1;
    }

    /// The same as a pass for the settled triangles of its part, if there are any.
    fn settled(&self, recorder: &mut Recorder<'_>, pass: &Pass, rank: usize) -> Option<Pass> {
        let groups = recorder.draws_of_groups(&[rank]);
        if groups.is_empty() {
            return None;
        }
        let mut settled = pass.clone();
        settled.name = format!("{} settled", pass.name);
        settled.reason = "the same for faces in a clip-surface or just beside it".to_owned();
        settled.shader = "strategies/inside/stencil/mark_settled.wgsl".into();
        settled.bindings.push(recorder.settled());
        settled.bindings.extend(self.crossings.bindings());
        settled.bindings.push(recorder.cut_table());
        if let Work::Draw { depth, draws, .. } = &mut settled.work {
            *draws = groups;
            if let Some(stencil) = &mut depth.stencil {
                stencil.clear = false;
            }
        }
        Some(settled)
    }

    /// Lays the depth of a crossing down.
    fn lay(&mut self, recorder: &mut Recorder<'_>, fill: Fill, crossing: u32) {
        self.laid = Some(crossing);
        let (indices, draws) = full_screen(recorder, 0);
        let again = match fill {
            Fill::EvenOdd => "",
            Fill::Nonzero => " to wind",
        };
        let pass = Pass {
            name: format!("lay {crossing}{again}"),
            clock: Clock::Frame,
            reason: format!(
                "the depth of crossing {crossing} is what fragments are tested against"
            ),
            shader: Shader::from("strategies/inside/stencil/lay.wgsl"),
            bindings: vec![
                recorder.frame(),
                Binding::read("crossing_heads", self.crossings.heads),
                Binding::read("crossing_z", self.crossings.z),
            ],
            constants: vec![("crossing", f64::from(crossing))],
            work: Work::Draw {
                color: None,
                depth: DepthTarget {
                    resource: self.stencil,
                    layer: 0,
                    clear: true,
                    compare: DepthCompare::Replace,
                    stencil: None,
                },
                vertices: Vertices::None,
                indices,
                draws,
            },
        };
        recorder.plan.add_pass(pass);
    }
}

/// Names of the constants that say where bits of the stencil go.
const TO: [&str; BITS] = [
    "to_0", "to_1", "to_2", "to_3", "to_4", "to_5", "to_6", "to_7",
];

/// Indices and draw of a triangle that covers the picture.
pub(in crate::strategies) fn full_screen(
    recorder: &mut Recorder<'_>,
    instance: u32,
) -> (ResourceId, Vec<Draw>) {
    let indices = recorder.once("screen indices", |_| {
        let contents = Contents::of(&[0_u32, 1, 2]);
        Resource::own_upload("screen indices", Role::Index, contents, Clock::Cut)
    });
    let draw = Draw {
        indices: 0..3,
        base_vertex: 0,
        vertex_count: 0,
        instance,
        arguments: None,
    };
    (indices, vec![draw])
}
