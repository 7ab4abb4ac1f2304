//! Scenes of the table whose relief is what is hard.

use cutaway::scene::{ClipSurface, Cut, Scene, Wrap};
use glam::{DVec2, DVec3};

use super::numbers::Numbers;
use super::solids;
use super::{meshes, scenes};

/// The solid of most of them.
pub fn ball() -> cutaway::scene::Mesh {
    meshes::shape("sphere?subdivisions=3")
}

/// Toward the kept side: the cap shows to the usual camera.
pub const TILTED: DVec3 = DVec3::new(-0.3, -0.5, -1.0);

/// Case 22: maps of one height.
pub fn flat(_: u32) -> Vec<Scene> {
    [(0.0, 0.5), (0.25, 0.5), (1.0, -0.125), (-0.5, 0.25)]
        .map(|(height, scale)| {
            let map = scenes::map([3, 5], |_, _| height);
            let surface = scenes::mapped(DVec3::ZERO, TILTED, map, (0.5, scale), Wrap::Repeat);
            scenes::scene(
                &format!("height {height} times {scale}"),
                ball(),
                vec![surface],
            )
        })
        .to_vec()
}

/// Case 23: also seen edge-on.
pub fn ramp_and_saddle(_: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for (name, texels) in [
        ("ramp", [0.0, 1.0, 0.0, 1.0]),
        ("saddle", [0.0, 1.0, 1.0, 0.0]),
    ] {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            let map = scenes::map([2, 2], |x, y| texels[(2 * y + x) as usize] - 0.5);
            let surface = scenes::mapped(DVec3::ZERO, TILTED, map, (1.6, 0.4), wrap);
            let scene = scenes::scene(name, ball(), vec![surface.clone()]);
            // Edge-on: along U, and along the diagonal on which a saddle is straight.
            for towards in [surface.u, surface.u + surface.v] {
                let from = towards.normalize() * 3.0;
                all.push(solids::through(
                    scene.clone(),
                    name,
                    scenes::parallel(from, DVec3::ZERO, 1.2),
                ));
            }
            all.push(scene);
        }
    }
    all
}

/// Heights without a pattern, between -1/2 and 1/2.
pub fn noise(size: [u32; 2], seed: u64) -> cutaway::scene::OffsetMap {
    let mut numbers = Numbers(seed);
    let texels: Vec<f32> = (0..size[0] * size[1])
        .map(|_| (numbers.unit() - 0.5) as f32)
        .collect();
    scenes::map(size, |x, y| texels[(y * size[0] + x) as usize])
}

/// A relief that lies flat on `z = 0`, with its texel centres on multiples of 1/8.
pub fn bumpy_floor(size: [u32; 2]) -> ClipSurface {
    let mut surface = scenes::mapped(
        DVec3::ZERO,
        DVec3::Z,
        noise(size, 5),
        (1.0, 0.3),
        Wrap::Repeat,
    );
    surface.u = DVec3::X;
    surface.v = DVec3::Y;
    surface.origin = DVec3::new(-0.5 - 0.0625, -0.5 - 0.0625, 0.0);
    surface
}

/// Case 24: rays along N, along U and V, along the plane.
pub fn along_axes(px: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for normal in [DVec3::Z, -DVec3::Z] {
        let surface = scenes::mapped(
            DVec3::ZERO,
            normal,
            noise([8, 8], 3),
            (0.7, 0.3),
            Wrap::Repeat,
        );
        let scene = scenes::scene("axes", ball(), vec![surface.clone()]);
        for towards in [
            DVec3::Z,
            -DVec3::Z,
            surface.u,
            surface.v,
            -surface.u,
            surface.u + surface.v,
        ] {
            let towards = towards.normalize();
            let eye = scenes::looking(towards * 2.0, DVec3::ZERO, 40.0);
            all.push(solids::through(
                scene.clone(),
                &format!("{normal} along {towards}"),
                solids::centred(towards, px),
            ));
            all.push(solids::through(
                scene.clone(),
                &format!("{normal} from {towards}"),
                eye,
            ));
        }
    }
    all
}

/// Case 25: rays along rows and diagonals of texels.
pub fn along_texels(px: u32) -> Vec<Scene> {
    let scene = scenes::scene("texels", ball(), vec![bumpy_floor([8, 8])]);
    [
        DVec3::X,
        DVec3::Y,
        -DVec3::X,
        DVec3::Z,
        DVec3::new(1.0, 1.0, 0.0).normalize(),
    ]
    .map(|towards| {
        solids::through(
            scene.clone(),
            &format!("along {towards}"),
            solids::centred(towards, px),
        )
    })
    .to_vec()
}

