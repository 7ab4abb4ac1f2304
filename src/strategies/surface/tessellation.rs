//! Clip-surfaces as triangles, for the two uses in strategies: as sheets, whose crossings go into the per-pixel list of depths, and by the
//! paper's rule, which draws them directly.
//!
//! A tessellation is a file that fills the open module `cutaway::tessellation` and an index buffer for each clip-surface; there are no
//! vertex buffers, since a vertex follows from its index. Triangles are oriented with `U` and `V`, so that their front faces the kept side.

use std::ops::Range;

use glam::DVec3;

use super::cutter;
use super::raycast::{self, WalkedPixels};
use crate::passes::{Crossings, Input, Refusal, SceneBuffers, SheetDraw, Sheets, Store};
use crate::plan::pack::most_box_margin;
use crate::plan::{Arguments, Binding, Draw, Plan, ResourceId, Vertices};
use crate::scene::{PreparedSurface, View};
use crate::shader::Shader;

/// Clip-surfaces per part in an instance number: `surface_of` and `place_of` in `shaders/lib/reliefs/facets.wgsl`.
const SURFACES_PER_PLACE: u32 = 32;

/// Least distance in scene units by which a tessellation extends beyond the reach of rays around the box of the cut solids.
const BEYOND_RAYS: f64 = 1e-4;

/// Least distance in scene units by which a tessellation extends beyond the box of the cut solids: farther than rays are followed beyond a
/// box face. Beyond the box corners rays may go on, by more than the vertex displacement.
pub(super) fn beyond_box(view: &View) -> f64 {
    most_box_margin(view.precision) + BEYOND_RAYS
}

/// Interval that the box of the cut solids spans along an axis, relative to the origin of a clip-surface.
pub(super) fn span(surface: &PreparedSurface, input: &Input<'_>, axis: DVec3) -> [f64; 2] {
    let corners = input.active_cuts.cut_box.corners();
    let at = corners.map(|c| (c - surface.origin).dot(axis));
    let low = at.into_iter().fold(f64::INFINITY, f64::min);
    let high = at.into_iter().fold(f64::NEG_INFINITY, f64::max);
    [low, high]
}

/// Positions along a pixel that rasterisers distinguish.
const SUBPIXELS: f64 = 256.0;
/// Slope assumed for the error of a displaced triangle.
const STEEP: f64 = 4.0;
/// Least displacement assumed for triangles, in scene units.
const LEAST_ROUNDING: f64 = 2e-4;

/// Error by which rasterised triangles may be displaced, in scene units: a 256th of a pixel along a steep slope, at the far end of the box
/// of the cut solids. Rounded to powers of two, because a shader is compiled for each value. Adapters with 4 sub-pixel bits get no more: in
/// 80 random scenes three tessellations drew the same pictures with 16 times as much.
pub(super) fn rounding(input: &Input<'_>) -> f64 {
    let view = input.view;
    let farthest = view.farthest_in(&input.active_cuts.cut_box);
    let beside = view.pixel_size(farthest) * STEEP / SUBPIXELS;
    let times = (beside / LEAST_ROUNDING).max(1.0);
    LEAST_ROUNDING * times.log2().ceil().exp2()
}

/// Clip-surfaces as triangles.
#[derive(Clone, Debug)]
pub(crate) struct Tessellation {
    /// File that fills `cutaway::tessellation`, and its dependencies.
    pub files: Vec<&'static str>,
    /// Bindings for relief heights.
    pub heights: Vec<Binding>,
    /// Bindings in addition to frame, cut table and heights.
    pub bindings: Vec<Binding>,
    /// File that fills `cutaway::sheet_side`, and its dependencies.
    pub side: Vec<&'static str>,
    /// Bindings for the side test in addition to frame, cut table and heights.
    pub side_bindings: Vec<Binding>,
    /// Largest error of the side test's height, in scene units.
    pub beside: f64,
    /// The triangles of each clip-surface that has any.
    pub facets: Vec<Facets>,
}

/// The triangles of a clip-surface.
#[derive(Clone, Debug)]
pub(crate) struct Facets {
    /// Its index in the table.
    pub surface: u32,
    /// Index buffer.
    pub indices: ResourceId,
    pub range: Range<u32>,
    /// Indirect arguments by which the device limits the index range; `None` if the whole range is drawn.
    pub arguments: Option<Arguments>,
}

