//! Promise: a scene, section or relief that makes no sense is refused by name, with its line and a mend; nothing panics.
//!
//! Every case is one change to a scene that loads: the intact scene is the negative control.

use std::fs;
use std::path::{Path, PathBuf};

use cutaway::error::{Error, Result};
use cutaway::scene::relief::read_offset_map;
use cutaway::scene::{
    Bounds, ClipSurface, Mesh, Part, ReliefSpec, SceneFile, apply_relief, load_scene_file,
    section_surface,
};
use glam::DVec3;

const INTACT: &str = r##"resolution = [64, 64]
background = "#102030"
[camera]
position = [0, 0, 5]
focal_point = [0, 0, 0]
view_up = [0, 1, 0]
projection = "perspective"
fov_y_deg = 30
near = 0.1
near_cap = true
up = "+Y"
[[part]]
name = "crank"
shape = "crank"
translate = [0, 0, 0]
rotate_deg = [0, 0, 0]
scale = 1.5
role = "exterior"
priority = 1
material = { color = "#8a94a6", hatch = "steel" }
[[part]]
name = "bolt"
mesh = "bolt.obj"
matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
[relief.ragged]
kind = "fractal"
size = [16, 8]
octaves = 3
[relief.bumps]
kind = "waves"
size = 8
[relief.both]
blend = ["ragged", "bumps"]
op = "mix"
share = 0.5
[[cut]]
name = "front"
applies_to = ["crank"]
except = ["b*"]
surfaces = [
  { origin = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0], scale = [4, 4, 0.1], relief = "both", wrap = "repeat" },
  { section = "z=50%", relief = "bumps", amplitude = "5%", period = 3 },
  { normal = [0, 1, 0], origin = [0, 0, 0] },
]
[strategy]
name = "raycast+mask"
[[key]]
target = "cut.front.surfaces.0.origin"
times_s = [0, 2]
values = [[0, 0, -1], [0, 0, 1]]
"##;