/// Ridges whose crests are exactly at the height of a row of samples.
pub fn grazing(px: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for height in [0.25, 0.25 + 1e-7, 0.25 - 1e-7] {
        let ridges = scenes::map([8, 4], |x, y| {
            if x % 2 == 0 {
                f32::from(y as u8 % 2)
            } else {
                0.0
            }
        });
        let mut surface =
            scenes::mapped(DVec3::ZERO, DVec3::Z, ridges, (1.0, height), Wrap::Repeat);
        surface.u = DVec3::X;
        surface.v = DVec3::Y;
        let scene = scenes::scene("crests", ball(), vec![surface.clone(), surface.flipped()]);
        for cuts in [vec![surface.clone()], vec![surface.flipped()]] {
            let mut one = scene.clone();
            one.cuts = vec![Cut::new("cut", cuts)];
            for towards in [DVec3::X, DVec3::Y] {
                let name = format!("height {height} along {towards}");
                all.push(solids::through(
                    one.clone(),
                    &name,
                    solids::centred(towards, px),
                ));
            }
        }
    }
    all
}

/// Case 28: steps one texel wide.
pub fn plateaus(_: u32) -> Vec<Scene> {
    [0.2, 2.0]
        .map(|height| {
            let checker = scenes::map([16, 16], |x, y| f32::from((x / 4 + y / 4) as u8 % 2) - 0.5);
            let surface = scenes::mapped(DVec3::ZERO, TILTED, checker, (0.9, height), Wrap::Repeat);
            scenes::scene(&format!("{height} high"), ball(), vec![surface])
        })
        .to_vec()
}

/// Case 29: each way for a map to go on.
pub fn wraps(_: u32) -> Vec<Scene> {
    [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp]
        .map(|wrap| {
            let surface = scenes::mapped(DVec3::ZERO, TILTED, noise([6, 6], 11), (0.6, 0.2), wrap);
            scenes::scene(&format!("{wrap:?}"), ball(), vec![surface])
        })
        .to_vec()
}

/// Case 31: maps of few rows, and of no power of two.
pub fn odd_sizes(_: u32) -> Vec<Scene> {
    [[1, 1], [1, 9], [9, 1], [13, 7], [2, 2], [255, 3]]
        .map(|size| {
            let surface = scenes::mapped(
                DVec3::ZERO,
                TILTED,
                noise(size, 17),
                (0.8, 0.2),
                Wrap::Mirror,
            );
            scenes::scene(&format!("{size:?}"), ball(), vec![surface])
        })
        .to_vec()
}

/// Case 32: a cut that leaves the top of a slab at an angle of a tenth, or a hundredth, of a degree, with a relief as low; in the last
/// one the relief is finer than a grid of 256, so that the grid is off by all its height.
pub fn tangent(_: u32) -> Vec<Scene> {
    [(0.1_f64, 32), (0.01, 32), (0.1, 500)]
        .map(|(angle_deg, texels)| {
            let slope = angle_deg.to_radians().tan();
            let normal = DVec3::new(slope, -1.0, 0.5 * slope);
            let low = scenes::mapped(
                DVec3::new(0.0, 0.25, 0.0),
                normal,
                noise([texels; 2], 23),
                (0.9, slope),
                Wrap::Repeat,
            );
            let slab = meshes::block(DVec3::new(-0.5, -0.25, -0.5), DVec3::new(0.5, 0.25, 0.5));
            scenes::scene(
                &format!("{angle_deg} degrees, {texels} texels"),
                slab,
                vec![low],
            )
        })
        .to_vec()
}

/// Case 37: a relief, and the same with its sides exchanged.
pub fn opposite(_: u32) -> Vec<Scene> {
    let surface = scenes::mapped(
        DVec3::ZERO,
        TILTED,
        noise([12, 12], 29),
        (0.9, 0.3),
        Wrap::Repeat,
    );
    let torus = || meshes::shape("torus?segments=40&sides=20");
    vec![
        scenes::scene("kept", torus(), vec![surface.clone()]),
        scenes::scene("removed", torus(), vec![surface.flipped()]),
    ]
}

/// A relief and a plane that cross in the picture.
pub fn crossing(_: u32) -> Vec<Scene> {
    let rough = scenes::mapped(
        DVec3::ZERO,
        TILTED,
        noise([12, 12], 31),
        (0.9, 0.2),
        Wrap::Mirror,
    );
    let plane = ClipSurface::plane(DVec3::new(0.05, 0.0, 0.0), DVec3::new(-1.0, 0.2, -0.4));
    let both = scenes::scene("and", ball(), vec![rough.clone(), plane.clone()]);
    let mut either = both.clone();
    either.name = "or".to_owned();
    either.cuts = vec![Cut::new("one", vec![rough]), Cut::new("two", vec![plane])];
    vec![both, either]
}

/// Case 48: directions of different lengths and scales.
pub fn anisotropic(_: u32) -> Vec<Scene> {
    [(1.0, 1.0), (2.5, -0.7)]
        .map(|(sx, sy)| {
            let mut surface = scenes::mapped(
                DVec3::ZERO,
                TILTED,
                noise([9, 14], 37),
                (1.0, 0.25),
                Wrap::Repeat,
            );
            surface.v *= 0.35;
            surface.scale = DVec2::new(sx, sy).extend(surface.scale.z);
            scenes::scene(&format!("scale {sx}, {sy}"), ball(), vec![surface])
        })
        .to_vec()
}
