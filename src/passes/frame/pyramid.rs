//! Pyramids over offset maps: least and greatest height of blocks of 4 x 4, 8 x 8, ... cells, up to one block for the whole map.
//!
//! Rays skip whole blocks that lie above or below them. One buffer holds all pyramids of a frame; clip-surfaces with the same map
//! share a pyramid, unless only some of them repeat it. Built on the clock of cuts, from the heights alone: if a clip-surface moves
//! or is scaled, its pyramid stays valid.
//!
//! Cost: one pass per five levels, three for the largest map; 8 bytes per node and one node per 12 texels: a sixth of
//! the heights' memory. `shaders/lib/reliefs/pyramid.wgsl` explains where blocks begin and how they lie in maps that repeat or continue.

use super::buffers::SceneBuffers;
use super::input::Input;
use crate::plan::pack::{LOWEST, MAX_SURFACES, Pyramid, SIDE};
use crate::plan::{
    Binding, BufferRole, Clock, Contents, Limits, Pass, Plan, Resource, ResourceId, Work,
};
use crate::scene::Wrap;
use crate::shader::Shader;

/// Maximum number of levels: blocks of 32,768 x 32,768 cells.
const MOST_LEVELS: u32 = 15;
/// Levels that one pass builds.
const LEVELS_OF_PASS: u32 = 5;
const NODE_BYTES: u64 = 8;

/// Nodes of a level along one side of a map with this many texels.
fn nodes_of(texels: u32, level: u32) -> u32 {
    texels.div_ceil(1 << level)
}

/// Number of levels up to the one with a single node.
fn levels_of(size: [u32; 2]) -> u32 {
    let longest = size[0].max(size[1]);
    longest
        .next_power_of_two()
        .trailing_zeros()
        .clamp(LOWEST, MOST_LEVELS)
}

impl Input<'_> {
    /// The pyramids of the active reliefs, one row per clip-surface, and the total number of nodes.
    fn pyramid_rows(&self) -> (Vec<Pyramid>, u64) {
        let mut rows: Vec<Pyramid> = Vec::new();
        let mut nodes = 0_u64;
        for number in &self.active_cuts.surfaces {
            let surface = &self.model.prepared.surfaces[*number];
            let map = surface.relief.as_ref();
            let Some(map) = map.filter(|_| self.model.is_relief(*number)) else {
                rows.push(bytemuck::Zeroable::zeroed());
                continue;
            };
            let mut row = Pyramid {
                first_texel: self.model.first_texel[*number],
                levels: levels_of(map.size()),
                map_size: map.size(),
                repeats: u32::from(surface.wrap == Wrap::Repeat),
                is_own: 1,
                padding: [0; 2],
                first_node: [[0; 4]; 4],
            };
            let same = |r: &&Pyramid| {
                (r.levels, r.first_texel, r.repeats) == (row.levels, row.first_texel, row.repeats)
            };
            if let Some(first) = rows.iter().find(same) {
                rows.push(Pyramid {
                    is_own: 0,
                    ..*first
                });
                continue;
            }
            for level in LOWEST..=row.levels {
                let [i, j] = [(level - 1) / 4, (level - 1) % 4].map(|i| i as usize);
                row.first_node[i][j] = u32::try_from(nodes).unwrap_or(u32::MAX);
                let [x, y] = map.size().map(|s| u64::from(nodes_of(s, level)));
                nodes += x * y;
            }
            rows.push(row);
        }
        (rows, nodes)
    }

    /// Returns true if the pyramids of the frame fit the limits of core WebGPU.
    pub(crate) fn pyramids_fit(&self) -> bool {
        let limits = Limits::CORE;
        let (rows, nodes) = self.pyramid_rows();
        let longest = rows.iter().flat_map(|r| r.map_size).max().unwrap_or(0);
        nodes * NODE_BYTES <= limits.storage_binding_bytes
            && nodes_of(longest, 1).div_ceil(SIDE) <= limits.groups_per_dimension
    }
}

/// The pyramids of all active reliefs, with the passes that build them: the bindings of `shaders/lib/reliefs/pyramid.wgsl`.
pub(crate) fn pyramids(plan: &mut Plan, scene: &SceneBuffers<'_>) -> [Binding; 2] {
    plan.has_pyramids = true;
    let (rows, nodes) = scene.input.pyramid_rows();
    let mut all = rows.clone();
    all.resize(MAX_SURFACES, bytemuck::Zeroable::zeroed());
    let table = Contents::from_values(&all);
    let table = Resource::upload("pyramid_table", BufferRole::Uniform, table, Clock::Cut);
    let table = Binding::read("pyramid_table", plan.add_resource(table));
    let built = build(plan, &scene.heights, &table, &rows, nodes);
    [table, Binding::read("nodes", built)]
}

fn build(
    plan: &mut Plan,
    heights: &Binding,
    table: &Binding,
    rows: &[Pyramid],
    nodes: u64,
) -> ResourceId {
    let bytes = nodes.max(1) * NODE_BYTES;
    let built = plan.add_resource(Resource::storage("pyramids", bytes, Clock::Cut));
    let levels = rows.iter().map(|r| r.levels).max().unwrap_or(0);
    for from in (0..levels).step_by(LEVELS_OF_PASS as usize) {
        let to = (from + LEVELS_OF_PASS).min(levels);
        let mut bindings = vec![table.clone()];
        let base = if from == 0 {
            bindings.extend([heights.clone(), Binding::write("built", built)]);
            "lib/pyramid_base/heights.wgsl"
        } else {
            bindings.push(Binding::update("built", built));
            "lib/pyramid_base/nodes.wgsl"
        };
        let groups = |axis: usize| {
            let nodes = rows.iter().map(|r| nodes_of(r.map_size[axis], from + 1));
            nodes.max().unwrap_or(0).div_ceil(SIDE).max(1)
        };
        let pass = Pass::new(
            format!("pyramid {}", from / LEVELS_OF_PASS),
            format!(
                "least and greatest height of blocks of cells, levels {} to {to}: rays skip blocks that are not near them",
                (from + 1).max(LOWEST)
            ),
            Shader::from("passes/pyramid.wgsl").with(base),
            bindings,
            Work::Compute {
                groups: [groups(0), groups(1), rows.len() as u32],
            },
        );
        plan.add_pass(
            pass.on(Clock::Cut)
                .with_constants(vec![("from_level", f64::from(from))]),
        );
    }
    built
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_end_with_one_node() {
        for size in [[5, 2], [2, 8], [5, 17], [256, 256], [4096, 4096], [1000, 1]] {
            let levels = levels_of(size);
            let top = size.map(|s| nodes_of(s, levels));
            let below = size.map(|s| nodes_of(s, levels - 1));
            assert!(top == [1, 1] && below != [1, 1], "{size:?}: {levels}");
        }
        assert_eq!(
            levels_of([2, 1]),
            LOWEST,
            "one node, of which some is empty"
        );
        assert_eq!(
            levels_of([1 << 20, 1]),
            MOST_LEVELS,
            "the rest goes side by side"
        );
    }
}
