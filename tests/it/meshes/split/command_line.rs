//! `--split`: what it does to the parts of the command line and of a scene file.

use super::*;

fn folder() -> Scratch {
    let folder = Scratch::new("split-option");
    folder.write("three.obj", three_bodies());
    folder.write(
        "scene.toml",
        "[[part]]\nname = \"drive\"\nmesh = \"three.obj\"\n",
    );
    folder
}

#[test]
fn the_option_is_the_key_of_all_parts() {
    let folder = folder();
    let names_of = |line: &str| -> Vec<String> {
        let json = folder.run(line).exits(0).json();
        let parts = json["parts"].as_array().expect("parts").iter();
        parts
            .map(|p| p["name"].as_str().expect("a name").to_owned())
            .collect()
    };
    let bodies = |name: &str| [1, 2, 3].map(|i| format!("{name}/{i}")).to_vec();
    assert_eq!(names_of("inspect three.obj --json -"), ["three"]);
    assert_eq!(
        names_of("inspect three.obj --split --json -"),
        bodies("three")
    );
    assert_eq!(
        names_of("inspect scene.toml --split --json -"),
        bodies("drive")
    );
    let set = "inspect scene.toml --set part.drive.split=true --json -";
    assert_eq!(names_of(set), bodies("drive"));
    let two = names_of("inspect three.obj shape:cube --split --json -");
    assert_eq!(two, [bodies("three"), vec!["cube".to_owned()]].concat());
}

#[test]
fn every_command_that_takes_meshes_takes_it() {
    let folder = folder();
    for line in [
        "render three.obj --split --section z=50% --resolution 64,48 -o a.png",
        "compare three.obj --split --section z=50% --resolution 64,48 --strategies raycast+mask",
        "plan three.obj --split --section z=50%",
        "section three.obj --split --section z=50% --json -",
        "animate three.obj --split --section z=50% --turntable --frames 2 --resolution 64,48 -o %d.png",
    ] {
        let ran = folder.run(line).exits(0);
        assert!(
            ran.stderr.contains("three.obj: 3 bodies in 1 part"),
            "{line}: {}",
            ran.stderr
        );
    }
    let json = folder.run("section three.obj --split --section z=50% --exclude three/3 --json -");
    let json = json.exits(0).json();
    let area = json["sections"][0]["area"].as_f64().expect("an area");
    assert!((area - 2.0).abs() < 1e-9, "two cubes are cut: {area}");
}

#[test]
fn a_saved_scene_is_split_too() {
    let folder = folder();
    let line = "render three.obj --split --section z=50% --resolution 64,48";
    folder
        .run(&format!("{line} --save s.toml -o a.png"))
        .exits(0);
    let text = std::fs::read_to_string(folder.path("s.toml")).expect("a scene");
    assert!(text.contains("split = true"), "{text}");
    folder.run("render s.toml -o b.png").exits(0);
    let read = |name: &str| std::fs::read(folder.path(name)).expect("a picture");
    assert!(read("a.png") == read("b.png"), "another picture");
    folder
        .run(&format!("{} -o c.png", line.replace("--split ", "")))
        .exits(0);
    assert!(read("a.png") != read("c.png"), "the option changes nothing");
}

#[test]
fn inspect_counts_bodies_and_says_how_to_have_them() {
    let folder = folder();
    let hint = "three has 3 bodies: --split makes each of them a part";
    let whole = folder.run("inspect three.obj").exits(0);
    assert!(whole.text().contains(hint), "{}", whole.text());
    let split = folder.run("inspect three.obj --split").exits(0);
    assert!(!split.text().contains("--split"), "{}", split.text());
    let json = folder.run("inspect three.obj --json -").exits(0).json();
    let of = |key: &str| json["parts"][0][key].as_u64();
    // A cavity is a component, and no body.
    assert_eq!((of("bodies"), of("components")), (Some(3), Some(4)));
    assert_eq!(json["total"]["bodies"].as_u64(), Some(3));
}
