//! Promise: of a 3MF file every mesh that its build names is a part where the build puts it, in its colours and by its name; what is no
//! solid or cannot be drawn is said. What is written as 3MF is read as it was. The samples of the format's consortium are read, those that
//! it wants refused for their geometry are refused.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use cutaway::scene::Topology;
use cutaway_io::load::{Loaded, load_mesh_file};
use glam::{DVec3, Vec3};

use crate::common::command::Scratch;
use crate::common::data::data;
use crate::common::package::{components, model, object, package, package_of_bytes, tetrahedron};

fn load(folder: &Scratch, model: &str) -> Loaded {
    load_mesh_file(&folder.write("a.3mf", package(model, &[]))).unwrap_or_else(|e| panic!("{e}"))
}

fn names(loaded: &Loaded) -> Vec<&str> {
    loaded.parts.iter().map(|part| part.name.as_str()).collect()
}

fn has_note(loaded: &Loaded, words: &str) -> bool {
    loaded
        .notes
        .iter()
        .any(|note| note.to_string().contains(words))
}

#[test]
fn items_and_components_place_meshes() {
    let folder = Scratch::new("3mf-places");
    let resources = object(1, "name=\"leaf\"")
        + &components(
            2,
            "",
            &[
                "objectid=\"1\"",
                "objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 10 0 0\"",
            ],
        )
        + &components(
            3,
            "name=\"tree\"",
            &["objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 5\""],
        )
        + &object(4, "name=\"unused\"");
    let items =
        "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 0 100 0\"/><item objectid=\"1\"/>";
    let loaded = load(&folder, &model(&resources, items));
    assert_eq!(names(&loaded), ["leaf", "leaf_2", "leaf_3"]);
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
    let of = |index: usize, point| loaded.parts[index].world_from_part.transform_point3(point);
    assert_eq!(of(0, DVec3::X), DVec3::new(2.0, 100.0, 5.0));
    // Rows of the file are where the axes go: x goes to y, y to -x.
    assert_eq!(of(1, DVec3::X), DVec3::new(20.0, 102.0, 5.0));
    assert_eq!(of(1, DVec3::Y), DVec3::new(18.0, 100.0, 5.0));
    assert_eq!(of(2, DVec3::X), DVec3::X);
    let volume = Topology::from_parts(&loaded.parts).volume;
    assert!((volume - 17.0 / 6.0).abs() < 1e-12, "{volume}");
    let meshes = loaded
        .parts
        .iter()
        .map(|part| std::sync::Arc::as_ptr(&part.mesh));
    assert!(
        meshes
            .clone()
            .all(|mesh| Some(mesh) == meshes.clone().next()),
        "one mesh for all places"
    );
}

#[test]
fn parts_are_named_by_what_names_there_are() {
    let folder = Scratch::new("3mf-names");
    let resources = object(1, "name=\"a &amp; b\" partnumber=\"n\"")
        + &object(2, "partnumber=\"number\"")
        + &object(3, "name=\" \"")
        + &object(4, "");
    let items = "<item objectid=\"1\"/><item objectid=\"2\"/><item objectid=\"3\"/><item objectid=\"4\" partnumber=\"item\"/>";
    let loaded = load(&folder, &model(&resources, items));
    assert_eq!(names(&loaded), ["a & b", "number", "object_3", "item"]);
    let alone = load(
        &folder,
        &model(&object(1, "name=\"x\""), "<item objectid=\"1\"/>"),
    );
    assert_eq!(
        names(&alone),
        ["a"],
        "one part is named after its file, as of any format"
    );
}

#[test]
fn only_objects_of_the_type_model_are_solids() {
    let folder = Scratch::new("3mf-types");
    let types = ["model", "support", "solidsupport", "surface", "other"];
    let resources: String = (1..)
        .zip(types)
        .map(|(id, kind)| object(id, &format!("type=\"{kind}\"")))
        .collect();
    let items: String = (1..6)
        .map(|id| format!("<item objectid=\"{id}\"/>"))
        .collect();
    let loaded = load(&folder, &model(&resources, &items));
    assert_eq!(loaded.parts.len(), 1);
    for kind in &types[1..] {
        assert!(
            has_note(&loaded, &format!("`{kind}`")),
            "{kind}: {:?}",
            loaded.notes
        );
    }
}

