//! What cannot be done is refused by name, before anything is written.

use super::*;

#[test]
fn what_cannot_be_written_is_refused_with_help() {
    let folder = Scratch::new("export-refused");
    folder.write(
        "bracket.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    );
    for (line, said) in [
        (
            "shape:cube --section z=0 -o half.step",
            ".stl or .ply or .obj or .glb or .3mf",
        ),
        ("shape:cube --section z=0 -o half", ".3mf"),
        ("shape:cube --section z=0 -o -", "--output -"),
        ("shape:cube -o half.stl", "nothing to cut by"),
        ("shape:cube --section z=0 --unit mm -o half.stl", "--unit"),
        (
            "shape:cube --section z=7 -o half.stl",
            "nothing of the model is left",
        ),
        (
            "shape:cube --section z=-7 --both -o half.stl",
            "nothing of the model is removed",
        ),
        ("bracket.obj --section z=50% -o bracket.obj", "input"),
        (
            "bracket.obj --section z=50% -o half.stl --json half.stl",
            "--json",
        ),
        (
            "bracket.obj --section z=50% -o half.stl --both --json half.removed.stl",
            "--json",
        ),
    ] {
        let ran = folder.run(&format!("export {line}")).exits(2);
        let complaint = &ran.stderr;
        assert!(
            complaint.contains(said) && complaint.contains("help:"),
            "{line}: {complaint}"
        );
        assert_eq!(folder.files(), ["bracket.obj"], "{line}");
    }
}

#[test]
fn the_material_library_of_an_input_is_not_replaced() {
    let folder = Scratch::new("export-library");
    folder.write("a.mtl", "newmtl red\nKd 1 0 0\n");
    folder.write(
        "model.obj",
        "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    );
    let ran = folder
        .run("export model.obj --section z=50% -o a.obj")
        .exits(2);
    assert!(ran.stderr.contains("a.mtl"), "{}", ran.stderr);
    folder
        .run("export model.obj --section z=50% -o b.obj")
        .exits(0);
    let color = read(&folder, "b.obj").parts[0].material.color;
    assert!(color.x > 0.9 && color.y < 0.1, "{color}");
}
