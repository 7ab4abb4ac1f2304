//! `adaptive:TAU`: a tessellation rebuilt for every view, just fine enough to stay within TAU pixels of the relief.
//!
//! Squares of texels are halved into right triangles, and these repeatedly at the middle of their longest edge, even below a texel
//! (Lindstrom & Pascucci, *Visualization of large terrains made easy*, 2001). A triangle's error is measured on the map, once per cut; how
//! much of it is visible follows from the least depth at which it may be seen. Whether an edge is halved is decided at its middle, in
//! integers where it matters, so that neighbours agree without communication and no crack can arise. Triangles outside the picture or the
//! box of the cut solids are left out: no crossings are needed there.
//!
//! Per cut: a texel is read once for each size of edge and of square, up to 13 times; 8 bytes per texel around the cut solids. Per frame: a
//! workgroup per patch, or several if an invocation would visit more than 2,000 triangles; time in proportion to the resulting triangles;
//! 12 bytes per triangle of capacity, and 4 per patch. The device draws the triangles itself: nothing is read back.
//!
//! Cannot: halve texels further than 16-bit coordinates allow on maps with very many texels; an error of TAU needs more only where a single
//! texel is hundreds of pixels high. All errors are measured again when a relief or the box of the cut solids moves across the relief's
//! texels. Pixels of triangles beyond the capacity are not marked: the frame is drawn again with enough. Reliefs with more texels than a
//! storage binding holds are refused: `raycast` draws those.

mod domain;
mod measure;
mod view;

use super::tessellation::{Facets, Tessellation, rounding};
use crate::passes::{NEED_OF_TRIANGLES, Refusal, SceneBuffers, need};
use crate::plan::pack::{Domain, MAX_SURFACES, Refinement};
use crate::plan::{
    ARGUMENT_BYTES, Arguments, Binding, Bounded, BufferRole, Capacities, Capacity, Clock, Contents,
    DISPATCH_ARGUMENT_BYTES, INDEX_BYTES, Pass, Plan, Resource, ResourceId, Shape, Work,
};
use crate::strategies::row::{Abilities, CapSurfaceRow, Caps, StrategyInfo, StrategyParameter};

/// Steps of the parameter TAU per pixel.
const STEPS_PER_PX: u32 = 1000;

/// The cap surface's row in the strategy table.
pub(crate) static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: StrategyInfo {
        name: "adaptive",
        parameter: Some(StrategyParameter {
            letter: "TAU",
            about: "an error in pixels",
            usual: STEPS_PER_PX / 2,
            least: STEPS_PER_PX / 100,
            most: 100 * STEPS_PER_PX,
            steps_per_unit: STEPS_PER_PX,
        }),
        about: "triangles just fine enough for an error of TAU pixels, chosen and drawn on the device",
        limit: "",
        rebuilds: "",
        can: Abilities::ALL,
        hard_cases: &[],
    },
    exact_heights: "measures its triangles against four texels",
    usual_tests: |test| test.facts.name == "mask",
    caps: Caps::Triangles(|plan, scene, steps, with_planes| {
        let tau_px = f64::from(steps) / f64::from(STEPS_PER_PX);
        tessellation(plan, scene, tau_px, with_planes)
    }),
};

/// Capacity of each relief, in triangles, until a frame reports its need.
const FIRST_TRIANGLES: u32 = 1 << 16;
/// Most triangles of all reliefs together: 128 MiB of indices.
const MOST_TRIANGLES: u32 = (128 << 20) / 12;