#[test]
fn colours_are_of_materials_groups_and_corners() {
    let folder = Scratch::new("3mf-colours");
    let groups = "<basematerials id=\"10\"><base name=\"red\" displaycolor=\"#FF0000\"/><base name=\"glass\" displaycolor=\"#0000FF80\"/></basematerials>\n\
        <m:colorgroup id=\"11\"><m:color color=\"#00FF00\"/><m:color color=\"#0000FFFF\"/></m:colorgroup>\n\
        <m:compositematerials id=\"12\" matid=\"10\" matindices=\"0 1\"><m:composite values=\"0.4 0.6\"/><m:composite values=\"0.6 0.4\"/></m:compositematerials>\n\
        <m:texture2dgroup id=\"13\" texid=\"1\"><m:tex2coord u=\"0\" v=\"0\"/></m:texture2dgroup>\n\
        <m:multiproperties id=\"14\" pids=\"13 11\"><m:multi pindices=\"0 1\"/></m:multiproperties>\n";
    let of = |attributes: &str, triangles: [&str; 4]| {
        let mesh = tetrahedron(triangles);
        let resources = format!("{groups}<object id=\"1\" {attributes}>{mesh}</object>");
        load(&folder, &model(&resources, "<item objectid=\"1\"/>"))
    };
    let plain = |attributes: &str| {
        let loaded = of(attributes, [""; 4]);
        assert!(
            loaded.parts[0].mesh.vertex_paint.is_none(),
            "one colour needs no coat"
        );
        (loaded.parts[0].material.color, loaded)
    };
    let (color, loaded) = plain("pid=\"10\" pindex=\"0\"");
    assert_eq!(
        (color, loaded.parts[0].materials.as_slice()),
        (Vec3::X, &["red".to_owned()][..])
    );
    assert!(
        !loaded.parts[0].is_transparent && loaded.notes.is_empty(),
        "{:?}",
        loaded.notes
    );
    let (color, loaded) = plain("pid=\"10\" pindex=\"1\"");
    assert!(
        color == Vec3::Z && loaded.parts[0].is_transparent,
        "{color}"
    );
    assert_eq!(plain("pid=\"11\" pindex=\"0\"").0, Vec3::Y);
    let (color, loaded) = plain("pid=\"12\" pindex=\"1\"");
    assert!(
        color == Vec3::X && has_note(&loaded, "4 triangles have several materials"),
        "{:?}",
        loaded.notes
    );
    assert_eq!(plain("pid=\"12\" pindex=\"0\"").0, Vec3::Z);
    assert_eq!(plain("pid=\"14\" pindex=\"0\"").0, Vec3::Z);
    for (pid, words) in [
        ("13", "a texture that is missing"),
        ("99", "that is missing"),
    ] {
        let (_, loaded) = plain(&format!("pid=\"{pid}\" pindex=\"0\""));
        assert!(has_note(&loaded, words), "{:?}", loaded.notes);
    }
    // Most triangles, one triangle, and one by its corners.
    let loaded = of(
        "pid=\"10\" pindex=\"0\"",
        [
            "",
            " pid=\"11\" p1=\"0\"",
            " pid=\"11\" p1=\"0\" p2=\"1\" p3=\"1\"",
            "",
        ],
    );
    assert_eq!(loaded.parts[0].material.color, Vec3::X);
    let vertex_paint = loaded.parts[0].mesh.vertex_paint.as_ref().unwrap();
    let [red, green, blue] = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]];
    let colors: Vec<_> = vertex_paint.triangles.iter().map(|t| t.colors).collect();
    assert_eq!(
        colors,
        [[red; 3], [green; 3], [green, blue, blue], [red; 3]]
    );
}

