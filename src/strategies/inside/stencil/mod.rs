//! `stencil`: parity in the stencil buffer, by fixed-function hardware alone.
//!
//! With a cap surface: the depth of every pixel's crossing i is written to the depth buffer, the solid is drawn with the depth test, and
//! fragments behind it invert a stencil bit, both faces alike (Carmack's reverse for one surface per pixel). The 8 stencil bits serve 8
//! pairs of part and crossing before they are copied into the mask, where the same resolve as that of `mask` finds the same bits. A part
//! filled nonzero uses the whole stencil: back faces add 1, front faces subtract 1. Ancestors: Heidmann's and Carmack's shadow volumes;
//! capping with the clip plane drawn into the depth buffer is old practice.
//!
//! Per frame: the mesh once for its surfaces, and each cut part once more for each crossing a pixel may have and once for the total; a pass
//! over the picture for each crossing and for every 8 pairs; 5 bytes a pixel in addition to the mask. No atomics in the mesh passes.
//!
//! On the test adapter the mask equals that of `mask` bit for bit. Elsewhere the depth test may round a depth differently from the shader
//! that draws the surfaces; then samples within such a rounding error of a crossing may differ.
//!
//! Cannot: count more than 255 shells of a part filled nonzero, where the stencil overflows undetected; work with the compute rasteriser.
//! `stencil` without a cap surface is [`alone`].

pub(crate) mod alone;

use crate::effects::{FrameOutput, finish};
use crate::passes::{Crossings, Input, Inside, LISTED, Lanes, Refusal, SceneBuffers, resolve};
use crate::plan::{
    Binding, Capacities, Clock, DepthCompare, DepthTarget, Draw, Format, Pass, Plan, Resource,
    ResourceId, Stencil, StencilStep, Vertices, Work,
};
use crate::scene::Fill;
use crate::shader::Shader;
use crate::strategies::row::{Abilities, CapSurface, InsideTestKind, InsideTestRow, StrategyInfo};
use crate::strategies::surface;

/// Pairs of part and crossing that fit in the stencil.
const BITS: usize = 8;
/// Maximum stencil passes per frame; a frame that needs more is refused. A device records the times of this many at once.
const MOST_PASSES: usize = 2000;

/// One draw of one part.
#[derive(Clone, Copy)]
struct StencilDraw {
    rank: usize,
    /// The crossing behind which fragments count; `None` to count all fragments.
    crossing: Option<u32>,
}

/// The inside test's row in the strategy table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
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
    answers: InsideTestKind::Rays(record),
};

/// Records the frame of a cap surface with `stencil`.
fn record(
    plan: &mut Plan,
    input: &Input<'_>,
    surface: CapSurface,
    _: u32,
) -> Result<FrameOutput, Refusal> {
    let parts = input.active_cuts.lanes;
    // Longer lists are shortened to reduce the passes; if one-word lists still need too many, the frame is refused.
    let most = (MOST_PASSES / (parts + 2)) as u32;
    let most = most.saturating_sub(1).max(Capacities::CROSSINGS_OF_A_WORD);
    let capacity = surface::capacity(input).min(most);
    let passes = (capacity as usize + 1) * (parts + 2);
    if passes > MOST_PASSES {
        return Err(Refusal::amount(format!(
            "{parts} cut parts with {capacity} crossings each need {passes} stencil passes; {MOST_PASSES} are the most"
        )));
    }
    let scene = SceneBuffers::upload(plan, input, Lanes::of_bits(input, capacity))?;
    let mask = scene.lanes.mask(plan, input, 0);
    let (crossings, nearest) = super::leaving_nothing(plan, &scene, surface, capacity, mask)?;

    let format = Format::Depth32FloatStencil8;
    let stencil = Resource::texture("stencil", input.view.size_px, 1, format, Clock::Frame);
    let mut marks = Marks {
        scene: &scene,
        stencil: plan.add_resource(stencil),
        mask,
        crossings,
        laid: None,
        batches: 0,
    };
    for (fill, most) in [(Fill::EvenOdd, BITS), (Fill::Nonzero, 1)] {
        let is_filled = |r: &&usize| input.model.prepared.parts[**r].fill == fill;
        let ranks: Vec<usize> = (input.active_cuts.cut_parts().iter())
            .filter(is_filled)
            .copied()
            .collect();
        let crossings = (0..capacity).map(Some).chain([None]);
        let all: Vec<StencilDraw> = crossings
            .flat_map(|crossing| {
                ranks.iter().map(move |rank| StencilDraw {
                    rank: *rank,
                    crossing,
                })
            })
            .collect();
        for batch in all.chunks(most) {
            marks.record(plan, fill, batch);
        }
    }
    let inside = Inside::mask(mask);
    let layered = resolve(plan, &scene, nearest, inside, &crossings.asked());
    Ok(finish(plan, &scene, layered))
}

/// Data shared by the batches of pairs.
struct Marks<'a> {
    scene: &'a SceneBuffers<'a>,
    stencil: ResourceId,
    mask: ResourceId,
    crossings: Crossings,
    /// The crossing whose depth the depth buffer holds.
    laid: Option<u32>,
    batches: u32,
}