/// The reliefs as triangles and, on request, the planes as a square each. Returns the reason if a relief is too large.
fn tessellation(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    tau_px: f64,
    with_planes: bool,
) -> Result<Tessellation, Refusal> {
    let input = scene.input;
    let rows = domain::rows(input)?;
    let surfaces = input.active_cuts.surfaces.iter().zip(0_u32..);
    let (reliefs, planes): (Vec<_>, Vec<_>) =
        surfaces.partition(|(number, _)| input.model.is_relief(**number));
    let [reliefs, planes] =
        [reliefs, planes].map(|all| all.into_iter().map(|(_, s)| s).collect::<Vec<u32>>());
    let domains = table(plan, "domains", "domains", Clock::Cut, &rows);
    let mut facets = Vec::new();
    if with_planes && !planes.is_empty() {
        let indices = square_indices(plan);
        facets.extend(planes.iter().map(|surface| Facets {
            surface: *surface,
            indices,
            range: 0..6,
            arguments: None,
        }));
    }
    let mut side_bindings = vec![domains.clone()];
    if !reliefs.is_empty() {
        let errors = measure::record(plan, scene, &rows, &reliefs);
        let capacity = room(input.capacities, reliefs.len() as u32);
        let refinements: Vec<Refinement> = (rows.iter().enumerate())
            .map(|(s, row)| Refinement {
                first_patch: first_patch(&rows, s),
                ..view::refinement(input, s, row, tau_px, capacity)
            })
            .collect();
        let name = "refinements";
        side_bindings.push(table(plan, name, name, Clock::Frame, &refinements));
        side_bindings.push(Binding::read("sheet_errors", errors));
        let reliefs = Reliefs {
            rows: &rows,
            surfaces: &reliefs,
            capacity,
        };
        facets.extend(reliefs.refine(plan, scene, &side_bindings));
    }
    Ok(Tessellation {
        files: vec!["lib/tessellation/adaptive.wgsl"],
        heights: vec![scene.heights.clone()],
        bindings: vec![domains],
        side: vec!["lib/sheet_side/adaptive.wgsl"],
        side_bindings,
        beside: rounding(input),
        facets,
    })
}

/// Total number of patches of all clip-surfaces before the one at the given table index.
fn first_patch(rows: &[Domain], index: usize) -> u32 {
    rows[..index]
        .iter()
        .map(|row| row.patches[0] * row.patches[1])
        .sum()
}

/// Triangle capacity of each relief: a power of two, so that a moving camera rarely needs another buffer.
fn room(capacities: &Capacities, reliefs: u32) -> u32 {
    let need = capacities.triangles.unwrap_or(0);
    let wanted = need.max(FIRST_TRIANGLES).checked_next_power_of_two();
    let most = MOST_TRIANGLES / reliefs.max(1);
    wanted.map_or(need, |w| w.min(most).max(need))
}

/// A uniform with one row per clip-surface, bound as a variable.
fn table<T: bytemuck::Pod>(
    plan: &mut Plan,
    variable: &'static str,
    name: &str,
    clock: Clock,
    rows: &[T],
) -> Binding {
    let mut all = vec![T::zeroed(); MAX_SURFACES];
    all[..rows.len()].copy_from_slice(rows);
    let table = Resource::own_upload(
        name,
        BufferRole::Uniform,
        Contents::from_values(&all),
        clock,
    );
    Binding::read(variable, plan.add_resource(table))
}

/// The two triangles of a plane, whose domain is one step along each side.
fn square_indices(plan: &mut Plan) -> ResourceId {
    let corners = Contents::from_values(&[[0, 1, 0x1_0001], [0, 0x1_0001, 0x1_0000]]);
    let indices = Resource::own_upload("square indices", BufferRole::Index, corners, Clock::Cut);
    plan.add_resource(indices)
}

/// The reliefs of a frame.
struct Reliefs<'a> {
    /// The domains of all clip-surfaces.
    rows: &'a [Domain],
    /// Table indices of the reliefs.
    surfaces: &'a [u32],
    /// Capacity of each relief, in triangles.
    capacity: u32,
}

