//! `--set`: values of a scene file from the command line.

use crate::command::Scratch;

const SCENE: &str = "\
# Kept.
[[part]]
name = \"solid\"
shape = \"cube\"

[[cut]]
name = \"front\"
surfaces = [{ section = \"-z=50%\" }] # the half
";

fn picture(folder: &Scratch, line: &str) -> Vec<u8> {
    let line = format!("render {line} --resolution 64,48 --supersample 1 -o out.png");
    folder.run(&line).exits(0);
    std::fs::read(folder.path("out.png")).unwrap()
}

#[test]
fn what_is_set_is_what_the_file_could_say() {
    let folder = Scratch::new("set");
    folder.write("scene.toml", SCENE);
    let as_it_stands = picture(&folder, "scene.toml");
    for (set, from, to) in [
        ("cut.front.surfaces.0.section=-z=75%", "-z=50%", "-z=75%"),
        (
            "part.solid.shape=sphere?subdivisions=2",
            "cube",
            "sphere?subdivisions=2",
        ),
        (
            "part.0.material.color=#f00",
            "\"cube\"\n",
            "\"cube\"\nmaterial = { color = \"#f00\" }\n",
        ),
        (
            "cut.front.enabled=false",
            "\"front\"\n",
            "\"front\"\nenabled = false\n",
        ),
        (
            "camera.azimuth_deg=12.5",
            "# Kept.\n",
            "[camera]\nazimuth_deg = 12.5\n",
        ),
        (
            "part.solid.rotate_deg=[0, 30, 0]",
            "\"cube\"\n",
            "\"cube\"\nrotate_deg = [0, 30, 0]\n",
        ),
    ] {
        assert!(SCENE.contains(from), "{from}");
        folder.write("edited.toml", &SCENE.replacen(from, to, 1));
        let edited = picture(&folder, "edited.toml");
        // Without blanks, for lines are split at them.
        let set = picture(
            &folder,
            &format!("scene.toml --set {}", set.replace(' ', "")),
        );
        assert_eq!(set, edited, "{to}");
        assert_ne!(set, as_it_stands, "the control: {to} is seen");
    }
    let file = std::fs::read_to_string(folder.path("scene.toml")).unwrap();
    assert_eq!(file, SCENE, "the file stays as it is");
    let twice = "scene.toml --set camera.azimuth_deg=0 --set camera.azimuth_deg=12.5";
    let once = "scene.toml --set camera.azimuth_deg=12.5";
    assert_eq!(
        picture(&folder, twice),
        picture(&folder, once),
        "the last counts"
    );
}

#[test]
fn what_cannot_be_set_is_refused_by_its_path() {
    let folder = Scratch::new("unset");
    folder.write("scene.toml", SCENE);
    for (line, told) in [
        (
            "scene.toml --set cut.frnt.enabled=false",
            "did you mean `front`",
        ),
        ("scene.toml --set camera.naer=1", "did you mean `near`"),
        (
            "scene.toml --set camera.near=-1",
            "`camera.near`: it must be a number above 0",
        ),
        (
            "scene.toml --set camera.near=close",
            "is the text \"close\"",
        ),
        ("scene.toml --set camra.near=1", "did you mean `camera`"),
        (
            "scene.toml --set cut.front.surfaces.3.flip=true",
            "there is no `3` in `cut.front.surfaces`",
        ),
        ("scene.toml --set camera.near", "a path and a value"),
        ("scene.toml --set =1", "a path and a value"),
        ("scene.toml --set camera..near=1", "names no value"),
        (
            "shape:cube --set camera.near=1",
            "no scene file to set it in",
        ),
    ] {
        let ran = folder.run(&format!("render {line} -o out.png")).exits(2);
        assert!(ran.stderr.contains(told), "{line}: {}", ran.stderr);
        assert!(ran.stderr.contains("help:"), "{line}: {}", ran.stderr);
    }
    assert_eq!(folder.files(), ["scene.toml"], "nothing is written");
}

#[test]
fn every_command_that_reads_a_scene_takes_settings() {
    let folder = Scratch::new("settings");
    folder.write("scene.toml", SCENE);
    let area = |line: &str| {
        let json = folder
            .run(&format!("section scene.toml {line} --json -"))
            .exits(0)
            .json();
        json["sections"][0]["area"]
            .as_f64()
            .unwrap_or_else(|| panic!("{json}"))
    };
    assert!((area("") - 1.0).abs() < 1e-9, "of a unit cube");
    let set = "--set part.solid.scale=2";
    assert!((area(set) - 4.0).abs() < 1e-9, "of one twice as large");
    let volume = |line: &str| {
        let json = folder
            .run(&format!("inspect scene.toml {line} --json -"))
            .exits(0)
            .json();
        json["total"]["volume"]
            .as_f64()
            .unwrap_or_else(|| panic!("{json}"))
    };
    assert!((volume("") - 1.0).abs() < 1e-6);
    assert!((volume(set) - 8.0).abs() < 1e-6);
    folder.run(&format!("plan scene.toml {set}")).exits(0);
    folder
        .run(&format!(
            "compare scene.toml {set} --strategies stencil --rounds 1 --resolution 32,24"
        ))
        .exits(0);
}
