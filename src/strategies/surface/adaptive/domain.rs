//! Tessellated texels of each clip-surface, and their patches.
//!
//! The domain covers the box of the cut solids as seen along the normal: a point of the surface lies over the point of the plane that it
//! was displaced from. It is rounded out to whole patches, counted from the map's origin, so that a moving solid does not move all
//! triangles. The patch size yields about a thousand patches: enough to share the work, and few enough triangles where no refinement is
//! needed. Texels are halved as often as 16 bits for each vertex coordinate allow.

use crate::passes::Refusal;
use glam::DVec3;

use super::super::tessellation::{beyond_box, span};
use crate::passes::Input;
use crate::plan::pack::{Domain, MOST_HALF_BITS};
use crate::scene::PreparedSurface;

/// A sufficient number of patches.
const ENOUGH_PATCHES: u64 = 1024;
/// Texels along a patch, as a power of two in this range.
const PATCH_BITS: std::ops::RangeInclusive<u32> = 1..=MOST_HALF_BITS + 1;
/// Halvings of a texel: least and most.
const STEP_BITS: std::ops::RangeInclusive<u32> = 3..=8;
/// Steps along a side that 16 bits can distinguish.
const MOST_STEPS: u64 = (1 << 16) - 1;
/// Most steps in a domain, so that 32 bits can count its triangles.
const MOST_AREA: u64 = (1 << 31) - 1;
/// Most texels of all domains: 128 MiB of errors, two per texel.
const MOST_MEASURED: u64 = (128 << 20) / 8;
/// Texel length in scene units beyond which f32 cannot resolve points between its corners.
const LONGEST_TEXEL: f64 = 64.0;

/// The domains of all relevant clip-surfaces, in table order; a refusal if one is too large.
pub(super) fn rows(input: &Input<'_>) -> Result<Vec<Domain>, Refusal> {
    let mut first = 0;
    let mut rows = Vec::new();
    for number in &input.active_cuts.surfaces {
        let surface = &input.model.prepared.surfaces[*number];
        if !input.model.is_relief(*number) {
            rows.push(of_plane(surface, input));
            continue;
        }
        let mut row = of_relief(*number, surface, input)?;
        let [width, height] = texels(&row);
        row.map_first = input.model.first_texel[*number];
        row.first_vertex = first as u32;
        row.first_cell = (first + (width + 1) * (height + 1)) as u32;
        first += (width + 1) * (height + 1) + width * height;
        if first > 2 * MOST_MEASURED {
            return Err(Refusal::amount(format!(
                "the reliefs have more than {MOST_MEASURED} texels across the parts, and a buffer holds errors for no more: \
                 raycast draws them"
            )));
        }
        rows.push(row);
    }
    Ok(rows)
}

/// Texels along the sides of a domain.
pub(super) fn texels(row: &Domain) -> [u64; 2] {
    row.patches.map(|n| u64::from(n) << row.patch_bits)
}

/// Interval that a domain covers along an axis, relative to the origin of a clip-surface.
fn covered(surface: &PreparedSurface, input: &Input<'_>, axis: DVec3) -> [f64; 2] {
    let margin = beyond_box(input.view);
    let [low, high] = span(surface, input, axis);
    [low - margin, high + margin]
}

/// The domain of a plane: one patch with one step along each side.
fn of_plane(surface: &PreparedSurface, input: &Input<'_>) -> Domain {
    let frame = &surface.frame;
    let [u, v] = [frame.u_hat, frame.v_hat].map(|axis| covered(surface, input, axis));
    let lift = -surface.flat_height().unwrap_or(0.0);
    let corner = surface.origin + frame.u_hat * u[0] + frame.v_hat * v[0] + frame.normal * lift;
    Domain {
        corner: row(corner),
        step_x: row(frame.u_hat * (u[1] - u[0])),
        step_y: row(frame.v_hat * (v[1] - v[0])),
        patches: [1, 1],
        ..bytemuck::Zeroable::zeroed()
    }
}

fn of_relief(
    number: usize,
    surface: &PreparedSurface,
    input: &Input<'_>,
) -> Result<Domain, Refusal> {
    let map = surface.relief.as_ref().map_or([1, 1], |m| m.size());
    let per_unit = [0, 1].map(|i| surface.map_per_unit[i] * f64::from(map[i]));
    if per_unit.iter().any(|t| t.abs() * LONGEST_TEXEL < 1.0) {
        return Err(Refusal::amount(format!(
            "a texel of clip-surface {number} is more than {LONGEST_TEXEL} times as long as the scene: raycast draws it"
        )));
    }
    let axes = [surface.frame.u_hat, surface.frame.v_hat];
    // Texel centres are at integers.
    let at: [[f64; 2]; 2] = [0, 1].map(|i| {
        let ends = covered(surface, input, axes[i]).map(|d| d * per_unit[i] - 0.5);
        [ends[0].min(ends[1]).floor(), ends[0].max(ends[1]).ceil()]
    });
    let patches_at = |bits: u32| {
        let side = f64::from(1_u32 << bits);
        at.map(|[low, high]| [(low / side).floor(), (high / side).ceil()])
    };
    let count = |bits: &u32| {
        let [x, y] = patches_at(*bits).map(|[low, high]| (high - low).max(1.0) as u64);
        x * y
    };
    let patch_bits = { PATCH_BITS }
        .find(|bits| count(bits) <= ENOUGH_PATCHES)
        .unwrap_or(*PATCH_BITS.end());
    let first = patches_at(patch_bits).map(|[low, _]| low);
    let patches = patches_at(patch_bits).map(|[low, high]| (high - low).max(1.0) as u64);
    let texels = patches.map(|n| n << patch_bits);
    let fits = |bits: &u32| {
        let steps = texels.map(|n| n << bits);
        steps.iter().all(|s| *s <= MOST_STEPS) && steps[0] * steps[1] <= MOST_AREA
    };
    let Some(step_bits) = STEP_BITS.rev().find(fits) else {
        return Err(Refusal::amount(format!(
            "the relief of clip-surface {number} is {} x {} texels across the parts; {} along a side and {} in all can be \
             tessellated: raycast draws it",
            texels[0],
            texels[1],
            MOST_STEPS >> STEP_BITS.start(),
            MOST_AREA >> (2 * STEP_BITS.start()),
        )));
    };
    let side = f64::from(1_u32 << patch_bits);
    let first = first.map(|p| p * side);
    let unit = |i: usize| axes[i] / per_unit[i];
    let corner = surface.origin + unit(0) * (first[0] + 0.5) + unit(1) * (first[1] + 0.5);
    let steps = f64::from(1_u32 << step_bits);
    let [low, high] = (surface.relief.as_ref()).map_or([0.0, 0.0], |m| m.range().map(f64::from));
    Ok(Domain {
        corner: row(corner),
        step_x: row(unit(0) / steps),
        step_y: row(unit(1) / steps),
        first_texel: first.map(|t| t as i32),
        patches: patches.map(|n| n as u32),
        patch_bits,
        step_bits,
        // No twist exceeds twice the height range; the twists of cells more than three away are weighted by at most 1 / 4^4.
        least_twist: ((high - low) * (2.0 / 256.0) * 1.000_01) as f32,
        mirrored: u32::from(per_unit[0] * per_unit[1] < 0.0),
        map_size: map,
        wrap: surface.wrap.code(),
        ..bytemuck::Zeroable::zeroed()
    })
}

fn row(v: DVec3) -> [f32; 4] {
    v.as_vec3().extend(0.0).to_array()
}
