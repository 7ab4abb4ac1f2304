//! Openings in scene files and on the command line.

use super::*;
use command::Scratch;

fn fault(text: &str) -> String {
    let folder = Scratch::new("cutaways");
    let scene = folder.load(text).and_then(|timeline| timeline.scene());
    scene.expect_err(text).to_string()
}

#[test]
fn what_cannot_be_opened_says_what_to_do() {
    for (text, phrases) in [
        (
            "part = [{ shape = \"crank\" }]\ncut = [{ breakaway = {} }]",
            &["no part is interior", "--split"][..],
        ),
        (
            "part = [{ shape = \"crank\" }]\ncut = [{ breakaway = { bevel_deg = 90 } }]",
            &["from 0 to 60"],
        ),
        (
            "part = [{ shape = \"crank\" }]\ncut = [{ breakaway = { distanc = 1 } }]",
            &["did you mean `distance`"],
        ),
        (
            "part = [{ shape = \"crank\" }]\ncut = [{ cutout = { axis = \"mian\" } }]",
            &["did you mean `main`"],
        ),
        (
            "part = [{ shape = \"crank\", role = \"interior\" }]\ncut = [{ cutout = {} }]",
            &["no exterior part"],
        ),
        (
            "roles = \"automatic\"\npart = [{ shape = \"crank\" }]",
            &["auto"],
        ),
    ] {
        let fault = fault(text);
        for phrase in phrases.iter().chain(&["help:"]) {
            assert!(fault.contains(phrase), "{phrase}: {fault}");
        }
    }
}

#[test]
fn what_is_doubtful_is_said() {
    let folder = Scratch::new("doubtful");
    let said = |line: &str| folder.run(line).exits(0).stderr;
    let small = "--resolution 32x24 --supersample 1 -o a.png";
    let even = said(&format!("render shape:cube --cutout {small}"));
    assert!(even.contains("no axis of the model stands out"), "{even}");
    let long = said(&format!("render shape:crank?detail=16 --cutout {small}"));
    assert!(!long.contains("stands out"), "the control: {long}");
    let within = "--camera-position 0.01,0,0 --camera-focal-point 1,0,0";
    let within = said(&format!(
        "render shape:earth?subdivisions=2 --breakaway {within} {small}"
    ));
    assert!(within.contains("opens nothing"), "{within}");
}

#[test]
fn roles_are_found_or_said_and_the_command_says_by_whom() {
    let folder = Scratch::new("roles");
    let by = |line: &str| folder.run(line).exits(0).text().to_owned();
    let found = by("inspect shape:earth --roles");
    for part in ["core", "mantle"] {
        let line = found
            .lines()
            .find(|l| l.starts_with(part))
            .unwrap_or_default();
        assert!(
            line.contains("interior") && line.contains("level"),
            "{found}"
        );
    }
    let json = folder
        .run("inspect shape:earth --roles --json -")
        .exits(0)
        .json();
    let roles: Vec<&str> = (json["parts"].as_array().into_iter().flatten())
        .filter_map(|p| p["role"].as_str())
        .collect();
    assert_eq!(roles, ["interior", "interior", "exterior"]);
    folder.write(
        "scene.toml",
        "part = [{ shape = \"earth\" }]\n[roles]\nwhole = [\"core\"]\ninterior = [\"mant*\"]\n",
    );
    let said = by("inspect scene.toml --roles");
    for (part, role) in [
        ("core", "whole"),
        ("mantle", "interior"),
        ("crust", "exterior"),
    ] {
        let line = said
            .lines()
            .find(|l| l.starts_with(part))
            .unwrap_or_default();
        assert!(line.contains(role), "{said}");
    }
}

#[test]
fn an_opening_follows_the_camera_and_a_cutout_stays() {
    let folder = Scratch::new("turning");
    folder.write(
        "scene.toml",
        "roles = \"auto\"\npart = [{ shape = \"earth\" }]\n\
         cut = [{ name = \"out\", applies_to = [\"crust\"], cutout = { angle_deg = 20 } }, { name = \"away\", breakaway = {} }]\n\
         [camera]\nazimuth_deg = 0\n[[key]]\ntarget = \"camera.azimuth_deg\"\ntimes_s = [0, 1]\nvalues = [0, 90]",
    );
    let timeline =
        folder.timeline(&std::fs::read_to_string(folder.path("scene.toml")).expect("it"));
    let at = |time_s: f64| timeline.at(time_s).expect("a scene");
    let (first, last) = (at(0.0), at(1.0));
    let normals = |scene: &Scene| -> Vec<DVec3> {
        let out = scene.cuts.iter().filter(|c| c.name == "out");
        out.flat_map(|c| c.surfaces.iter().map(|s| s.frame().normal))
            .collect()
    };
    assert!(!normals(&first).is_empty() && normals(&first) == normals(&last));
    let opening = |scene: &Scene| {
        let away = scene.cuts.iter().find(|c| c.name == "away");
        let cutter = away.and_then(|c| c.volume.as_ref()).expect("an opening");
        cutter.bounds_in_world()
    };
    assert!(opening(&first) != opening(&last), "it follows the camera");
}

#[test]
fn a_turntable_opens_to_each_of_its_views() {
    let folder = Scratch::new("turntable");
    let line = "animate shape:earth --breakaway --turntable=180 --frames 2 --resolution 96x72 --supersample 1 -o f_%d.png";
    folder.run(line).exits(0);
    let frames = folder.files();
    assert_eq!(frames.len(), 2, "{frames:?}");
    for frame in frames {
        let picture = image::open(folder.path(&frame))
            .expect("a picture")
            .to_rgb8();
        // The core is in the middle of both: the crust has another colour.
        let middle = picture.get_pixel(48, 36);
        let border = picture.get_pixel(48, 8);
        assert!(middle != border, "frame {frame}: {middle:?} and {border:?}");
    }
}