impl Marks<'_> {
    /// Records the draws that fill the stencil, and the pass that copies it into the mask.
    fn record(&mut self, plan: &mut Plan, fill: Fill, batch: &[StencilDraw]) {
        let (scene, input) = (self.scene, self.scene.input);
        let (vertices, indices) = scene.mesh();
        let mut constants = vec![("used", batch.len() as f64)];
        for (bit, mark) in batch.iter().enumerate() {
            if let Some(crossing) = mark.crossing
                && self.laid != Some(crossing)
            {
                self.laid = Some(crossing);
                plan.add_pass(self.lay(fill, crossing));
            }
            let place = input.active_cuts.place_of(mark.rank);
            let name = &input.model.prepared.parts[mark.rank].name;
            let (to, what, reason) = match mark.crossing {
                Some(i) => (
                    i,
                    format!("crossing {i}"),
                    format!("fragments of `{name}` behind crossing {i} count in the stencil"),
                ),
                None => (
                    scene.lanes.bits - 1,
                    "in all".to_owned(),
                    format!("all fragments of `{name}` count, to find where the mesh is open"),
                ),
            };
            let [word, shift] = scene.lanes.of_place(place);
            constants.push((TO[bit], f64::from(32 * word + shift + to)));
            let step = match fill {
                Fill::EvenOdd => StencilStep::Flip { bits: 1 << bit },
                Fill::Nonzero => StencilStep::Wind,
            };
            let depth = DepthTarget {
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
            };
            let pass = Pass::new(
                format!("mark {place} {what}"),
                reason,
                "strategies/inside/stencil/mark.wgsl",
                vec![scene.frame.clone()],
                Work::Draw {
                    color: None,
                    depth,
                    vertices,
                    indices,
                    draws: input.draws_of_rest(&[mark.rank]),
                },
            );
            let preclassified = self.preclassified(&pass, mark.rank);
            plan.add_pass(pass);
            if let Some(pass) = preclassified {
                plan.add_pass(pass);
            }
        }
        if fill == Fill::Nonzero {
            constants.push(("winds", 1.0));
        }
        let take = Pass::new(
            format!("take {}", self.batches),
            "the stencil becomes bits of the mask, and is free for other pairs",
            "strategies/inside/stencil/take.wgsl",
            vec![
                scene.frame.clone(),
                Binding::read("stencil", self.stencil),
                Binding::update("mask", self.mask),
            ],
            Work::over(input.view.size_px),
        );
        plan.add_pass(take.with_constants(constants));
        self.batches += 1;
    }

    /// The same pass for the part's preclassified triangles, if any.
    fn preclassified(&self, pass: &Pass, rank: usize) -> Option<Pass> {
        let groups = self.scene.input.draws_of_groups(&[rank]);
        let table = (self.scene.preclassified.as_ref()).filter(|_| !groups.is_empty())?;
        let mut preclassified = pass.clone();
        preclassified.name = format!("{} preclassified", pass.name);
        preclassified.reason = "the same for faces in or right next to a clip-surface".to_owned();
        preclassified.shader =
            Shader::from("strategies/inside/stencil/mark_preclassified.wgsl").with_all(&LISTED);
        preclassified.bindings.push(table.clone());
        preclassified.bindings.extend(self.crossings.bindings());
        preclassified.bindings.push(self.scene.cut_table.clone());
        if let Work::Draw { depth, draws, .. } = &mut preclassified.work {
            *draws = groups;
            if let Some(stencil) = &mut depth.stencil {
                stencil.clear = false;
            }
        }
        Some(preclassified)
    }

    /// The pass that writes the depth of a crossing to the depth buffer.
    fn lay(&self, fill: Fill, crossing: u32) -> Pass {
        let again = match fill {
            Fill::EvenOdd => "",
            Fill::Nonzero => " to wind",
        };
        let pass = Pass::new(
            format!("lay {crossing}{again}"),
            format!("the depth of crossing {crossing} is what fragments are tested against"),
            Shader::from("strategies/inside/stencil/lay.wgsl").with_all(&LISTED),
            vec![
                self.scene.frame.clone(),
                Binding::read("crossing_heads", self.crossings.heads),
                Binding::read("crossing_z", self.crossings.z),
            ],
            Work::Draw {
                color: None,
                depth: DepthTarget {
                    resource: self.stencil,
                    layer: 0,
                    clear: true,
                    compare: DepthCompare::Replace,
                    stencil: None,
                },
                vertices: Vertices::None,
                indices: self.scene.screen_indices,
                draws: vec![Draw::full_screen(0)],
            },
        );
        pass.with_constants(vec![("crossing", f64::from(crossing))])
    }
}

/// Names of the constants that say where bits of the stencil go.
const TO: [&str; BITS] = [
    "to_0", "to_1", "to_2", "to_3", "to_4", "to_5", "to_6", "to_7",
];
