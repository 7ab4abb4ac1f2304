//! `vds:RES`: the volumetric depth sprite of Trapp & Döllner 2013 (after their *Real-time volumetric tests using layered depth
//! images*, 2008): a layered depth image of one part, built once by depth peeling, and a parity test on it.
//!
//! The sprite looks along one axis of scene space, the shortest of the part's box, orthographically and with linear depth in 0..1. It has
//! as many layers as the depth complexity at its resolution, which is counted first, since grazing silhouettes make it grow with the
//! resolution. The test loads texels unfiltered, because filtering would blend different surfaces.
//!
//! Per solid: one counting pass and d peeling passes; 4 d RES² bytes per part, and 4 RES² for counting. Per frame: d loads per cap
//! fragment. Error: a point is tested up to half a texel away from its position, so wrong pixels line the silhouettes in proportion to
//! 1/RES. Cannot: follow a moving mesh without a rebuild; keep coincident faces apart (peeling loses ties).
//!
//! Corrections to the paper: its listing 2 samples slices at their boundary, where filtering blends two layers; its VPT formula is also
//! true in gaps outside the solid, while the parity in its listing is right.
//!
//! With `raycast` instead of the paper's grid, the crossings of each pixel are looked up in the sprites of one part after the other, and
//! the answers become mask words: the caps have the right depth, and only their rims are inexact.

use glam::{DVec2, DVec3};

use crate::passes::{NEED_OF_SPRITES, SceneBuffers, Volume, need, pixels};
use crate::plan::pack::Sprite;
use crate::plan::{
    Binding, Bounded, BufferRole, Capacity, Clock, Contents, DepthCompare, DepthTarget, Format,
    Pass, Plan, Resource, ResourceId, Work,
};
use crate::scene::{Bounds, Precision, View};
use crate::strategies::row::{
    Abilities, InsideTestKind, InsideTestRow, StrategyInfo, StrategyParameter,
};

/// The inside test's row in the strategy table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
        name: "vds",
        parameter: Some(StrategyParameter {
            letter: "RES",
            about: "texels along a side",
            usual: 1024,
            least: 16,
            most: 8192,
            steps_per_unit: 1,
        }),
        about: "the paper's volumetric depth sprite: a layered depth image of RES x RES of each part",
        limit: "",
        rebuilds: "the sprite, one pass for each of its layers",
        can: Abilities {
            nonzero: false,
            compute: false,
            ..Abilities::ALL
        },
        hard_cases: &[("raycast+vds:512", false), ("grid:256+vds:512", true)],
    },
    answers: InsideTestKind::Points(|plan, scene, resolution| {
        // All parts count in the same buffer, one after the other.
        let bytes = pixels([resolution; 2]) * 4;
        let counts = Resource::storage("sprite counts", bytes, Clock::Solid);
        let counts = plan.add_resource(counts);
        let ranks = scene.input.active_cuts.cut_parts().iter().enumerate();
        let sprites = ranks.map(|(place, rank)| {
            let sprite = record(plan, scene, *rank, resolution, counts);
            (place..place + 1, sprite)
        });
        Ok(sprites.collect())
    }),
};

/// Maximum number of layers of a sprite: the layer limit of a texture.
pub(crate) const MOST_LAYERS: u32 = 256;

