//! Which way is up in meshes that do not say it is guessed for pictures, and said.

use super::common::command::Scratch;

/// A slab, lying on the face across an axis, as PLY.
fn slab(size: [f64; 3]) -> String {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { size[axis] } else { 0.0 });
    let vertices: String = (0..8)
        .map(corner)
        .map(|[x, y, z]| format!("{x} {y} {z}\n"))
        .collect();
    let faces = "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
    format!(
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
         element face 6\nproperty list uchar int vertex_indices\nend_header\n{vertices}{faces}"
    )
}

#[test]
fn up_is_guessed_by_the_base_and_said() {
    let folder = Scratch::new("framing_upright");
    folder.write("flat_y.ply", slab([3.0, 0.25, 2.0]));
    folder.write("flat_z.ply", slab([3.0, 2.0, 0.25]));
    folder.write("cube.ply", slab([1.0; 3]));
    folder.write(
        "solid.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
    );
    let render = |line: &str| {
        folder
            .run(&format!(
                "render {line} --resolution 32,24 --force --save s.toml -o x.png"
            ))
            .exits(0)
    };
    for (line, said) in [
        ("flat_y.ply", Some("+Y")),
        ("flat_z.ply", Some("+Z")),
        ("cube.ply", Some("+Y")),
        ("flat_z.ply flat_y.ply", Some("+Y")),
        ("flat_z.ply --up +Y", None),
        ("flat_z.ply --set camera.up=+Y", None),
        ("flat_z.ply shape:cube", None),
        ("solid.obj", None),
    ] {
        let ran = render(line);
        let note = ran.stderr.lines().find(|l| l.contains("up is guessed"));
        match said {
            None => assert_eq!(note, None, "{line}"),
            Some(up) => {
                let note = note.unwrap_or_else(|| panic!("{line}: {}", ran.stderr));
                assert!(
                    note.contains(&format!("guessed: {up}")) && note.contains("--up"),
                    "{line}: {note}"
                );
                let saved = std::fs::read_to_string(folder.path("s.toml")).expect("a scene");
                assert!(saved.contains(&format!("up = \"{up}\"")), "{line}: {saved}");
                assert!(saved.contains("azimuth_deg = \"auto\""), "{line}: {saved}");
                // The scene says it now.
                let again = folder
                    .run("render s.toml -o again.png --resolution 32,24")
                    .exits(0);
                assert!(!again.stderr.contains("guessed"), "{}", again.stderr);
            }
        }
    }
    // A scene file means +Y, and stays as it is; where its meshes look otherwise, that is said.
    for (part, more, said) in [
        ("mesh = 'flat_z.ply'", "", true),
        ("mesh = 'flat_y.ply'", "", false),
        ("mesh = 'flat_z.ply'", "camera = { up = '+Y' }", false),
        ("mesh = 'flat_z.ply', rotate_deg = [-90, 0, 0]", "", false),
    ] {
        let text = format!("{more}\npart = [{{ {part} }}]\n");
        folder.write("file.toml", &text);
        let ran = folder
            .run("render file.toml -o file.png --resolution 32,24")
            .exits(0);
        let note = ran.stderr.lines().find(|l| l.contains("look like +Z"));
        assert_eq!(note.is_some(), said, "{text}{}", ran.stderr);
        let kept = std::fs::read_to_string(folder.path("file.toml")).expect("a scene");
        assert_eq!(kept, text);
    }
    let compared = folder
        .run("compare flat_z.ply --strategies raycast+mask --resolution 16,12 --json -")
        .exits(0);
    assert!(
        !compared.stderr.contains("guessed"),
        "what is measured is not guessed"
    );
}
