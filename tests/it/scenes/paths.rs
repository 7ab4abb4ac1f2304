//! Promise: every value that a scene can hold is in the table of paths, can be set, is read back as it was, and reaches its reader; and
//! what the table says can move can.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use cutaway::scene::{OffsetMap, Texture, TextureKind};
use cutaway_io::document::paths::{self, Path, ValueType};
use cutaway_io::document::{Document, Node, Value};
use cutaway_io::load::{Assets, Loaded};

use crate::common::command;

/// A scene with an entry of everything that has entries.
const SCENE: &str = r#"
[[part]]
name = "p"
mesh = "p.obj"
defects = [{ kind = "holes" }]
deform = [{ kind = "twist" , turn_deg = 0 }]

[relief.a]
kind = "fractal"
size = [8, 8]

[relief.b]
kind = "waves"
size = [8, 8]

[relief.r]
kind = "fractal"
size = [8, 8]

[[cut]]
name = "c"
surfaces = [{ section = "z=50%", relief = "r" }]

[[key]]
target = "camera.near"
times_s = [0, 1]
values = [1, 2]

[camera]
near = 1
"#;

/// What has to be there besides for a value to mean something: values by their paths, none of which takes a path away.
fn besides(path: &str) -> Vec<(&'static str, &'static str)> {
    let last = path.rsplit('.').next().unwrap();
    let of = |start: &str| path.starts_with(start);
    let relief = |kind| ("relief.r", kind);
    match path {
        "camera.focal_point" | "camera.view_up" => vec![("camera.position", "[0.3, 0, 9]")],
        "camera.height" => vec![("camera.projection", "orthographic")],
        "part.*.shape" => vec![("part.p.mesh", "")],
        "part.*.mesh" => vec![],
        "part.*.except" => vec![("part.p.mesh", "crank.obj")],
        _ if of("part.*.defects") => match last {
            "charts" => vec![("part.p.defects.0.kind", "gaps")],
            "copies" => vec![("part.p.defects.0.kind", "overlap")],
            "axis" => vec![("part.p.defects.0.kind", "open")],
            _ => vec![],
        },
        _ if of("part.*.deform") => match last {
            "amplitude" | "period" | "phase_deg" => {
                vec![("part.p.deform.0", "{ kind = \"wave\", amplitude = 0.1 }")]
            }
            "by" => vec![("part.p.deform.0", "{ kind = \"inflate\", by = 0.1 }")],
            "across" => vec![("part.p.deform.0.axis", "y")],
            _ => vec![],
        },
        "style.hatch.least" => vec![("style.hatch.most", "1000")],
        "style.hatch.most" => vec![("style.hatch.least", "0.1")],
        "part.*.fps" | "part.*.first" | "part.*.loop" => vec![("part.p.mesh", "frame_%d.obj")],
        _ if of("relief.*") => match last {
            "seed" | "octaves" | "gain" | "cells" | "kind" | "size" => vec![],
            "count" => vec![relief("{ kind = \"waves\", size = 8 }")],
            "width" => vec![relief("{ kind = \"cracks\", size = 8 }")],
            "levels" => vec![relief("{ kind = \"steps\", size = 8 }")],
            "value" => vec![relief("{ kind = \"constant\" }")],
            "image" => vec![relief("{ kind = \"image\" }")],
            "blend" => vec![relief("{ kind = \"blend\", op = \"add\" }")],
            "op" | "share" => vec![relief("{ blend = [\"a\", \"b\"], op = \"mix\" }")],
            "heights" => vec![relief("{ kind = \"profile\" }")],
            "of" => vec![relief("{ kind = \"layers\" }")],
            "images" | "first" => vec![relief("{ kind = \"layers\", images = \"l_%d.png\" }")],
            _ => vec![relief("{ kind = \"layers\", of = [\"a\", \"b\"] }")],
        },
        _ if of("cut.*.surfaces") => match last {
            "normal" => vec![("cut.c.surfaces.0", "{ origin = [0, 0, 0] }")],
            "origin" => vec![("cut.c.surfaces.0", "{ normal = [0, 0, 1] }")],
            "u" | "v" | "scale" => {
                vec![("cut.c.surfaces.0", "{ u = [1, 0, 0], v = [0, 1, 0] }")]
            }
            "relief" => vec![("relief.ragged", "{ kind = \"fractal\", size = 8 }")],
            _ => vec![],
        },
        _ if of("cut.*.box") => {
            let ragged = ("relief.ragged", "{ kind = \"fractal\", size = 8 }");
            let corners = "{ min = [0, 0, 0], max = [1, 1, 1], relief = \"ragged\" }";
            match last {
                "centre" | "size" => vec![("cut.c.box", "{ size = 1 }")],
                _ => vec![ragged, ("cut.c.box", corners)],
            }
        }
        _ if of("cut.*.wedge") => {
            let ragged = ("relief.ragged", "{ kind = \"fractal\", size = 8 }");
            let wedge = "{ axis = \"z\", from_deg = 0, to_deg = 80, relief = \"ragged\" }";
            vec![ragged, ("cut.c.wedge", wedge)]
        }
        _ if of("cut.*.cutout") => {
            let ragged = ("relief.ragged", "{ kind = \"fractal\", size = 8 }");
            vec![
                ragged,
                ("cut.c.cutout", "{ angle_deg = 80, relief = \"ragged\" }"),
            ]
        }
        _ if of("cut.*.breakaway") => {
            vec![("part.p.role", "interior"), ("cut.c.breakaway", "{}")]
        }
        "cut.*.translate" | "cut.*.rotate_deg" | "cut.*.scale" | "cut.*.pivot" | "cut.*.matrix"
        | "cut.*.flip" => vec![("cut.c.volume", "shape:sphere")],
        "key.*.interpolation" => vec![],
        "key.*.target" => vec![("camera.azimuth_deg", "1")],
        "key.*.values" => vec![],
        _ => vec![],
    }
}