/// What is replaced, by what, and two words that the error has to hold: the culprit and what is wrong or its mend.
const BROKEN: &[(&str, &str, &str, &str)] = &[
    (
        "resolution = [64, 64]",
        "resolution = [0, 64]",
        "resolution",
        "from 1",
    ),
    (
        "resolution = [64, 64]",
        "resolution = 64",
        "resolution",
        "a list",
    ),
    (
        "resolution = [64, 64]",
        "resolutoin = [64, 64]",
        "resolutoin",
        "did you mean `resolution`?",
    ),
    ("\"#102030\"", "\"blue\"", "background", "#rrggbb"),
    ("\"#102030\"", "\"#+12345\"", "background", "#rrggbb"),
    ("[camera]", "[camrea]", "camrea", "did you mean `camera`?"),
    (
        "position = [0, 0, 5]",
        "position = [0, 5]",
        "camera.position",
        "3 numbers",
    ),
    (
        "position = [0, 0, 5]",
        "position = [0, 0, nan]",
        "camera.position.2",
        "finite",
    ),
    (
        "position = [0, 0, 5]",
        "position = [0, 0, 0]",
        "camera.focal_point",
        "position",
    ),
    (
        "position = [0, 0, 5]",
        "azimuth_deg = 3",
        "azimuth_deg",
        "focal_point",
    ),
    ("focal_point = [0, 0, 0]", "", "camera", "focal_point"),
    (
        "view_up = [0, 1, 0]",
        "view_up = [0, 0, -2]",
        "camera.view_up",
        "viewing direction",
    ),
    (
        "view_up = [0, 1, 0]",
        "view_up = [0, 0, 0]",
        "camera.view_up",
        "viewing direction",
    ),
    (
        "\"perspective\"",
        "\"prespective\"",
        "camera.projection",
        "did you mean `perspective`?",
    ),
    (
        "\"perspective\"",
        "\"orthographic\"",
        "camera.fov_y_deg",
        "perspective",
    ),
    (
        "fov_y_deg = 30",
        "fov_y_deg = 180",
        "camera.fov_y_deg",
        "170",
    ),
    (
        "fov_y_deg = 30",
        "fov_y_deg = \"30\"",
        "camera.fov_y_deg",
        "number",
    ),
    ("near = 0.1", "near = 0", "camera.near", "above 0"),
    ("near = 0.1", "near = inf", "camera.near", "finite"),
    (
        "near_cap = true",
        "near_cap = 1",
        "camera.near_cap",
        "true or false",
    ),
    ("up = \"+Y\"", "up = \"Y\"", "camera.up", "+Y, +Z"),
    (
        "shape = \"crank\"",
        "shape = \"cranck\"",
        "part.crank.shape",
        "did you mean `crank`?",
    ),
    (
        "shape = \"crank\"",
        "shape = \"nothing\"",
        "part.crank.shape",
        "no solid",
    ),
    ("shape = \"crank\"", "", "part.crank", "neither"),
    (
        "shape = \"crank\"",
        "shape = \"crank\"\nmesh = \"bolt.obj\"",
        "part.crank.shape",
        "keep one",
    ),
    ("name = \"bolt\"", "name = \"crank\"", "part.crank", "taken"),
    ("name = \"bolt\"", "name = \"\"", "part", "empty"),
    (
        "name = \"bolt\"",
        "name = 7",
        "part.1.name",
        "text in quotes",
    ),
    (
        "mesh = \"bolt.obj\"",
        "mesh = \"blot.obj\"",
        "part.bolt.mesh",
        "blot.obj",
    ),
    (
        "translate = [0, 0, 0]",
        "translate = [1e99, 1e99, 1e400]",
        "part.crank.translate.2",
        "finite",
    ),
    (
        "rotate_deg = [0, 0, 0]",
        "rotate = [0, 0, 0]",
        "part.crank.rotate",
        "did you mean `rotate_deg`?",
    ),
    (
        "scale = 1.5",
        "scale = [1, 0, 1]",
        "part.crank.scale",
        "flattens",
    ),
    (
        "scale = 1.5",
        "scale = 1.5\nmatrix = []",
        "part.crank.translate",
        "matrix",
    ),
    ("scale = 1.5", "scale = 1e308\n", "part.crank", "1e100"),
    (
        "[0, 0, 1, 0], [0, 0, 0, 1]]",
        "[0, 0, 0, 0], [0, 0, 0, 1]]",
        "part.bolt.matrix",
        "flattens",
    ),
    (
        "[0, 0, 0, 1]]",
        "[0, 0, 1, 1]]",
        "part.bolt.matrix.3",
        "last row",
    ),
    (
        "[0, 0, 1, 0], [0, 0, 0, 1]]",
        "[0, 0, 0, 1]]",
        "part.bolt.matrix",
        "3 rows",
    ),
    (
        "role = \"exterior\"",
        "role = \"inside\"",
        "part.crank.role",
        "interior",
    ),
    (
        "priority = 1",
        "priority = 3000000000",
        "part.crank.priority",
        "whole number",
    ),
    (
        "priority = 1",
        "priority = 1.5",
        "part.crank.priority",
        "whole number",
    ),
    (
        "color = \"#8a94a6\"",
        "colour = \"#8a94a6\"",
        "part.crank.material.colour",
        "did you mean `color`?",
    ),
    (
        "hatch = \"steel\"",
        "hatch = \"stel\"",
        "part.crank.material.hatch",
        "did you mean `steel`?",
    ),
    (
        "kind = \"fractal\"",
        "kind = \"fratcal\"",
        "relief.ragged.kind",
        "did you mean `fractal`?",
    ),
    (
        "kind = \"fractal\"",
        "kind = \"steps\"",
        "relief.ragged.octaves",
        "levels",
    ),
    (
        "kind = \"fractal\"\nsize = [16, 8]\noctaves = 3",
        "image = \"none.png\"",
        "none.png",
        "check the path",
    ),
    (
        "kind = \"fractal\"\nsize = [16, 8]\noctaves = 3",
        "image = \"nan.exr\"",
        "nan.exr",
        "check the path",
    ),
    (
        "kind = \"fractal\"\nsize = [16, 8]\noctaves = 3",
        "image = \"bolt.obj\"",
        "bolt.obj",
        "PNG",
    ),
    (
        "kind = \"fractal\"\nsize = [16, 8]\noctaves = 3",
        "",
        "relief.ragged",
        "where its heights",
    ),
    (
        "size = [16, 8]",
        "size = [0, 8]",
        "relief.ragged.size",
        "from 1",
    ),
    (
        "size = [16, 8]",
        "size = [65536, 65536]",
        "relief.ragged.size",
        "texels",
    ),
    (
        "octaves = 3",
        "octaves = 2.5",
        "relief.ragged.octaves",
        "whole",
    ),
    (
        "octaves = 3",
        "octvaes = 3",
        "relief.ragged.octvaes",
        "did you mean `octaves`?",
    ),
    (
        "[\"ragged\", \"bumps\"]",
        "[\"ragged\", \"bmups\"]",
        "bmups",
        "did you mean `bumps`?",
    ),
    (
        "[\"ragged\", \"bumps\"]",
        "[\"ragged\", \"both\"]",
        "relief.both",
        "made of itself",
    ),
    (
        "[\"ragged\", \"bumps\"]",
        "[\"ragged\"]",
        "relief.both.blend",
        "exactly two",
    ),
    (
        "op = \"mix\"",
        "op = \"mux\"",
        "relief.both.op",
        "did you mean `mix`?",
    ),
    ("op = \"mix\"", "op = \"add\"", "relief.both.share", "mix"),
    ("share = 0.5", "share = 2", "relief.both.share", "0 to 1"),
    (
        "applies_to = [\"crank\"]",
        "applies_to = [\"crnak\"]",
        "cut.front.applies_to",
        "did you mean `crank`?",
    ),
    (
        "applies_to = [\"crank\"]",
        "applies_to = \"crank\"",
        "cut.front.applies_to",
        "list of texts",
    ),
    (
        "except = [\"b*\"]",
        "except = [\"bolts\"]",
        "cut.front.except",
        "did you mean `bolt`?",
    ),
    (
        "u = [1, 0, 0]",
        "u = [0, 0, 0]",
        "cut.front.surfaces.0",
        "u is too short",
    ),
    (
        "u = [1, 0, 0]",
        "u = [1, 0.5, 0]",
        "cut.front.surfaces.0",
        "orthogonal",
    ),
    (
        "u = [1, 0, 0]",
        "u = [1e200, 0, 0]",
        "cut.front.surfaces.0",
        "1e100",
    ),
    ("u = [1, 0, 0], ", "", "cut.front.surfaces.0", "`u`"),
    (
        "scale = [4, 4, 0.1]",
        "scale = [4, -inf, 0.1]",
        "cut.front.surfaces.0.scale.1",
        "finite",
    ),
    (
        "relief = \"both\"",
        "relief = \"boht\"",
        "cut.front.surfaces.0.relief",
        "did you mean `both`?",
    ),
    (
        "wrap = \"repeat\"",
        "wrap = \"reapet\"",
        "cut.front.surfaces.0.wrap",
        "did you mean `repeat`?",
    ),
    (
        "wrap = \"repeat\"",
        "amplitude = 2",
        "cut.front.surfaces.0.amplitude",
        "scale",
    ),
    (
        "section = \"z=50%\"",
        "section = \"q=50%\"",
        "cut.front.surfaces.1.section",
        "no axis",
    ),
    (
        "relief = \"bumps\", amplitude",
        "amplitude",
        "cut.front.surfaces.1.amplitude",
        "no relief",
    ),
    (
        "amplitude = \"5%\"",
        "amplitude = \"5 percent\"",
        "cut.front.surfaces.1.amplitude",
        "not a number",
    ),
    (
        "period = 3",
        "period = 0",
        "cut.front.surfaces.1",
        "above 0",
    ),
    (
        "normal = [0, 1, 0]",
        "normal = [0, 0, 0]",
        "cut.front.surfaces.2.normal",
        "zero",
    ),
    (
        "surfaces = [\n",
        "surface = [\n",
        "cut.front.surface",
        "did you mean `surfaces`?",
    ),
    (
        "name = \"raycast+mask\"",
        "strategy = \"raycast+mask\"",
        "strategy.strategy",
        "name",
    ),
    (
        "target = \"cut.front.",
        "target = \"cut.back.",
        "key.0.target",
        "front",
    ),
    (
        "target = \"cut.front.",
        "target = \"scene.front.",
        "key.0.target",
        "camera, part, cut",
    ),
    (
        "\"cut.front.surfaces.0.origin\"",
        "\"cut.front\"",
        "key.0.target",
        "no number",
    ),
    (
        "times_s = [0, 2]",
        "times_s = [2, 0]",
        "key.0.times_s",
        "ascend",
    ),
    (
        "times_s = [0, 2]",
        "times_s = [0, 1, 2]",
        "key.0.values",
        "2 values for 3 times",
    ),
    (
        "values = [[0, 0, -1], [0, 0, 1]]",
        "values = [[0, 0, -1], [0, 0]]",
        "key.0.values",
        "length",
    ),
    (
        "values = [[0, 0, -1], [0, 0, 1]]",
        "values = [[], []]",
        "key.0.values",
        "length",
    ),
    (
        "near = 0.1",
        "near = 0.1\nnear = 0.2",
        ":10",
        "duplicate key",
    ),
    ("near = 0.1", "near = = 0.1", ":9", "TOML"),
    // What overflows where it is computed with.
    ("period = 3 }", "period = 1e-320 }", "cut.front", "period"),
    ("scale = 1.5", "scale = 1e101", "part.crank.scale", "1e100"),
    (
        "translate = [0, 0, 0]",
        "translate = [1e155, 0, 0]",
        "part.crank.translate",
        "1e100",
    ),
    (
        "matrix = [[1, 0, 0, 0]",
        "matrix = [[9e99, 0, 0, 9e99]",
        "part.bolt",
        "once it is placed",
    ),
    ("scale = 1.5", "scale = 1e-120", "part.crank", "wide"),
    (
        "position = [0, 0, 5]",
        "position = [0, 1e155, 5]",
        "camera.position",
        "1e100",
    ),
    ("near = 0.1", "near = 1e-320", "camera.near", "at least"),
    (
        "scale = [4, 4, 0.1]",
        "scale = [1e60, 4, 0.1]",
        "cut.front",
        "repeats",
    ),
    (
        "scale = [4, 4, 0.1]",
        "scale = [4, 4, 1e60]",
        "cut.front",
        "high",
    ),
    (
        "amplitude = \"5%\"",
        "amplitude = \"1e99%\"",
        "cut.front",
        "amplitude",
    ),
];

