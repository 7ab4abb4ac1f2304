//! What each format says of caps, as its own words have it.

use std::io::Read;

use super::*;

fn bytes(folder: &Scratch, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

fn exported(extension: &str) -> (Scratch, Vec<u8>) {
    let folder = Scratch::new(&format!("export-{extension}"));
    folder
        .run(&format!(
            "export shape:gears --section z=50% -o cut.{extension}"
        ))
        .exits(0);
    let written = bytes(&folder, &format!("cut.{extension}"));
    (folder, written)
}

#[test]
fn stl_has_as_many_triangles_as_it_says() {
    let (_folder, bytes) = exported("stl");
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count);
    assert!(!bytes.starts_with(b"solid"), "that would be a text");
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    for t in 0..count {
        let vector = |i: usize| [0, 4, 8].map(|k| float(84 + 50 * t + 12 * i + k));
        let [n, a, b, c] = [0, 1, 2, 3].map(vector);
        assert!(
            a != b && b != c && c != a,
            "triangle {t} has a corner twice"
        );
        let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
        let cross =
            [0, 1, 2].map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
        let dot: f32 = (0..3).map(|i| cross[i] * n[i]).sum();
        assert!(dot >= 0.0, "the normal of triangle {t} points inward");
    }
}

#[test]
fn ply_holds_doubles_and_marks_caps() {
    let (folder, bytes) = exported("ply");
    let header = String::from_utf8_lossy(&bytes[..600]).into_owned();
    for line in [
        "property double x",
        "property uchar cap",
        "property int part",
        "comment part 1 ",
    ] {
        assert!(header.contains(line), "{line}: {header}");
    }
    let end = header.find("end_header\n").unwrap() + 11;
    let count = |element: &str| -> usize {
        let at = header.find(&format!("element {element} ")).unwrap();
        header[at..]
            .lines()
            .next()
            .unwrap()
            .rsplit(' ')
            .next()
            .unwrap()
            .parse()
            .unwrap()
    };
    let (vertices, faces) = (count("vertex"), count("face"));
    assert_eq!(bytes.len(), end + 24 * vertices + 21 * faces);
    let positions: Vec<[f64; 3]> = (bytes[end..end + 24 * vertices].chunks_exact(24))
        .map(|p| [0, 8, 16].map(|k| f64::from_le_bytes(p[k..k + 8].try_into().unwrap())))
        .collect();
    let middle = read(&folder, "cut.ply").parts[0].bounds_in_world().min.z;
    let mut caps = 0;
    for face in bytes[end + 24 * vertices..].chunks_exact(21) {
        let corners = [1, 5, 9].map(|k| u32::from_le_bytes(face[k..k + 4].try_into().unwrap()));
        let is_on_plane = corners.iter().all(|i| positions[*i as usize][2] == middle);
        assert_eq!(
            face[20] == 1,
            is_on_plane,
            "caps are what lies on the plane"
        );
        caps += usize::from(face[20]);
    }
    assert!(caps > 100, "{caps} triangles of caps");
}

#[test]
fn ply_keeps_the_colours_of_vertices() {
    let folder = Scratch::new("export-coat");
    folder.write(
        "coated.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
         property uchar green\nproperty uchar blue\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0 0 0 30\n1 0 0 0 0 60\n0 1 0 0 0 90\n0 0 1 255 0 0\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
    );
    folder
        .run("export coated.ply --section -z=50% -o cut.ply")
        .exits(0);
    let bytes = bytes(&folder, "cut.ply");
    // The base is whole: the mean of its corners; no cap has a colour of vertices.
    let faces: Vec<&[u8]> = bytes.rchunks_exact(21).take_while(|f| f[0] == 3).collect();
    let base = faces.iter().filter(|f| f[13..16] == [0, 0, 60]);
    assert_eq!(base.count(), 1, "{faces:?}");
    // What a side has below the cut lies between its corners, and is less red than all of it.
    let sides: Vec<u8> = faces.iter().filter(|f| f[20] == 0).map(|f| f[13]).collect();
    let red = sides.iter().filter(|red| (1..188).contains(*red));
    assert_eq!(red.count(), 6, "three sides, each in two parts: {sides:?}");
    assert!(
        faces.iter().all(|f| f[20] == 0 || f[13..16] != [0, 0, 60]),
        "{faces:?}"
    );
}

#[test]
fn obj_has_a_group_and_a_material_for_caps() {
    let (folder, text) = exported("obj");
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("mtllib cut.mtl\n"), "the library is named");
    let library = String::from_utf8(bytes(&folder, "cut.mtl")).unwrap();
    for part in cutaway::generate::shapes::shape("gears").unwrap() {
        for name in [part.name.clone(), format!("{}_cap", part.name)] {
            assert!(
                text.contains(&format!("g {name}\nusemtl {name}\nf ")),
                "{name}"
            );
            assert!(library.contains(&format!("newmtl {name}\n")), "{name}");
        }
    }
}

#[test]
fn glb_has_a_primitive_for_caps_on_the_same_vertices() {
    let (_folder, bytes) = exported("glb");
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(
        (&bytes[..4], word(4), word(8)),
        (&b"glTF"[..], 2, bytes.len())
    );
    let json: Value = serde_json::from_slice(&bytes[20..20 + word(12)]).unwrap();
    for mesh in json["meshes"].as_array().unwrap() {
        let primitives = mesh["primitives"].as_array().unwrap();
        assert_eq!(primitives.len(), 2, "{mesh}");
        let position = |i: usize| &primitives[i]["attributes"]["POSITION"];
        assert_eq!(position(0), position(1), "{mesh}");
        let cap = primitives[1]["material"].as_u64().unwrap() as usize;
        let name = json["materials"][cap]["name"].as_str().unwrap();
        assert_eq!(name, format!("{} cap", mesh["name"].as_str().unwrap()));
    }
}

