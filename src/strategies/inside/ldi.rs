//! `ldi:RES`: layered depth images (Shade et al. 1998) of all cut parts, built in one go in every frame.
//!
//! The image of a part is that of `vds`: along the shortest axis of its box, orthographic, depth in 0..1. But instead of peeling layer
//! after layer, one pass over the mesh counts the fragments of each texel of all images, a prefix sum lays their lists out, and a second
//! pass fills them. The parity test counts the depths behind a point, in any order. So a mesh may move or change from frame to frame at the
//! cost of two passes, whatever its depth complexity, and coincident faces, which peeling loses, are all kept.
//!
//! The hardware rasteriser draws all images at once; the compute rasteriser draws the parts one by one.
//!
//! Per frame: two mesh passes at RES x RES, a prefix sum of three to five passes, one load per query for each depth in the texel; 4 bytes
//! per texel of each part and 4 per fragment. Error: that of `vds`, in proportion to 1/RES along silhouettes.
//!
//! Cannot: predict the number of fragments (nor can `abuffer`); hold more texels and fragments than fit in a storage binding, 128 MiB in
//! core WebGPU.

use super::vds;
use crate::passes::{
    FragmentLists, Fresh, Rasteriser, Refusal, SceneBuffers, ScreenMesh, ScreenOf, Share, Store,
    SweepPasses, Volume, counted, groups_along, need,
};
use crate::plan::pack::{self, Sprite};
use crate::plan::{
    Binding, BufferRole, Clock, Contents, DepthTarget, Format, Pass, Plan, Resource, ResourceId,
    Work,
};
use crate::shader::Shader;
use crate::strategies::row::{
    Abilities, InsideTestKind, InsideTestRow, StrategyInfo, StrategyParameter,
};

/// Name of the bounded buffer, reported when a frame needs more.
const FRAGMENTS_OF_TEXELS: &str = "fragments of the layered depth images";

/// The inside test's row in the strategy table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
        name: "ldi",
        parameter: Some(StrategyParameter {
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
    answers: InsideTestKind::Points(|plan, scene, resolution| {
        let volume = record(plan, scene, resolution)?;
        Ok(vec![(0..scene.input.active_cuts.lanes, volume)])
    }),
};

/// Records the images of the cut parts.
fn record(plan: &mut Plan, scene: &SceneBuffers<'_>, resolution: u32) -> Result<Volume, Refusal> {
    let input = scene.input;
    let ranks = input.active_cuts.cut_parts();
    let texels = u64::from(resolution).pow(2) * ranks.len() as u64;
    let lists = FragmentLists::of_mesh(plan, input, texels, false, FRAGMENTS_OF_TEXELS)?;
    let sprites = table(plan, scene, resolution);
    let need = need(plan, input, Clock::Frame);
    plan.add_pass(Pass::new(
        "image clear",
        "the fragment counts of all texels start at zero",
        "strategies/inside/ldi/clear.wgsl",
        lists.emptied().to_vec(),
        Work::Compute {
            groups: groups_along(lists.count()),
        },
    ));
    let of = counted(ranks.len(), "part");
    let count = format!("how many fragments each texel has, in the images of {of}");
    let fill = format!("the depths of the fragments, in the images of {of}");
    match input.rasteriser {
        Rasteriser::Hardware => {
            let format = Format::Depth32Float;
            let target =
                Resource::texture("image target", [resolution; 2], 1, format, Clock::Frame);
            let target = plan.add_resource(target);
            let draw = |name, reason: &str, store: &Store| {
                draw(scene, name, reason, store, &sprites, target)
            };
            plan.add_pass(draw("image count", &count, &lists.counting()));
            lists.lay_out(plan, "fragments of each texel", need);
            plan.add_pass(draw("image fill", &fill, &lists.keeping()));
        }
        Rasteriser::Compute => {
            let mut screens = Vec::with_capacity(ranks.len());
            for (image, rank) in ranks.iter().enumerate() {
                let first = image as u32 * resolution * resolution;
                let own = lists.starting_at(plan, first);
                let counting = own.counting();
                let screen = screen(plan, scene, (image, *rank), resolution, &counting)?;
                SweepPasses::of_fragments("count", &count, &counting).record(plan, scene, &screen);
                screens.push((screen, own));
            }
            lists.lay_out(plan, "fragments of each texel", need);
            for (screen, own) in screens {
                let keeping = own.keeping();
                let filling = SweepPasses {
                    again: true,
                    ..SweepPasses::of_fragments("fill", &fill, &keeping)
                };
                filling.record(plan, scene, &screen);
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

/// The boxes of the parts, indexed as in the part table.
fn table(plan: &mut Plan, scene: &SceneBuffers<'_>, resolution: u32) -> Binding {
    let parts = &scene.input.model.prepared.parts;
    let ranks = scene.input.active_cuts.cut_parts().iter().zip(0_u32..);
    let rows: Vec<Sprite> = ranks
        .map(|(rank, image)| vds::sprite(&parts[*rank].bounds, resolution, 0, image))
        .collect();
    let images = Resource::own_upload(
        "images",
        BufferRole::Storage,
        Contents::from_values(&rows),
        Clock::Cut,
    );
    Binding::read("sprites", plan.add_resource(images))
}

/// A pass in which the fragments of all images are passed to the store.
fn draw(
    scene: &SceneBuffers<'_>,
    name: &str,
    reason: &str,
    store: &Store,
    sprites: &Binding,
    target: ResourceId,
) -> Pass {
    let (vertices, indices) = scene.mesh();
    let mut bindings = vec![sprites.clone()];
    bindings.extend(store.bindings.iter().cloned());
    Pass::new(
        name,
        reason,
        Shader::from("strategies/inside/ldi/fragments.wgsl").with(store.file),
        bindings,
        Work::Draw {
            color: None,
            depth: DepthTarget::untouched(target),
            vertices,
            indices,
            draws: scene.input.draws_of(scene.input.active_cuts.cut_parts()),
        },
    )
}

/// The compute rasteriser's screen for the image of a part.
fn screen(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    (image, rank): (usize, usize),
    resolution: u32,
    store: &Store,
) -> Result<ScreenMesh, Refusal> {
    let bounds = scene.input.model.prepared.parts[rank].bounds;
    let sprite = vds::sprite(&bounds, resolution, 0, 0);
    let view = vds::view(&bounds, resolution);
    let name = format!("image {image}");
    let frame = Contents::from_values(&[pack::sprite_frame(&sprite)]);
    let frame_name = format!("{name} frame");
    let frame = Resource::upload(frame_name, BufferRole::Uniform, frame, Clock::Frame);
    let of = ScreenOf {
        classifies: false,
        share: Share::of_store(store),
        name: &name,
        view: &view,
        frame: Binding::read("frame", plan.add_resource(frame)),
        clock: Clock::Frame,
        ranks: &[rank],
        fresh: Fresh::nothing(),
    };
    ScreenMesh::record(plan, scene, of)
}
