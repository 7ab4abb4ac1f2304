//! `ldi:RES`: layered depth images (Shade et al. 1998) of all cut parts, built in one go in every frame.
//!
//! The image of a part is that of `vds`: along the shortest axis of its box, orthographic, depth in 0..1. But instead of
//! peeling layer after layer, one pass over the mesh counts the fragments of each texel of all images, a prefix sum lays
//! their lists out, and a second pass fills them. The parity test counts the depths behind a point, in whatever order they
//! came. So a mesh may move or change from frame to frame at the price of two passes, whatever its depth complexity, and
//! faces of equal depth are all kept, which peeling loses.
//!
//! Per frame: two mesh passes at RES x RES, a prefix sum of three to five, as many loads per question as the texel has
//! depths; 4 bytes per texel of each part and 4 per fragment. Error: that of `vds`, in proportion to 1/RES along silhouettes.
//!
//! Cannot: know before a frame how many fragments there will be, as `abuffer`; hold more texels and fragments than a storage
//! binding, 128 MiB in core WebGPU.

use super::vds;
use crate::passes::{Rasteriser, Recorder, Store, Volume, counted};
use crate::plan::pack::Sprite;
use crate::plan::{
    Binding, Capacities, Clock, Contents, DepthCompare, DepthTarget, Format, Pass, Resource,
    ResourceId, Role, Work,
};
use crate::shader::Shader;

/// What is bounded, for the report of a frame that needs more.
const FRAGMENTS_OF_TEXELS: &str = "fragments of the layered depth images";

/// Records the images of some parts, by rank.
pub fn record(
    recorder: &mut Recorder<'_>,
    ranks: &[usize],
    resolution: u32,
    capacities: &Capacities,
) -> Result<Volume, String> {
    let texels = u64::from(resolution).pow(2) * ranks.len() as u64;
    let lists = recorder.fragment_lists(texels, false, capacities, FRAGMENTS_OF_TEXELS)?;
    let sprites = table(recorder, ranks, resolution);
    let need = recorder.need(Clock::Frame);
    let row = u64::from(crate::passes::INVOCATIONS_PER_ROW);
    let groups = [
        u64::from(lists.count()).min(row).div_ceil(64).max(1) as u32,
        u64::from(lists.count()).div_ceil(row).max(1) as u32,
        1,
    ];
    recorder.plan.add_pass(Pass {
        name: "image clear".to_owned(),
        clock: Clock::Frame,
        reason: "the lists of all texels are counted from zero".to_owned(),
        shader: "strategies/inside/ldi/clear.wgsl".into(),
        bindings: lists.emptied().to_vec(),
        constants: Vec::new(),
        work: Work::Compute { groups },
    });
    let target = recorder.once("image target", |_| {
        Resource::texture(
            "image target",
            [resolution; 2],
            1,
            Format::Depth32Float,
            Clock::Frame,
        )
    });
    let of = counted(ranks.len(), "part");
    draw(
        recorder,
        ranks,
        "image count",
        format!("how many fragments each texel has, in the images of {of}"),
        &lists.counting(),
        &sprites,
        target,
    );
    recorder.lay_out(&lists, "fragments of each texel", need);
    draw(
        recorder,
        ranks,
        "image fill",
        format!("the depths of the fragments, in the images of {of}"),
        &lists.keeping(),
        &sprites,
        target,
    );
    let mut bindings = vec![sprites];
    bindings.extend(lists.read());
    Ok(Volume {
        file: "lib/volume/ldi.wgsl",
        bindings,
    })
}

/// Records the frame of `raycast+ldi:RES`.
pub fn record_with_raycast(
    recorder: &mut Recorder<'_>,
    rasteriser: Rasteriser,
    resolution: u32,
    capacities: &Capacities,
) -> Result<(), String> {
    let ranks = recorder.relevance.cut_parts().to_vec();
    vds::probed(recorder, rasteriser, capacities, |recorder| {
        let volume = record(recorder, &ranks, resolution, capacities)?;
        Ok(vec![(0..ranks.len(), volume)])
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
        let resource = Resource::upload("images", Role::Storage, Contents::of(&rows), Clock::Cut);
        Resource {
            is_scene: false,
            ..resource
        }
    });
    Binding::read("sprites", id)
}

fn draw(
    recorder: &mut Recorder<'_>,
    ranks: &[usize],
    name: &str,
    reason: String,
    store: &Store,
    sprites: &Binding,
    target: ResourceId,
) {
    let (vertices, indices) = recorder.mesh();
    let mut bindings = vec![sprites.clone()];
    bindings.extend(store.bindings.iter().cloned());
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
            },
            vertices,
            indices,
            draws: recorder.draws_of(ranks),
        },
    });
}
