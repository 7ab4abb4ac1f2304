//! `ldi:RES`: layered depth images (Shade et al. 1998) of all cut parts, built in one go in every frame.
//!
//! The image of a part is that of `vds`: along the shortest axis of its box, orthographic, depth in 0..1. But instead of
//! peeling layer after layer, one pass over the mesh counts the fragments of each texel of all images, a prefix sum lays
//! their lists out, and a second pass fills them. The parity test counts the depths behind a point, in whatever order they
//! came. So a mesh may move or change from frame to frame at the price of two passes, whatever its depth complexity, and
//! faces of equal depth are all kept, which peeling loses.
//!
//! By the GPU's own rasteriser all images are drawn at once; the compute rasteriser takes the parts one by one.
//!
//! Per frame: two mesh passes at RES x RES, a prefix sum of three to five, as many loads per question as the texel has
//! depths; 4 bytes per texel of each part and 4 per fragment. Error: that of `vds`, in proportion to 1/RES along silhouettes.
//!
//! Cannot: know before a frame how many fragments there will be, as `abuffer`; hold more texels and fragments than a storage
//! binding, 128 MiB in core WebGPU.

use super::vds;
use crate::passes::Refusal;
use crate::passes::{
    Rasteriser, Recorder, Screen, ScreenOf, Store, Sweep, Volume, counted, groups_along,
    sweep_of_fragments,
};
use crate::plan::pack::{self, Sprite};
use crate::plan::{
    Binding, Capacities, Clock, Contents, DepthCompare, DepthTarget, Format, Pass, Resource, Role,
    Work,
};
use crate::shader::Shader;
use crate::strategies::row::{Abilities, Answers, Facts, InsideTestRow, Parameter};

/// What is bounded, for the report of a frame that needs more.
const FRAGMENTS_OF_TEXELS: &str = "fragments of the layered depth images";

/// The row of the table.
pub static ROW: InsideTestRow = InsideTestRow {
    facts: Facts {
        name: "ldi",
        parameter: Some(Parameter {
            letter: "RES",
            about: "texels along a side",
            usual: 1024,
            least: 16,
            most: 8192,
            steps_per_unit: 1,
        }),
        about: "layered depth images of RES x RES of all parts, filled in one go in every frame; faces that coincide are kept",
        limit: "",
        rebuilds: "",
        can: Abilities {
            nonzero: false,
            ..Abilities::ALL
        },
        hard_cases: &[("raycast+ldi:512", false), ("grid:256+ldi:512", false)],
    },
    answers: Answers::Points(|recorder, resolution, rasteriser, capacities| {
        let ranks = recorder.relevance.cut_parts().to_vec();
        let volume = record(recorder, rasteriser, &ranks, resolution, capacities)?;
        Ok(vec![(0..ranks.len(), volume)])
    }),
};

/// Records the images of some parts, by rank.
fn record(
    recorder: &mut Recorder<'_>,
    rasteriser: Rasteriser,
    ranks: &[usize],
    resolution: u32,
    capacities: &Capacities,
) -> Result<Volume, Refusal> {
    let texels = u64::from(resolution).pow(2) * ranks.len() as u64;
    let lists = recorder.fragment_lists(texels, false, capacities, FRAGMENTS_OF_TEXELS)?;
    let sprites = table(recorder, ranks, resolution);
    let need = recorder.need(Clock::Frame);
    recorder.plan.add_pass(Pass {
        name: "image clear".to_owned(),
        clock: Clock::Frame,
        reason: "the lists of all texels are counted from zero".to_owned(),
        shader: "strategies/inside/ldi/clear.wgsl".into(),
        bindings: lists.emptied().to_vec(),
        constants: Vec::new(),
        work: Work::Compute {
            groups: groups_along(lists.count()),
        },
    });
    let of = counted(ranks.len(), "part");
    let count = format!("how many fragments each texel has, in the images of {of}");
    let fill = format!("the depths of the fragments, in the images of {of}");
    match rasteriser {
        Rasteriser::Hardware => {
            let counting = lists.counting();
            draw(
                recorder,
                ranks,
                resolution,
                "image count",
                count,
                &counting,
                &sprites,
            );
            recorder.lay_out(&lists, "fragments of each texel", need);
            let keeping = lists.keeping();
            draw(
                recorder,
                ranks,
                resolution,
                "image fill",
                fill,
                &keeping,
                &sprites,
            );
        }
        Rasteriser::Compute => {
            let mut screens = Vec::with_capacity(ranks.len());
            for (image, rank) in ranks.iter().enumerate() {
                let first = image as u32 * resolution * resolution;
                let own = recorder.lists_from(&lists, first);
                let screen = screen(recorder, image, *rank, resolution)?;
                let counting = own.counting();
                recorder.sweep(&screen, &sweep_of_fragments("count", &count, &counting));
                screens.push((screen, own));
            }
            recorder.lay_out(&lists, "fragments of each texel", need);
            for (screen, own) in screens {
                let keeping = own.keeping();
                let filling = Sweep {
                    again: true,
                    ..sweep_of_fragments("fill", &fill, &keeping)
                };
                recorder.sweep(&screen, &filling);
            }
        }
    }
    let mut bindings = vec![sprites];
    bindings.extend(lists.read());
    Ok(Volume {
        file: "lib/volume/ldi.wgsl",
        bindings,
    })
}

