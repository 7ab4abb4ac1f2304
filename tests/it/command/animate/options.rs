//! Options: what they mean together, what is refused, and what is told.

use serde_json::{Value, json};

use super::command::Scratch;
use super::reading::{apng, gif};
use super::{CUT_CUBE, fs};

#[test]
fn lengths_and_rates_go_together() {
    let folder = Scratch::new("animate-lengths");
    let small = CUT_CUBE.replace("64,48", "16,12");
    let line = format!("animate {small} --turntable --supersample 1");
    for (options, frames, delay_ms) in [
        ("--duration 0.5 --fps 10", 5, 100.0),
        ("--duration 0.25", 6, 1000.0 / 24.0),
        ("--frames 7 --fps 50", 7, 20.0),
        ("--fps 2", 8, 500.0),
    ] {
        folder.run(&format!("{line} {options} -o out.png")).exits(0);
        let read = apng(&folder.path("out.png"));
        assert_eq!(read.frames.len(), frames, "{options}");
        assert!(
            read.delays_ms.iter().all(|d| (d - delay_ms).abs() < 1.0),
            "{options}: {:?}",
            read.delays_ms
        );
    }
}

#[test]
fn a_gif_takes_the_nearest_rate_and_says_so() {
    let folder = Scratch::new("animate-rates");
    for (options, delay_ms, said) in [
        // Two frames of a turn that takes four seconds.
        ("", 2000.0, None),
        ("--fps 25", 40.0, None),
        ("--fps 24", 40.0, Some("25 frames per second instead of 24")),
        (
            "--fps 30",
            30.0,
            Some("33.3333 frames per second instead of 30"),
        ),
        (
            "--fps 100",
            20.0,
            Some("50 frames per second instead of 100"),
        ),
    ] {
        let ran = folder
            .run(&format!(
                "animate {CUT_CUBE} --turntable --frames 2 --supersample 1 -o out.gif {options}"
            ))
            .exits(0);
        assert_eq!(
            gif(&folder.path("out.gif")).delays_ms,
            [delay_ms; 2],
            "{options}"
        );
        match said {
            Some(said) => assert!(ran.stderr.contains(said), "{options}: {}", ran.stderr),
            None => assert!(!ran.stderr.contains("instead"), "{options}: {}", ran.stderr),
        }
    }
}

#[test]
fn a_gif_is_as_small_and_slow_as_others_are() {
    let folder = Scratch::new("animate-usual");
    let line = "animate shape:cube --section z=50% --turntable --duration 0.16 --supersample 1";
    for (output, size, frames, delay_ms) in [
        ("out.gif", (640, 480), 2, 80.0),
        ("out.png", (1024, 768), 4, 1000.0 / 24.0),
        ("out.gif --resolution 1024,768", (1024, 768), 2, 80.0),
    ] {
        folder.run(&format!("{line} -o {output}")).exits(0);
        let read = match output {
            "out.png" => apng(&folder.path("out.png")),
            _ => gif(&folder.path("out.gif")),
        };
        assert_eq!(read.frames.len(), frames, "{output}");
        assert_eq!(read.frames[0].dimensions(), size, "{output}");
        assert!((read.delays_ms[0] - delay_ms).abs() < 1.0, "{output}");
    }
}

#[test]
fn every_frame_is_accounted_for() {
    let folder = Scratch::new("animate-json");
    let line =
        format!("animate {CUT_CUBE} --turntable --frames 3 --fps 10 --start 0.5 --supersample 1");
    let ran = folder
        .run(&format!(
            "{line} --strategy grid:8+vds:64 -o out.png --json -"
        ))
        .exits(0);
    let json = ran.json();
    assert_eq!(json["strategy"], "grid:8+vds:64");
    assert_eq!(json["format"], "apng");
    assert_eq!(json["turntable_deg"], 360.0);
    let frames = json["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 3);
    for (i, frame) in frames.iter().enumerate() {
        assert_eq!(frame["outcome"], "complete");
        assert!(
            (frame["time_s"].as_f64().unwrap() - (0.5 + 0.1 * i as f64)).abs() < 1e-9,
            "{frame}"
        );
        assert!(frame["time_ms"]["frame"].as_f64().unwrap() > 0.0, "{frame}");
        assert!(frame["drawn_ms"].as_f64().unwrap() > 0.0, "{frame}");
        let clocks = if i == 0 {
            json!(["solid", "cut", "frame"])
        } else {
            json!(["frame"])
        };
        assert_eq!(frame["clocks"], clocks, "only the camera moves: frame {i}");
        assert_eq!(frame["time_ms"]["solid"] == Value::Null, i > 0, "{frame}");
    }
    for said in [
        "3 frames of 64 x 48",
        "0.3 s at 10 a second",
        "solid in 1",
        "frame in 3",
    ] {
        assert!(ran.stderr.contains(said), "no `{said}` in {}", ran.stderr);
    }
    let exact = folder
        .run(&format!("{line} --strategy exact -o out.png --json -"))
        .exits(0)
        .json();
    assert_eq!(
        exact["frames"][0]["clocks"],
        json!([]),
        "exact has no clocks"
    );
}

#[test]
fn a_failure_leaves_what_was_there() {
    let folder = Scratch::new("animate-old");
    for name in ["out.gif", "out.png", "1.png"] {
        folder.write(name, "old");
        let pattern = if name == "1.png" { "%d.png" } else { name };
        folder
            .run(&format!(
                "animate {CUT_CUBE} --turntable --frames 2 --strategy planar+mask -o {pattern}"
            ))
            .exits(2);
        assert_eq!(
            fs::read_to_string(folder.path(name)).unwrap(),
            "old",
            "{name}"
        );
        // The control: what works replaces it.
        folder
            .run(&format!(
                "animate {CUT_CUBE} --turntable --frames 2 --supersample 1 -o {pattern}"
            ))
            .exits(0);
        assert!(fs::read(folder.path(name)).unwrap().len() > 100, "{name}");
    }
    assert_eq!(folder.files(), ["1.png", "2.png", "out.gif", "out.png"]);
}