#[test]
fn images_are_shown_where_all_corners_have_a_place_in_one() {
    let folder = Scratch::new("3mf-images");
    let mut png = std::io::Cursor::new(Vec::new());
    let picture = image::RgbImage::from_pixel(3, 2, image::Rgb([255, 0, 0]));
    picture
        .write_to(&mut png, image::ImageFormat::Png)
        .expect("an image");
    let groups = "<m:texture2d id=\"20\" path=\"/3D/Textures/a.png\" contenttype=\"image/png\"/>\n\
        <m:texture2d id=\"21\" path=\"/3D/Textures/broken.png\" contenttype=\"image/png\"/>\n\
        <m:texture2dgroup id=\"30\" texid=\"20\"><m:tex2coord u=\"0\" v=\"0\"/><m:tex2coord u=\"0.25\" v=\"1\"/></m:texture2dgroup>\n\
        <m:texture2dgroup id=\"31\" texid=\"21\"><m:tex2coord u=\"0\" v=\"0\"/></m:texture2dgroup>\n\
        <m:texture2dgroup id=\"32\" texid=\"21\"><m:tex2coord u=\"0\" v=\"0\"/></m:texture2dgroup>\n\
        <m:colorgroup id=\"33\"><m:color color=\"#00FF00\"/></m:colorgroup>\n\
        <m:multiproperties id=\"34\" pids=\"33 30\"><m:multi pindices=\"0 1\"/></m:multiproperties>\n\
        <m:multiproperties id=\"35\" pids=\"31 33\"><m:multi pindices=\"0 0\"/></m:multiproperties>\n";
    let png = png.into_inner();
    let files = [
        ("3D/Textures/a.png", &png[..]),
        ("3D/Textures/broken.png", b"no image".as_slice()),
    ];
    let read = |triangles: [&str; 4]| {
        let mesh = tetrahedron(triangles);
        let resources = format!("{groups}<object id=\"1\">{mesh}</object>");
        let model = model(&resources, "<item objectid=\"1\"/>");
        let path = folder.write("a.3mf", package_of_bytes(&model, &files));
        load_mesh_file(&path).unwrap_or_else(|e| panic!("{e}"))
    };
    let loaded = read([
        " pid=\"30\" p1=\"0\" p2=\"1\" p3=\"0\"",
        " pid=\"31\" p1=\"0\"",
        " pid=\"30\" p1=\"0\" p2=\"7\" p3=\"0\"",
        "",
    ]);
    let vertex_paint = loaded.parts[0]
        .mesh
        .vertex_paint
        .as_ref()
        .expect("an image");
    assert_eq!(vertex_paint.images.len(), 1);
    assert_eq!(vertex_paint.images[0].size(), [3, 2]);
    let shown: Vec<Option<u32>> = vertex_paint.triangles.iter().map(|t| t.image).collect();
    assert_eq!(shown, [Some(0), None, None, None]);
    let uv = vertex_paint.triangles[0].uv.map(|at| at.to_array());
    assert_eq!(uv, [[0.0, 1.0], [0.25, 0.0], [0.0, 1.0]]);
    assert_eq!(vertex_paint.triangles[0].colors, [[255; 4]; 3]);
    let of_broken = loaded
        .notes
        .iter()
        .filter(|n| n.to_string().contains("broken.png"));
    assert_eq!(of_broken.count(), 1, "{:?}", loaded.notes);
    let not_there = "2 triangles have a texture that is missing or cannot be read";
    assert!(has_note(&loaded, not_there), "{:?}", loaded.notes);

    // Of a colour and an image the image is shown, where it could be read.
    let loaded = read([" pid=\"34\" p1=\"0\"", " pid=\"35\" p1=\"0\"", "", ""]);
    let vertex_paint = loaded.parts[0]
        .mesh
        .vertex_paint
        .as_ref()
        .expect("an image");
    let shown: Vec<Option<u32>> = vertex_paint.triangles.iter().map(|t| t.image).collect();
    assert_eq!(shown, [Some(0), None, None, None]);
    assert_eq!(vertex_paint.triangles[1].colors, [[0, 255, 0, 255]; 3]);
}

