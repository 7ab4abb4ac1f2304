//! Keys and deformers that make no sense: each is one change to a scene that loads.

use cutaway::error::Error;

use super::Folder;

const INTACT: &str = r#"[camera]
azimuth_deg = 0
near = 0.1
[[part]]
name = "bar"
shape = "cube?divisions=2"
pivot = "centre"
rotate_deg = [0, 0, 0]
priority = 1
deform = [
  { kind = "twist", axis = "y", across = "x", centre = [0, 0, 0], turn_deg = 30 },
  { kind = "wave", amplitude = "2%", period = 0.5 },
  { kind = "inflate", by = 0.1 },
]
[[part]]
name = "globe"
shape = "earth?subdivisions=1"
only = ["c*"]
except = ["crust"]
[relief.ragged]
kind = "fractal"
size = 8
gain = 0.5
[[cut]]
name = "front"
surfaces = [
  { origin = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0], relief = "ragged" },
  { section = "x=5%", relief = "ragged", amplitude = "5%", period = 1 },
]
[[key]]
target = "cut.front.surfaces.0.u"
times_s = [0, 1, 2]
values = [[1, 0, 0], [2, 0, 0], [1, 0, 0]]
interpolation = "linear"
[[key]]
target = "part.bar.rotate_deg"
times_s = [0, 2]
values = [[0, 0, 0], [0, 90, 0]]
"#;

