//! Cuts and reliefs that make no sense are refused by name, with a line and a mend.
//!
//! Every case is one change to a scene that loads: the intact scene is the negative control.

use super::Folder;

const INTACT: &str = r#"
[[part]]
name = "solid"
shape = "cube"
[[part]]
shape = "earth?subdivisions=1"
[relief.rough]
kind = "waves"
size = 8
[relief.row]
kind = "profile"
heights = [0, 1, 0.5]
[relief.fine]
kind = "waves"
size = 8
[relief.stack]
kind = "layers"
of = ["rough", "fine"]
at = 0.5
wrap = "clamp"
[[cut]]
name = "block"
enabled = true
offset = { solid = 0.1, "c*" = "5%" }
box = { min = [0, 0, "10%"], max = [1, 2, 3], relief = "rough", amplitude = "5%", faces = ["-x"] }
[[cut]]
name = "pie"
wedge = { axis = "z", origin = [0, 0, "50%"], from_deg = 0, to_deg = 90, min = -1, max = "90%", relief = "stack" }
[[cut]]
name = "cube"
box = { centre = [0, 0, 0], size = 0.5 }
[[key]]
target = "cut.block.enabled"
times_s = [0, 1]
values = [true, false]
interpolation = "step"
[[key]]
target = "relief.stack.at"
times_s = [0, 1]
values = [0, 1]
"#;

