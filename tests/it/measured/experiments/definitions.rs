//! Files of experiments: what they say is read and expanded, and what makes no sense is refused by file, line, run and mend.

use std::path::Path;

use cutaway_io::document::Value;
use cutaway_io::load::Assets;
use cutaway_lab::experiment::Moves;
use cutaway_lab::experiment::definition::{Asked, Wanted};
use cutaway_lab::experiment::sweep::Point;
use cutaway_lab::experiment::{Definition, Parameter, Synopsis};

use super::{read, scenes};

const GOOD: &str = r#"
question = "What does it cost?"
analysis = """Look."""

[[run]]
name = "cube"
input = "relief cuts"
moves = "cut"
strategies = ["raycast+mask", "grid:{cells}+vds:64", "grid:{cells}+mask"]
rounds = 5

[run.scene]
part = [{ shape = "cube" }]
relief.waves = { kind = "waves" }
cut = [{ name = "front", surfaces = [{ section = "-z=50%", relief = "waves" }] }]

[run.sweep]
amplitude = { path = "cut.front.surfaces.0.amplitude", values = ["1%", "2%"] }
cells = [8, 16, 32]
size = [{ is = "small", resolution = [64, 1] }]

[run.quick]
resolution = [32, 24]
rounds = 1
strategies = ["raycast+mask", "grid:{cells}+vds:64"]
sweep = { amplitude = ["2%"], cells = [8] }

[[run.expect]]
strategies = ["raycast+*"]
decided_wrong_px = 0

[[run.expect]]
strategies = ["grid:*+vds:*"]
where = { amplitude = "1%", cells = 8 }
why = "two approximations"
decided_wrong_px = { least = 1, most = 900 }

[[run.expect]]
strategies = ["grid:*"]
crack_px = { falls_along = "cells" }

[[chart]]
title = "It falls"
x = "cells"
y = "crack_px"
log = ["x"]
"#;

#[test]
fn a_file_is_read_and_expanded() {
    let definition = read(GOOD).unwrap();
    assert_eq!(definition.name, "01-test");
    assert_eq!(definition.synopsis.name, "01-test");
    assert_eq!(definition.synopsis.toml, GOOD);
    let chart = &definition.synopsis.charts[0];
    assert_eq!(
        (&*chart.y, &*chart.log),
        ("crack_px", &["x".to_owned()][..])
    );
    // What is written of it is what a report reads.
    let written = serde_json::to_string(&definition.synopsis).unwrap();
    let read: Synopsis = serde_json::from_str(&written).unwrap();
    assert_eq!(read, definition.synopsis);
    let full = scenes(&definition, false);
    let stems: Vec<&str> = full.points.iter().map(|p| p.stem.as_str()).collect();
    assert_eq!(stems, ["1__small", "2__small"]);
    let first = &full.points[0];
    let amplitude = |point: &Point| {
        let amplitude = point.scene.get("cut.front.surfaces.0.amplitude");
        amplitude.unwrap().value.clone()
    };
    assert_eq!(amplitude(first), Value::from("1%"));
    let size = &first.scene.get("resolution").unwrap().value;
    assert_eq!(*size, Value::read("[64, 1]"));
    let small = Parameter::Text("small".to_owned());
    assert_eq!(first.parameters["size"], small);
    assert!(
        !first.parameters.contains_key("cells"),
        "it makes renderers"
    );
    let names: Vec<String> = first
        .trials
        .iter()
        .map(|e| e.renderer.to_string())
        .collect();
    assert_eq!(
        names,
        [
            "raycast+mask",
            "grid:8+vds:64",
            "grid:16+vds:64",
            "grid:32+vds:64",
            "grid:8+mask",
            "grid:16+mask",
            "grid:32+mask"
        ]
    );
    let cells = &first.trials[2].families[0].1.parameters["cells"];
    assert_eq!(*cells, Parameter::Whole(16));
    let families = [0, 2, 4].map(|e: usize| first.trials[e].families[0].1.family.as_str());
    assert_eq!(
        families,
        ["raycast+mask", "grid:{cells}+vds:64", "grid:{cells}+mask"]
    );
    let found = &definition.synopsis.runs[0];
    assert_eq!(
        (found.input.as_deref(), found.moves),
        (Some("relief cuts"), Moves::Cut)
    );
    assert_eq!(full.rounds, 5);
    assert_eq!(
        full.claims[2].figures[0].1,
        Wanted::FallsAlong("cells".to_owned())
    );

    let quick = scenes(&definition, true);
    assert_eq!(quick.points.len(), 1, "one amplitude, and no size any more");
    assert_eq!(amplitude(&quick.points[0]), Value::from("2%"));
    let size = &quick.points[0].scene.get("resolution").unwrap().value;
    assert_eq!(*size, Value::read("[32, 24]"));
    assert_eq!(quick.points[0].trials.len(), 2);
    assert_eq!(quick.rounds, 1);
}

