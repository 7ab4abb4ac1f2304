//! Caps show what they are made of: images in the (u, v) of the clip-surface, the right way up, in their mean where they are fine.

use cutaway::scene::style::Shading;
use cutaway::scene::{
    Amount, CapMaterial, Projection, SolidTexture, Texture, TextureKind, Viewpoint,
};

use super::*;
use std::sync::Arc;

/// A cube cut in the middle, straight from the front, in its own colours without light.
fn cube_of(material: CapMaterial) -> Scene {
    let mut cube = Part::new("cube", meshes::shape("cube"));
    cube.material.cap = Some(Arc::new(material));
    let mut scene = scenes::of_parts("dressed", vec![cube], Vec::new());
    let bounds = scene.bounds();
    let plane = ClipSurface::parse("-z=50%", &bounds).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.camera.viewpoint = Viewpoint::Orbit {
        azimuth_deg: 0.0,
        elevation_deg: 0.0,
    };
    scene.camera.projection = Projection::Orthographic { height: None };
    scene.style = Style {
        shading: Shading::Flat,
        ..Style::default()
    };
    scene
}

/// Four texels, from the upper left: red, green, blue, white.
fn four(kind: TextureKind) -> Arc<Texture> {
    let texels = vec![
        [255, 0, 0, 255],
        [0, 255, 0, 255],
        [0, 0, 255, 255],
        [255; 4],
    ];
    Arc::new(Texture::new([2, 2], texels, kind).expect("a texture"))
}

fn even(color: [u8; 4], kind: TextureKind) -> Option<Arc<Texture>> {
    let texture = Texture::new([4, 4], vec![color; 16], kind).expect("a texture");
    Some(Arc::new(texture))
}

/// The colours of the pixels that show a cap, with where they are.
fn caps(session: &mut Session, scene: &Scene) -> Vec<([u32; 2], [u8; 3])> {
    let method = Method::from(Strategy::RAYCAST_MASK);
    let picture = picture_of(session, scene, method).expect("a picture");
    let layers = session.layers(method).expect("layers");
    let pixels = (0..).zip(layers.pixels.iter().zip(picture.chunks_exact(4)));
    let caps = pixels.filter(|(_, (layer, _))| layer.kind == Kind::Cap);
    let caps = caps.map(|(i, (_, c))| ([i % SIZE_PX[0], i / SIZE_PX[0]], [c[0], c[1], c[2]]));
    let caps: Vec<_> = caps.collect();
    assert!(caps.len() > 1000, "{} pixels of caps", caps.len());
    caps
}

/// What is seen at a share of the cap, from its upper left.
fn at_share(caps: &[([u32; 2], [u8; 3])], [x, y]: [f64; 2]) -> [u8; 3] {
    let range = |axis: usize| {
        let values = || caps.iter().map(move |(at, _)| f64::from(at[axis]));
        (
            values().fold(f64::INFINITY, f64::min),
            values().fold(0.0, f64::max),
        )
    };
    let along = |(low, high): (f64, f64), share: f64| (low + (high - low) * share).round() as u32;
    let wanted = [along(range(0), x), along(range(1), y)];
    let found = caps.iter().find(|(at, _)| *at == wanted);
    found.unwrap_or_else(|| panic!("no cap at {wanted:?}")).1
}

#[test]
fn images_stand_upright_on_the_cut() {
    let mut session = session();
    let size = scenes_size();
    // A repeat is as large as the cube, and begins at the middle of the clip-surface.
    let material = CapMaterial {
        diffuse: Some(four(TextureKind::Color)),
        size: Some(Amount::Units(size)),
        ..CapMaterial::default()
    };
    let caps = caps(&mut session, &cube_of(material));
    // The middles of texels, half a repeat away from the middle of the cut.
    let [right_below, left_below] = [[0.75, 0.75], [0.25, 0.75]].map(|at| at_share(&caps, at));
    let [right_above, left_above] = [[0.75, 0.25], [0.25, 0.25]].map(|at| at_share(&caps, at));
    let near = |a: [u8; 3], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 60);
    // Four repeats meet in the middle: right below of it is the upper left of one.
    assert!(near(right_below, [255, 0, 0]), "{right_below:?}");
    assert!(near(left_below, [0, 255, 0]), "{left_below:?}");
    assert!(near(right_above, [0, 0, 255]), "{right_above:?}");
    assert!(near(left_above, [255, 255, 255]), "{left_above:?}");
}