/// Records the sprite of the part with the given rank.
fn record(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    rank: usize,
    resolution: u32,
    counts: ResourceId,
) -> Volume {
    let part = &scene.input.model.prepared.parts[rank];
    // Keyed by the part's number in the scene, which cuts do not change: a sprite is kept when other parts begin or cease to be cut.
    let number = part.part as u32;
    let name = &part.name;
    let layers = scene.input.capacities.layers_of(rank);
    let layers = layers.clamp(1, MOST_LAYERS);
    let slot = NEED_OF_SPRITES + number;
    let size = [resolution; 2];
    let sprite = Contents::from_values(&[sprite(&part.bounds, resolution, layers, slot)]);
    let table_name = format!("sprite {number}");
    let sprite = Resource::upload(table_name, BufferRole::Uniform, sprite, Clock::Solid);
    let sprite = Binding::read("sprite", plan.add_resource(sprite));
    let layers_name = format!("sprite layers {number}");
    let format = Format::Depth32Float;
    let depth = Resource::texture(layers_name, size, layers, format, Clock::Solid);
    let depth = plan.add_resource(depth);
    let need = need(plan, scene.input, Clock::Solid);

    let clear = Pass::new(
        format!("sprite clear {number}"),
        format!("the layer count of `{name}` starts at zero"),
        "strategies/inside/vds/clear.wgsl",
        vec![
            sprite.clone(),
            Binding::write("counts", counts),
            Binding::write("need", need),
        ],
        Work::over(size),
    );
    plan.add_pass(clear.on(Clock::Solid));
    let draw_into = |depth| {
        let (vertices, indices) = scene.solid_mesh();
        Work::Draw {
            color: None,
            depth,
            vertices,
            indices,
            draws: scene.input.draws_of(&[rank]),
        }
    };
    let count = Pass::new(
        format!("sprite count {number}"),
        "the sprite needs as many layers as the depth complexity at this resolution",
        "strategies/inside/vds/count.wgsl",
        vec![
            sprite.clone(),
            Binding::update("counts", counts),
            Binding::update("need", need),
        ],
        draw_into(DepthTarget::untouched(depth)),
    );
    plan.add_pass(count.on(Clock::Solid));
    for layer in 0..layers {
        let mut bindings = vec![sprite.clone()];
        let shader = if layer == 0 {
            "strategies/inside/vds/peel_first.wgsl"
        } else {
            bindings.push(Binding::read_layer("previous", depth, layer - 1));
            "strategies/inside/vds/peel_next.wgsl"
        };
        let peel = Pass::new(
            format!("sprite peel {number}.{layer}"),
            format!("layer {layer} of `{name}`, behind the previous layer"),
            shader,
            bindings,
            draw_into(DepthTarget {
                resource: depth,
                layer,
                clear: true,
                compare: DepthCompare::Less,
                stencil: None,
            }),
        );
        plan.add_pass(peel.on(Clock::Solid));
    }
    plan.bounded.push(Bounded {
        what: format!("layers of the sprite of `{name}`"),
        slot,
        capacity: layers,
        resizes: Some(Capacity::Layers(rank)),
        exact: true,
    });
    Volume {
        file: "lib/volume/vds.wgsl",
        bindings: vec![sprite, Binding::read("depth_layers", depth)],
    }
}

/// Axes of a sprite (s, t and depth), and the scale from scene space to the sprite. The depth axis is along the shortest side of the box,
/// and there is a margin of two texels.
fn axes(bounds: &Bounds, resolution: u32) -> ([DVec3; 3], f64) {
    let size = bounds.size();
    let all = [DVec3::X, DVec3::Y, DVec3::Z];
    let depth = (0..3)
        .min_by(|a, b| size[*a].total_cmp(&size[*b]))
        .unwrap_or(2);
    let margin = 4.0 / f64::from(resolution);
    let per_unit = (1.0 - margin) / size.max_element().max(1e-12);
    let axes = [(depth + 1) % 3, (depth + 2) % 3, depth].map(|axis| all[axis]);
    (axes, per_unit)
}

/// Rows from scene space to the sprite: the box, scaled uniformly into the unit cube.
pub(super) fn sprite(bounds: &Bounds, resolution: u32, layers: u32, slot: u32) -> Sprite {
    let (axes, per_unit) = axes(bounds, resolution);
    let [s_row, t_row, depth_row] = axes.map(|axis| {
        let n = axis * per_unit;
        let w = 0.5 - n.dot(bounds.centre());
        [n.x as f32, n.y as f32, n.z as f32, w as f32]
    });
    Sprite {
        s_row,
        t_row,
        depth_row,
        resolution,
        layers,
        slot,
        padding: 0,
    }
}

/// The sprite's projection as a view, one pixel per texel.
pub(super) fn view(bounds: &Bounds, resolution: u32) -> View {
    let ([s, t, depth], per_unit) = axes(bounds, resolution);
    let half = 0.5 / per_unit;
    View {
        size_px: [resolution; 2],
        centre_px: DVec2::splat(0.5 * f64::from(resolution)),
        eye: bounds.centre() - depth * half,
        right: s,
        up: -t,
        forward: depth,
        half_height: half,
        orthographic: true,
        near: 0.0,
        far: 2.0 * half,
        near_cap: false,
        band: [0, resolution],
        halo_rows: [0; 2],
        fineness: 1,
        precision: Precision::USUAL,
    }
}