/// A path of the scene.
fn of_scene(path: &str) -> String {
    for (pattern, entry) in [
        ("part.*.", "part.0."),
        ("relief.*.", "relief.r."),
        ("cut.*.offset.*", "cut.0.offset.p"),
        ("cut.*.", "cut.0."),
        ("key.*.", "key.0."),
    ] {
        if let Some(rest) = path.strip_prefix(pattern) {
            return format!("{entry}{rest}").replace('*', "0");
        }
    }
    path.to_owned()
}

/// The scene with a value, and with what that needs.
fn with(path: &Path, value: &Value) -> Document {
    let mut document = Document::parse("scene.toml", SCENE).unwrap();
    for (path, text) in besides(&path.path) {
        match text {
            "" => document.remove(path).unwrap(),
            text => document.set(path, Value::read(text)).unwrap(),
        }
    }
    let at = of_scene(&path.path);
    document
        .set(&at, value.clone())
        .unwrap_or_else(|e| panic!("{at}: {e}"));
    document
}

fn assets() -> Assets {
    let cube = || cutaway::generate::shapes::shape("cube").unwrap();
    let mut several = cube();
    for (name, x) in [("gear 1", 2.0), ("bolt 2", 4.0)] {
        let mut part = cube().remove(0);
        part.name = name.to_owned();
        part.world_from_part.translation.x = x;
        several.push(part);
    }
    let mut assets = Assets::default();
    assets.insert_mesh("p.obj", cube());
    assets.insert_mesh("crank.obj", Loaded::from(several));
    let map = |value: f32| OffsetMap::new([2, 2], vec![0.0, value, 0.5, 1.0]).unwrap();
    assets.insert_image("rock.png", map(0.5));
    for name in ["rust.png", "grain.png", "soft.png"] {
        let texels = vec![[200, 90, 30, 255]; 4];
        let texture = Texture::new([2, 2], texels, TextureKind::Color).unwrap();
        assets.insert_texture(name, texture);
    }
    assets
}

/// Names that examples have and this scene has not.
fn fits(path: &Path, value: Value) -> Value {
    match path.path.as_str() {
        "part.*.mesh" => "crank.obj".into(),
        "part.*.only" => Value::read("[\"cube\"]"),
        "part.*.except" => Value::read("[\"gear*\"]"),
        "cut.*.except" => Value::read("[\"p*\"]"),
        "key.*.values" => Value::read("[0.5, 1]"),
        _ => value,
    }
}