fn solid(name: &str) -> Part {
    let mesh = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z * 1e2],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        corner_normals: None,
    };
    Part::new(name, mesh)
}

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("cutaway-hostile-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        fs::write(path.join("bolt.obj"), "no image").expect("a temporary file");
        Self(path)
    }

    fn load(&self, text: &str) -> Result<SceneFile> {
        let path = self.0.join("scene.toml");
        fs::write(&path, text).expect("a temporary file");
        let open_mesh = |_: &Path| Ok((vec![solid("bolt")], Vec::new()));
        let open_shape = |text: &str| match text {
            "crank" => Ok(vec![solid("crank")]),
            "nothing" => Ok(Vec::new()),
            _ => Err(Error::input(
                text,
                "there is no such shape",
                "did you mean `crank`?",
            )),
        };
        load_scene_file(&path, &open_mesh, &open_shape)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind in the temporary directory harms nobody.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn the_intact_scene_loads() {
    let folder = Folder::new("intact");
    let file = folder.load(INTACT).expect("the negative control");
    assert_eq!(file.scene.cuts[0].surfaces.len(), 3, "surfaces of the cut");
}

#[test]
fn one_slip_is_named_with_its_line_and_a_mend() {
    let folder = Folder::new("slips");
    for (intact, broken, culprit, told) in BROKEN {
        assert_eq!(
            INTACT.matches(intact).count().min(1),
            1,
            "{intact} is not in the scene"
        );
        let text = INTACT.replacen(intact, broken, 1);
        let Err(error) = folder.load(&text) else {
            panic!("`{broken}` was taken");
        };
        let message = error.to_string();
        for word in [*culprit, *told, "help:"] {
            assert!(
                message.contains(word),
                "`{broken}` does not tell `{word}`:\n{message}"
            );
        }
        let line = match &error {
            Error::File { line, path, .. } if path.ends_with("scene.toml") => line.is_some(),
            _ => true,
        };
        assert!(line, "`{broken}` has no line:\n{message}");
    }
}

#[test]
fn the_line_is_that_of_the_slip() {
    let folder = Folder::new("line");
    let text = INTACT.replacen("octaves = 3", "octvaes = 3", 1);
    let expected = 1 + text
        .lines()
        .position(|l| l.starts_with("octvaes"))
        .expect("the slip");
    let message = folder.load(&text).expect_err("a slip").to_string();
    assert!(
        message.contains(&format!("scene.toml:{expected}: ")),
        "line {expected}:\n{message}"
    );
}

#[test]
fn files_that_are_no_scene_are_refused() {
    let folder = Folder::new("files");
    for text in [
        "",
        "[camera]\n",
        "part = []\n",
        "part = 3\n",
        "part = [3]\n",
        "\u{0}",
        "[[part]]\n",
    ] {
        let message = folder.load(text).expect_err(text).to_string();
        assert!(
            message.contains("scene.toml") && message.contains("help:"),
            "{text:?}:\n{message}"
        );
    }
    let path = folder.0.join("latin1.toml");
    fs::write(&path, [0xE9, 0xFF]).expect("a temporary file");
    for path in [path, folder.0.join("absent.toml"), folder.0.clone()] {
        let open_mesh = |_: &Path| Ok((Vec::new(), Vec::new()));
        let error = load_scene_file(&path, &open_mesh, &|_| Ok(Vec::new())).expect_err("no scene");
        let message = error.to_string();
        let name = path.display().to_string();
        assert!(
            message.contains(&name) && message.contains("help:"),
            "{message}"
        );
    }
}

/// Every cut-off of the intact scene either loads or says why not.
#[test]
fn no_prefix_of_a_scene_panics() {
    let folder = Folder::new("prefix");
    for end in (0..INTACT.len()).step_by(7) {
        if let Err(error) = folder.load(&INTACT[..end]) {
            assert!(error.to_string().contains("help:"), "{error}");
        }
    }
}

fn unit_box() -> Bounds {
    Bounds {
        min: DVec3::ZERO,
        max: DVec3::ONE,
    }
}

#[test]
fn sections_that_make_no_sense_are_refused() {
    assert!(
        section_surface("z=10", &unit_box()).is_ok(),
        "the negative control"
    );
    for (text, told) in [
        ("", "not a number"),
        ("z", "not a number"),
        ("z=", "not a number"),
        ("z=ten", "`ten`"),
        ("z=nan", "finite"),
        ("z=1e999", "finite"),
        ("w=1", "no axis"),
        ("--z=1", "no axis"),
        ("=1", "no axis"),
        ("z=1=2", "not a number"),
        ("0,0,0,1", "zero"),
        ("0,0,0@1,2,3", "zero"),
        ("0,0,1", "3 numbers"),
        ("0,0,1,2,3", "5 numbers"),
        ("0,0,1,50%", "percentage"),
        ("0,0%,1,5", "without %"),
        ("0,1@1,2,3", "3 numbers"),
        ("0,0,1@1,2", "2 coordinates"),
        ("0,0,1@", "not a number"),
        ("1e-300,0,0,1e300", "too far"),
        ("1e-300,0,0,1e99", "too far"),
        ("0,nan,1,2", "finite"),
    ] {
        let message = section_surface(text, &unit_box())
            .expect_err(text)
            .to_string();
        let culprit = format!("section `{text}`");
        for word in [&*culprit, told, "help:", "z=10"] {
            if word == "z=10" && told == "too far" {
                continue;
            }
            assert!(
                message.contains(word),
                "`{text}` does not tell `{word}`:\n{message}"
            );
        }
    }
}

#[test]
fn reliefs_that_make_no_sense_are_refused() {
    let plane = ClipSurface::plane(DVec3::splat(0.5), DVec3::Z);
    let apply = |text: &str, bounds: Bounds| {
        ReliefSpec::parse(text).and_then(|spec| apply_relief(plane.clone(), &spec, &bounds))
    };
    assert!(
        apply("fractal:seed=3,size=8x4", unit_box()).is_ok(),
        "the negative control"
    );
    for (text, told) in [
        ("", "use one of"),
        ("fractl", "did you mean `fractal`?"),
        ("fractal:7", "fractal"),
        ("fractal:sede=7", "did you mean `seed`?"),
        ("fractal:seed=", "seed"),
        ("fractal:seed=-1", "whole number"),
        ("fractal:size=8x", "size"),
        ("fractal:size=0", "from 1"),
        ("fractal:size=1x2x3", "one or two"),
        ("fractal:octaves=99", "16"),
        ("fractal:seed=7,loud", "key=value"),
        ("fractal:amplitude=high", "not a number"),
        ("fractal:amplitude=inf", "finite"),
        ("fractal:period=0", "above 0"),
        ("fractal:period=-5%", "above 0"),
        ("fractal:period=1e-320", "period"),
        ("fractal:period=1e-320%", "period"),
        ("fractal:amplitude=1e99", "amplitude"),
        ("fractal:amplitude=1e300", "amplitude"),
        ("fractal:wrap=rpeat", "did you mean `repeat`?"),
        ("sawtooth:seed=1", "`seed`"),
        ("none.png", "cannot be read"),
        ("none.png:seed=1", "`seed`"),
        ("./none.exr", "cannot be read"),
    ] {
        let message = apply(text, unit_box()).expect_err(text).to_string();
        assert!(
            message.contains(told) && message.contains("help:"),
            "`{text}`:\n{message}"
        );
    }
    let nothing = apply("fractal", Bounds::EMPTY)
        .expect_err("a relief of nothing")
        .to_string();
    assert!(nothing.contains("help:"), "{nothing}");
}

#[test]
fn images_cut_short_are_refused() {
    let folder = Folder::new("images");
    for name in ["map.png", "map.tga", "map.exr"] {
        let path = folder.0.join(name);
        if name.ends_with("exr") {
            let pixel = |x: usize, y: usize| ((x * y) as f32, 0.0_f32, 0.0_f32);
            exr::prelude::write_rgb_file(&path, 40, 30, pixel).expect("exr");
        } else {
            let image = image::GrayImage::from_fn(40, 30, |x, y| image::Luma([(x * y) as u8]));
            image.save(&path).expect(name);
        }
        assert!(
            read_offset_map(&path).is_ok(),
            "the negative control {name}"
        );
        let whole = fs::read(&path).expect(name);
        for keep in [0, 1, 10, whole.len() / 2, whole.len() - 40] {
            fs::write(&path, &whole[..keep]).expect(name);
            let message = match read_offset_map(&path) {
                Err(error) => error.to_string(),
                Ok(map) => panic!("{keep} bytes of {name} gave {:?}", map.size),
            };
            assert!(
                message.contains(name) && message.contains("help:"),
                "{message}"
            );
        }
    }
}