impl Reliefs<'_> {
    /// Records the passes that make the triangles of a frame.
    fn refine(&self, plan: &mut Plan, scene: &SceneBuffers<'_>, read: &[Binding]) -> Vec<Facets> {
        let capacity = self.capacity;
        let count = self.surfaces.len() as u64;
        let bytes = count * u64::from(capacity) * 3 * INDEX_BYTES;
        let indices = plan.add_resource(Resource {
            shape: Shape::Buffer {
                bytes,
                role: BufferRole::Index,
            },
            ..Resource::storage("triangles", bytes, Clock::Frame)
        });
        let bytes = count * ARGUMENT_BYTES;
        let arguments = plan.add_resource(Resource::arguments("arguments", bytes, Clock::Frame));
        let bytes = count * DISPATCH_ARGUMENT_BYTES;
        let deep_arguments = Resource::arguments("deep arguments", bytes, Clock::Frame);
        let deep_arguments = plan.add_resource(deep_arguments);
        let bytes = 4 * u64::from(first_patch(self.rows, self.rows.len()));
        let deep_patches = Resource::storage("deep patches", bytes, Clock::Frame);
        let deep_patches = plan.add_resource(deep_patches);
        let sizes = vec![("count", count as f64), ("capacity", f64::from(capacity))];
        let begin = Pass::new(
            "triangles begin",
            "no triangles yet",
            "strategies/surface/adaptive/begin.wgsl",
            vec![
                Binding::write("arguments", arguments),
                Binding::write("deep_arguments", deep_arguments),
            ],
            Work::once(),
        );
        plan.add_pass(begin.with_constants(sizes.clone()));
        for (slot, surface) in (0_u32..).zip(self.surfaces) {
            let row = &self.rows[*surface as usize];
            let mut bindings = vec![
                Binding::write("triangles", indices),
                Binding::update("arguments", arguments),
            ];
            bindings.extend(read.iter().cloned());
            let mut deep_bindings = bindings.clone();
            bindings.push(Binding::write("deep_patches", deep_patches));
            bindings.push(Binding::update("deep_arguments", deep_arguments));
            deep_bindings.push(Binding::read("deep_patches", deep_patches));
            let constants = vec![("surface", f64::from(*surface)), ("slot", f64::from(slot))];
            let refine = Pass::new(
                format!("triangles {slot}"),
                "triangulates a relief as finely as the view needs, where the relief is visible",
                "strategies/surface/adaptive/refine.wgsl",
                bindings,
                Work::Compute {
                    groups: [row.patches[0], row.patches[1], 1],
                },
            );
            plan.add_pass(refine.with_constants(constants.clone()));
            let groups = Arguments {
                resource: deep_arguments,
                offset: u64::from(slot) * DISPATCH_ARGUMENT_BYTES,
            };
            let deep = Pass::new(
                format!("deep triangles {slot}"),
                "patches of very many triangles, by several workgroups each",
                "strategies/surface/adaptive/refine_deep.wgsl",
                deep_bindings,
                Work::ComputeIndirect { arguments: groups },
            );
            plan.add_pass(deep.with_constants(constants));
        }
        let need = need(plan, scene.input, Clock::Frame);
        let end = Pass::new(
            "triangles end",
            "how many triangles are drawn, and how many there should be room for",
            "strategies/surface/adaptive/end.wgsl",
            vec![
                Binding::update("arguments", arguments),
                Binding::write("need", need),
            ],
            Work::once(),
        );
        plan.add_pass(end.with_constants(sizes));
        plan.bounded.push(Bounded {
            what: "triangles of a relief".to_owned(),
            slot: NEED_OF_TRIANGLES,
            capacity,
            resizes: Some(Capacity::Triangles),
            exact: false,
        });
        let facets = self.surfaces.iter().zip(0_u32..);
        facets
            .map(|(surface, slot)| Facets {
                surface: *surface,
                indices,
                range: 3 * capacity * slot..3 * capacity * (slot + 1),
                arguments: Some(Arguments {
                    resource: arguments,
                    offset: u64::from(slot) * ARGUMENT_BYTES,
                }),
            })
            .collect()
    }
}
