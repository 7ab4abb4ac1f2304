//! What a user can get wrong: told by name with a mend, exit code 2, and no file.

use super::command::Scratch;

#[test]
fn slips_are_refused_by_name() {
    let folder = Scratch::new("section-hostile");
    folder.write("ragged.toml", "[relief.r]\nkind = \"fractal\"\n[[part]]\nshape = \"cube\"\n[[cut]]\nname = \"torn\"\nsurfaces = [{ section = \"z=50%\", relief = \"r\", amplitude = \"4%\" }]\n");
    for (line, told) in [
        ("shape:cube", "there is no plane to cut by"),
        (
            "shape:cube --section z=50% --relief waves",
            "cut `z=50%`: clip-surface 0 has a relief",
        ),
        ("ragged.toml", "cut `torn`: clip-surface 0 has a relief"),
        (
            "shape:cube --section z=50% -o cut.png",
            "let the name end in .svg or .json",
        ),
        (
            "shape:cube --section z=50% -o cut.json --json -",
            "--output asks for the same data",
        ),
        (
            "shape:cube --section z=50% -o - --json -",
            "standard output already carries",
        ),
        (
            "shape:cube --section z=50% -o a.svg --json a.svg",
            "the file of --output",
        ),
        ("shape:cube --section up=5", "up=5"),
        (
            "shape:cube --section z=50% --exclude nobody",
            "--exclude nobody",
        ),
        ("shape:cube --section z=50% --unit furlong", "--unit"),
        ("nothing.obj --section z=50%", "nothing.obj"),
        ("shape:cube --section z=50% --fill both", "--fill"),
    ] {
        let ran = folder.run(&format!("section {line}")).exits(2);
        assert!(ran.stderr.contains(told), "{line}: {}", ran.stderr);
        assert!(ran.stdout.is_empty(), "{line}: standard output");
        assert_eq!(folder.files(), ["ragged.toml"], "{line}");
    }
    // The control: the same words without the slips.
    folder
        .run("section shape:cube --section z=50% -o a.svg --json b.json --unit in")
        .exits(0);
    assert_eq!(folder.files(), ["a.svg", "b.json", "ragged.toml"]);
}

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
