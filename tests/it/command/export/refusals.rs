//! What cannot be done is refused by name, before anything is written.

use super::*;

#[test]
fn nothing_takes_its_place_where_one_place_is_a_folder() {
    for (line, folder_name, file) in [
        (
            "shape:cube --section x=50% -o half.stl --both",
            "half.removed.stl",
            "half.stl",
        ),
        (
            "shape:cube --section x=50% -o half.obj",
            "half.mtl",
            "half.obj",
        ),
        (
            "shape:cube --section x=50% -o half.stl --json facts.json",
            "facts.json",
            "half.stl",
        ),
    ] {
        let folder = Scratch::new("export-places");
        folder.write(file, "as before");
        fs::create_dir(folder.path(folder_name)).unwrap();
        folder.run(&format!("export {line}")).must_refuse(&[
            folder_name,
            "it is a folder",
            "help:",
        ]);
        assert_eq!(
            fs::read_to_string(folder.path(file)).unwrap(),
            "as before",
            "{line}"
        );
        assert_eq!(folder.files().len(), 2, "{line}: {:?}", folder.files());
        fs::remove_dir(folder.path(folder_name)).unwrap();
        folder.run(&format!("export {line}")).exits(0);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_is_written_to_and_stays() {
    use std::os::unix::fs::FileTypeExt;

    let folder = Scratch::new("export-pipe");
    let pipe = folder.path("pipe.stl");
    let made = std::process::Command::new("mkfifo")
        .arg(&pipe)
        .status()
        .unwrap();
    assert!(made.success());
    let from = pipe.clone();
    let reader = std::thread::spawn(move || fs::read(from).unwrap());
    folder
        .run("export shape:cube --section x=50% -o pipe.stl")
        .exits(0);
    assert!(reader.join().unwrap().starts_with(b"binary STL"));
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
}

#[test]
fn what_is_wrong_with_a_solid_is_said_with_what_helps() {
    let folder = Scratch::new("export-solids");
    let open = folder
        .run("export shape:cube --defect holes:amount=20% --section x=50% --relief waves -o a.stl");
    open.must_refuse(&["part `cube`", "not closed", "inspect"]);
    // Faces that disagree which side is out are no reason to stop, but are told.
    folder.write(
        "turned.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n",
    );
    let ran = folder
        .run("export turned.obj --section z=30% -o b.stl")
        .exits(0);
    assert!(ran.stderr.contains("face the other way"), "{}", ran.stderr);
    let ran = folder
        .run("export shape:cube --section z=30% -o c.stl")
        .exits(0);
    assert!(
        !ran.stderr.contains("face the other way"),
        "the control: {}",
        ran.stderr
    );
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

#[test]
fn an_image_of_an_input_is_not_replaced() {
    let folder = Scratch::new("export-image");
    let red = image::RgbImage::from_pixel(2, 2, image::Rgb([255, 0, 0]));
    red.save(folder.path("a.0.png")).unwrap();
    folder.write("model.mtl", "newmtl red\nmap_Kd a.0.png\n");
    folder.write(
        "model.obj",
        "mtllib model.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n\
         f 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 1/1 4/1 3/1\nf 2/1 3/1 4/1\n",
    );
    let before = fs::read(folder.path("a.0.png")).unwrap();
    for name in ["a.obj", "a.ply"] {
        let ran = folder.run(&format!("export model.obj --section z=50% -o {name}"));
        let ran = ran.exits(2);
        assert!(ran.stderr.contains("a.0.png"), "{}", ran.stderr);
        assert_eq!(fs::read(folder.path("a.0.png")).unwrap(), before);
    }
    let line = "export model.obj --section z=50% -o b.obj --json b.0.png";
    let ran = folder.run(line).exits(2);
    assert!(ran.stderr.contains("b.0.png"), "{}", ran.stderr);
    folder
        .run("export model.obj --section z=50% -o b.obj")
        .exits(0);
    assert!(folder.path("b.0.png").is_file());
}

/// The name beside it, under which a file is begun, was once longer than file systems take.
#[test]
fn a_name_may_be_as_long_as_the_file_system_takes() {
    let folder = Scratch::new("export-long-name");
    let name = format!("{}.stl", "a".repeat(251));
    folder
        .run(&format!("export shape:cube --section z=0 -o {name}"))
        .exits(0);
    assert!(folder.path(&name).is_file());
}
