//! Colours of vertices and images survive the cut in all formats that have a place for them; others say so.

use cutaway::scene::Mesh;

use super::*;

/// A cube whose vertices have the colours of their coordinates, as PLY.
fn colored_cube() -> String {
    let corner = |i: usize| [i & 1, (i >> 1) & 1, i >> 2];
    let vertices = (0..8).map(|i| {
        let [x, y, z] = corner(i);
        format!("{x} {y} {z} {} {} {}\n", 255 * x, 255 * y, 255 * z)
    });
    let faces = [
        "0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5",
    ];
    let faces = faces.map(|f| format!("4 {f}\n")).concat();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 6\n\
         property list uchar int vertex_indices\nend_header\n{}{faces}",
        vertices.collect::<String>()
    )
}

/// As IEC 61966-2-1 has it.
fn srgb_from_linear(v: f32) -> f32 {
    match v <= 0.003_130_8 {
        true => 12.92 * v,
        false => 1.055 * v.powf(1.0 / 2.4) - 0.055,
    }
}

/// The faces of a mesh that are not in the plane x = 0.5, each with the colours of its corners.
fn faces(mesh: &Mesh) -> impl Iterator<Item = ([glam::DVec3; 3], [[u8; 4]; 3])> {
    let vertex_paint = mesh.vertex_paint.as_ref().expect("colours");
    let all =
        (0..mesh.triangles.len()).map(|t| (mesh.corners(t), vertex_paint.triangles[t].colors));
    all.filter(|(corners, _)| corners.iter().any(|p| p.x != 0.5))
}

#[test]
fn colours_of_vertices_survive_in_all_formats_that_hold_them() {
    let folder = Scratch::new("export-colours");
    folder.write("cube.ply", colored_cube());
    for extension in ["glb", "obj", "ply", "3mf"] {
        let ran = folder.run(
            &format!("export cube.ply --section x=0.5 --unit mm -o half.{extension}").replace(
                " --unit mm",
                if extension == "3mf" { " --unit mm" } else { "" },
            ),
        );
        let ran = ran.exits(0);
        assert!(
            !ran.stderr.contains("without"),
            "{extension}: {}",
            ran.stderr
        );
        let read = read(&folder, &format!("half.{extension}"));
        let facts = Topology::from_parts(&read.parts);
        assert!(
            facts.closed && (facts.volume - 0.5).abs() < 1e-9,
            "{extension}"
        );
        let mesh = &read.parts[0].mesh;
        let mut count = 0;
        for (corners, colors) in faces(mesh) {
            count += 1;
            for (p, color) in corners.iter().zip(colors) {
                for axis in 0..3 {
                    let expected = 255.0 * srgb_from_linear(p[axis] as f32);
                    let off = (f32::from(color[axis]) - expected).abs();
                    assert!(off < 1.5, "{extension}: {color:?} at {p}");
                }
            }
        }
        assert!(count >= 10, "{extension}: {count} faces");
        // A cap has the one colour of caps, and no corner that of the faces beside it.
        let vertex_paint = mesh.vertex_paint.as_ref().expect("colours");
        let caps: Vec<[[u8; 4]; 3]> = (0..mesh.triangles.len())
            .filter(|t| mesh.corners(*t).iter().all(|p| p.x == 0.5))
            .map(|t| vertex_paint.triangles[t].colors)
            .collect();
        assert!(
            caps.len() >= 2 && caps.iter().all(|c| *c == [caps[0][0]; 3]),
            "{extension}: {caps:?}"
        );
    }
    let ran = folder
        .run("export cube.ply --section x=0.5 -o half.stl")
        .exits(0);
    assert!(ran.stderr.contains("without colours"), "{}", ran.stderr);
}

