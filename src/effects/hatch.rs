//! Hatches: parallel lines on caps, with the plane of each clip-surface and what each part has.
//!
//! The horizontal of a plane is across the up direction and its normal, from left to right as it is seen from the removed side, so that the
//! angle of a hatch does not hang on the numbers of a plane; a plane that is moved along its normal carries its lines with it. Distances follow the mean thickness of parts, in steps of the
//! root of two, and are held from when the scene was first packed. Costs a few multiplications a pixel of a cap; who touches whom is found
//! once, where two parts are cut.
//!
//! Cannot: follow a part that moves; tell more than eight classes by direction alone, after which spacing grows.

use glam::{DVec2, DVec3};

use crate::passes::{SceneBuffers, or_one};
use crate::plan::{Binding, Clock, Contents, Plan, Resource, Role, pack};
use crate::scene::style::{Hatch, Style};
use crate::scene::{PreparedSurface, linear_from_srgb, map_channels};

/// Direction of a class over that of the first, in degrees, and its spacing over the usual.
const CLASSES: [(f64, f64); 8] = [
    (0.0, 1.0),
    (90.0, 1.0),
    (0.0, 1.6),
    (90.0, 1.6),
    (-25.0, 1.0),
    (115.0, 1.0),
    (25.0, 1.0),
    (65.0, 1.0),
];

/// What the pattern of caps binds; none where no cap is in the picture or the style has no hatch.
pub(super) fn hatch(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Style,
) -> Option<[Binding; 2]> {
    let input = scene.input;
    if !style.hatch.is_drawn() || input.relevance.lanes == 0 {
        return None;
    }
    let prepared = &input.model.prepared;
    let up = prepared.up();
    let planes = prepared.surfaces.iter().map(|s| plane_of(s, up));
    let planes = or_one(planes.collect());
    let hatches = or_one(part_hatches(scene, style));
    let mut table = |name: &'static str, contents| {
        let table = Resource::upload(name, Role::Storage, contents, Clock::Cut);
        Binding::read(name, plan.add_resource(table))
    };
    Some([
        table("hatch_planes", Contents::from_values(&planes)),
        table("part_hatches", Contents::from_values(&hatches)),
    ])
}

fn row(direction: DVec3, origin: DVec3) -> [f32; 4] {
    let offset = -direction.dot(origin);
    direction.extend(offset).as_vec4().to_array()
}

fn plane_of(surface: &PreparedSurface, up: DVec3) -> pack::HatchPlane {
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
    pack::HatchPlane {
        u_row: row(u, surface.origin),
        v_row: row(normal.cross(u), surface.origin),
        normal: (normal.extend(f64::from(u8::from(surface.volume.is_some()))))
            .as_vec4()
            .to_array(),
    }
}

/// In the order of the table of parts.
fn part_hatches(scene: &SceneBuffers<'_>, style: &Style) -> Vec<pack::PartHatch> {
    let input = scene.input;
    let (prepared, at_rest) = (&input.model.prepared, &input.model.at_rest);
    // Who is cut alone touches nobody that is.
    let classes = match input.relevance.lanes {
        0 | 1 => &[],
        _ => at_rest.classes(),
    };
    let unit = at_rest.picture_height() / 1000.0;
    let color = style.hatch.color.unwrap_or(style.ink);
    let color = map_channels(color, linear_from_srgb).extend(1.0).to_array();
    let hatch = &style.hatch;
    let places = input.relevance.order.iter();
    places
        .map(|rank| {
            let part = prepared.parts[*rank].part;
            let thickness = at_rest.thicknesses()[part] / unit;
            let class = usize::from(classes.get(part).copied().unwrap_or_default());
            let spacing = spacing_of(thickness, hatch) * unit * prepared.scale;
            pack::PartHatch {
                across: across(class, f64::from(hatch.angle_deg), spacing),
                width_px: Style::px(hatch.width, input.view.band[1]),
                alpha: hatch.alpha,
                is_solid: u32::from(thickness < f64::from(hatch.solid_below)),
                padding: 0,
                padding_b: 0,
                padding_c: 0,
                color,
            }
        })
        .collect()
}

/// From line to line, in thousandths of the picture's height.
fn spacing_of(thickness: f64, hatch: &Hatch) -> f64 {
    let [share, least, most] = [hatch.per_thickness, hatch.least, hatch.most].map(f64::from);
    let wanted = (share * thickness).clamp(least, most);
    // In steps of the root of two from the greatest.
    let steps = ((wanted / most).log2() * 2.0).round() / 2.0;
    (most * 2.0_f64.powf(steps)).max(least)
}

/// Across the lines of a class of parts, in periods per scene unit.
fn across(class: usize, angle_deg: f64, spacing: f64) -> [f32; 2] {
    let (turn_deg, wider) = CLASSES[class % CLASSES.len()];
    let round = (class / CLASSES.len()) as f64;
    let angle = (angle_deg + turn_deg + 11.0 * round).to_radians();
    let normal = DVec2::new(-angle.sin(), angle.cos());
    (normal / (spacing * wider * (1.0 + 0.25 * round)))
        .as_vec2()
        .to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_classes_look_alike() {
        let all: Vec<_> = (0..40)
            .map(|c| DVec2::from(across(c, 45.0, 1.0).map(f64::from)))
            .collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[..i] {
                // Lines have no sense of direction.
                let apart = (*a - *b).length().min((*a + *b).length());
                assert!(apart > 0.05, "{a} and {b}");
            }
        }
    }

    #[test]
    fn spacing_follows_thickness_within_bounds() {
        let hatch = Hatch::default();
        let [thin, usual, thick] = [1.0, 35.0, 900.0].map(|t| spacing_of(t, &hatch));
        assert_eq!(thin, f64::from(hatch.least));
        assert!(usual > thin && thick > usual, "{thin} {usual} {thick}");
        assert!(thick <= f64::from(hatch.most), "{thick}");
    }
}
