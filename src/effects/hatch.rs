//! Hatches: families of parallel lines on caps. Packs the plane of each clip-surface and the lines of each part.
//!
//! The horizontal of a plane is perpendicular to the up direction and to its normal, from left to right as seen from the removed side, so
//! the hatch angle does not depend on how the plane is specified; when a plane moves along its normal, its lines follow. Cutter faces use
//! the axis-aligned planes of the scene. Line spacing follows the mean thickness of parts, in steps of about the square root of two, and is
//! fixed when the scene is first packed. The lines of a part that moves rigidly move with it ([`HatchAnchor::Part`]), and turn by the
//! component of its rotation about the plane's normal.
//!
//! Costs a few multiplications per line family and cap pixel. Contacts between parts are found only once, and only if two parts are cut.
//!
//! Cannot: follow a bending part or a moving cutter; distinguish more than eight classes by direction alone: the rest get wider spacing.

use glam::DVec3;

use super::hatch_lines::{HatchPlacement, lines_of};
use crate::passes::{Moved, SceneBuffers, or_one};
use crate::plan::{Binding, BufferRole, Clock, Contents, Plan, Resource, pack};
use crate::scene::style::{Hatch, HatchAnchor, HatchZoom, Style};
use crate::scene::{CapHatch, PreparedSurface, linear_from_srgb, map_channels};

/// Hatch bindings: planes, parts, lines; none if the picture has no caps or the style has no hatch.
pub(super) fn hatch(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Style,
) -> Option<[Binding; 3]> {
    let input = scene.input;
    if !style.hatch.is_drawn() || input.active_cuts.lanes == 0 {
        return None;
    }
    let prepared = &input.model.prepared;
    let up = prepared.up();
    let mut planes: pack::HatchPlanes = bytemuck::Zeroable::zeroed();
    let rows = f64::from(input.view.band[1]);
    planes.unit_px = (input.model.at_rest.picture_height() * prepared.scale / rows) as f32;
    for (plane, surface) in planes.planes.iter_mut().zip(&prepared.surfaces) {
        *plane = plane_of(surface, up);
        planes.count += 1;
    }
    let (parts, lines) = part_hatches(scene, style);
    let mut table = |name: &'static str, role, contents| {
        let table = Resource::upload(name, role, contents, Clock::Cut);
        Binding::read(name, plan.add_resource(table))
    };
    let planes = Contents::from_values(&[planes]);
    let parts = Contents::from_values(&or_one(parts));
    let lines = Contents::from_values(&or_one(lines));
    Some([
        table("hatch_planes", BufferRole::Uniform, planes),
        table("part_hatches", BufferRole::Storage, parts),
        table("hatch_lines", BufferRole::Storage, lines),
    ])
}

fn row(direction: DVec3, origin: DVec3) -> [f32; 4] {
    let offset = -direction.dot(origin);
    direction.extend(offset).as_vec4().to_array()
}

fn plane_of(surface: &PreparedSurface, up: DVec3) -> pack::CapPlane {
    // Seen from the removed side.
    let normal = -surface.frame.normal;
    let across = up.cross(normal);
    let u = match across.length() > 1e-6 {
        true => across.normalize(),
        // For a horizontal plane, the world's horizontal is used.
        false => (DVec3::X - normal * normal.x)
            .try_normalize()
            .unwrap_or(DVec3::Z),
    };
    pack::CapPlane {
        u_row: row(u, surface.origin),
        v_row: row(normal.cross(u), surface.origin),
        normal: (normal.extend(f64::from(u8::from(surface.volume.is_some()))))
            .as_vec4()
            .to_array(),
    }
}

