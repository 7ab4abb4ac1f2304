//! Cutters in scene files and on the command line, and what is refused at the door.

use cutaway::scene::{Cutter, Mesh, Part};
use glam::DVec3;

use super::command::Scratch;
use super::common::meshes::{block, shape};

const INTACT: &str = r#"
[[part]]
shape = "cube"
[[cut]]
name = "bite"
volume = "bite.obj"
translate = [1, 0, 0]
rotate_deg = [0, 0, 90]
scale = 2
flip = true
"#;

/// A tetrahedron; without its last face it is open.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
const LAST_FACE: &str = "f 2 3 4\n";

fn folder(name: &str) -> Scratch {
    let folder = Scratch::new(name);
    folder.write("bite.obj", format!("{TETRAHEDRON}{LAST_FACE}"));
    folder.write("open.obj", TETRAHEDRON);
    folder.write("empty.obj", "v 0 0 0\n");
    folder.write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder
}

#[test]
fn a_cutter_is_placed_as_parts_are() {
    let file = folder("placed").load(INTACT).expect("a scene that loads");
    let cut = &file.rest().cuts[0];
    assert!(cut.surfaces.is_empty(), "it stands alone");
    let cutter = cut.volume.as_ref().expect("the cutter");
    assert_eq!(cutter.name(), "bite.obj");
    assert!(cutter.keeps_inside, "flipped");
    let x = cutter.world_from_cutter.transform_point3(DVec3::X);
    assert!(
        (x - DVec3::new(1.0, 2.0, 0.0)).length() < 1e-12,
        "scaled, turned, moved: {x}"
    );
    let bounds = cutter.bounds_in_world();
    assert!((bounds.size() - DVec3::splat(2.0)).length() < 1e-12);
    // With clip-surfaces it is one more of them.
    let text = INTACT.replace("flip = true", "surfaces = [{ section = \"z=50%\" }]");
    let file = folder("with-surfaces")
        .load(&text)
        .expect("a scene that loads");
    let cut = &file.rest().cuts[0];
    assert_eq!((cut.surfaces.len(), cut.volume.is_some()), (1, true));
}

#[test]
fn a_mesh_that_is_not_closed_is_no_cutter() {
    let cube = block(DVec3::ZERO, DVec3::ONE);
    assert!(Cutter::new("cube", cube.clone()).is_ok(), "a closed one is");
    let mut open = cube.clone();
    open.triangles.pop();
    let mut of_nothing = cube.clone();
    of_nothing.triangles.clear();
    let mut wild = cube.clone();
    wild.positions[0].x = f64::NAN;
    let mut lost = cube;
    lost.triangles[0][0] = 99;
    for (mesh, phrase) in [
        (open, "3 edges"),
        (of_nothing, "no triangles"),
        (wild, "NaN"),
        (lost, "vertex 99"),
        (Mesh::default(), "no triangles"),
    ] {
        let message = Cutter::new("it", mesh).expect_err(phrase).to_string();
        assert!(
            message.contains(phrase) && message.contains("help:"),
            "{message}"
        );
    }
    // Twice the same edge is no hole: parity asks for no manifold.
    let twice = super::common::meshes::joined(&[shape("cube"), shape("cube")]);
    assert!(Cutter::new("twice", twice).is_ok());
    assert!(
        Cutter::from_parts("none", &[] as &[Part]).is_err(),
        "no part, no cutter"
    );
}

#[test]
fn keys_move_it_and_only_its_numbers() {
    let folder = folder("keys");
    let keyed = |target: &str, values: &str| {
        format!("{INTACT}\n[[key]]\ntarget = \"{target}\"\ntimes_s = [0, 2]\nvalues = {values}\n")
    };
    let timeline = folder.timeline(&keyed("cut.bite.translate", "[[0, 0, 0], [4, 0, 0]]"));
    let at = |t: f64| {
        let scene = timeline.at(t).expect("a time");
        scene.cuts[0].volume.clone().expect("the cutter")
    };
    let [begin, middle] = [0.0, 1.0].map(at);
    assert_eq!(middle.world_from_cutter.translation.x, 2.0);
    assert!(
        std::sync::Arc::ptr_eq(begin.mesh(), middle.mesh()),
        "the mesh is opened once"
    );
    assert!(
        folder.load(&keyed("cut.bite.volume", "[0, 1]")).is_err(),
        "a text stays"
    );
    let message = folder.load(&keyed("cut.bite.scale", "[1, -1]"));
    let message = message.expect_err("a scale of 0 on the way").to_string();
    assert!(message.contains("cut.bite.scale"), "{message}");
}

#[test]
fn the_command_line_takes_a_cutter() {
    let folder = folder("cli");
    let ran = folder.run("plan shape:cube --cutter bite.obj");
    assert!(ran.text().contains("  cutter  [draw"), "{}", ran.text());
    let ran = folder.run("plan shape:cube --cutter open.obj");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("a cutter must be closed"),
        "{}",
        ran.stderr
    );
    let ran = folder.run("plan shape:cube --cutter shape:sphere?radius=0.1 --exclude cube");
    assert!(
        !ran.text().contains("  cutter  [draw"),
        "spared: {}",
        ran.text()
    );
    folder.write(
        "far.toml",
        "[[part]]\nshape = \"cube\"\n[[cut]]\nvolume = \"bite.obj\"\ntranslate = [9, 9, 9]\n",
    );
    let ran = folder.run("plan far.toml");
    assert!(ran.stderr.contains("misses the model"), "{}", ran.stderr);
    let far = std::fs::read_to_string(folder.path("far.toml")).expect("it was written");
    folder.write("off.toml", format!("{far}enabled = false\n"));
    let ran = folder.run("plan off.toml");
    assert!(!ran.stderr.contains("misses the model"), "{}", ran.stderr);

    let huge = format!("{TETRAHEDRON}{LAST_FACE}").replace("v 0 0 1\n", "v 0 0 1e40\n");
    folder.write("huge.obj", &huge);
    let ran = folder.run("plan shape:cube --cutter huge.obj");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("radii of the model"), "{}", ran.stderr);
}
