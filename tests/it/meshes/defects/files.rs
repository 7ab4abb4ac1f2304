//! The option and the key of scene files, by the command.

use crate::meshes::defects::command::Scratch;

#[test]
fn the_option_breaks_what_is_inspected_and_says_so() {
    let folder = Scratch::new("defects-option");
    let ran = folder
        .run("inspect shape:sphere --defect holes:amount=5%,patch=10 --defect soup:amount=0% --json -")
        .exits(0);
    let facts = &ran.json()["total"];
    assert_eq!(facts["closed"], false);
    assert!(facts["boundary_edges"].as_u64().unwrap() > 0);
    assert!(ran.stderr.contains("faces are missing"), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("soup:amount=0%,seed=1`: nothing"),
        "{}",
        ran.stderr
    );
    let whole = folder.run("inspect shape:sphere --json -").exits(0);
    assert_eq!(whole.json()["total"]["closed"], true);
    assert_eq!(whole.json()["total"]["bounds"], facts["bounds"]);
}

#[test]
fn scene_files_break_parts_once_and_refuse_what_they_do_not_know() {
    let folder = Scratch::new("defects-file");
    let file = |defects: &str, more: &str| {
        let text = format!(
            "[[part]]\nname = \"ball\"\nshape = \"sphere\"\ndefects = {defects}\n[[part]]\nshape = \"sphere\"\n{more}"
        );
        folder.write("scene.toml", &text);
    };
    file(
        "[{ kind = \"holes\", amount = \"5%\", seed = 3, patch = 4 }, { kind = \"open\", axis = \"-x\" }]",
        "",
    );
    let ran = folder.run("inspect scene.toml --json -").exits(0);
    let parts = &ran.json()["parts"];
    assert_eq!(parts[0]["closed"], false);
    assert_eq!(
        parts[1]["closed"], true,
        "a shape is shared, a defect is not"
    );
    assert!(
        ran.stderr.contains("missing beyond a plane"),
        "{}",
        ran.stderr
    );
    let by_option = folder
        .run("inspect shape:sphere --defect holes:amount=5%,seed=3,patch=4 --defect open:axis=-x --json -")
        .exits(0);
    assert_eq!(by_option.json()["parts"][0]["faces"], parts[0]["faces"]);

    let key = "[[key]]\ntarget = \"part.ball.defects.0.seed\"\ntimes_s = [0, 1]\nvalues = [1, 2]\n";
    for (defects, more, said) in [
        ("[{ kind = \"hole\" }]", "", "did you mean `holes`"),
        (
            "[{ kind = \"holes\", seeed = 1 }]",
            "",
            "did you mean `seed`",
        ),
        ("[{ amount = \"5%\" }]", "", "it has no `kind`"),
        ("[{ kind = \"holes\", amount = 0.05 }]", "", "in percent"),
        ("[{ kind = \"holes\", amount = \"100%\" }]", "", "no face"),
        ("\"holes\"", "", "a list"),
        ("[{ kind = \"holes\", seed = 1 }]", key, "broken once"),
    ] {
        file(defects, more);
        let message = folder.run("inspect scene.toml").exits(2).stderr;
        assert!(message.contains(said), "{message}");
        assert!(
            message.contains("scene.toml:"),
            "the place is missing: {message}"
        );
    }
}