/// One row per part, in the order of the part table, and the lines of all parts.
fn part_hatches(
    scene: &SceneBuffers<'_>,
    style: &Style,
) -> (Vec<pack::PartHatch>, Vec<pack::HatchLine>) {
    let input = scene.input;
    let (prepared, at_rest) = (&input.model.prepared, &input.model.at_rest);
    // If only one part is cut, it has no contacts.
    let classes = match input.active_cuts.lanes {
        0 | 1 => &[],
        _ => at_rest.classes(),
    };
    let unit = at_rest.picture_height() / 1000.0;
    let color = style.hatch.color.unwrap_or(style.ink);
    let color = map_channels(color, linear_from_srgb).extend(1.0).to_array();
    let hatch = &style.hatch;
    let mut lines = Vec::new();
    let parts = (input.active_cuts.order.iter()).map(|rank| {
        let part = &prepared.parts[*rank];
        let thickness = at_rest.thicknesses()[part.part] / unit;
        // A part with negligible volume, or whose thickness overflows, does not count as thin.
        let thickness = match thickness > 0.0 {
            true => thickness,
            false => f64::INFINITY,
        };
        let is_solid = thickness < f64::from(hatch.solid_below);
        let placed = HatchPlacement {
            class: usize::from(classes.get(part.part).copied().unwrap_or_default()),
            angle_deg: f64::from(hatch.angle_deg),
            spacing: spacing_of(thickness, hatch) * unit * prepared.scale,
        };
        let first_line = lines.len() as u32;
        match &part.material.hatch {
            _ if is_solid => {}
            CapHatch::General => lines.extend(lines_of(None, &placed)),
            CapHatch::Pattern(pattern) => lines.extend(lines_of(Some(pattern), &placed)),
            CapHatch::None | CapHatch::Solid => {}
        }
        let moved = match hatch.anchor {
            HatchAnchor::Part => input.model.moved[part.part],
            HatchAnchor::Cut => None,
        };
        let point = |p: DVec3, w: f32| p.as_vec3().extend(w).to_array();
        let [turned, start, end] = match moved {
            Some(Moved { turned, start, end }) => [
                turned.as_quat().to_array(),
                point(start, 1.0),
                point(end, 1.0),
            ],
            None => [[0.0; 4]; 3],
        };
        pack::PartHatch {
            color,
            first_line,
            line_count: lines.len() as u32 - first_line,
            alpha: match part.material.hatch {
                CapHatch::None => 0.0,
                // No hatch may cover the cap material.
                CapHatch::General if part.material.cap.is_some() => 0.0,
                _ => hatch.alpha,
            },
            width_px: Style::px(hatch.width, input.view.band[1]),
            turned,
            start,
            end,
        }
    });
    (parts.collect(), lines)
}

/// Path of the file that fills the open module `cutaway::hatch_zoom`.
pub(super) fn zoom_of(hatch: &Hatch) -> &'static str {
    match hatch.zoom {
        HatchZoom::Fixed => "lib/hatch_zoom/fixed.wgsl",
        HatchZoom::Banded => "lib/hatch_zoom/banded.wgsl",
    }
}

/// Line spacing in thousandths of the picture's height.
fn spacing_of(thickness: f64, hatch: &Hatch) -> f64 {
    let [share, least, most] = [hatch.per_thickness, hatch.least, hatch.most].map(f64::from);
    let wanted = (share * thickness).clamp(least, most);
    // Equal steps from the least to the greatest spacing, each by a factor of about the square root of two.
    let range = (most / least).log2();
    let steps = (2.0 * range).round().max(1.0);
    let step = ((wanted / least).log2() / range.max(1e-9) * steps).round();
    least * 2.0_f64.powf(step / steps * range)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacing_follows_thickness_within_bounds() {
        let hatch = Hatch::default();
        let [thin, usual, thick] = [1.0, 35.0, 900.0].map(|t| spacing_of(t, &hatch));
        assert_eq!(thin, f64::from(hatch.least));
        assert!(usual > thin && thick > usual, "{thin} {usual} {thick}");
        assert!(thick <= f64::from(hatch.most), "{thick}");
    }
}
