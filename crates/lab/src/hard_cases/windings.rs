//! Scenes of meshes that wind around points more than once, and the rule that fills them.

use cutaway::scene::{ClipSurface, Fill, Mesh, Scene};
use glam::{DVec2, DVec3};

use super::scenes;

/// The same scenes with every part filled by the nonzero rule.
pub fn nonzero(mut scenes: Vec<Scene>) -> Vec<Scene> {
    for scene in &mut scenes {
        scene.name = format!("{}, nonzero", scene.name);
        for part in &mut scene.parts {
            part.fill = Fill::Nonzero;
        }
    }
    scenes
}

/// A closed profile turned about the z axis. Its winding number around a point is that of the profile around the point's
/// distance from the axis and height, up to the corners of the turn.
pub fn revolved(profile: &[DVec2], segments: u32) -> Mesh {
    let count = profile.len() as u32;
    let mut mesh = Mesh::default();
    for s in 0..segments {
        let turn = std::f64::consts::TAU * f64::from(s) / f64::from(segments);
        let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
        (mesh.positions).extend(profile.iter().map(|p| out * p.x + DVec3::Z * p.y));
        for p in 0..count {
            let at = |s: u32, p: u32| s % segments * count + p % count;
            let [a, b, c, d] = [at(s, p), at(s + 1, p), at(s + 1, p + 1), at(s, p + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// Curves that cross themselves: a loop within a loop, which goes round its inside twice, and an eight, of which one half is
/// inside out.
pub fn profiles() -> [(&'static str, Vec<DVec2>); 2] {
    let around = |point: &dyn Fn(f64) -> DVec2| {
        let turns = (0..96).map(|i| std::f64::consts::TAU * f64::from(i) / 96.0);
        turns.map(point).collect()
    };
    [
        (
            "loop in a loop",
            around(&|t| {
                let reach = 0.12 + 0.24 * t.cos();
                DVec2::new(0.45 + reach * t.cos(), reach * t.sin())
            }),
        ),
        (
            "eight",
            around(&|t| DVec2::new(0.5 + 0.3 * t.sin(), 0.25 * (2.0 * t).sin())),
        ),
    ]
}

/// Self-crossing solids seen from the usual place.
pub fn self_crossing(_: u32) -> Vec<Scene> {
    profiles()
        .into_iter()
        .map(|(name, profile)| {
            let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(-0.3, 0.2, -1.0));
            scenes::scene(name, revolved(&profile, 64), vec![plane])
        })
        .collect()
}