/// The boxes of the parts, by place.
fn table(recorder: &mut Recorder<'_>, ranks: &[usize], resolution: u32) -> Binding {
    let rows: Vec<Sprite> = recorder
        .relevance
        .cut_parts()
        .iter()
        .map(|rank| match ranks.iter().position(|r| r == rank) {
            None => bytemuck::Zeroable::zeroed(),
            Some(image) => {
                let bounds = &recorder.model.prepared.parts[*rank].bounds;
                vds::sprite(bounds, resolution, 0, image as u32)
            }
        })
        .collect();
    let id = recorder.once("images", |_| {
        Resource::own_upload("images", Role::Storage, Contents::of(&rows), Clock::Cut)
    });
    Binding::read("sprites", id)
}

#[allow(
    clippy::too_many_arguments,
    reason = "the sentence form of a pass: each word is one argument"
)]
fn draw(
    recorder: &mut Recorder<'_>,
    ranks: &[usize],
    resolution: u32,
    name: &str,
    reason: String,
    store: &Store,
    sprites: &Binding,
) {
    let (vertices, indices) = recorder.mesh();
    let mut bindings = vec![sprites.clone()];
    bindings.extend(store.bindings.iter().cloned());
    // Nothing is drawn into it: a pass that draws must have one.
    let target = recorder.once("image target", |_| {
        let size = [resolution; 2];
        Resource::texture("image target", size, 1, Format::Depth32Float, Clock::Frame)
    });
    recorder.plan.add_pass(Pass {
        name: name.to_owned(),
        clock: Clock::Frame,
        reason,
        shader: Shader::from("strategies/inside/ldi/fragments.wgsl").with(store.file),
        bindings,
        constants: Vec::new(),
        work: Work::Draw {
            color: None,
            depth: DepthTarget {
                resource: target,
                layer: 0,
                clear: true,
                compare: DepthCompare::Always,
                stencil: None,
            },
            vertices,
            indices,
            draws: recorder.draws_of(ranks),
        },
    });
}

/// A part on the screen that is its image.
fn screen(
    recorder: &mut Recorder<'_>,
    image: usize,
    rank: usize,
    resolution: u32,
) -> Result<Screen, Refusal> {
    let bounds = recorder.model.prepared.parts[rank].bounds;
    let sprite = vds::sprite(&bounds, resolution, 0, 0);
    let view = vds::view(&bounds, resolution);
    let contents = Contents::of(&[pack::sprite_frame(&sprite)]);
    let name = format!("image {image}");
    let frame = recorder.once(&format!("{name} frame"), |_| {
        Resource::upload(
            format!("{name} frame"),
            Role::Uniform,
            contents,
            Clock::Frame,
        )
    });
    recorder.screen(ScreenOf {
        settles: false,
        name: &name,
        view: &view,
        frame: Binding::read("frame", frame),
        clock: Clock::Frame,
        ranks: &[rank],
        fresh: "lib/fresh/nothing.wgsl",
        freshened: Vec::new(),
    })
}
