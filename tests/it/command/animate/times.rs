//! `--time` and `--clip`: which moment of a scene the other commands show.

use super::command::Scratch;
use super::{CUT_CUBE, fs};

const STILL: &str = "note: nothing moves";

#[test]
fn a_still_scene_is_the_same_at_all_times() {
    let folder = Scratch::new("time-still");
    let plain = folder
        .run(&format!("render {CUT_CUBE} -o plain.png"))
        .exits(0);
    assert!(
        !plain.stderr.contains(STILL),
        "nobody asked: {}",
        plain.stderr
    );
    let timed = folder
        .run(&format!(
            "render {CUT_CUBE} --time 1.5 -o timed.png --json -"
        ))
        .exits(0);
    assert!(timed.stderr.contains(STILL), "{}", timed.stderr);
    assert_eq!(timed.json()["time_s"], 1.5);
    let read = |name: &str| fs::read(folder.path(name)).unwrap();
    assert_eq!(read("plain.png"), read("timed.png"));
    let quiet = folder
        .run(&format!("render {CUT_CUBE} --time 1.5 -o timed.png -q"))
        .exits(0);
    assert_eq!(quiet.stderr, "");
}

#[test]
fn every_command_that_shows_a_scene_takes_a_time() {
    let folder = Scratch::new("time-all");
    for line in [
        format!("compare {CUT_CUBE} --strategies raycast+mask --rounds 1 --max-decided-wrong 0"),
        format!("plan {CUT_CUBE}"),
        "inspect shape:cube".to_owned(),
    ] {
        let plain = folder.run(&line).exits(0);
        let timed = folder.run(&format!("{line} --time 2")).exits(0);
        assert!(
            timed.stderr.contains(STILL) && !plain.stderr.contains(STILL),
            "{line}"
        );
        if !line.starts_with("compare") {
            assert_eq!(plain.text(), timed.text(), "{line}");
        }
        for (options, said) in [
            ("--time -1", "--time"),
            ("--time soon", "--time"),
            ("--clip walk", "walk"),
        ] {
            let ran = folder.run(&format!("{line} {options}")).exits(2);
            assert!(
                ran.stderr.contains(said) && ran.stderr.contains("help:"),
                "{line} {options}: {}",
                ran.stderr
            );
        }
    }
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

/// Regression: a sequence was played at 24 frames a second in a GIF of 25, so that the first mesh was seen twice and the last
/// not at all.
#[test]
fn every_numbered_mesh_has_one_frame_in_every_format() {
    let folder = Scratch::new("time-sequence");
    for (number, size) in (1..=5).zip([1.0, 1.3, 1.6, 1.9, 2.2]) {
        let corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let mut text: String = corners
            .map(|c| c.map(|c: i32| (f64::from(c) * size).to_string()).join(" "))
            .map(|c| format!("v {c}\n"))
            .concat();
        text.push_str("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        folder.write(&format!("t{number:02}.obj"), &text);
    }
    for (output, fps) in [("t.gif", ""), ("t.gif", "--fps 7"), ("t.png", "--fps 30")] {
        let line = format!("animate t%02d.obj --resolution 64,48 {fps} -o {output}");
        folder.run(&line).exits(0);
        let path = folder.path(output);
        let animation = match output {
            "t.gif" => super::reading::gif(&path),
            _ => super::reading::apng(&path),
        };
        assert_eq!(animation.frames.len(), 5, "{line}");
        for pair in animation.frames.windows(2) {
            assert!(pair[0] != pair[1], "{line}: a mesh is seen twice");
        }
    }
}

#[test]
fn inspect_names_the_clips_of_a_file() {
    let folder = Scratch::new("time-clips");
    let still = folder.run("inspect shape:cube --json -").exits(0);
    assert_eq!(still.json()["clips"], serde_json::json!([]));
}