/// The files of an archive.
fn unzipped(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let half = |at: usize| usize::from(u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap()));
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let (mut at, mut files) = (0, Vec::new());
    while bytes[at..].starts_with(b"PK\x03\x04") {
        let name = at + 30..at + 30 + half(at + 26);
        let start = name.end + half(at + 28);
        let packed = &bytes[start..start + word(at + 18)];
        let mut file = Vec::new();
        flate2::read::DeflateDecoder::new(packed)
            .read_to_end(&mut file)
            .unwrap();
        assert_eq!(file.len(), word(at + 22), "its length");
        let mut crc = flate2::Crc::new();
        crc.update(&file);
        assert_eq!(crc.sum() as usize, word(at + 14), "its check sum");
        files.push((String::from_utf8(bytes[name].to_vec()).unwrap(), file));
        at = start + packed.len();
    }
    assert!(
        bytes[at..].starts_with(b"PK\x01\x02"),
        "the directory follows"
    );
    files
}

#[test]
fn three_mf_is_a_package_with_units_objects_and_materials() {
    let folder = Scratch::new("export-3mf");
    folder
        .run("export shape:gears --section z=50% -o cut.3mf --unit in")
        .exits(0);
    let files = unzipped(&bytes(&folder, "cut.3mf"));
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
    );
    let model = String::from_utf8(files[2].1.clone()).unwrap();
    assert!(model.contains("<model unit=\"inch\""), "its unit");
    let parts = cutaway::generate::shapes::shape("gears").unwrap();
    assert_eq!(model.matches("<object ").count(), parts.len());
    assert_eq!(model.matches("<item ").count(), parts.len());
    for part in &parts {
        assert!(model.contains("type=\"model\" pid=\"1\""), "a material");
        assert!(
            model.contains(&format!("name=\"{}\"", part.name)),
            "{}",
            part.name
        );
        assert!(
            model.contains(&format!("<base name=\"{} cap\"", part.name)),
            "{}",
            part.name
        );
    }
    assert!(
        model.matches("pid=\"1\" p1=").count() > 100,
        "caps have a material of their own"
    );
}

#[test]
fn obj_names_are_read_back_whatever_they_were() {
    let folder = Scratch::new("export-obj-names");
    let names = ["a\\\\", "#1", "#2", "plain"];
    folder.write_cubes("parts.toml", &names);
    folder.run("export parts.toml -o cut.obj").exits(0);
    let found: Vec<String> = read(&folder, "cut.obj")
        .parts
        .iter()
        .map(|p| p.name.clone())
        .collect();
    assert_eq!(found, ["a_", "_1", "_2", "plain"]);
    assert!(facts(&folder, "cut.obj").closed);
}

#[test]
fn a_unit_that_a_model_has_is_kept() {
    let folder = Scratch::new("export-units");
    folder
        .run("export shape:cube --section z=50% -o in.3mf --unit in")
        .exits(0);
    folder
        .run("export shape:cube --section z=50% -o metres.glb")
        .exits(0);
    folder
        .run("export shape:cube --section z=50% -o none.stl")
        .exits(0);
    for (model, options, unit, is_guessed) in [
        ("in.3mf", "", "inch", false),
        ("metres.glb", "", "meter", false),
        ("none.stl", "", "millimeter", true),
        ("none.stl in.3mf", "", "millimeter", true),
        ("in.3mf", "--unit cm", "centimeter", false),
    ] {
        let ran = folder
            .run(&format!(
                "export {model} --section x=50% -o out.3mf {options}"
            ))
            .exits(0);
        let model_part = unzipped(&bytes(&folder, "out.3mf"))[2].1.clone();
        let text = String::from_utf8(model_part).unwrap();
        assert!(text.contains(&format!("<model unit=\"{unit}\"")), "{model}");
        let says = ran.stderr.contains("nothing says how long a unit");
        assert_eq!(says, is_guessed, "{model}: {}", ran.stderr);
    }
}

#[test]
fn what_is_far_from_the_origin_keeps_its_shape_in_glb() {
    let folder = Scratch::new("export-far");
    folder.write(
        "far.toml",
        "[[part]]\nshape = \"sphere\"\ntranslate = [500000, 4600000, 100]\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n",
    );
    for name in ["far.glb", "far.ply"] {
        let ran = folder.run(&format!("export far.toml -o {name}")).exits(0);
        assert!(
            !ran.stderr.contains("rounds coordinates"),
            "{name}: {}",
            ran.stderr
        );
    }
    let [glb, ply] = ["far.glb", "far.ply"].map(|name| facts(&folder, name).volume);
    assert!((glb - ply).abs() < 1e-6 * ply, "{glb} and {ply}");
    let ran = folder.run("export far.toml -o far.stl").exits(0);
    assert!(ran.stderr.contains("rounds coordinates"), "{}", ran.stderr);
    // Smaller than one step of f32 there.
    folder.write(
        "dust.toml",
        "[[part]]\nshape = \"sphere\"\nscale = 0.000001\ntranslate = [500000, 4600000, 100]\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n",
    );
    folder
        .run("export dust.toml -o dust.stl")
        .must_refuse(&["no triangle is left", "help:"]);
}

#[test]
fn the_same_line_gives_the_same_bytes() {
    for extension in ["stl", "ply", "obj", "glb", "3mf"] {
        assert!(
            exported(extension).1 == exported(extension).1,
            "{extension}"
        );
    }
}