#[test]
fn all_names_every_strategy_once() {
    let text = GOOD.replace(
        r#"["raycast+mask", "grid:{cells}+vds:64", "grid:{cells}+mask"]"#,
        r#"["all", "raycast+mask", "grid:{cells}+vds:64"]"#,
    );
    let run = scenes(&read(&text).unwrap(), false);
    assert_eq!(
        run.points[0].trials.len(),
        cutaway::Strategy::all().len() + 3
    );
}

#[test]
fn other_runs_are_read() {
    let text = r#"
question = "Does it hold?"
analysis = ""
[[run]]
name = "cases"
cases = ["4*", "B8"]
sizes = [64, 256]
quick = { sizes = [64] }
[[run]]
name = "random"
random = { scenes = 200, seed = 3 }
strategies = ["raycast+mask"]
quick = { random = { scenes = 20 } }
"#;
    let definition = read(text).unwrap();
    let [cases, quick] = [false, true].map(|q| match definition.runs[0].asked(q) {
        Asked::Cases(cases) => cases.clone(),
        other => panic!("{other:?}"),
    });
    assert_eq!((cases.cases.len(), cases.sizes_px), (2, vec![64, 256]));
    assert_eq!(quick.sizes_px, [64]);
    let [search, quick] = [false, true].map(|q| match definition.runs[1].asked(q) {
        Asked::Search(search) => search.clone(),
        other => panic!("{other:?}"),
    });
    assert_eq!((search.scenes, search.seed), (200, 3));
    assert_eq!((quick.scenes, quick.seed), (20, 3));
    for (from, to, phrase) in [
        ("[64, 256]", "[]", "sizes"),
        ("scenes = 200", "scenes = 0", "at least 1"),
        ("sizes = [64, 256]", "resolution = [1, 1]", "resolution"),
        (r#"["raycast+mask"]"#, r#"["raycats+mask"]"#, "did you mean"),
    ] {
        assert!(text.contains(from), "{from}");
        let message = read(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(phrase), "{message}");
    }
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let good = GOOD;
    read(good).expect("the control");
    for (from, to, phrase) in [
        ("cost?", "cost", "question mark"),
        ("\"cut\"", "\"cuts\"", "did you mean `cut`"),
        ("\"cut\"", "\"wind\"", "use one of: view, cut, mesh"),
        ("\"relief cuts\"", "\" \"", "what a user would call it"),
        ("input = ", "imput = ", "did you mean `input`"),
        ("analysis", "analisis", "did you mean `analysis`"),
        ("rounds = 5", "round = 5", "did you mean `rounds`"),
        ("rounds = 5", "rounds = 0", "rounds"),
        ("rounds = 5", "scenes = 5", "no such key"),
        ("name = \"cube\"", "name = \"Cube 1\"", "cannot be a name"),
        (
            "strategies = [\"raycast+mask\", \"grid:{cells}+vds:64\", \"grid:{cells}+mask\"]",
            "strategies = []",
            "empty",
        ),
        (
            "\"raycast+mask\", \"grid:{cells}+vds",
            "\"raycats+mask\", \"grid:{cells}+vds",
            "did you mean",
        ),
        (
            "\"raycast+mask\", \"grid:{cells}+vds",
            "\"exact\", \"grid:{cells}+vds",
            "leave it out",
        ),
        (
            "grid:{cells}+mask",
            "grid:{cell}+mask",
            "did you mean `cells`",
        ),
        ("grid:{cells}+mask", "grid:{cells+mask", "brace"),
        ("cells = [8", "cell = [8", "its values are not used"),
        (
            "\"cut.front.surfaces",
            "\"cut.frnt.surfaces",
            "did you mean `front`",
        ),
        ("path = \"cut", "paths = \"cut", "did you mean `path`"),
        ("part = [{ shape", "parts = [{ shape", "did you mean `part`"),
        ("[\"1%\", \"2%\"]", "[]", "no values"),
        ("[\"1%\", \"2%\"]", "[\"1%\", \"1%\"]", "twice"),
        ("[\"1%\", \"2%\"]", "[[1, 2]]", "has no name"),
        (
            "[{ is = \"small\", resolution = [64, 1] }]",
            "[{ is = \"small\", resolution = [64, 1] }, { is = 2, \"part.0.name\" = \"a\" }]",
            "different paths",
        ),
        (
            "[{ is = \"small\", resolution = [64, 1] }]",
            "[{ resolution = [64, 1] }]",
            "no `is`",
        ),
        (
            "[{ is = \"small\", resolution = [64, 1] }]",
            "[{ is = \"small\" }]",
            "it sets nothing",
        ),
        (
            "sweep = { amplitude",
            "sweep = { amplitud",
            "did you mean `amplitude`",
        ),
        (
            "decided_wrong_px = 0",
            "decided_wrong = 0",
            "did you mean `decided_wrong_px`",
        ),
        ("decided_wrong_px = 0", "ratio = 2", "time"),
        ("decided_wrong_px = 0", "", "nothing is expected"),
        ("decided_wrong_px = 0", "flicker_px = 0", "no such key"),
        (
            "decided_wrong_px = 0",
            "outcome = \"refused\"",
            "does not say why",
        ),
        ("why = \"two approximations\"\n", "", "does not say why"),
        ("least = 1, most = 900", "least = 1, most = 0", "no number"),
        (
            "amplitude = \"1%\", cells",
            "amplitude = \"3%\", cells",
            "never `3%`",
        ),
        (
            "where = { amplitude",
            "where = { amplitud",
            "did you mean `amplitude`",
        ),
        ("[\"raycast+*\"]", "[\"raycats+*\"]", "no strategy matches"),
        (
            "[\"grid:*+vds:*\"]\nwhere",
            "[\"raycast+*\"]\nwhere",
            "matches no renderer",
        ),
        (
            "why = \"two approximations\"",
            "why = \"w\"\nsub_pixel_bits = 16",
            "adapters have 4 to 8",
        ),
        (
            "falls_along = \"cells\"",
            "falls_along = \"amplitude\"",
            "use one of: cells",
        ),
        (
            "y = \"crack_px\"",
            "y = \"crack\"",
            "did you mean `crack_px`",
        ),
        ("x = \"cells\"", "x = \"cell\"", "did you mean `cells`"),
        ("log = [\"x\"]", "log = [\"z\"]", "no axis"),
        ("log = [\"x\"]", "runs = [\"cub\"]", "did you mean `cube`"),
        ("question = ", "question ", "correct the TOML"),
    ] {
        assert!(good.contains(from), "{from} is in the text");
        // What only the readers of scenes know is checked before anything is measured.
        let checked = read(&good.replacen(from, to, 1)).and_then(|definition| {
            let run = scenes(&definition, false);
            run.points
                .iter()
                .try_for_each(|p| p.scene.check(&Assets::default()))
        });
        let message = checked.expect_err(&format!("{from} -> {to}")).to_string();
        assert!(message.contains(phrase), "{to}: {message}");
        for always in ["here/01-test.toml:", "help: "] {
            assert!(message.contains(always), "{to}: {message}");
        }
    }
    let twice = format!(
        "{good}\n[[run]]\nname = \"cube\"\nscene = {{ part = [{{ shape = \"cube\" }}] }}\nstrategies = [\"all\"]\n"
    );
    let message = read(&twice).unwrap_err().to_string();
    assert!(message.contains("the name is taken"), "{message}");
    for (from, to) in [
        ("analysis = ", "# "),
        ("[\"grid:*\"]", "[\"gird:*\"]"),
        ("= \"cells\" }\n", "= \"amplitude\" }\n"),
    ] {
        let text = good.replacen(from, to, 1);
        let message = read(&text).unwrap_err().to_string();
        assert!(!message.contains("``"), "{message}");
        assert!(
            message.matches("raycast+mask").count() < 2,
            "each once: {message}"
        );
        assert!(!message.contains("did you mean `amplitude`"), "{message}");
    }
    let at_most_0 = good.replacen("decided_wrong_px = 0", "decided_wrong_px = { most = 0 }", 1);
    read(&at_most_0).expect("it declares no failure");
}

#[test]
fn nothing_is_called_like_what_stands_beside_records() {
    let text = |run: &str| {
        format!(
            "question = \"What?\"\nanalysis = \"It.\"\n[[run]]\nname = \"{run}\"\nscene.part = [{{ shape = \"cube\" }}]\n\
             resolution = [8, 8]\nstrategies = [\"raycast+mask\"]\n"
        )
    };
    let read = |file: &str, run: &str| Definition::read(Path::new(file), &text(run));
    assert!(read("a.toml", "b").is_ok(), "other names are free");
    for (file, run) in [
        ("peers.toml", "b"),
        ("experiment.toml", "b"),
        ("a.toml", "experiment"),
    ] {
        let message = read(file, run).unwrap_err().to_string();
        assert!(
            message.contains("neither `experiment` nor `peers`"),
            "{message}"
        );
    }
}

/// A file with one run of these strategies and this sweep.
fn swept(strategies: &str, sweep: &str) -> String {
    format!(
        "question = \"What?\"\nanalysis = \"It.\"\n[[run]]\nname = \"cube\"\nscene.part = [{{ shape = \"cube\" }}]\n\
         resolution = [8, 8]\nstrategies = {strategies}\n[run.sweep]\n{sweep}\n"
    )
}

#[test]
fn what_two_texts_come_to_is_asked_once_and_belongs_to_both() {
    let strategies = r#"["grid:{cells}+vds:1024", "grid:256+vds:{texels}"]"#;
    let text = swept(strategies, "cells = [128, 256]\ntexels = [512, 1024, 2048]");
    let falls = "[[run.expect]]\nstrategies = [\"*\"]\ndecided_wrong_px = { falls_along = \"texels\" }\nwhy = \"it does\"";
    let definition = read(&format!("{text}{falls}")).unwrap();
    let full = scenes(&definition, false);
    let trials = &full.points[0].trials;
    let names: Vec<String> = trials.iter().map(|e| e.renderer.to_string()).collect();
    let expected = [
        "grid:128+vds:1024",
        "grid:256+vds:1024",
        "grid:256+vds:512",
        "grid:256+vds:2048",
    ];
    assert_eq!(names, expected);
    let families: Vec<&str> = trials[1]
        .families
        .iter()
        .map(|(_, m)| m.family.as_str())
        .collect();
    assert_eq!(families, ["grid:{cells}+vds:1024", "grid:256+vds:{texels}"]);
}

#[test]
fn what_two_axes_set_or_nobody_hears_is_refused() {
    for (sweep, phrase) in [
        (
            "\"part.0.scale\" = [1, 2]\nother = { path = \"part.cube.scale\", values = [3, 4] }",
            "axis `other` sets `part.0.scale` too",
        ),
        (
            "\"camera.near\" = [1, 2]\na = [{ is = \"x\", \"camera\" = { near = 3 } }]",
            "axis `a`",
        ),
        (
            "\"strategy.name\" = [\"planar\", \"stencil\"]",
            "`strategies`",
        ),
    ] {
        let told_by = read(&swept("[\"raycast+mask\"]", sweep))
            .unwrap_err()
            .to_string();
        assert!(told_by.contains(phrase), "{told_by}");
    }
    let apart = "\"part.0.scale\" = [1, 2]\nsupersample = [1, 2]";
    assert_eq!(
        scenes(&read(&swept("[\"raycast+mask\"]", apart)).unwrap(), false)
            .points
            .len(),
        4
    );
}

#[test]
fn sweeps_without_end_are_refused_at_once() {
    let axes: String = (0..70)
        .map(|i| format!("a{i} = {{ path = \"camera.near\", values = [1, 2] }}\n"))
        .collect();
    let text = swept("[\"raycast+mask\"]", &axes);
    let message = read(&text).unwrap_err().to_string();
    assert!(message.contains("too many points"), "{message}");
    let values: Vec<String> = (1..=300).map(|n| n.to_string()).collect();
    let text = swept(
        "[\"grid:{cells}+mask\"]",
        &format!("cells = [{}]", values.join(", ")),
    );
    let message = read(&text).unwrap_err().to_string();
    assert!(message.contains("at most 200"), "{message}");
}
