//! Every format holds the frames, their times, and what is said about playing them.

use super::command::Scratch;
use super::reading::{Animation, apng, gif, mean_off, most_off, still};
use super::{CUT_CUBE, fs};

/// Most that a channel of a GIF is off, by its colours and by the pattern that hides them, and on average.
const GIF_MOST_OFF: u8 = 40;
const GIF_MEAN_OFF: f64 = 3.0;

#[test]
fn an_animated_png_is_what_render_draws_bit_by_bit() {
    let folder = Scratch::new("animate-apng");
    folder
        .run(&format!(
            "animate {CUT_CUBE} --turntable --frames 4 --fps 10 -o out.png"
        ))
        .exits(0);
    assert_eq!(folder.files(), ["out.png"]);
    let Animation {
        frames,
        delays_ms,
        plays,
    } = apng(&folder.path("out.png"));
    assert_eq!(frames.len(), 4);
    assert_eq!(delays_ms, [100.0; 4]);
    assert_eq!(plays, 0, "for ever");
    let camera = |at: &str| CUT_CUBE.replace("1,1.5,3", at);
    for (frame, at) in frames
        .iter()
        .zip(["1,1.5,3", "3,1.5,-1", "-1,1.5,-3", "-3,1.5,1"])
    {
        folder
            .run(&format!("render {} -o one.png", camera(at)))
            .exits(0);
        let one = still(&folder.path("one.png"));
        if at == "1,1.5,3" {
            assert_eq!(*frame, one, "the first frame");
        }
        // The sine of half a turn is not quite 0.
        assert!(
            mean_off(frame, &one) < 0.05,
            "{at}: {}",
            mean_off(frame, &one)
        );
    }
    assert!(mean_off(&frames[0], &frames[1]) > 1.0, "the camera moves");
}

#[test]
fn a_gif_is_the_same_within_its_colors() {
    let folder = Scratch::new("animate-gif");
    let line = format!("animate {CUT_CUBE} --turntable --frames 6");
    folder.run(&format!("{line} -o out.gif")).exits(0);
    folder.run(&format!("{line} -o out.png")).exits(0);
    let (shown, true_ones) = (gif(&folder.path("out.gif")), apng(&folder.path("out.png")));
    assert_eq!(shown.frames.len(), 6);
    assert_eq!(shown.delays_ms, [670.0; 6], "a turn takes 4 s");
    assert_eq!(shown.plays, 0, "for ever");
    for (a, b) in shown.frames.iter().zip(&true_ones.frames) {
        let (most, mean) = (most_off(a, b), mean_off(a, b));
        assert!(
            most <= GIF_MOST_OFF && mean <= GIF_MEAN_OFF,
            "{most}, {mean:.2} on average"
        );
    }
    // The control: another frame is farther off than the colours.
    let other = mean_off(&shown.frames[0], &true_ones.frames[1]);
    assert!(other > 2.0 * GIF_MEAN_OFF, "{other}");
}

#[test]
fn numbered_pictures_are_the_frames() {
    let folder = Scratch::new("animate-numbered");
    let line = format!("animate {CUT_CUBE} --turntable=-90 --frames 3");
    folder.run(&format!("{line} -o out.apng")).exits(0);
    let quiet = folder
        .run(&format!("{line} -o new/100%%_%03d.png -q"))
        .exits(0);
    assert_eq!(quiet.stderr, "", "quiet");
    let frames = apng(&folder.path("out.apng")).frames;
    let mut names: Vec<String> = fs::read_dir(folder.path("new"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["100%_001.png", "100%_002.png", "100%_003.png"]);
    for (name, frame) in names.iter().zip(&frames) {
        assert_eq!(still(&folder.path("new").join(name)), *frame, "{name}");
    }
    let shorter = folder
        .run(&format!(
            "animate {CUT_CUBE} --turntable --frames 2 -o new/100%%_%03d.png"
        ))
        .exits(0);
    assert!(
        shorter
            .stderr
            .contains("100%_003.png is from an earlier run"),
        "{}",
        shorter.stderr
    );
}

#[test]
fn transparent_pixels_stay_so_in_every_frame() {
    let folder = Scratch::new("animate-clear");
    // Without strokes, whose edges are soft: a GIF has pixels or has none.
    let line = format!(
        "animate {CUT_CUBE} --turntable --frames 5 --no-background --supersample 1 --style lit"
    );
    folder.run(&format!("{line} -o out.gif")).exits(0);
    folder.run(&format!("{line} -o out.png")).exits(0);
    let (gif, apng) = (
        gif(&folder.path("out.gif")).frames,
        apng(&folder.path("out.png")).frames,
    );
    for (a, b) in gif.iter().zip(&apng) {
        let same = a.pixels().zip(b.pixels()).all(|(a, b)| a[3] == b[3]);
        assert!(same, "nothing of the frame before is left");
        assert_eq!(a.get_pixel(0, 0)[3], 0, "there is nothing behind the cube");
        assert_eq!(a.get_pixel(32, 24)[3], 255, "and there is a cube");
    }
    let covered = |f: &image::RgbaImage| f.pixels().filter(|p| p[3] == 255).count();
    assert_ne!(covered(&gif[0]), covered(&gif[1]), "the outline moves");
}

#[test]
fn it_plays_as_often_as_is_said() {
    let folder = Scratch::new("animate-loop");
    for (said, plays) in [("forever", 0), ("1", 1), ("3", 3), ("65535", 65535)] {
        let line =
            format!("animate {CUT_CUBE} --turntable --frames 2 --supersample 1 --loop {said}");
        folder.run(&format!("{line} -o out.gif")).exits(0);
        folder.run(&format!("{line} -o out.png")).exits(0);
        assert_eq!(gif(&folder.path("out.gif")).plays, plays, "GIF, {said}");
        assert_eq!(
            apng(&folder.path("out.png")).plays,
            plays,
            "animated PNG, {said}"
        );
    }
}

#[test]
fn a_turn_ends_where_it_began() {
    let folder = Scratch::new("animate-turn");
    folder.run("animate shape:crank?throws=2 --section -z=50% --turntable --frames 48 --resolution 96,72 --supersample 1 -o out.png").exits(0);
    let frames = apng(&folder.path("out.png")).frames;
    let off = |a: usize, b: usize| mean_off(&frames[a], &frames[b]);
    let steps: Vec<f64> = (1..frames.len()).map(|i| off(i - 1, i)).collect();
    let most = steps.iter().copied().fold(0.0, f64::max);
    assert!(
        steps.iter().all(|s| *s > 0.0),
        "every frame differs from the one before: {steps:?}"
    );
    let joint = off(frames.len() - 1, 0);
    assert!(
        joint > 0.0 && joint <= most,
        "the last joins the first: {joint} against {most}"
    );
    assert!(off(0, 24) > most, "the control: opposite sides do not");
}
