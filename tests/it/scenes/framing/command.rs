//! What the command frames where nobody says how, and how it is said.

use image::RgbaImage;

use super::common::command::Scratch;
use super::{margins, misfit};

const SIZE: [u32; 2] = [240, 180];

fn margins_in(image: &RgbaImage) -> [f64; 4] {
    let is_shown = |x, y| image.get_pixel(x, y).0[3] > 127;
    margins([image.width(), image.height()], is_shown).expect("the model is shown")
}

fn picture(folder: &Scratch, line: &str, name: &str) -> RgbaImage {
    let line = format!("{line} --resolution 240,180 --no-background --style lit -o {name}");
    folder.run(&line).exits(0);
    image::open(folder.path(name)).expect(name).to_rgba8()
}

#[test]
fn pictures_show_what_is_kept_unless_they_are_told_to_show_all() {
    let folder = Scratch::new("framing_pictures");
    let half = "render shape:crank --section -z=50%";
    let kept = margins_in(&picture(&folder, half, "kept.png"));
    assert_eq!(misfit(kept, SIZE, 1.0), None);
    let all = picture(&folder, &format!("{half} --camera-fit all"), "all.png");
    assert!(misfit(margins_in(&all), SIZE, 1.0).is_some(), "the control");
    let set = picture(&folder, &format!("{half} --set camera.fit=all"), "set.png");
    assert!(all == set, "an option is a path");
}

#[test]
fn what_is_measured_is_framed_as_ever() {
    let folder = Scratch::new("framing_measured");
    let line = "compare shape:crank --section -z=50% --strategies raycast+mask --resolution 64,48 --json -";
    let count = |options: &str| {
        let json = folder.run(&format!("{line} {options}")).exits(0).json();
        json["exact"]["background_px"].as_u64().expect("a count")
    };
    let usual = count("");
    assert_eq!(usual, count("--camera-fit all"));
    assert!(
        count("--camera-fit kept") < usual,
        "the control: what is kept is larger"
    );
}

#[test]
fn a_turntable_has_one_fit() {
    let folder = Scratch::new("framing_turntable");
    let line = "animate shape:crank --section -z=50% --turntable --frames 8 --resolution 120,90 --no-background --style lit";
    folder.run(&format!("{line} -o f%d.png")).exits(0);
    let frames = (0..8).filter_map(|i| image::open(folder.path(&format!("f{i}.png"))).ok());
    let frames: Vec<[f64; 4]> = frames.map(|f| margins_in(&f.to_rgba8())).collect();
    assert!(frames.len() >= 7, "{} frames", frames.len());
    let least = frames
        .iter()
        .flatten()
        .copied()
        .fold(f64::INFINITY, f64::min);
    assert!(
        (4.4..14.0).contains(&least),
        "nearest to a border by {least}: {frames:?}"
    );
}

#[test]
fn views_and_pans_are_options() {
    let folder = Scratch::new("framing_views");
    let line = "render shape:crank --section 1,2,3@50%,50%,50%";
    let cut = picture(
        &folder,
        &format!("{line} --view cut --camera-orthographic"),
        "cut.png",
    );
    assert_eq!(misfit(margins_in(&cut), SIZE, 1.0), None);
    let set = format!("{line} --set camera.view=cut --camera-orthographic");
    assert!(
        cut == picture(&folder, &set, "set.png"),
        "an option is a path"
    );
    assert!(cut != picture(&folder, &format!("{line} --view front"), "front.png"));
    let still = margins_in(&picture(&folder, line, "still.png"));
    let panned = margins_in(&picture(
        &folder,
        &format!("{line} --camera-pan 0.05,0.02"),
        "panned.png",
    ));
    let moved: Vec<f64> = panned.iter().zip(still).map(|(p, s)| p - s).collect();
    let wanted = [9.0, -9.0, -3.6, 3.6];
    let is_near = moved.iter().zip(wanted).all(|(m, w)| (m - w).abs() <= 1.5);
    assert!(is_near, "{moved:?}");
    // A scene file that says where the camera is gives way to an option, and the other way round.
    folder.write(
        "scene.toml",
        "[camera]\nview = \"top\"\n[[part]]\nshape = \"crank\"\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n",
    );
    for options in [
        "--view front",
        "--camera-azimuth-angle 0 --camera-elevation-angle 0",
    ] {
        picture(
            &folder,
            &format!("render scene.toml {options}"),
            "of_scene.png",
        );
    }
}

#[test]
fn colours_have_names_and_are_those_that_are_asked_for() {
    let folder = Scratch::new("framing_colours");
    let line = "render shape:cube --section z=50% --view cut --resolution 48,36 --background navy";
    let middle = |options: &str, name: &str| {
        folder.run(&format!("{line} {options} -o {name}")).exits(0);
        let image = image::open(folder.path(name)).expect(name).to_rgba8();
        assert_eq!(image.get_pixel(0, 0).0, [0, 0, 128, 255], "navy");
        image.get_pixel(20, 20).0
    };
    for style in ["technical", "lit", "clay"] {
        let [r, g, b, _] = middle(&format!("--style {style} --cap-color red"), "cap.png");
        assert!(
            r > 150 && g < 110 && b < 110,
            "{style}: {r} {g} {b} is no red"
        );
        let [r, g, b, _] = middle(
            &format!("--style {style} --color red --cap-color #00f"),
            "both.png",
        );
        assert!(
            b > 120 && r < 110 && g < 110,
            "{style}: {r} {g} {b} is no blue"
        );
    }
    let plain = middle("", "plain.png");
    assert!(plain[0].abs_diff(plain[2]) < 60, "the control: {plain:?}");
}
