//! Openings in scene files and on the command line.

use super::*;
use command::Scratch;
use serde_json::{Value, json};

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
    let idle = said(&format!(
        "render shape:earth?subdivisions=2 --section x=50% --roles whole=blot* {small}"
    ));
    assert!(
        idle.contains("no part or material has a name that matches `blot*`"),
        "{idle}"
    );
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

/// A cube of half a side so long around the origin, its corners from the number after `before`.
fn box_of(size: f64, before: u32, material: &str) -> String {
    let corners = (0..8).map(|i| {
        let [x, y, z] = [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { size } else { -size });
        format!("v {x} {y} {z}\n")
    });
    let faces = [
        "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
    ]
    .map(|face| {
        let corners = face
            .split(' ')
            .map(|i| i.parse::<u32>().expect("a number") + before);
        let corners: Vec<String> = corners.map(|i| i.to_string()).collect();
        format!("f {}\n", corners.join(" "))
    });
    let corners: String = corners.collect();
    format!(
        "o {material}_box\nusemtl {material}\n{corners}{}",
        faces.concat()
    )
}

#[test]
fn materials_of_a_file_say_roles_by_their_names_and_by_transparency() {
    let folder = Scratch::new("materials");
    let model = [box_of(1.0, 0, "steel"), box_of(3.0, 8, "window")].concat();
    folder.write("it.obj", format!("mtllib it.mtl\n{model}"));
    folder.write(
        "it.mtl",
        "newmtl steel\nKd 0.5 0.5 0.5\nnewmtl window\nd 0.3\n",
    );
    let roles = |options: &str| {
        folder
            .run(&format!("inspect it.obj --roles {options}"))
            .exits(0)
            .text()
            .to_owned()
    };
    let line = |said: &str, part: &str| {
        let line = said.lines().find(|l| l.starts_with(part));
        line.unwrap_or_else(|| panic!("{part}: {said}")).to_owned()
    };
    let seen = roles("");
    assert!(
        line(&seen, "window_box").contains("a transparent material"),
        "{seen}"
    );
    assert!(line(&seen, "steel_box").contains("interior"), "{seen}");
    folder.write(
        "scene.toml",
        "part = [{ mesh = \"it.obj\" }]\n[roles]\nwhole = [\"ste?l\"]\ninterior = [\"window\"]\n",
    );
    let said = folder
        .run("inspect scene.toml --roles")
        .exits(0)
        .text()
        .to_owned();
    assert!(line(&said, "steel_box").contains("whole"), "{said}");
    assert!(line(&said, "window_box").contains("interior"), "{said}");
}

#[test]
fn a_node_says_its_role() {
    let folder = Scratch::new("extras");
    let triangles: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let places: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let indices = triangles
        .as_flattened()
        .iter()
        .flat_map(|i| i.to_le_bytes());
    let bytes: Vec<u8> = indices
        .chain(places.as_flattened().iter().flat_map(|c| c.to_le_bytes()))
        .collect();
    folder.write("it.bin", bytes);
    let gltf = |role: &str| {
        serde_json::json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }],
            "nodes": [
                { "mesh": 0, "name": "pin", "extras": { "role": role } },
                { "mesh": 0, "name": "case", "scale": [4, 4, 4], "translation": [-1, -1, -1] },
            ],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 1 }, "indices": 0 }] }],
            "buffers": [{ "uri": "it.bin", "byteLength": 72 }],
            "bufferViews": [{ "buffer": 0, "byteLength": 24 }, { "buffer": 0, "byteOffset": 24, "byteLength": 48 }],
            "accessors": [
                { "bufferView": 0, "componentType": 5123, "count": 12, "type": "SCALAR" },
                { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1] },
            ],
        })
        .to_string()
    };
    folder.write("it.gltf", gltf("whole"));
    let said = folder
        .run("inspect it.gltf --roles")
        .exits(0)
        .text()
        .to_owned();
    let pin = said
        .lines()
        .find(|l| l.starts_with("pin"))
        .unwrap_or_default();
    assert!(pin.contains("whole") && pin.contains("the model"), "{said}");
    folder.write("it.gltf", gltf("hole"));
    let said = folder.run("inspect it.gltf --roles").exits(0).stderr;
    assert!(
        said.contains("\"hole\" is not one of exterior, interior, whole"),
        "{said}"
    );
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
    let middles = |options: &str, name: &str| -> Vec<image::Rgb<u8>> {
        let line = format!(
            "animate shape:earth?subdivisions=3 {options} --turntable=180 --frames 2 --resolution 96x72 --supersample 1 -o {name}_%d.png --json {name}.json"
        );
        folder.run(&line).exits(0);
        let files = folder.files();
        let is_picture = |f: &&String| f.starts_with(name) && f.ends_with(".png");
        let files: Vec<_> = files.iter().filter(is_picture).collect();
        assert_eq!(files.len(), 2, "{files:?}");
        let pictures = files
            .iter()
            .map(|f| image::open(folder.path(f)).expect("a picture"));
        pictures.map(|p| *p.to_rgb8().get_pixel(48, 36)).collect()
    };
    let (open, closed) = (middles("--breakaway", "open"), middles("", "closed"));
    // Of a solid nothing is read or made again for another view, and without an opening nothing of a cut either.
    for (name, later) in [
        ("open", json!(["cut", "frame"])),
        ("closed", json!(["frame"])),
    ] {
        let said: Value = {
            let text = std::fs::read_to_string(folder.path(&format!("{name}.json")));
            serde_json::from_str(&text.expect("a file")).expect("JSON")
        };
        let clocks = [0, 1].map(|i| said["frames"][i]["clocks"].clone());
        assert_eq!(clocks, [json!(["solid", "cut", "frame"]), later], "{name}");
    }
    // The crust is before the mantle in all views, unless it is opened to each.
    for (open, closed) in open.iter().zip(&closed) {
        assert!(open != closed, "{open:?} and {closed:?}");
    }
}

#[test]
fn an_opening_to_the_first_eye_is_that_of_time_0() {
    let folder = Scratch::new("first");
    let text = |view: &str, azimuth: &str| {
        format!(
            "roles = \"auto\"\npart = [{{ shape = \"earth?subdivisions=2\" }}]\ncut = [{{ breakaway = {{ view = \"{view}\" }} }}]\n\
             [camera]\nazimuth_deg = {azimuth}"
        )
    };
    let keyed = "35\n[[key]]\ntarget = \"camera.azimuth_deg\"\ntimes_s = [0, 1]\nvalues = [0, 90]";
    let opening = |text: &str, time_s: f64| {
        let scene = folder.timeline(text).at(time_s).expect("a scene");
        let cutter = scene.cuts[0].volume.as_ref().expect("an opening");
        cutter.bounds_in_world()
    };
    let of_zero = opening(&text("each", "0"), 0.0);
    for time_s in [0.0, 0.5, 1.0] {
        assert_eq!(
            opening(&text("first", keyed), time_s),
            of_zero,
            "at {time_s} s"
        );
    }
    assert!(
        opening(&text("each", keyed), 1.0) != of_zero,
        "the control follows"
    );
}