/// Length of the sides of the cube.
fn scenes_size() -> f64 {
    meshes::shape("cube").bounds().size().x
}

#[test]
fn what_is_finer_than_a_pixel_is_its_mean() {
    let mut session = session();
    let checks = (0..256 * 256).map(|i| {
        let bright = (i / 256 + i % 256) % 2 == 0;
        [if bright { 255 } else { 0 }; 3]
    });
    let texels = checks.map(|[r, g, b]| [r, g, b, 255]).collect();
    let texture = Arc::new(Texture::new([256, 256], texels, TextureKind::Color).expect("checks"));
    let spread = |session: &mut Session, size: f64| {
        let material = CapMaterial {
            diffuse: Some(texture.clone()),
            size: Some(Amount::Units(size)),
            ..CapMaterial::default()
        };
        let caps = caps(session, &cube_of(material));
        let [least, most] = caps
            .iter()
            .fold([255, 0], |[l, m], (_, c)| [c[0].min(l), c[0].max(m)]);
        (least, most)
    };
    let side = scenes_size();
    let (least, most) = spread(&mut session, side / 3.0);
    // Half of the light.
    assert!(least >= 184 && most <= 192, "{least} to {most}");
    // The control: as large as they are here checks are seen.
    let (least, most) = spread(&mut session, side * 32.0);
    assert!(least < 40 && most > 220, "{least} to {most}");
}

#[test]
fn light_and_normals_do_what_they_say() {
    let mut session = session();
    let with = |light, normal, shading| {
        let mut scene = cube_of(CapMaterial {
            diffuse: even([200, 120, 60, 255], TextureKind::Color),
            light,
            normal,
            ..CapMaterial::default()
        });
        scene.style.shading = shading;
        scene
    };
    let mut color = |scene: &Scene| caps(&mut session, scene)[500].1;
    let plain = color(&with(None, None, Shading::Flat));
    assert_eq!(plain, [200, 120, 60], "the colour of the image");
    let half = color(&with(
        even([128; 4], TextureKind::Data),
        None,
        Shading::Flat,
    ));
    // 128 / 255 of the light of 200 is 147 in sRGB.
    assert!(half[0].abs_diff(147) <= 1, "{half:?}");
    let lit = color(&with(None, None, Shading::Calm));
    let straight = even([128, 128, 255, 255], TextureKind::Data);
    let leaning = even([218, 128, 218, 255], TextureKind::Data);
    let straight = color(&with(None, straight, Shading::Clay));
    let leaning = color(&with(None, leaning, Shading::Clay));
    let without = color(&with(None, None, Shading::Clay));
    assert!(
        straight[0].abs_diff(without[0]) <= 1,
        "{straight:?} {without:?}"
    );
    // Leaning to the right, away from the light over the left shoulder.
    assert!(
        f64::from(leaning[0]) < 0.92 * f64::from(without[0]),
        "{leaning:?} {without:?}"
    );
    assert_ne!(lit, [0; 3]);
}