/// A cube whose faces all show an image of 2 x 2 texels.
fn write_painted_cube(folder: &Scratch) {
    let mut png = image::RgbImage::new(2, 2);
    png.put_pixel(0, 0, image::Rgb([255, 0, 0]));
    png.save(folder.path("wall.png")).unwrap();
    folder.write("cube.mtl", "newmtl wall\nmap_Kd wall.png\n");
    let corner = |i: usize| [i & 1, (i >> 1) & 1, i >> 2];
    let vertices: String = (0..8)
        .map(|i| format!("v {} {} {}\n", corner(i)[0], corner(i)[1], corner(i)[2]))
        .collect();
    let faces = [
        [1, 3, 4, 2],
        [5, 6, 8, 7],
        [1, 2, 6, 5],
        [3, 7, 8, 4],
        [1, 5, 7, 3],
        [2, 4, 8, 6],
    ];
    let faces: String = faces
        .iter()
        .map(|[a, b, c, d]| format!("f {a}/1 {b}/2 {c}/3 {d}/4\n"))
        .collect();
    folder.write(
        "cube.obj",
        format!("mtllib cube.mtl\n{vertices}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wall\n{faces}"),
    );
}

/// On the face below, whose first corner is at the origin, u goes with y and v down from 1 with x.
fn is_painted_below(corners: [glam::DVec3; 3], uv: [glam::Vec2; 3]) -> Option<bool> {
    let expected = |p: glam::DVec3| glam::Vec2::new(p.y as f32, 1.0 - p.x as f32);
    let is_below = corners.iter().all(|p| p.z == 0.0);
    let mut all = corners.iter().zip(uv);
    is_below.then(|| all.all(|(p, uv)| uv.distance(expected(*p)) < 1e-6))
}

#[test]
fn images_survive_in_all_formats_but_stl() {
    let folder = Scratch::new("export-images");
    write_painted_cube(&folder);
    for (extension, options) in [("glb", ""), ("obj", ""), ("3mf", " --unit mm")] {
        let name = format!("half.{extension}");
        let ran = folder.run(&format!(
            "export cube.obj --section x=0.25{options} -o {name}"
        ));
        let ran = ran.exits(0);
        assert!(!ran.stderr.contains("without"), "{name}: {}", ran.stderr);
        let read = read(&folder, &name);
        let mesh = &read.parts[0].mesh;
        let vertex_paint = mesh.vertex_paint.as_ref().expect("an image");
        assert_eq!(vertex_paint.images.len(), 1, "{name}");
        assert_eq!(vertex_paint.images[0].size(), [2, 2], "{name}");
        assert!(Topology::from_parts(&read.parts).closed, "{name}");
        let below = (0..mesh.triangles.len())
            .filter_map(|t| is_painted_below(mesh.corners(t), vertex_paint.triangles[t].uv));
        let below: Vec<bool> = below.collect();
        assert!(below.len() >= 2 && below.iter().all(|is| *is), "{name}");
        // Caps show none.
        let caps =
            (0..mesh.triangles.len()).filter(|t| mesh.corners(*t).iter().all(|p| p.x == 0.25));
        let caps: Vec<Option<u32>> = caps.map(|t| vertex_paint.triangles[t].image).collect();
        assert!(
            caps.len() >= 2 && caps.iter().all(Option::is_none),
            "{name}: {caps:?}"
        );
    }
    // Its names in the package are XML identifiers, which begin with a letter.
    let package = fs::File::open(folder.path("half.3mf")).unwrap();
    let mut package = zip::ZipArchive::new(package).expect("a package");
    let mut of_model = package.by_name("3D/_rels/3dmodel.model.rels").unwrap();
    let mut text = String::new();
    std::io::Read::read_to_string(&mut of_model, &mut text).unwrap();
    assert!(text.contains("Id=\"rel0\""), "{text}");
    assert!(text.contains("Target=\"/3D/Textures/0.png\""), "{text}");
    let ran = folder.run("export cube.obj --section x=0.25 -o half2.stl");
    let ran = ran.exits(0);
    assert!(ran.stderr.contains("images"), "{}", ran.stderr);
    assert!(!folder.path("half2.0.png").exists(), "STL names no image");
}

