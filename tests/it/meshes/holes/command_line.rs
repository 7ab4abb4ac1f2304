//! `--close-holes`: what it does to the parts of the command line and of a scene file, and what it says.

use super::*;

/// A cube without one of its sides, and one that is whole.
fn folder() -> Scratch {
    let folder = Scratch::new("holes");
    let obj = |mesh: &Mesh| {
        let vertices = mesh.positions.iter();
        let mut text: String = vertices
            .map(|p| format!("v {} {} {}\n", p.x, p.y, p.z))
            .collect();
        for [a, b, c] in &mesh.triangles {
            text.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1));
        }
        text
    };
    let mut open = cube(2);
    folder.write("whole.obj", obj(&open));
    open.triangles.truncate(40);
    folder.write("open.obj", obj(&open));
    folder.write(
        "scene.toml",
        "[[part]]\nname = \"box\"\nmesh = \"open.obj\"\n",
    );
    folder
}

#[test]
fn the_option_is_the_key_of_all_parts() {
    let folder = folder();
    let total = |line: &str| folder.run(line).exits(0).json()["total"].clone();
    for (line, closed, faces, volume) in [
        ("inspect open.obj --json -", false, 40, None),
        (
            "inspect open.obj --close-holes --json -",
            true,
            46,
            Some(1.0),
        ),
        (
            "inspect scene.toml --close-holes --json -",
            true,
            46,
            Some(1.0),
        ),
        (
            "inspect scene.toml --set part.box.close_holes=true --json -",
            true,
            46,
            Some(1.0),
        ),
        (
            "inspect scene.toml --close-holes --set part.box.close_holes=false --json -",
            false,
            40,
            None,
        ),
        (
            "inspect whole.obj --close-holes --json -",
            true,
            48,
            Some(1.0),
        ),
        (
            "inspect open.obj whole.obj --close-holes --json -",
            true,
            94,
            Some(2.0),
        ),
        (
            "inspect whole.obj --defect open:axis=z,amount=40% --close-holes --json -",
            true,
            0,
            None,
        ),
    ] {
        let facts = total(line);
        assert_eq!(facts["closed"], closed, "{line}: {facts}");
        if faces > 0 {
            assert_eq!(facts["faces"], faces, "{line}: {facts}");
        }
        if let Some(volume) = volume {
            let found = facts["volume"].as_f64().expect("a volume");
            assert!((found - volume).abs() < 1e-9, "{line}: {facts}");
        }
    }
}

#[test]
fn every_command_that_takes_meshes_takes_it_and_says_what_it_did() {
    let folder = folder();
    for line in [
        "render open.obj --close-holes --section z=50% --resolution 64,48 -o a.png",
        "compare open.obj --close-holes --section z=50% --resolution 64,48 --strategies raycast+mask",
        "plan open.obj --close-holes --section z=50%",
        "section open.obj --close-holes --section y=30% --json -",
        "export open.obj --close-holes --section y=30% -o half.stl",
        "inspect open.obj --close-holes",
        "animate open.obj --close-holes --section z=50% --turntable --frames 2 --resolution 64,48 -o %d.png",
    ] {
        let said = folder.run(line).exits(0).stderr;
        let note = "open: closed 1 of 1 hole with 6 triangles: 8 edges, 4 around, at 0.5,0.5,1";
        assert!(said.contains(note), "{line}: {said}");
        assert!(!said.contains("is open at"), "{line}: {said}");
    }
    // The control: without it the mesh is open, which is said.
    let said = folder.run("plan open.obj --section z=50%").exits(0).stderr;
    assert!(said.contains("is open at 8 edges"), "{said}");
    let half = folder.run("inspect half.stl --json -").exits(0).json();
    assert_eq!(half["total"]["closed"], true, "{half}");
}

#[test]
fn what_is_saved_closes_them_again() {
    let folder = folder();
    folder
        .run("plan open.obj --close-holes --section z=50% --save kept.toml")
        .exits(0);
    let kept = std::fs::read_to_string(folder.path("kept.toml")).expect("a file");
    assert!(kept.contains("close_holes = true"), "{kept}");
    let facts = folder.run("inspect kept.toml --json -").exits(0).json();
    assert_eq!(facts["total"]["closed"], true, "{facts}");
}

#[test]
fn what_stays_open_is_said_with_the_reason() {
    let folder = Scratch::new("holes");
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    folder.write("sheet.obj", sheet);
    let said = folder
        .run("inspect sheet.obj --close-holes")
        .exits(0)
        .stderr;
    let note = "sheet: closed 0 of 1 hole with 0 triangles; left open, the filling would lie on the mesh itself: 4 edges, 4 around, at 0.5,0.5,0";
    assert!(said.contains(note), "{said}");
}