#[test]
fn solid_textures_stay_in_the_solid() {
    let mut session = session();
    for (name, solid) in SolidTexture::NAMED {
        let of = |section: &str, turn: f64| {
            let mut scene = cube_of(CapMaterial {
                solid: Some(solid.clone()),
                size: Some(Amount::Units(0.4 * scenes_size())),
                ..CapMaterial::default()
            });
            let plane = ClipSurface::parse(section, &scene.bounds()).expect("a section");
            scene.cuts[0].surfaces = vec![plane];
            scene.camera.viewpoint = Viewpoint::Orbit {
                azimuth_deg: turn,
                elevation_deg: 0.0,
            };
            scene
        };
        // Two cuts have an edge in common, the vertical through the middle: from the front it is where the right half begins that the
        // other cut leaves.
        let front = caps(&mut session, &of("-z=50%", 0.0));
        let side = caps(&mut session, &of("-x=50%", 90.0));
        // How unlike the common edge is to itself in the other cut, and to a vertical elsewhere in it.
        let [same, other] = [0.5, 0.2].map(|x| {
            let rows = (5..95).map(|i| f64::from(i) / 100.0);
            let pairs = rows.map(|y| (at_share(&front, [0.5, y]), at_share(&side, [x, y])));
            let unlike = pairs.map(|(a, b)| {
                a.iter()
                    .zip(b)
                    .map(|(a, b)| u32::from(a.abs_diff(b)))
                    .sum::<u32>()
            });
            unlike.sum::<u32>()
        });
        assert!(
            2 * same < other,
            "{name}: {same} at the common edge, {other} elsewhere"
        );
    }
}

#[test]
fn stacks_fill_the_box_of_the_part() {
    let slices = [
        [255, 0, 0, 255],
        [0, 255, 0, 255],
        [0, 0, 255, 255],
        [255, 255, 0, 255],
    ];
    let images = slices.map(|color| even(color, TextureKind::Color).expect("a slice"));
    let of = |section: &str| {
        let mut scene = cube_of(CapMaterial {
            solid: Some(SolidTexture::Stack(images.to_vec())),
            ..CapMaterial::default()
        });
        let plane = ClipSurface::parse(section, &scene.bounds()).expect("a section");
        scene.cuts[0].surfaces = vec![plane];
        scene
    };
    let mut session = session();
    for (i, section) in ["-z=12.5%", "-z=37.5%", "-z=62.5%", "-z=87.5%"]
        .iter()
        .enumerate()
    {
        let color = caps(&mut session, &of(section))[300].1;
        assert_eq!(color, slices[i][..3], "{section}");
    }
    // The ends do not run into each other.
    for (section, i) in [("-z=1%", 0), ("-z=99%", 3)] {
        let color = caps(&mut session, &of(section))[300].1;
        assert_eq!(color, slices[i][..3], "{section}");
    }
}

#[test]
fn stripes_of_interference_lie_over_materials() {
    let mut scene = cube_of(CapMaterial {
        solid: Some(SolidTexture::Marble),
        ..CapMaterial::default()
    });
    let mut other = scene.parts[0].clone();
    other.name = "other".to_owned();
    other.world_from_part = DAffine3::from_scale(DVec3::splat(0.5));
    scene.parts.push(other);
    let mut session = session();
    let red = |caps: &[([u32; 2], [u8; 3])]| {
        caps.iter()
            .filter(|(_, [r, g, b])| (*r, *g, *b) == (255, 0, 0))
            .count()
    };
    assert_eq!(red(&caps(&mut session, &scene)), 0, "the control");
    scene.interference = Some(glam::Vec3::X);
    assert!(red(&caps(&mut session, &scene)) > 300, "stripes are seen");
}

#[test]
fn every_strategy_dresses_its_layers() {
    let mut session = session();
    let mut scene = scene_in(Style::default());
    for part in &mut scene.parts {
        part.material.cap = Some(Arc::new(CapMaterial {
            diffuse: Some(four(TextureKind::Color)),
            normal: Some(four(TextureKind::Data)),
            solid: Some(SolidTexture::Marble),
            ..CapMaterial::default()
        }));
    }
    let mut compared = 0;
    for strategy in Strategy::all() {
        for by in [Rasteriser::Hardware, Rasteriser::Compute] {
            let method = Method::new(strategy, DrawOptions::by(by));
            compared +=
                usize::from(drawn_as_shaded(&mut session, ("marble", &scene), method).is_some());
        }
    }
    assert!(compared > 8, "{compared} pictures");
}
