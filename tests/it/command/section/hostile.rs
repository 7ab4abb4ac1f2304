//! What a user can get wrong: told by name with a mend, exit code 2, and no file.

use super::command::Scratch;

#[test]
fn planes_that_miss_and_far_models_are_no_trouble() {
    let folder = Scratch::new("section-far");
    let ran = folder
        .run("section shape:cube --section z=9 -o none.svg")
        .exits(0);
    assert!(ran.stderr.contains("misses the model"), "{}", ran.stderr);
    folder.write(
        "far.toml",
        "[[part]]\nname = \"far\"\nshape = \"cube\"\ntranslate = [1e6, -1e6, 1e6]\nscale = 1e-3\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n",
    );
    let json = folder.run("section far.toml --json -").exits(0).json();
    let area = json["sections"][0]["area"].as_f64().expect("a number");
    // Coordinates of 1e6 are told to 1e-10, so a side of 1e-3 to 1e-7 of itself.
    assert!((area - 1e-6).abs() < 1e-12, "{area}");
}

#[test]
fn planes_may_begin_far_away() {
    let folder = Scratch::new("section-far-origin");
    let measured = |line: &str| {
        let json = folder
            .run(&format!("section {line} --json -"))
            .exits(0)
            .json();
        let section = &json["sections"][0];
        ["area", "perimeter"].map(|key| section[key].as_f64().expect("a number"))
    };
    // Each pair is one and the same plane: across an axis, and across a diagonal of whole numbers.
    for (near, far) in [
        ("0,0,1@0,0,0.1", "0,0,1@FAR,FAR,0.1"),
        ("0,0,-1@0,0,0.1", "0,0,-1@-FAR,FAR,0.1"),
        ("1,1,0@0,0,0", "1,1,0@FAR,-FAR,0"),
    ] {
        for shape in ["shape:sphere", "shape:cube", "shape:gears"] {
            let expected = measured(&format!("{shape} --section {near}"));
            for at in ["1e6", "1e9", "1e17"] {
                let far = far.replace("FAR", at);
                let found = measured(&format!("{shape} --section {far}"));
                for (found, expected) in found.into_iter().zip(expected) {
                    let off = (found - expected).abs();
                    assert!(off <= 1e-9 * expected, "{shape} by {far}: off by {off}");
                }
            }
        }
    }
}
