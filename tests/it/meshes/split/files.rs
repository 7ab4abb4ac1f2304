//! `split` in scene files: names, choices, colours, frames, and what is refused.

use super::*;

fn folder() -> Scratch {
    let folder = Scratch::new("split");
    folder.write("three.obj", three_bodies());
    folder.write("one.obj", obj(&cube(DVec3::ZERO, 1.0, false), 0));
    let [left, right] = [0.0, 5.0].map(|x| cube(DVec3::X * x, 1.0, false));
    let groups = format!(
        "o pair\n{}{}o single\n{}",
        obj(&left, 0),
        obj(&right, 8),
        obj(&cube(DVec3::Z * 9.0, 1.0, false), 16)
    );
    folder.write("groups.obj", groups);
    folder
}

fn parts(folder: &Scratch, text: &str) -> Vec<Part> {
    folder.scene(&format!("[[part]]\n{text}")).parts
}

#[test]
fn bodies_are_called_by_their_numbers() {
    let folder = folder();
    for (text, expected) in [
        ("mesh = \"three.obj\"", vec!["three"]),
        ("mesh = \"three.obj\"\nsplit = false", vec!["three"]),
        (
            "mesh = \"three.obj\"\nsplit = true",
            vec!["three/1", "three/2", "three/3"],
        ),
        (
            "name = \"drive\"\nmesh = \"three.obj\"\nsplit = true",
            vec!["drive/1", "drive/2", "drive/3"],
        ),
        (
            "name = \"drive\"\nmesh = \"groups.obj\"\nsplit = true",
            vec!["drive/pair/1", "drive/pair/2", "drive/single"],
        ),
        (
            "mesh = \"groups.obj\"\nsplit = true",
            vec!["pair/1", "pair/2", "single"],
        ),
        (
            "name = \"drive\"\nmesh = \"one.obj\"\nsplit = true",
            vec!["drive"],
        ),
        ("shape = \"cube\"\nsplit = true", vec!["cube"]),
        // Names are chosen among as they are after the split.
        (
            "mesh = \"three.obj\"\nsplit = true\nexcept = [\"three/2\"]",
            vec!["three/1", "three/3"],
        ),
        (
            "name = \"drive\"\nmesh = \"groups.obj\"\nsplit = true\nonly = [\"pair/*\"]",
            vec!["drive/pair/1", "drive/pair/2"],
        ),
        (
            "name = \"drive\"\nmesh = \"three.obj\"\nsplit = true\nonly = [\"*/3\"]",
            vec!["drive"],
        ),
    ] {
        assert_eq!(names(&parts(&folder, text)), expected, "{text}");
    }
}

#[test]
fn bodies_have_their_cavities_and_colours_by_shape() {
    let folder = folder();
    let split = parts(&folder, "mesh = \"three.obj\"\nsplit = true");
    let volumes: Vec<f64> = split.iter().map(|p| p.mesh.volume()).collect();
    for (volume, expected) in volumes.iter().zip([1.0, 1.0, 3.375 - 0.125]) {
        assert!((volume - expected).abs() < 1e-12, "{volumes:?}");
    }
    let colors: Vec<_> = split.iter().map(|p| p.material.color).collect();
    assert_eq!(colors[0], colors[1], "equal cubes are alike");
    assert_ne!(colors[1], colors[2]);
    let left = parts(
        &folder,
        "mesh = \"three.obj\"\nsplit = true\nexcept = [\"three/1\"]",
    );
    assert_ne!(left[0].material.color, left[1].material.color);
    let red = "mesh = \"three.obj\"\nsplit = true\nmaterial = { color = \"#ff0000\" }";
    let red = parts(&folder, red);
    assert!(red.iter().all(|p| p.material.color == glam::Vec3::X));
}

