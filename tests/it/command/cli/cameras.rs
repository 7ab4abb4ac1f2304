//! Where a scene is seen from when nobody says it: from where the cut is seen.

use crate::command::cli::command::Scratch;

/// How many pixels show a cap.
fn cap_px(folder: &Scratch, line: &str) -> u64 {
    let line = format!("render {line} --resolution 64,48 --supersample 1 -o out.png --json -");
    let json = folder.run(&line).exits(0).json();
    json["cap_px"].as_u64().unwrap()
}

#[test]
fn a_scene_file_without_a_camera_is_turned_to_the_cut() {
    let folder = Scratch::new("turned");
    let part = "[[part]]\nshape = \"cube\"\n";
    let cut = |section: &str| format!("[[cut]]\nsurfaces = [{{ section = \"{section}\" }}]\n");
    folder.write("part.toml", part);
    for section in ["z=50%", "-z=50%", "x=50%", "-x=50%", "y=50%", "-y=50%"] {
        folder.write("cut.toml", [part, &cut(section)].concat());
        let by_options = cap_px(&folder, &format!("shape:cube --section={section}"));
        assert!(by_options > 100, "{section}: {by_options}");
        for line in [
            "cut.toml".to_owned(),
            format!("part.toml --section={section}"),
        ] {
            assert_eq!(cap_px(&folder, &line), by_options, "{line}, {section}");
        }
        // At a time, as in an animation.
        assert_eq!(
            cap_px(&folder, "cut.toml --time 0"),
            by_options,
            "{section}"
        );
    }
    // What a scene says of its camera holds, and so do the options.
    let front = "[camera]\nazimuth_deg = 0\nelevation_deg = 10\n";
    folder.write("front.toml", [front, part, &cut("z=50%")].concat());
    assert_eq!(cap_px(&folder, "front.toml"), 0, "the camera of the scene");
    folder.write("behind.toml", [part, &cut("z=50%")].concat());
    let line = "behind.toml --camera-azimuth-angle 0 --camera-elevation-angle 10";
    assert_eq!(cap_px(&folder, line), 0, "the camera of the options");
    // A cut that is off turns nothing.
    let off = cut("z=50%").replace("[[cut]]", "[[cut]]\nname = \"off\"\nenabled = false");
    folder.write("off.toml", [part, &off, &cut("-z=50%")].concat());
    assert!(
        cap_px(&folder, "off.toml") > 100,
        "the cut that is on is seen"
    );
}