#[test]
fn what_is_set_is_read_back_as_it_was() {
    for path in paths::all() {
        let value = Value::read(path.example);
        let document = with(path, &value);
        let saved = document.to_string();
        let again = Document::parse("scene.toml", &saved);
        let again = again.unwrap_or_else(|e| panic!("{}: {e}\n{saved}", path.path));
        let at = of_scene(&path.path);
        assert_eq!(again.get(&at).unwrap().value, value, "{at}: {saved}");
        assert_eq!(again, document, "{at}: {saved}");
        document
            .check(&Assets::default())
            .unwrap_or_else(|e| match path.path.as_str() {
                // Files that are not there.
                "part.*.mesh" | "part.*.fps" | "part.*.first" | "part.*.loop" => {}
                _ if e.to_string().contains("there is no file") => {}
                _ => panic!("{at}: {e}"),
            });
    }
}

#[test]
fn every_choice_of_a_file_and_every_number_reaches_its_reader() {
    for path in paths::all() {
        // Files and clips that nobody has here.
        let is_elsewhere =
            ["images", "first", "clip", "fps", "loop"].map(|k| path.path.ends_with(k));
        if is_elsewhere.contains(&true) {
            continue;
        }
        let mut values = vec![fits(path, Value::read(path.example))];
        if let ValueType::Choice(words) = path.takes {
            values.extend(words.iter().map(|w| Value::from(*w)));
        }
        for value in values {
            let document = with(path, &value);
            let at = of_scene(&path.path);
            let message = match document.timeline(&mut assets()) {
                Ok(_) => continue,
                Err(e) => e.to_string(),
            };
            // A kind alone lacks what other kinds need.
            let is_kind = path.path.ends_with("kind");
            let lacks = [
                "it has no",
                "there is no such key",
                "no source of heights",
                "no layers",
            ];
            let is_lack = is_kind && lacks.iter().any(|l| message.contains(l));
            assert!(is_lack, "{at} = {value:?}: {message}\n{document}");
        }
    }
}

/// Values that no key of a type takes; none of the types that take any text.
fn wrong(takes: ValueType) -> &'static [&'static str] {
    match takes {
        ValueType::Or(one, _) => wrong(*one),
        ValueType::Number(least, _) if least >= 0.0 => &["-1", "\"much\"", "[1, 2]"],
        ValueType::Number(..) => &["\"much\"", "[1, 2]"],
        ValueType::Whole(..) => &["0.5", "\"much\""],
        ValueType::Numbers(..) | ValueType::Wholes(..) => {
            &["[1, 2, 3, 4, 5]", "\"much\"", "[\"a\", \"b\", \"c\"]"]
        }
        ValueType::Amount(..) => &["\"much\"", "true"],
        ValueType::Amounts => &["[1, 2]", "\"much\""],
        ValueType::OneOrMore(..) => &["\"much\"", "[1, 2, 3, 4]"],
        ValueType::Flag => &["1", "\"yes\""],
        ValueType::Choice(_) | ValueType::Color => &["\"qqq\"", "1"],
        ValueType::Texts => &["\"one\"", "1"],
        ValueType::Name => &["0.5", "[1]"],
        ValueType::File | ValueType::Text | ValueType::Table | ValueType::Other => &[],
    }
}

#[test]
fn what_is_out_of_range_or_of_another_kind_is_refused_by_its_path() {
    for path in paths::all() {
        let at = of_scene(&path.path);
        for wrong in wrong(path.takes) {
            let document = with(path, &Value::read(wrong));
            let message = document
                .timeline(&mut assets())
                .err()
                .map(|e| e.to_string());
            // Values of frames are read where there are frames.
            let is_frames = ["fps", "loop", "first"].iter().any(|k| at.ends_with(k));
            if is_frames {
                continue;
            }
            let message = message.unwrap_or_else(|| panic!("{at} = {wrong} was taken\n{document}"));
            assert!(message.contains("help:"), "{at} = {wrong}: {message}");
        }
    }
}