#[test]
fn what_was_found_is_said() {
    let folder = folder();
    let mut open = cube(DVec3::ZERO, 1.0, false);
    open.triangles.pop();
    folder.write(
        "open.obj",
        obj(&open, 0) + &obj(&cube(DVec3::X * 4.0, 1.0, false), 8),
    );
    for (mesh, said) in [
        ("three.obj", "three.obj: 3 bodies in 1 part"),
        ("groups.obj", "groups.obj: 3 bodies in 2 parts"),
        (
            "one.obj",
            "one.obj: 1 body in 1 part: there is nothing to split",
        ),
        ("open.obj", "open.obj: 2 bodies in 1 part, 1 of them open"),
    ] {
        let text = format!("[[part]]\nmesh = \"{mesh}\"\nsplit = true");
        let timeline = folder.timeline(&text);
        let notes = timeline.notes();
        let found = notes.iter().find(|n| n.to_string().ends_with(said));
        assert!(found.is_some(), "{mesh}: {notes:?}");
        let whole = folder.timeline(&text.replace("true", "false"));
        assert!(
            !whole.notes().iter().any(|n| n.to_string().contains("bod")),
            "{mesh}"
        );
    }
}

#[test]
fn frames_come_apart_as_the_first_one_does() {
    let folder = folder();
    // The cube that moves goes through the other: bodies are those of the first frame.
    for (frame, x) in [(1, 3.0), (2, 0.5)] {
        let both = [0.0, x].map(|x| cube(DVec3::X * x, 1.0, false));
        let text = obj(&both[0], 0) + &obj(&both[1], 8);
        folder.write(&format!("walk_{frame}.obj"), text);
    }
    let text = "[[part]]\nname = \"w\"\nmesh = \"walk_%d.obj\"\nfps = 1\nsplit = true";
    let timeline = folder.timeline(text);
    assert!(
        timeline
            .notes()
            .iter()
            .any(|n| n.to_string().ends_with("walk_%d.obj: 2 bodies in 1 part"))
    );
    for (time_s, x) in [(0.0, 3.0), (1.0, 0.5)] {
        let scene = timeline.at(time_s).expect("a frame");
        assert_eq!(names(&scene.parts), ["w/1", "w/2"]);
        assert_eq!(scene.parts[1].mesh.bounds().centre().x, x, "at {time_s}");
    }
    folder.write("walk_3.obj", three_bodies());
    let error = folder.load(text).expect_err("another topology").to_string();
    assert!(error.contains("walk_3.obj"), "{error}");
    assert!(error.contains("help: leave `split` out"), "{error}");
    // Frames of several solids are called by their numbers, and their bodies below these.
    for frame in 1..4 {
        std::fs::copy(
            folder.path("groups.obj"),
            folder.path(&format!("walk_{frame}.obj")),
        )
        .expect("a copy");
    }
    let scene = folder.scene(text);
    assert_eq!(names(&scene.parts), ["w/0/1", "w/0/2", "w/1"]);
}

#[test]
fn slips_are_refused_with_their_place() {
    let folder = folder();
    for (line, said) in [
        ("splt = true", "did you mean `split`"),
        ("split = 2", "part.0.split"),
        ("split = true\nonly = [\"three\"]", "did you mean `three/"),
        ("split = true\nexcept = [\"*\"]", "it leaves no solid"),
    ] {
        let text = format!("[[part]]\nmesh = \"three.obj\"\n{line}");
        let error = folder.load(&text).expect_err(line).to_string();
        assert!(error.contains(said) && error.contains("help:"), "{error}");
    }
}

#[test]
fn defects_break_bodies_one_by_one() {
    let folder = folder();
    let text =
        "mesh = \"three.obj\"\nsplit = true\ndefects = [{ kind = \"holes\", amount = \"20%\" }]";
    let broken = parts(&folder, text);
    assert_eq!(
        broken.len(),
        3,
        "holes are made in bodies, not bodies by holes"
    );
    for part in &broken {
        assert!(
            part.mesh.triangles.len() % 12 != 0,
            "{} is whole",
            part.name
        );
    }
}
