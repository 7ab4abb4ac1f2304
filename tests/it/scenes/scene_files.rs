//! Promise: what a scene file, a section or a relief says is what the scene holds.

use std::path::Path;

use command::Scratch;
use cutaway::error::{Diagnostic, Result};
use cutaway::scene::describe::OrWord;
use cutaway::scene::relief::{Procedure, ProcedureKind};
use cutaway::scene::style::Paper;
use cutaway::scene::{Fill, Mesh, Part, Projection, Role, Up, Viewpoint, Wrap};
use cutaway_io::document::{Settings, StrategySettings, Timeline, section};
use cutaway_io::load::{Assets, Loaded, read_offset_map};
use glam::{DVec3, Vec3};

use crate::common::command;
mod grey_tiff;

/// A tetrahedron with corners at the origin and 1 along each axis.
fn solid(name: &str) -> Part {
    let mesh = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        corner_normals: None,
        vertex_paint: None,
    };
    Part::new(name, mesh)
}

/// Assets in which every mesh and shape that these tests name is a tetrahedron.
fn assets(folder: &Scratch) -> Assets {
    let mut assets = Assets::default();
    for stem in ["crank", "bolt", "two"] {
        let parts = match stem {
            "two" => vec![solid("left"), solid("right")],
            _ => vec![solid(stem)],
        };
        let notes = vec![Diagnostic::note("welded", format!("{stem} was welded"))];
        let loaded = Loaded {
            parts,
            notes,
            ..Loaded::default()
        };
        assets.insert_mesh(folder.path(&format!("{stem}.obj")), loaded);
    }
    assets
}

fn load(folder: &Scratch, text: &str) -> Result<Timeline> {
    folder.load_with(text, &mut assets(folder))
}

