//! A plane that moves through a model by one option.

use super::common::command::Scratch;

#[test]
fn a_sweep_becomes_a_cut_and_a_key() {
    let folder = Scratch::new("framing_sweep");
    let line = "animate shape:cube --sweep -y=10%:90% --frames 4 --fps 2 --resolution 100,100 --no-background --style lit \
                --camera-azimuth-angle 0 --camera-elevation-angle 0 --camera-orthographic";
    folder
        .run(&format!("{line} --save s.toml -o f%d.png"))
        .exits(0);
    let saved = std::fs::read_to_string(folder.path("s.toml")).expect("a scene");
    for said in [
        "name = \"sweep\"",
        "target = \"cut.sweep.surfaces.0.origin\"",
        "times_s = [0",
    ] {
        assert!(saved.contains(said), "no `{said}` in\n{saved}");
    }
    // What is kept grows, in pictures that are framed alike.
    let shown = |name: &str| -> usize {
        let image = image::open(folder.path(name)).expect(name).to_rgba8();
        image.pixels().filter(|p| p.0[3] > 127).count()
    };
    let files = folder.files();
    let frames: Vec<usize> = files
        .iter()
        .filter(|f| f.starts_with('f'))
        .map(|f| shown(f))
        .collect();
    assert_eq!(frames.len(), 4, "{files:?}");
    assert!(frames.windows(2).all(|w| w[0] < w[1]), "{frames:?}");
    // From a tenth of it to nine tenths.
    let grown = frames[3] as f64 / frames[0] as f64;
    assert!((8.0..10.0).contains(&grown), "{frames:?}");
    // The scene that it amounts to has the same frames.
    folder
        .run("animate s.toml --fps 2 --style lit --no-background -o g%d.png")
        .exits(0);
    for i in files.iter().filter(|f| f.starts_with('f')) {
        let again = i.replacen('f', "g", 1);
        let [a, b] = [i, &again].map(|f| image::open(folder.path(f)).expect(f).to_rgba8());
        assert!(a == b, "{i} is not {again}");
    }
    // Spared parts are spared, and need no other section.
    folder
        .run(&format!("{line} --exclude cube -o h%d.png"))
        .exits(0);
}
