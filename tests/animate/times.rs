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
                ran.stderr.contains(said) && ran.stderr.contains("mend:"),
                "{line} {options}: {}",
                ran.stderr
            );
        }
    }
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}