#[test]
fn every_table_reaches_the_scene() {
    let folder = Scratch::new("every-table");
    let text = r##"
resolution = [640, 480]
background = "#fff"
interference = "#00f"

[camera]
azimuth_deg = 10
elevation_deg = -20.5
projection = "orthographic"
height = 3
near = 0.25
near_cap = false
up = "+Z"

[[part]]
name = "crank"
mesh = "crank.obj"
translate = [1, 2, 3]
rotate_deg = [0, 0, 90]
scale = 2
role = "interior"
priority = -3
fill = "nonzero"
material = { color = "#8a94a6", cap_color = "#ff0000", hatch = "steel" }

[[part]]
name = "pair"
mesh = "two.obj"
matrix = [[0, 0, 1, 5], [1, 0, 0, 6], [0, 1, 0, 7], [0, 0, 0, 1]]

[[part]]
shape = "cube?size=2"

[relief.ragged]
kind = "fractal"
size = [32, 16]
seed = 7

[relief.bumps]
kind = "waves"
count = [2, 0]
size = 16

[relief.both]
blend = ["ragged", "bumps"]
op = "mix"
share = 0.25

[[cut]]
name = "front"
applies_to = ["pair/*"]
except = ["*/right"]
surfaces = [
  { origin = [0, 0, 0.5], u = [2, 0, 0], v = [0, 1, 0], scale = [4, 4, 0.1], relief = "both", wrap = "mirror" },
  { section = "x=25%" },
]

[[cut]]
surfaces = [
  { normal = [0, 0, 2], origin = [0, 0, 9], flip = true },
  { section = "-z=50%", relief = "ragged", amplitude = "10%", period = 2 },
]

[strategy]
name = "raycast+mask"

[[key]]
target = "cut.front.surfaces.0.origin"
times_s = [0, 2]
values = [[0, 0, -1], [0, 0, 1]]
"##;
    let file = load(&folder, text).expect("a sound scene");
    let scene = file.rest();
    assert_eq!(scene.name, "scene", "name of the scene");
    let expected = Settings {
        size_px: Some([640, 480]),
        strategy: StrategySettings {
            name: Some("raycast+mask".to_owned()),
            rasteriser: None,
        },
        background: Some(OrWord::Value(Paper::Color(Vec3::ONE))),
        interference: Some(Vec3::Z),
        ..Settings::default()
    };
    assert_eq!(file.settings(), &expected);
    assert_eq!(scene.interference, Some(Vec3::Z));
    assert_eq!(scene.style.paper, Paper::Color(Vec3::ONE));

    let camera = scene.camera;
    assert_eq!(
        camera.viewpoint,
        Viewpoint::Orbit {
            azimuth_deg: 10.0,
            elevation_deg: -20.5
        },
        "viewpoint"
    );
    assert_eq!(
        camera.projection,
        Projection::Orthographic { height: Some(3.0) },
        "projection"
    );
    assert_eq!(
        (camera.up, camera.near, camera.near_cap),
        (Up::PlusZ, Some(0.25), false),
        "camera"
    );

    let names: Vec<&str> = scene.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(
        names,
        ["crank", "pair/left", "pair/right", "cube"],
        "names of the parts"
    );
    let crank = &scene.parts[0];
    assert_eq!(
        (crank.role, crank.priority),
        (Role::Interior, Some(-3)),
        "role and priority"
    );
    let fills: Vec<Fill> = scene.parts.iter().map(|p| p.fill).collect();
    assert_eq!(fills[0], Fill::Nonzero, "fill");
    assert_eq!(fills[1..], [Fill::EvenOdd; 3], "the usual fill");
    let moved = crank.world_from_part.transform_point3(DVec3::X);
    assert!(
        (moved - DVec3::new(1.0, 4.0, 3.0)).length() < 1e-12,
        "x goes to {moved}"
    );
    assert_eq!(
        crank.material.color * 255.0,
        Vec3::new(138.0, 148.0, 166.0),
        "colour"
    );
    assert_eq!(crank.material.cap_color, Some(Vec3::X), "colour of the cap");
    let cutaway::scene::CapHatch::Pattern(pattern) = &crank.material.hatch else {
        panic!("{:?} is no pattern", crank.material.hatch);
    };
    assert_eq!(pattern.name, "steel");
    let turned = scene.parts[1]
        .world_from_part
        .transform_point3(DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(turned, DVec3::new(8.0, 7.0, 9.0), "rows of the matrix");

    let front = &scene.cuts[0];
    let cut: Vec<bool> = scene.parts.iter().map(|p| front.applies_to(p)).collect();
    assert_eq!(cut, [false, true, false, false], "parts that `front` cuts");
    let map = front.surfaces[0].relief.as_ref().expect("a relief");
    assert_eq!(map.size(), [32, 16], "size of the blend");
    assert_eq!(front.surfaces[0].wrap, Wrap::Mirror, "wrap");
    assert_eq!(front.surfaces[0].scale, DVec3::new(4.0, 4.0, 0.1), "scale");
    assert_eq!(
        front.surfaces[1].frame().normal,
        DVec3::X,
        "normal of the section"
    );
    assert_eq!(
        scene.cuts[1].surfaces[0].frame().normal,
        DVec3::NEG_Z,
        "flipped normal"
    );
    let placed = &scene.cuts[1].surfaces[1];
    assert!(
        (placed.u.length() - 2.0).abs() < 1e-12,
        "period {}",
        placed.u.length()
    );
    let height = scene.bounds().size().length() * 0.1;
    assert!(
        (placed.scale.z - height).abs() < 1e-12,
        "amplitude {}",
        placed.scale.z
    );

    assert_eq!(
        file.keys().next().expect("the key").values[1],
        [0.0, 0.0, 1.0],
        "values of the key"
    );
    let notes = crate::common::text_of(file.notes());
    assert!(notes.contains("crank was welded"), "{notes}");
}

#[test]
fn a_minimal_scene_takes_the_usual_values() {
    let folder = Scratch::new("minimal");
    let file = load(&folder, "[[part]]\nshape = \"cube\"\n").expect("a sound scene");
    assert_eq!(file.rest().camera, Default::default(), "camera");
    assert!(
        file.rest().cuts.is_empty() && file.notes().is_empty(),
        "{file:?}"
    );
}

#[test]
fn a_camera_can_be_placed_outright() {
    let folder = Scratch::new("camera");
    let text = "[camera]\nposition = [0, 0, 5]\nfocal_point = [0, 0, 0]\nview_up = [1, 0, 0]\nfov_y_deg = 45\n[[part]]\nshape = \"cube\"\n";
    let file = load(&folder, text).expect("a sound scene");
    let camera = file.rest().camera;
    let viewpoint = Viewpoint::Explicit {
        position: DVec3::new(0.0, 0.0, 5.0),
        focal_point: DVec3::ZERO,
        view_up: Some(DVec3::X),
    };
    assert_eq!(camera.viewpoint, viewpoint, "viewpoint");
    assert_eq!(
        camera.projection,
        Projection::Perspective { fov_y_deg: 45.0 },
        "projection"
    );
}

#[test]
fn a_section_with_a_relief_cuts_what_the_section_cuts() {
    let bounds = solid("s").bounds_in_world();
    for name in Procedure::NAMES {
        let relief = section("z=50%").relief(name).on(&bounds).expect(name);
        assert!(!relief.misses(&bounds), "{name} misses");
        for (z, kept) in [(0.0, false), (1.0, true)] {
            let height = relief.kept_height(DVec3::new(0.1, 0.2, z));
            assert_eq!(height > 0.0, kept, "{name}: height {height} at z = {z}");
        }
    }
}

#[test]
fn large_maps_are_computed() {
    let large = Procedure {
        kind: ProcedureKind::Steps { levels: 3 },
        size: [4096, 4096],
        seed: 0,
    };
    assert_eq!(
        large.map().range(),
        [0.0, 1.0],
        "heights of 4096 x 4096 texels"
    );
}

mod images {
    use super::*;

    fn heights(path: &Path) -> ([u32; 2], Vec<f32>) {
        let map = read_offset_map(path).expect("a sound image");
        (map.size(), map.texels().to_vec())
    }

    #[test]
    fn integers_are_divided_by_their_greatest_value() {
        let folder = Scratch::new("integers");
        let grey8 = [0_u8, 1, 128, 254, 255, 77];
        let path = folder.path("grey8.png");
        image::GrayImage::from_raw(3, 2, grey8.to_vec())
            .expect("6 texels")
            .save(&path)
            .expect("png");
        let expected: Vec<f32> = grey8.iter().map(|v| f32::from(*v) / 255.0).collect();
        assert_eq!(heights(&path), ([3, 2], expected.clone()), "8 bits");

        // Grey stored as RGBA has the same heights, whatever its alpha.
        let path = folder.path("rgba8.png");
        let rgba = grey8.iter().flat_map(|v| [*v, *v, *v, 255 - *v]).collect();
        image::RgbaImage::from_raw(3, 2, rgba)
            .expect("6 texels")
            .save(&path)
            .expect("png");
        assert_eq!(heights(&path).1, expected, "grey as RGBA");

        let path = folder.path("rgb8.bmp");
        image::RgbImage::from_raw(3, 1, vec![255, 0, 0, 0, 255, 0, 0, 0, 255])
            .expect("3 texels")
            .save(&path)
            .expect("bmp");
        assert_eq!(
            heights(&path).1,
            [0.2126, 0.7152, 0.0722],
            "luma of the primaries"
        );

        let grey16 = [0_u16, 1, 255, 256, 40_000, 65_535];
        for (name, width) in [("grey16.png", 2), ("column16.tiff", 1), ("row16.png", 6)] {
            let path = folder.path(name);
            image::ImageBuffer::<image::Luma<u16>, _>::from_raw(width, 6 / width, grey16.to_vec())
                .expect("6 texels")
                .save(&path)
                .expect(name);
            let expected = grey16.iter().map(|v| f32::from(*v) / 65_535.0).collect();
            assert_eq!(heights(&path), ([width, 6 / width], expected), "{name}");
        }
    }

    fn write_exr(path: &Path, channels: &[(&str, Vec<f32>)]) {
        use exr::prelude::*;
        let list = channels
            .iter()
            .map(|(name, v)| AnyChannel::new(*name, FlatSamples::F32(v.clone())))
            .collect();
        let layer = Layer::new(
            (2, 2),
            LayerAttributes::named("heights"),
            Encoding::FAST_LOSSLESS,
            AnyChannels::sort(list),
        );
        Image::from_layer(layer).write().to_file(path).expect("exr");
    }

    #[test]
    fn floats_are_taken_as_they_are() {
        let folder = Scratch::new("floats");
        let path = folder.path("heights.exr");
        let values = vec![-3.5, 0.0, 1e-3, 1234.5];
        let other = vec![9.0; 4];
        for channels in [
            vec![("depth", values.clone())],
            vec![("Y", values.clone()), ("R", other.clone())],
            vec![
                ("R", values.clone()),
                ("G", other.clone()),
                ("B", other.clone()),
            ],
        ] {
            write_exr(&path, &channels);
            assert_eq!(heights(&path), ([2, 2], values.clone()), "{channels:?}");
        }
        write_exr(&path, &[("p", other.clone()), ("q", other)]);
        let error = read_offset_map(&path)
            .expect_err("two unknown channels")
            .to_string();
        assert!(error.contains("p, q") && error.contains("help:"), "{error}");

        write_exr(&path, &[("Y", vec![0.0, 1.0, f32::NAN, 2.0])]);
        let error = read_offset_map(&path).expect_err("NaN").to_string();
        assert!(error.contains("texel (0, 1) is NaN"), "{error}");
        assert!(
            error.contains("heights.exr") && error.contains("help:"),
            "{error}"
        );
    }
}