/// Draws that fit in one pass.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    /// Override constants.
    pub constants: Vec<(&'static str, f64)>,
    /// Index buffer.
    pub indices: ResourceId,
    pub draws: Vec<Draw>,
}

/// The instance number of a clip-surface for the part at a part-table index.
pub(crate) fn instance(place: u32, surface: u32) -> u32 {
    place * SURFACES_PER_PLACE + surface
}

impl Tessellation {
    /// The draws of the given instances, one for each that has triangles.
    pub(crate) fn batches(&self, instances: &[u32]) -> Vec<Batch> {
        let mut batches: Vec<Batch> = Vec::new();
        for instance in instances {
            let surface = instance % SURFACES_PER_PLACE;
            let Some(facets) = self.facets.iter().find(|f| f.surface == surface) else {
                continue;
            };
            let mut draw = Draw {
                indices: facets.range.clone(),
                base_vertex: 0,
                vertex_count: 0,
                instance: *instance,
                arguments: facets.arguments,
            };
            if facets.arguments.is_some() {
                // A draw with arguments can only use instance 0: a constant passes the instance number to the shader.
                draw.instance = 0;
                batches.push(Batch {
                    constants: vec![("first_instance", f64::from(*instance))],
                    indices: facets.indices,
                    draws: vec![draw],
                });
                continue;
            }
            let same = |b: &&mut Batch| b.constants.is_empty() && b.indices == facets.indices;
            match batches.iter_mut().find(same) {
                Some(batch) => batch.draws.push(draw),
                None => batches.push(Batch {
                    constants: Vec::new(),
                    indices: facets.indices,
                    draws: vec![draw],
                }),
            }
        }
        batches
    }

    /// Bindings needed for every use of the triangles.
    pub(crate) fn bindings(&self, scene: &SceneBuffers<'_>) -> Vec<Binding> {
        let mut bindings = vec![scene.frame.clone(), scene.cut_table.clone()];
        bindings.extend(self.heights.iter().cloned());
        bindings.extend(self.bindings.iter().cloned());
        bindings
    }
}

/// Records the passes that write the list of crossings: planes in closed form, because a sheet adds nothing for them, and reliefs as the
/// sheets that `tessellate` makes. Without reliefs there are no sheets.
pub(crate) fn list(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    capacity: u32,
    store: &Store,
    tessellate: impl FnOnce(&mut Plan, &SceneBuffers<'_>) -> Result<Tessellation, Refusal>,
) -> Result<Crossings, Refusal> {
    let input = scene.input;
    let surfaces = input.active_cuts.surfaces.iter().enumerate();
    let reliefs: Vec<u32> = surfaces
        .filter(|(_, number)| input.model.is_relief(**number))
        .map(|(index, _)| index as u32)
        .collect();
    if reliefs.is_empty() {
        return cutter::list(plan, scene, capacity, store);
    }
    let by_facing = reliefs.iter().fold(0, |bits, s| bits | 1 << s);
    // The tessellation comes first, because it may record passes on slower clocks.
    let tessellation = tessellate(plan, scene)?;
    let by_triangles = by_facing | cutter::bits(input);
    let crossings = raycast::record(
        plan,
        scene,
        capacity,
        &WalkedPixels::All(store),
        by_triangles,
    );
    let instances: Vec<u32> = reliefs.iter().map(|s| instance(0, *s)).collect();
    let batches = tessellation.batches(&instances).into_iter().enumerate();
    let bindings = tessellation.bindings(scene);
    let draws = batches.map(|(i, batch)| SheetDraw {
        name: format!("sheet {i}"),
        shader: Shader::from("passes/sheet/draw.wgsl").with_all(&tessellation.files),
        bindings: bindings.clone(),
        constants: batch.constants,
        vertices: Vertices::None,
        indices: batch.indices,
        draws: batch.draws,
    });
    let mut side_bindings = tessellation.heights;
    side_bindings.extend(tessellation.side_bindings);
    let mut sheets = Sheets {
        draws: draws.collect(),
        by_facing,
        side: tessellation.side,
        beside: tessellation.beside,
        side_bindings,
        ..Sheets::default()
    };
    cutter::add(plan, scene, &mut sheets);
    sheets.merge(plan, scene, &crossings)?;
    Ok(crossings)
}