/// What is replaced, by what, and words that the error has to hold.
const BROKEN: &[(&str, &str, &[&str])] = &[
    // Targets.
    (
        "bar.rotate_deg",
        "baar.rotate_deg",
        &["key.1.target", "no part `baar`", "did you mean `bar`?"],
    ),
    (
        "bar.rotate_deg",
        "bar.rotate",
        &["key.1.target", "did you mean `rotate_deg`?"],
    ),
    (
        "bar.rotate_deg",
        "bar.translate",
        &[
            "key.1.target",
            "no `translate` in `part.bar`",
            "add `translate = [0.0, 0.0, 0.0]`",
            "in line 4",
        ],
    ),
    (
        "bar.rotate_deg",
        "bar.rotate_deg.x",
        &["key.1.target", "no `x`", "0, 1, 2"],
    ),
    (
        "bar.rotate_deg",
        "bar.rotate_deg.0.0",
        &["key.1.target", "nothing below `part.bar.rotate_deg.0`"],
    ),
    (
        "bar.rotate_deg",
        "bar.rotate_deg.",
        &["key.1.target", "no number"],
    ),
    (
        "bar.rotate_deg",
        "bar",
        &["key.1.target", "no number", "rotate_deg"],
    ),
    (
        "bar.rotate_deg",
        "bar.shape",
        &["key.1.target", "text \"cube?divisions=2\""],
    ),
    (
        "part.bar.rotate_deg",
        "part",
        &["key.1.target", "no number"],
    ),
    (
        "part.bar.rotate_deg",
        "prat.bar.rotate_deg",
        &["key.1.target", "`prat`", "did you mean `part`?"],
    ),
    (
        "part.bar.rotate_deg",
        "key.0.times_s",
        &["key.1.target", "`key`", "camera, part, cut, relief"],
    ),
    (
        "part.bar.rotate_deg",
        "relief.smooth.gain",
        &["key.1.target", "no relief `smooth`", "ragged"],
    ),
    (
        "part.bar.rotate_deg",
        "camera.up.x",
        &["key.1.target", "no `up` in `camera`", "azimuth_deg"],
    ),
    (
        "part.bar.rotate_deg",
        "cut.front.surfaces.1.section",
        &["key.1.target", "\"x=5%\"", "normal", "origin"],
    ),
    (
        "part.bar.rotate_deg",
        "cut.front.surfaces.1.amplitude",
        &["key.1.target", "\"5%\"", "scene units"],
    ),
    (
        "part.bar.rotate_deg",
        "part.bar.first",
        &["key.1.target", "while they play"],
    ),
    (
        "part.bar.rotate_deg\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [0, 90, 0]]",
        "cut.front.surfaces.0.u.1\"\ntimes_s = [0, 2]\nvalues = [0, 0]",
        &["key.1.target", "`key.0` moves it too"],
    ),
    (
        "target = \"part.bar.rotate_deg\"\n",
        "",
        &["key.1", "it has no `target`"],
    ),
    // Times and values.
    (
        "times_s = [0, 1, 2]",
        "times_s = [0, 1, 1]",
        &["key.0.times_s", "ascend"],
    ),
    (
        "times_s = [0, 1, 2]",
        "times_s = []",
        &["key.0.times_s", "ascend"],
    ),
    (
        "times_s = [0, 1, 2]",
        "times_s = [0, 1, inf]",
        &["key.0.times_s.2", "finite"],
    ),
    (
        "times_s = [0, 1, 2]",
        "times_s = [0, 1]",
        &["key.0.values", "3 values for 2 times"],
    ),
    (
        "[2, 0, 0], ",
        "[2, 0], ",
        &["key.0.values", "differ in length"],
    ),
    (
        "[2, 0, 0], ",
        "[2, 0, \"0\"], ",
        &["key.0.values.1.2", "finite number"],
    ),
    (
        "[2, 0, 0], ",
        "[2, 0, nan], ",
        &["key.0.values.1.2", "finite number"],
    ),
    (
        "[[0, 0, 0], [0, 90, 0]]",
        "[0, 90]",
        &["key.1.values", "a number each", "a list of 3 numbers"],
    ),
    (
        "[[0, 0, 0], [0, 90, 0]]",
        "[[[0], [0], [0]], [[0], [0], [0]]]",
        &["key.1.values", "lists in a list"],
    ),
    (
        "\"linear\"",
        "\"liner\"",
        &["key.0.interpolation", "did you mean `linear`?"],
    ),
    (
        "interpolation =",
        "interpolate =",
        &["key.0.interpolate", "did you mean `interpolation`?"],
    ),
    // Values that make no sense at some time.
    (
        "[2, 0, 0], ",
        "[0, 0, 0], ",
        &[
            "at 1 s",
            "cut.front.surfaces.0.u",
            "key.0",
            "u is too short",
        ],
    ),
    (
        "[2, 0, 0], ",
        "[1, 1, 0], ",
        &["at 1 s", "key.0", "orthogonal"],
    ),
    // Sound at the keys, not between them: u passes through zero.
    (
        "[2, 0, 0], ",
        "[-1, 0, 0], ",
        &["at 0.5 s", "key.0", "u is too short"],
    ),
    (
        "part.bar.rotate_deg\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [0, 90, 0]]",
        "camera.near\"\ntimes_s = [0, 2]\nvalues = [1, -1]",
        &["at 1 s", "camera.near", "key.1", "above 0"],
    ),
    (
        "part.bar.rotate_deg\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [0, 90, 0]]",
        "part.bar.priority\"\ntimes_s = [0, 2]\nvalues = [1, 2]",
        &["part.bar.priority", "key.1", "whole number"],
    ),
    (
        "part.bar.rotate_deg\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [0, 90, 0]]",
        "relief.ragged.gain\"\ntimes_s = [0, 2]\nvalues = [1, 2]",
        &["relief.ragged.gain", "key.1", "gain"],
    ),
    (
        "part.bar.rotate_deg\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [0, 90, 0]]",
        "part.bar.deform.1.period\"\ntimes_s = [0, 2]\nvalues = [1, 0]",
        &["part.bar.deform.1.period", "at 2 s", "above 0"],
    ),
    (
        "[0, 90, 0]]",
        "[0, 1e99, 1e309]]",
        &["key.1.values.1.2", "finite"],
    ),
    // Deformers.
    (
        "kind = \"twist\"",
        "kind = \"twsit\"",
        &["part.bar.deform.0.kind", "did you mean `twist`?"],
    ),
    (
        "kind = \"twist\", ",
        "",
        &["part.bar.deform.0", "it has no `kind`"],
    ),
    (
        "turn_deg = 30",
        "turn = 30",
        &["part.bar.deform.0.turn", "did you mean `turn_deg`?"],
    ),
    (
        ", turn_deg = 30",
        "",
        &["part.bar.deform.0", "it has no `turn_deg`"],
    ),
    (
        "axis = \"y\"",
        "axis = \"w\"",
        &["part.bar.deform.0.axis", "no choice"],
    ),
    (
        "axis = \"y\"",
        "axis = [0, 0, 0]",
        &["part.bar.deform.0.axis", "nowhere"],
    ),
    (
        "across = \"x\"",
        "across = \"-y\"",
        &["part.bar.deform.0.across", "along the axis"],
    ),
    (
        "amplitude = \"2%\", ",
        "",
        &["part.bar.deform.1", "it has no `amplitude`"],
    ),
    (
        "amplitude = \"2%\"",
        "amplitude = \"2 percent\"",
        &["part.bar.deform.1.amplitude", "not a number"],
    ),
    (
        "amplitude = \"2%\"",
        "amplitude = 1e308, phase_deg = 90",
        &["part.bar.deform.1.amplitude", "1e100"],
    ),
    (
        "period = 0.5",
        "period = 1e-320",
        &["part.bar.deform.1.period", "above 0"],
    ),
    (
        "by = 0.1",
        "by = 1e60",
        &["part.bar.deform.", "radii of the model"],
    ),
    (
        "period = 0.5",
        "period = -1",
        &["part.bar.deform.1.period", "above 0"],
    ),
    (
        "by = 0.1",
        "by = 0.1, axis = \"y\"",
        &["part.bar.deform.2.axis", "no such key"],
    ),
    (
        "deform = [\n",
        "deform = [ 3,\n",
        &["part.bar.deform.0", "a table"],
    ),
    // Placement.
    (
        "pivot = \"centre\"",
        "pivot = \"center\"",
        &["part.bar.pivot", "did you mean `centre`?"],
    ),
    (
        "pivot = \"centre\"",
        "pivot = \"centre\"\nmatrix = []",
        &["part.bar.rotate_deg", "matrix"],
    ),
    (
        "only = [\"c*\"]",
        "only = [\"corr\"]",
        &["part.globe.only", "no solid `corr`", "did you mean `core`?"],
    ),
    (
        "except = [\"crust\"]",
        "except = [\"*\"]",
        &["part.globe.except", "leaves no solid"],
    ),
];

