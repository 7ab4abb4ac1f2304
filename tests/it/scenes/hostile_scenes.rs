//! Promise: a scene, section or relief that makes no sense is refused by name, with its line and a mend; nothing panics.
//!
//! Every case is one change to a scene that loads, which is the negative control; `tests/it/scenes/paths.rs` goes through all keys.

use std::fs;

use cutaway::error::{Error, Result};
use cutaway::scene::{Bounds, ClipSurface, Mesh, Part};
use cutaway_io::document::{Document, Timeline, section};
use cutaway_io::load::{Assets, read_offset_map};
use glam::DVec3;

use crate::common::command;

use command::Scratch;

fn solid(name: &str) -> Part {
    let mesh = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z * 1e2],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        corner_normals: None,
        vertex_paint: None,
    };
    Part::new(name, mesh)
}

/// A scene of this text, in which the files and shapes that it names are tetrahedra.
fn load(folder: &Scratch, text: &str) -> Result<Timeline> {
    // A tetrahedron; without its last face it is open.
    let open = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    folder.write("bite.obj", format!("{open}f 2 3 4\n"));
    folder.write("open.obj", open);
    folder.write("empty.obj", "v 0 0 0\n");
    folder.write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("bolt.obj", "no image");
    let mut assets = Assets::default();
    assets.insert_mesh(folder.path("bolt.obj"), vec![solid("bolt")]);
    assets.insert_shape("crank", vec![solid("crank")]);
    assets.insert_shape("nothing", Vec::new());
    folder.load_with(text, &mut assets)
}

/// A scene that loads, and what may be changed in it: what is replaced, by what, and words that the error has to hold.
struct Table {
    scene: String,
    slips: Vec<Vec<String>>,
}

/// The tables beside this file: a comment, a scene, a line of dashes, and a slip in each line.
fn tables() -> Vec<Table> {
    let texts = [
        include_str!("hostile_scenes/general.txt"),
        include_str!("hostile_scenes/moving.txt"),
        include_str!("hostile_scenes/cuts.txt"),
        include_str!("hostile_scenes/cutters.txt"),
    ];
    let unescaped = |field: &str| field.replace("\\n", "\n").replace("\\\\", "\\");
    let table = |text: &str| {
        let (scene, slips) = text.split_once("\n----\n").expect("a scene and its slips");
        let slips = slips
            .lines()
            .map(|l| l.split(" => ").map(unescaped).collect());
        Table {
            scene: format!("{scene}\n"),
            slips: slips.collect(),
        }
    };
    texts.map(table).into()
}