/// What is replaced, by what, and two words that the error has to hold: the culprit and what is wrong or its mend.
const BROKEN: &[(&str, &str, &str, &str)] = &[
    (
        "enabled = true",
        "enabled = 1",
        "cut.block.enabled",
        "true or false",
    ),
    (
        "enabled = true",
        "enabeld = true",
        "enabeld",
        "did you mean `enabled`?",
    ),
    (
        "solid = 0.1",
        "solid = nan",
        "cut.block.offset.solid",
        "finite",
    ),
    (
        "solid = 0.1",
        "solid = \"much\"",
        "cut.block.offset.solid",
        "\"6%\"",
    ),
    (
        "solid = 0.1",
        "sold = 0.1",
        "there is no part `sold`",
        "did you mean `solid`?",
    ),
    (
        "solid = 0.1",
        "\"s*\" = 1, \"*d\" = 2",
        "part `solid` fits",
        "add `\"solid\" =",
    ),
    (
        "offset = { solid = 0.1, \"c*\" = \"5%\" }",
        "offset = 0.1",
        "cut.block.offset",
        "a table",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "min = [0, 0]",
        "cut.block.box.min",
        "3 numbers",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "min = 0",
        "cut.block.box.min",
        "3 numbers",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "min = [0, 0, \"ten%\"]",
        "cut.block.box.min.2",
        "\"6%\"",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "min = [0, 0, inf]",
        "cut.block.box.min.2",
        "finite",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "min = [1.5, 0, 0]",
        "cut.block.box",
        "along x",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "minimum = [0, 0, 0]",
        "minimum",
        "did you mean `min`?",
    ),
    (
        "min = [0, 0, \"10%\"]",
        "min = [0, 0, 0], size = 1",
        "cut.block.box",
        "there is no such key",
    ),
    (
        "min = [0, 0, \"10%\"], max = [1, 2, 3], relief = \"rough\", amplitude = \"5%\", faces = [\"-x\"]",
        "",
        "cut.block.box",
        "no side",
    ),
    (
        "faces = [\"-x\"]",
        "faces = [\"x\"]",
        "cut.block.box.faces.0",
        "no choice",
    ),
    (
        "faces = [\"-x\"]",
        "faces = \"-x\"",
        "cut.block.box.faces",
        "a list",
    ),
    (
        "min = [0, 0, \"10%\"], ",
        "",
        "cut.block.box.faces",
        "no choice",
    ),
    (
        "relief = \"rough\", ",
        "",
        "cut.block.box",
        "there is no relief",
    ),
    (
        "relief = \"rough\", amplitude = \"5%\", ",
        "",
        "cut.block.box.faces",
        "there is no relief",
    ),
    (
        "relief = \"rough\"",
        "relief = \"rouhg\"",
        "there is no relief `rouhg`",
        "did you mean `rough`?",
    ),
    (
        "centre = [0, 0, 0]",
        "center = [0, 0, 0]",
        "center",
        "did you mean `centre`?",
    ),
    (
        "size = 0.5",
        "size = -0.5",
        "cut.cube.box",
        "no size be below 0",
    ),
    (
        "size = 0.5",
        "size = [1, 2]",
        "cut.cube.box.size",
        "3 numbers",
    ),
    (", size = 0.5", "", "cut.cube.box", "no `size`"),
    (
        "box = { centre = [0, 0, 0], size = 0.5 }",
        "",
        "cut.cube",
        "remove everything",
    ),
    (
        "box = { centre = [0, 0, 0], size = 0.5 }",
        "box = 3",
        "cut.cube.box",
        "a table",
    ),
    (
        "box = { centre = [0, 0, 0], size = 0.5 }",
        "surfaces = []",
        "cut.cube.surfaces",
        "needs a surface",
    ),
    (
        "box = { centre = [0, 0, 0], size = 0.5 }",
        "wedge = { axis = \"z\", from_deg = 0, to_deg = 360 }",
        "cut.cube",
        "remove everything",
    ),
    ("axis = \"z\", ", "", "cut.pie.wedge", "no `axis`"),
    (
        "axis = \"z\"",
        "axis = \"w\"",
        "cut.pie.wedge.axis",
        "no choice",
    ),
    (
        "axis = \"z\"",
        "axis = [0, 0, 0]",
        "cut.pie.wedge.axis",
        "nowhere",
    ),
    ("from_deg = 0, ", "", "cut.pie.wedge", "no `from_deg`"),
    (
        "to_deg = 90",
        "to_deg = -1",
        "cut.pie.wedge",
        "it turns by -1",
    ),
    (
        "to_deg = 90",
        "to_deg = 361",
        "cut.pie.wedge",
        "from 0 to 360 more",
    ),
    (
        "to_deg = 90",
        "to_deg = nan",
        "cut.pie.wedge.to_deg",
        "finite",
    ),
    ("min = -1", "min = 1.5", "cut.pie.wedge", "along its axis"),
    (
        "origin = [0, 0, \"50%\"]",
        "origin = \"50%\"",
        "cut.pie.wedge.origin",
        "3 numbers",
    ),
    (
        "origin = [0, 0, \"50%\"]",
        "origin = [0, 0, \"1e400%\"]",
        "cut.pie.wedge.origin.2",
        "not finite",
    ),
    (
        "heights = [0, 1, 0.5]",
        "heights = []",
        "relief.row.heights",
        "0 heights",
    ),
    (
        "heights = [0, 1, 0.5]",
        "heights = [0, nan]",
        "relief.row.heights.1",
        "finite",
    ),
    (
        "heights = [0, 1, 0.5]",
        "heights = [0, 1e39]",
        "relief `row`",
        "inf",
    ),
    (
        "heights = [0, 1, 0.5]",
        "heights = 3",
        "relief.row.heights",
        "a list",
    ),
    ("heights = [0, 1, 0.5]", "", "relief.row", "no `heights`"),
    (
        "kind = \"profile\"",
        "kind = \"profil\"",
        "relief.row.kind",
        "did you mean `profile`?",
    ),
    (
        "kind = \"layers\"",
        "kind = \"layer\"",
        "relief.stack.kind",
        "did you mean `layers`?",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "",
        "relief.stack",
        "no layers",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "of = []",
        "relief.stack.of",
        "names no layer",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "of = [\"rough\", \"row\"]",
        "relief `stack`",
        "8 x 8 of the first, 3 x 1",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "of = [\"rough\", \"stack\"]",
        "stack -> stack",
        "made of itself",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "of = [\"rouhg\"]",
        "relief `rouhg`",
        "did you mean `rough`?",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "of = [\"rough\"]\nimages = \"a%d.png\"",
        "relief.stack.images",
        "keep one",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "images = \"a.png\"",
        "relief.stack.images",
        "no number",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "images = \"a%d.png\"",
        "relief.stack.images",
        "there is neither",
    ),
    (
        "of = [\"rough\", \"fine\"]",
        "images = \"a%d.png\"\nfirst = 7",
        "relief.stack.images",
        "there is no file",
    ),
    (
        "at = 0.5\nwrap",
        "first = 2\nat = 0.5\nwrap",
        "relief.stack.first",
        "remove it",
    ),
    ("at = 0.5", "at = inf", "relief.stack.at", "finite"),
    (
        "wrap = \"clamp\"",
        "wrap = \"clmap\"",
        "relief.stack.wrap",
        "did you mean `clamp`?",
    ),
    (
        "values = [true, false]",
        "values = [0.5, 1]",
        "key.0.values",
        "true or false",
    ),
    (
        "values = [true, false]",
        "values = [[true], [false]]",
        "key.0.values",
        "on or off",
    ),
    (
        "values = [0, 1]\n",
        "values = [true, false]\n",
        "key.1.values",
        "is a number",
    ),
    (
        "interpolation = \"step\"",
        "interpolation = \"linear\"",
        "key.0",
        "step",
    ),
    (
        "enabled = true\n",
        "",
        "the file has no `enabled`",
        "enabled = true",
    ),
    (
        "cut.block.enabled",
        "cut.block.offset.mantle",
        "mantle",
        "add `mantle",
    ),
    (
        "cut.block.enabled",
        "relief.stack.first",
        "key.0.target",
        "cannot change",
    ),
    (
        "to_deg = 90, min = -1, max = \"90%\"",
        "to_deg = 360",
        "cut.pie.wedge",
        "all the way round",
    ),
    // At some time only.
    (
        "to_deg = 90, min = -1, max = \"90%\", relief = \"stack\" }",
        "to_deg = 90 }\n[[key]]\ntarget = \"cut.pie.wedge.to_deg\"\ntimes_s = [0, 2]\nvalues = [9, 360]\n",
        "cut.pie.wedge",
        "all the way round",
    ),
    (
        "values = [0, 1]\n",
        "values = [0, 1]\n[[key]]\ntarget = \"cut.pie.wedge.to_deg\"\ntimes_s = [0, 2]\nvalues = [9, 400]\n",
        "cut.pie.wedge",
        "at 2 s",
    ),
];