#[test]
fn one_slip_is_named_with_its_line_and_a_mend() {
    let folder = Folder::new("hostile");
    folder.load(INTACT).expect("the negative control");
    let mut missed = Vec::new();
    for (intact, broken, told) in BROKEN {
        assert!(INTACT.contains(intact), "{intact} is not in the scene");
        let text = INTACT.replacen(intact, broken, 1);
        let Err(error) = folder.load(&text) else {
            missed.push(format!("`{broken}` was taken"));
            continue;
        };
        let message = error.to_string();
        for word in told.iter().chain(&["help:", "scene.toml:"]) {
            if !message.contains(word) {
                missed.push(format!("`{broken}` does not tell `{word}`:\n{message}"));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n\n"));
}

#[test]
fn the_line_is_that_of_what_is_moved() {
    let folder = Folder::new("line");
    let text = INTACT.replacen("[2, 0, 0], ", "[0, 0, 0], ", 1);
    let Err(Error::File {
        line: Some(line), ..
    }) = folder.load(&text)
    else {
        panic!("no line is told");
    };
    let told = text.lines().nth(line - 1).unwrap_or_default();
    assert!(told.contains("u = [1, 0, 0]"), "line {line}: {told}");
}

/// Every cut-off of the intact scene either loads or says why not.
#[test]
fn no_prefix_of_a_scene_panics() {
    let folder = Folder::new("prefix");
    for end in (0..INTACT.len()).step_by(13) {
        if let Err(error) = folder.load(&INTACT[..end]) {
            assert!(error.to_string().contains("help:"), "{error}");
        }
    }
}