#[test]
fn other_models_of_the_package_are_read_in_their_unit() {
    let folder = Scratch::new("3mf-production");
    let inner = model(
        &(object(5, "name=\"inner\"") + &components(6, "", &["objectid=\"5\""])),
        "",
    );
    let outer = model(
        &components(
            1,
            "",
            &["objectid=\"6\" p:path=\"/3D/Inner.model\" transform=\"1 0 0 0 1 0 0 0 1 3 0 0\""],
        ),
        "<item objectid=\"1\"/><item objectid=\"5\" p:path=\"/3D/inner.model\"/>",
    );
    let with = |inner: &str| {
        let bytes = package(&outer, &[("3D/inner.model", inner)]);
        load_mesh_file(&folder.write("a.3mf", bytes)).unwrap_or_else(|e| panic!("{e}"))
    };
    let loaded = with(&inner);
    assert_eq!(names(&loaded), ["inner", "inner_2"]);
    let x = |loaded: &Loaded| loaded.parts[0].world_from_part.transform_point3(DVec3::X).x;
    assert!(
        (x(&loaded) - 4.0).abs() < 1e-12 && loaded.notes.is_empty(),
        "{:?}",
        loaded.notes
    );
    let loaded = with(&inner.replace("millimeter", "inch"));
    assert!((x(&loaded) - 28.4).abs() < 1e-12, "{}", x(&loaded));
    assert!(has_note(&loaded, "inch"), "{:?}", loaded.notes);
    for (from, to, word) in [
        ("<resources>", "<resources", "a.3mf/3D/inner.model:"),
        ("<mesh>", "<mash>", "a.3mf/3D/inner.model:"),
        ("id=\"6\"", "id=\"7\"", "no object 6 in /3D/Inner.model"),
    ] {
        let bytes = package(&outer, &[("3D/inner.model", &inner.replace(from, to))]);
        let said = load_mesh_file(&folder.write("a.3mf", bytes))
            .unwrap_err()
            .to_string();
        assert!(said.contains(word) && said.contains("help:"), "{said}");
    }
}

#[test]
fn units_and_what_is_passed_over_are_said() {
    let folder = Scratch::new("3mf-notes");
    let text = model(&object(1, ""), "<item objectid=\"1\"/>");
    let inch = load(&folder, &text.replace("millimeter", "inch"));
    assert!(
        has_note(&inch, "its unit of length is the inch"),
        "{:?}",
        inch.notes
    );
    assert_eq!(
        inch.parts[0].mesh.positions[1],
        DVec3::X,
        "numbers stay as they are"
    );
    let unknown = load(
        &folder,
        &text.replace("<resources>", "<resources><u:thing><u:a/></u:thing>"),
    );
    assert!(
        has_note(&unknown, "ignored <u:thing>"),
        "{:?}",
        unknown.notes
    );
    let beams = text.replace(
        "</mesh>",
        "<b:beamlattice><b:beams/></b:beamlattice></mesh>",
    );
    let beams = load(&folder, &beams);
    assert!(has_note(&beams, "beams are not drawn"), "{:?}", beams.notes);
}