#[test]
fn every_slip_is_named_with_its_line_and_a_mend() {
    let folder = Folder::new("slips");
    folder.scene(INTACT);
    let mut faults = Vec::new();
    for (intact, broken, culprit, told) in BROKEN {
        assert!(INTACT.contains(intact), "{intact} is not in the scene");
        let text = INTACT.replacen(intact, broken, 1);
        let Err(error) = folder.load(&text) else {
            faults.push(format!("`{broken}` was taken instead of `{intact}`"));
            continue;
        };
        let message = error.to_string();
        for word in [*culprit, *told, "help:", "scene.toml:"] {
            if !message.contains(word) {
                faults.push(format!("`{broken}` does not tell `{word}`:\n{message}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_gap_between_images_is_told() {
    let folder = Folder::new("gap");
    for number in [0, 1, 3] {
        let picture = image::GrayImage::new(2, 2);
        let path = folder.0.join(format!("a{number}.png"));
        picture.save(path).expect("a picture");
    }
    let layers = "images = \"a%d.png\"";
    let text = INTACT.replacen("of = [\"rough\", \"fine\"]", layers, 1);
    let message = folder.load(&text).expect_err("a gap").to_string();
    assert!(message.contains("frame 2, which is missing"), "{message}");
    // The control: without the gap it loads, and layers of two sizes do not.
    let path = folder.0.join("a2.png");
    image::GrayImage::new(2, 2).save(&path).expect("a picture");
    folder.scene(&text);
    image::GrayImage::new(3, 2).save(&path).expect("a picture");
    let message = folder.load(&text).expect_err("two sizes").to_string();
    assert!(message.contains("3 x 2 of number 2"), "{message}");
    // Images that are layers are no names to choose from.
    image::GrayImage::new(2, 2).save(&path).expect("a picture");
    let text = text.replace(
        "[[cut]]\nname = \"cube\"",
        "[relief.odd]\nkind = \"layers\"\nof = [\"qqqqq\"]\n[[cut]]\nname = \"cube\"",
    );
    let message = folder.load(&text).expect_err("no such relief").to_string();
    assert!(message.contains("relief `qqqqq`"), "{message}");
    assert!(
        !message.contains(['\u{7f}']) && !message.contains(".png"),
        "{message}"
    );
}

#[test]
fn an_offset_of_no_part_of_the_cut_is_noted() {
    let folder = Folder::new("offset-of-none");
    let notes = |offset: &str, rest: &str| {
        let text = INTACT.replacen("solid = 0.1, \"c*\" = \"5%\"", offset, 1);
        let text = text.replacen("enabled = true\n", &format!("enabled = true\n{rest}"), 1);
        folder.load(&text).expect("a scene that loads").notes
    };
    for (offset, rest, noted) in [
        ("solid = 0.1, \"c*\" = 1", "", 0),
        ("solid = 0.1, \"q*\" = 1", "", 1),
        ("solid = 0.1, \"c*\" = 1", "except = [\"solid\"]\n", 1),
    ] {
        let notes = notes(offset, rest);
        let told = notes
            .iter()
            .filter(|n| n.contains("no part of the cut"))
            .count();
        assert_eq!(told, noted, "{offset}: {notes:?}");
    }
}