#[test]
fn what_can_move_moves_and_what_cannot_is_refused() {
    for path in paths::all() {
        let at = of_scene(&path.path);
        let example = fits(path, Value::read(path.example));
        let is_movable = |value: &Value| match value {
            Value::Number(_) | Value::Flag(_) => true,
            Value::List(list) => {
                let all = list.iter();
                all.map(|n| &n.value)
                    .all(|v| matches!(v, Value::Number(_) | Value::List(_)))
            }
            _ => false,
        };
        if !is_movable(&example) || path.path.starts_with("key.") {
            continue;
        }
        let mut document = with(path, &example);
        document.set("key.0.target", at.as_str()).unwrap();
        document
            .set(
                "key.0.values",
                Value::List(vec![Node::new(example.clone()), Node::new(example.clone())]),
            )
            .unwrap();
        let found = document.timeline(&mut assets());
        match (path.moves, found) {
            (true, Err(e)) => panic!("{at} does not move: {e}\n{document}"),
            (false, Ok(_)) => panic!("{at} moves"),
            _ => {}
        }
    }
}

/// Numbers at the ends of a range and just beyond, where these ends are finite.
fn ends(takes: ValueType) -> Vec<(Value, bool)> {
    let Some((least, most)) = takes.range() else {
        return Vec::new();
    };
    if let ValueType::Or(one, _) = takes {
        return ends(*one);
    }
    if let ValueType::OneOrMore(one, count) = takes {
        // One at its end and the others small: the product may have a limit of its own.
        let small = Node::new(least.max(1.0) as i64);
        let list = |value: Value| {
            let first = std::iter::once(Node::new(value));
            Value::List(first.chain(vec![small.clone(); count - 1]).collect())
        };
        let all = ends(*one).into_iter();
        return all.map(|(value, fits)| (list(value), fits)).collect();
    }
    let is_whole = matches!(takes, ValueType::Whole(..) | ValueType::Wholes(..));
    let count = match takes {
        ValueType::Numbers(count, ..) | ValueType::Wholes(count, ..) => Some(count),
        _ => None,
    };
    let value = |number: f64| {
        let one = match is_whole {
            true => Value::from(number as i64),
            false => number.into(),
        };
        match count {
            Some(count) => Value::List(vec![Node::new(one); count]),
            None => one,
        }
    };
    // Styles are in f32: a step beyond an end is one that does not round back to it.
    let step = |end: f64| {
        if is_whole {
            1.0
        } else {
            (end.abs() * 1e-6).max(1e-6)
        }
    };
    // What is above 0 is not tried at its end: lengths are held against the model too.
    let below = match least {
        least if least > 0.0 && least < 1e-9 => [(1e-6, true), (0.0, false)],
        least => [(least, true), (least - step(least), false)],
    };
    let above = [(most, true), (most + step(most), false)];
    let all = below.into_iter().chain(above);
    let finite = all.filter(|(number, _)| number.is_finite() && number.abs() < 9e15);
    finite.map(|(number, fits)| (value(number), fits)).collect()
}

#[test]
fn published_ranges_are_those_that_are_checked() {
    let mut probed = 0;
    let mut wrong = Vec::new();
    for path in paths::all() {
        let at = of_scene(&path.path);
        for (value, fits) in ends(path.takes) {
            let document = with(path, &value);
            let found = document.timeline(&mut assets());
            let is_frames = ["fps", "loop", "first"].iter().any(|k| at.ends_with(k));
            if is_frames {
                continue;
            }
            probed += 1;
            match (fits, &found) {
                (true, Err(e)) => {
                    wrong.push(format!("{at}, {}: {value:?} is refused: {e}", path.takes))
                }
                (false, Ok(_)) => wrong.push(format!("{at}, {}: {value:?} is taken", path.takes)),
                _ => {}
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(probed > 150, "{probed} numbers");
}

#[test]
fn the_command_checks_the_published_ranges() {
    let folder = command::Scratch::new("ranges");
    let mut probed = 0;
    let styles = paths::all().iter().filter(|p| p.path.starts_with("style."));
    // Both limits of hatch lines are held against each other.
    for path in styles.filter(|p| !p.path.contains("hatch")).step_by(6) {
        for (value, fits) in ends(path.takes) {
            let line = format!("inspect shape:cube --set {}={value}", path.path);
            let ran = folder.run(&line);
            probed += 1;
            if fits {
                ran.exits(0);
            } else {
                ran.exits(2);
            }
        }
    }
    assert!(probed > 10, "{probed} numbers");
}
