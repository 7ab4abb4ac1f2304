//! `--set`: values of a scene file from the command line.

use crate::command::cli::command::Scratch;

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
            "[camera]\nazimuth_deg = 12.5\nelevation_deg = \"auto\"\n",
        ),
        (
            "part.solid.rotate_deg=[0, 30, 0]",
            "\"cube\"\n",
            "\"cube\"\nrotate_deg = [0, 30, 0]\n",
        ),
    ] {
        assert!(SCENE.contains(from), "{from}");
        folder.write("edited.toml", SCENE.replacen(from, to, 1));
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

#[test]
fn a_camera_that_is_set_is_the_camera_of_the_options() {
    let folder = Scratch::new("set-camera");
    for (set, option) in [
        ("camera.zoom=1.2", "--camera-zoom-factor 1.2"),
        ("camera.elevation_deg=10", "--camera-elevation-angle 10"),
        ("camera.up=+Z", "--up +Z"),
    ] {
        let line = "shape:crank --section x=50%";
        let by_option = picture(&folder, &format!("{line} {option}"));
        let by_set = picture(&folder, &format!("{line} --set {set}"));
        assert!(by_set == by_option, "{set}");
    }
}

#[test]
fn names_of_cuts_and_parts_are_paths_as_they_are() {
    let folder = Scratch::new("set-names");
    let angles = "--camera-azimuth-angle 35 --camera-elevation-angle 20";
    let whole = picture(&folder, &format!("shape:crank {angles}"));
    let line = &format!("shape:crank --section x=50% {angles}");
    let cut = picture(&folder, line);
    let off = picture(
        &folder,
        &format!("{line} --set cut.x=50%.enabled=false --set part.crank.scale=1"),
    );
    assert!(off == whole && cut != whole);
    let ran = folder.run(&format!(
        "render {line} --set cut.y=50%.enabled=false -o a.png"
    ));
    assert!(ran.exits(2).stderr.contains("there is no cut `y`"));
    for set in [
        "cut.0.surfaces.0.section=x=1",
        "key.0.target=x",
        "part.0.deform.0.kind=twist",
    ] {
        let ran = folder
            .run(&format!("render shape:crank --set {set} -o a.png"))
            .exits(2);
        assert!(ran.stderr.contains("there is no `0`"), "{}", ran.stderr);
    }
}

#[test]
fn a_cut_of_the_command_line_is_not_that_of_the_file() {
    let folder = Scratch::new("set-own");
    let more = "enabled = false\n[relief.r]\nkind = \"fractal\"\nseed = 1\n";
    folder.write("scene.toml", format!("{SCENE}{more}"));
    // One that the file switches off is not taken for one without an inside.
    let cuts = "--box 0,0,0:0.5,0.5,0.5 --section z=50% --relief fractal:seed=1";
    let line = format!("render scene.toml {cuts} --set relief.r.seed=9 -o a.png --save all.toml");
    folder.run(&line).exits(0);
    let saved = std::fs::read_to_string(folder.path("all.toml")).unwrap();
    assert!(saved.contains("relief = \"fractal\""), "{saved}");
    assert!(
        saved.contains("seed = 9") && saved.contains("seed = 1"),
        "{saved}"
    );
    let empty = folder
        .run("render scene.toml --box 0,0,0:0,1,1 -o a.png")
        .exits(2);
    assert!(empty.stderr.contains("it is empty"), "{}", empty.stderr);
}

#[test]
fn a_file_with_something_else_is_replaced_by_force_alone() {
    let folder = Scratch::new("set-force");
    folder.write("mine.toml", "# By hand.\n");
    let line = "render shape:cube --section x=50% --resolution 8,6 -o a.png --save mine.toml";
    let ran = folder.run(line).exits(2);
    assert!(ran.stderr.contains("--force"), "{}", ran.stderr);
    assert_eq!(
        std::fs::read_to_string(folder.path("mine.toml")).unwrap(),
        "# By hand.\n"
    );
    folder.run(&format!("{line} --force")).exits(0);
    folder.run(line).exits(0);
}