#[test]
fn what_is_written_is_read_as_it_was() {
    let folder = Scratch::new("3mf-round-trip");
    folder
        .run("export shape:gears --section z=50% -o cut.3mf --unit mm")
        .exits(0);
    folder
        .run("export cut.3mf --section x=-1000 -o again.3mf --unit mm")
        .exits(0);
    folder
        .run("export shape:gears --section z=50% -o cut.obj")
        .exits(0);
    let [of, again, obj] =
        ["cut.3mf", "again.3mf", "cut.obj"].map(|name| load_mesh_file(&folder.path(name)).unwrap());
    let whole = cutaway::generate::shapes::shape("gears").unwrap();
    assert_eq!(
        names(&of),
        whole
            .iter()
            .map(|part| part.name.as_str())
            .collect::<Vec<_>>()
    );
    assert_eq!(names(&again), names(&of));
    for (part, index) in of.parts.iter().zip(0..) {
        let name = &part.name;
        let facts = Topology::from_parts(std::slice::from_ref(part));
        assert!(
            facts.closed && facts.inconsistent_edges == 0,
            "{name} is open"
        );
        assert_eq!(
            part.mesh.positions, obj.parts[index].mesh.positions,
            "{name}: an OBJ has the same f64s"
        );
        assert_eq!(
            part.mesh.triangles, obj.parts[index].mesh.triangles,
            "{name}"
        );
        assert_eq!(
            part.mesh.positions, again.parts[index].mesh.positions,
            "{name}"
        );
        assert_eq!(
            part.mesh.triangles.len(),
            again.parts[index].mesh.triangles.len(),
            "{name}"
        );
        let off = (part.material.color - whole[index].material.color)
            .abs()
            .max_element();
        assert!(off < 1.0 / 250.0, "{name} has another colour");
        assert_eq!(part.materials, [name.clone(), format!("{name} cap")]);
        let vertex_paint = part.mesh.vertex_paint.as_ref().unwrap();
        let bytes = |color: Vec3| (color * 255.0).round().as_u8vec3().extend(255).to_array();
        let (face, cap) = (
            bytes(whole[index].material.color),
            bytes(whole[index].material.cap_color()),
        );
        for (of, count) in [(face, 100), (cap, 10)] {
            let found = vertex_paint
                .triangles
                .iter()
                .filter(|t| t.colors == [of; 3])
                .count();
            assert!(found > count, "{name}: {found} triangles are {of:?}");
        }
    }
}

#[test]
fn the_command_and_scenes_take_it() {
    let folder = Scratch::new("3mf-command");
    let resources = object(1, "name=\"one\"") + &object(2, "name=\"two\"");
    let text = model(
        &resources,
        "<item objectid=\"1\"/><item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 3 0 0\"/>",
    );
    folder.write("a.3mf", package(&text, &[]));
    let json = folder.run("inspect a.3mf --json -").exits(0).json();
    assert_eq!(json["parts"][1]["name"], "two");
    assert_eq!(json["parts"][1]["closed"], true);
    folder.write("scene.toml", "[[part]]\nmesh = \"a.3mf\"\n");
    folder
        .run("export scene.toml --section z=50% -o out.stl")
        .exits(0);
    folder.write(
        "broken.3mf",
        package(text.replace("v1=\"1\"", "v1=\"9\""), &[]),
    );
    folder
        .run("inspect broken.3mf")
        .must_refuse(&["broken.3mf/3D/3dmodel.model:15: ", "vertex 9"]);
}

#[test]
fn its_up_axis_is_defined_and_not_guessed() {
    let folder = Scratch::new("3mf-up");
    let text = model(&object(1, ""), "<item objectid=\"1\"/>");
    folder.write("a.3mf", package(text, &[]));
    folder.run("export a.3mf --section z=50% -o a.stl").exits(0);
    for (name, is_guessed) in [("a.3mf", false), ("a.stl", true)] {
        let line = format!("--section z=50% --resolution 16,16 --save {name}.toml -o {name}.png");
        let ran = folder.run(&format!("render {name} {line}")).exits(0);
        assert_eq!(
            ran.stderr.contains("up is guessed"),
            is_guessed,
            "{}",
            ran.stderr
        );
        let scene = std::fs::read_to_string(folder.path(&format!("{name}.toml"))).unwrap();
        assert!(is_guessed || scene.contains("up = \"+Z\""), "{scene}");
    }
}

