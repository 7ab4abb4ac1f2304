//! Hatches: families of parallel lines on caps, with the plane of each clip-surface and what each part has.
//!
//! The horizontal of a plane is across the up direction and its normal, from left to right as it is seen from the removed side, so that
//! the angle of a hatch does not depend on the numbers of a plane; a plane that is moved along its normal carries its lines with it. The
//! faces of cutters have the planes of the axes of the scene. Distances follow the mean thickness of parts, in steps of about the root of
//! two, and are held from when the scene was first packed. A part that moves as a whole carries its lines ([`HatchAnchor::Part`]): what
//! of its turn is about the normal of the plane turns them.
//!
//! Costs a few multiplications for each family of lines at each pixel of a cap; contacts of parts are found once, where two parts are cut.
//!
//! Cannot: follow a part that bends or a cutter that moves; tell more than eight classes by direction alone, after which spacing grows.

use glam::DVec3;

use super::hatch_lines::{Placed, lines_of};
use crate::passes::{Moved, SceneBuffers, or_one};
use crate::plan::{Binding, Clock, Contents, Plan, Resource, Role, pack};
use crate::scene::style::{Hatch, HatchAnchor, HatchZoom, Style};
use crate::scene::{CapHatch, PreparedSurface, linear_from_srgb, map_channels};

/// Bindings of hatches: planes, parts, lines; none if no cap is in the picture or the style has no hatch.
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
        table("hatch_planes", Role::Uniform, planes),
        table("part_hatches", Role::Storage, parts),
        table("hatch_lines", Role::Storage, lines),
    ])
}

fn row(direction: DVec3, origin: DVec3) -> [f32; 4] {
    let offset = -direction.dot(origin);
    direction.extend(offset).as_vec4().to_array()
}

fn plane_of(surface: &PreparedSurface, up: DVec3) -> pack::CapPlane {
    // As it is seen: from the removed side.
    let normal = -surface.frame.normal;
    let across = up.cross(normal);
    let u = match across.length() > 1e-6 {
        true => across.normalize(),
        // A plane that lies: its horizontal is that of the world.
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

/// In the order of the table of parts, and the lines of all.
fn part_hatches(
    scene: &SceneBuffers<'_>,
    style: &Style,
) -> (Vec<pack::PartHatch>, Vec<pack::HatchLine>) {
    let input = scene.input;
    let (prepared, at_rest) = (&input.model.prepared, &input.model.at_rest);
    // A part that is cut alone touches no other that is.
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
        // What has no volume to speak of, or more than numbers hold, is not thin.
        let thickness = match thickness > 0.0 {
            true => thickness,
            false => f64::INFINITY,
        };
        let is_solid = thickness < f64::from(hatch.solid_below);
        let placed = Placed {
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
                // What it is made of is seen.
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

/// The file that fills `cutaway::hatch_zoom`.
pub(super) fn zoom_of(hatch: &Hatch) -> &'static str {
    match hatch.zoom {
        HatchZoom::Fixed => "lib/hatch_zoom/fixed.wgsl",
        HatchZoom::Banded => "lib/hatch_zoom/banded.wgsl",
    }
}

/// From line to line, in thousandths of the picture's height.
fn spacing_of(thickness: f64, hatch: &Hatch) -> f64 {
    let [share, least, most] = [hatch.per_thickness, hatch.least, hatch.most].map(f64::from);
    let wanted = (share * thickness).clamp(least, most);
    // Even steps from the least to the greatest, of about the root of two.
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