#[test]
fn one_slip_is_named_with_its_line_and_a_mend() {
    let folder = Scratch::new("slips");
    let mut missed = Vec::new();
    let mut count = 0;
    for Table { scene, slips } in tables() {
        load(&folder, &scene).expect("the negative control");
        for slip in &slips {
            let [intact, broken, phrases @ ..] = slip.as_slice() else {
                panic!("{slip:?} is no slip");
            };
            assert!(scene.contains(intact), "{intact} is not in the scene");
            count += 1;
            let error = match load(&folder, &scene.replacen(intact, broken, 1)) {
                Err(Error::Missing(error)) => *error,
                Err(error) => error,
                Ok(_) => {
                    missed.push(format!("`{broken}` was taken instead of `{intact}`"));
                    continue;
                }
            };
            let message = error.to_string();
            for word in phrases.iter().map(String::as_str).chain(["help:"]) {
                if !message.contains(word) {
                    missed.push(format!("`{broken}` does not tell `{word}`:\n{message}"));
                }
            }
            let is_placed = match &error {
                Error::File { column, path, .. } => {
                    column.is_some() || !path.ends_with("scene.toml")
                }
                _ => false,
            };
            if !is_placed {
                missed.push(format!("`{broken}` has no line:\n{message}"));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n\n"));
    assert!(count > 200, "{count} slips");
}

#[test]
fn the_place_is_that_of_the_slip_or_of_what_a_key_moves() {
    let folder = Scratch::new("line");
    let all = tables();
    for (table, from, to, at) in [
        (0, "octaves = 3", "octvaes = 3", "octvaes"),
        (0, "octaves = 3", "'ü' = 3", "'ü'"),
        (0, "size = [16, 8]", "size = ['ü', 3]", "'ü', 3]"),
        (
            0,
            "surfaces = [",
            "surfaces = [{ 'ü' = 1, sectoin = 1 },",
            "'ü'",
        ),
        (
            0,
            "surfaces = [",
            "surfaces = [{ relief = 'ü', sectoin = 1 },",
            "sectoin",
        ),
        (1, "[2, 0, 0], ", "[0, 0, 0], ", "{ origin = [0, 0, 0], u"),
    ] {
        let text = all[table].scene.replacen(from, to, 1);
        let error = load(&folder, &text).expect_err("a slip");
        let Error::File {
            line: Some(line),
            column: Some(column),
            ..
        } = error
        else {
            panic!("{error} has no place");
        };
        let found = text.lines().nth(line - 1).unwrap_or_default();
        let found: String = found.chars().skip(column - 1).collect();
        assert!(found.starts_with(at), "{line}:{column}: {found}");
    }
}

#[test]
fn files_that_are_no_scene_are_refused() {
    let folder = Scratch::new("files");
    for text in [
        "",
        "[camera]\n",
        "part = []\n",
        "part = 3\n",
        "part = [3]\n",
        "\u{0}",
        "[[part]]\n",
    ] {
        let message = load(&folder, text).expect_err(text).to_string();
        assert!(
            message.contains("scene.toml") && message.contains("help:"),
            "{text:?}:\n{message}"
        );
    }
    let path = folder.path("latin1.toml");
    fs::write(&path, [0xE9, 0xFF]).expect("a temporary file");
    for path in [path, folder.path("absent.toml"), folder.path("")] {
        let error = Document::read(&path).expect_err("no scene");
        let message = error.to_string();
        let name = path.display().to_string();
        assert!(
            message.contains(&name) && message.contains("help:"),
            "{message}"
        );
    }
}

/// Every cut-off of an intact scene either loads or says why not.
#[test]
fn no_prefix_of_a_scene_panics() {
    let folder = Scratch::new("prefix");
    for Table { scene, .. } in tables() {
        for end in (0..scene.len()).step_by(7) {
            if let Err(error) = load(&folder, &scene[..end]) {
                assert!(error.to_string().contains("help:"), "{error}");
            }
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
        ClipSurface::parse("z=10", &unit_box()).is_ok(),
        "the negative control"
    );
    for (text, phrase) in [
        ("", "not a number"),
        ("z", "not a number"),
        ("z=", "not a number"),
        ("z=ten", "`ten`"),
        ("z=nan", "finite"),
        ("z=1e999", "finite"),
        ("w=1", "not an axis"),
        ("--z=1", "not an axis"),
        ("=1", "not an axis"),
        ("z=1=2", "not a number"),
        ("0,0,0,1", "zero"),
        ("0,0,0@1,2,3", "zero"),
        ("0,0,1", "has 4 numbers, not 3"),
        ("0,0,1,2,3", "not 5"),
        ("0,0,1,50%", "percentage"),
        ("0,0%,1,5", "not percentages"),
        ("0,1@1,2,3", "3 numbers"),
        ("0,0,1@1,2", "2 coordinates"),
        ("0,0,1@", "not a number"),
        ("1e-300,0,0,1e300", "too far"),
        ("1e-300,0,0,1e99", "too far"),
        ("0,nan,1,2", "finite"),
    ] {
        let message = ClipSurface::parse(text, &unit_box())
            .expect_err(text)
            .to_string();
        let culprit = format!("section `{text}`");
        for word in [&*culprit, phrase, "help:", "z=10"] {
            if word == "z=10" && phrase == "too far" {
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
    let apply = |text: &str, bounds: Bounds| section("z=0.5").relief(text).on(&bounds);
    assert!(
        apply("fractal:seed=3,size=8x4", unit_box()).is_ok(),
        "the negative control"
    );
    for (text, phrase) in [
        ("", "use one of"),
        ("fractl", "did you mean `fractal`?"),
        ("fractal:7", "fractal"),
        ("fractal:sede=7", "did you mean `seed`?"),
        ("fractal:seed=", "seed"),
        ("fractal:seed=-1", "whole number"),
        ("fractal:size=8x", "size"),
        ("fractal:size=0", "from 1"),
        ("fractal:size=1x2x3", "2 of them"),
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
            message.contains(phrase) && message.contains("help:"),
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
    let folder = Scratch::new("images");
    for name in ["map.png", "map.tga", "map.exr"] {
        let path = folder.path(name);
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
                Ok(map) => panic!("{keep} bytes of {name} gave {:?}", map.size()),
            };
            assert!(
                message.contains(name) && message.contains("help:"),
                "{message}"
            );
        }
    }
}