/// Parts, triangles and volume of samples, the volumes as trimesh 4 has them.
const SAMPLES: [(&str, usize, usize, f64); 20] = [
    ("box.3mf", 1, 12, 6000.0),
    ("box_prod.3mf", 1, 12, 6000.0),
    ("box_sliced.3mf", 1, 12, 6188.030670624),
    ("cube_gears_prod.3mf", 17, 25692, 112366.328248564),
    ("cylinder.3mf", 1, 88, 6198.101851213),
    ("dodeca_chain_loop.3mf", 1, 7680, 32583.878670282),
    ("dodeca_chain_loop_color.3mf", 1, 7680, 32583.878670282),
    ("multiple_cylinders.3mf", 6, 528, 37188.5572536),
    ("multiprop-opaque.3mf", 1, 12, 1000.0),
    (
        "mustpass/MUSTPASS_Chapter2.2_PartNaming.3mf",
        1,
        12,
        16387.064,
    ),
    (
        "mustpass/MUSTPASS_Chapter3.2c_MultipleItemsTransform.3mf",
        2,
        60,
        14000.0028,
    ),
    (
        "mustpass/MUSTPASS_Chapter3.4.2_MetaData_Resources_Build.3mf",
        1,
        12,
        1000.0,
    ),
    (
        "mustpass/MUSTPASS_Chapter3.4.3a_MustNotOutputNonReferencedObjects.3mf",
        1,
        12,
        1000.0,
    ),
    (
        "mustpass/MUSTPASS_Chapter4.2_Components.3mf",
        2,
        60,
        14000.0028,
    ),
    ("pyramid_vertexcolor.3mf", 1, 4, 333.333333333),
    ("rhombicuboctahedron_color.3mf", 1, 44, 1089262.183320344),
    ("sphere.3mf", 1, 2880, 4172.802690004),
    ("sphere_logo.3mf", 1, 3032, 33382.414646948),
    ("torus.3mf", 1, 2200, 776.830794973),
    ("torus_proc.3mf", 1, 2200, 776.831077147),
];

#[test]
fn samples_of_the_consortium_are_read() {
    let Some(data) = data() else { return };
    for (name, parts, triangles, volume) in SAMPLES {
        let loaded = load_mesh_file(&data.join("3mf").join(name)).unwrap_or_else(|e| panic!("{e}"));
        let facts = Topology::from_parts(&loaded.parts);
        assert_eq!(
            (loaded.parts.len(), facts.faces),
            (parts, triangles),
            "{name}"
        );
        let off = (facts.volume - volume).abs();
        assert!(off < 1e-6 * volume, "{name}: {} and {volume}", facts.volume);
    }
}

#[test]
fn samples_for_conformance_are_read_or_refused() {
    let Some(data) = data() else { return };
    let files = |folder: &str| -> Vec<std::path::PathBuf> {
        let all = std::fs::read_dir(data.join("3mf").join(folder)).unwrap();
        all.map(|entry| entry.unwrap().path()).collect()
    };
    let passing = files("mustpass");
    assert!(passing.len() > 10, "{passing:?}");
    for path in passing {
        let loaded = load_mesh_file(&path).unwrap_or_else(|e| panic!("{e}"));
        assert!(!loaded.parts.is_empty(), "{}", path.display());
    }
    let mut read = Vec::new();
    for path in files("mustfail") {
        match load_mesh_file(&path) {
            Ok(loaded) => {
                assert!(!loaded.notes.is_empty(), "{}", path.display());
                read.push(path.file_name().unwrap().to_string_lossy().into_owned());
            }
            Err(e) => assert!(e.to_string().contains("help:"), "{e}"),
        }
    }
    read.sort();
    // No matter of geometry: an element of no known namespace, and colours that are given twice.
    assert_eq!(
        read,
        [
            "MUSTFAIL_Chapter2.3.2d_UndefinedXMLXSIInXSDSchema.3mf",
            "MUSTFAIL_Chapter5a_DuplicatedBaseMaterials.3mf",
        ]
    );
}