#[test]
fn colours_under_an_image_are_a_note_of_3mf_alone() {
    let folder = Scratch::new("export-tinted");
    write_painted_cube(&folder);
    let cube = fs::read_to_string(folder.path("cube.obj")).unwrap();
    let tinted = cube.lines().map(|line| match line.starts_with("v ") {
        true => format!("{line} 0.5 0.5 0.5\n"),
        false => format!("{line}\n"),
    });
    folder.write("cube.obj", tinted.collect::<String>());
    for (extension, options, is_noted) in [
        ("3mf", " --unit mm", true),
        ("obj", "", false),
        ("glb", "", false),
    ] {
        let line = format!("export cube.obj --section x=0.25{options} -o half.{extension}");
        let ran = folder.run(&line).exits(0);
        let is_said = ran
            .stderr
            .contains("without colours of vertices under the images");
        assert_eq!(is_said, is_noted, "{extension}: {}", ran.stderr);
    }
}

#[test]
fn files_beside_have_names_that_are_one_word() {
    let folder = Scratch::new("export-words");
    write_painted_cube(&folder);
    let names = ["my half", "-half", "a#b"];
    for (name, word) in names.into_iter().zip(["my_half", "_half", "a_b"]) {
        let mut command = folder.command("export cube.obj --section x=0.25");
        let ran = command
            .args(["-o", &format!("./{name}.obj")])
            .output()
            .unwrap();
        assert!(
            ran.status.success(),
            "{}",
            String::from_utf8_lossy(&ran.stderr)
        );
        let mesh = &read(&folder, &format!("{name}.obj")).parts[0].mesh;
        assert_eq!(
            mesh.vertex_paint.as_ref().expect("an image").images.len(),
            1,
            "{name}"
        );
        assert!(folder.path(&format!("{word}.mtl")).is_file(), "{word}");
        assert!(folder.path(&format!("{word}.0.png")).is_file(), "{word}");
    }
}

#[test]
fn a_ply_names_its_images_and_the_places_of_each_face() {
    let folder = Scratch::new("export-images-ply");
    write_painted_cube(&folder);
    folder
        .run("export cube.obj --section x=0.25 -o half.ply")
        .exits(0);
    let image = image::open(folder.path("half.0.png"))
        .expect("an image")
        .to_rgba8();
    assert_eq!(
        (image.dimensions(), image[(0, 0)].0),
        ((2, 2), [255, 0, 0, 255])
    );
    let bytes = fs::read(folder.path("half.ply")).unwrap();
    let end = bytes
        .windows(11)
        .position(|w| w == b"end_header\n")
        .expect("a header")
        + 11;
    let header = String::from_utf8_lossy(&bytes[..end]).into_owned();
    assert!(
        header.contains("comment TextureFile half.0.png\n"),
        "{header}"
    );
    assert!(
        header.contains("property list uchar float texcoord\nproperty int texnumber\nend"),
        "{header}"
    );
    assert!(
        !header[..header.find("element face").unwrap()].contains("red"),
        "white is no colour: {header}"
    );
    let mesh = &read(&folder, "half.ply").parts[0].mesh;
    let faces = bytes[end + 24 * mesh.positions.len()..].chunks_exact(13 + 3 + 4 + 1 + 25 + 4);
    assert_eq!(faces.len(), mesh.triangles.len());
    let [mut below, mut caps] = [0; 2];
    for (t, face) in faces.enumerate() {
        let number = |at: usize| f32::from_le_bytes(face[at..at + 4].try_into().unwrap());
        let image = i32::from_le_bytes(face[46..50].try_into().unwrap());
        let is_cap = face[20] == 1;
        assert_eq!(image, if is_cap { -1 } else { 0 });
        caps += usize::from(is_cap);
        let uv = [0, 1, 2].map(|i| glam::Vec2::new(number(22 + 8 * i), 1.0 - number(26 + 8 * i)));
        if let Some(is_right) = is_painted_below(mesh.corners(t), uv) {
            assert!(is_right, "{t}");
            below += 1;
        }
    }
    assert!(below >= 2 && caps >= 2, "{below} below, {caps} caps");
}
