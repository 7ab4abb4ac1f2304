//! 3MF as slicers write projects: modifiers, negative parts and regions of supports are no solids.

use super::*;
use crate::common::package::{components, model, object, package, tetrahedron};
use command::Scratch;

/// The note on a use that a slicer has for a mesh.
const USES: [(&str, &str, &str); 3] = [
    ("ParameterModifier", "modifier_part", "a modifier"),
    ("NegativeVolume", "negative_part", "not subtracted"),
    ("SupportBlocker", "support_blocker", "supports"),
];

#[test]
fn volumes_of_one_mesh_are_left_out_by_their_triangles() {
    let folder = Scratch::new("foreign-3mf");
    // Two tetrahedra in one mesh, of which the second is a volume of its own.
    let one = tetrahedron([""; 4]);
    let (vertices, triangles) = one.split_once("</vertices>").unwrap();
    let second = vertices
        .replace("<mesh>\n<vertices>", "")
        .replace("x=\"0\"", "x=\"5\"")
        .replace("x=\"1\"", "x=\"6\"");
    let shifted = triangles
        .replace("</triangles>\n</mesh>", "")
        .replace("<triangles>", "")
        .replace("\"3\"", "\"7\"")
        .replace("\"2\"", "\"6\"")
        .replace("\"1\"", "\"5\"")
        .replace("\"0\"", "\"4\"");
    let first = triangles.replace("</triangles>\n</mesh>", "");
    let both = format!(
        "<object id=\"1\" type=\"model\">\n{vertices}{second}</vertices>{first}{shifted}</triangles>\n</mesh>\n</object>"
    );
    let text = model(&both, "<item objectid=\"1\"/>");
    let config = |kind: &str| {
        let volume = |first: usize, last: usize, kind: &str| {
            format!(
                "<volume firstid=\"{first}\" lastid=\"{last}\"><metadata type=\"volume\" key=\"volume_type\" value=\"{kind}\"/></volume>"
            )
        };
        format!(
            "<config><object id=\"1\">{}{}</object></config>",
            volume(0, 3, "ModelPart"),
            volume(4, 7, kind)
        )
    };
    let read = |others: &[(&str, &str)]| open(&folder.write("a.3mf", package(&text, others)));
    let volume = |loaded: &Loaded| 6.0 * Topology::from_parts(&loaded.parts).volume;
    for (kind, _, words) in USES {
        let loaded = read(&[("Metadata/Slic3r_PE_model.config", &config(kind))]);
        assert!(
            (volume(&loaded) - 1.0).abs() < 1e-9,
            "{kind}: {}",
            volume(&loaded)
        );
        must_say(&loaded, words, kind);
    }
    // The controls: a part of the model stays, and what cannot be read is said.
    let all = read(&[("Metadata/Slic3r_PE_model.config", &config("ModelPart"))]);
    assert!((volume(&all) - 2.0).abs() < 1e-9);
    let broken = read(&[("Metadata/Slic3r_PE_model.config", "<config><object")]);
    assert!((volume(&broken) - 2.0).abs() < 1e-9);
    must_say(
        &broken,
        "Slic3r_PE_model.config cannot be read",
        "a broken file",
    );
}

#[test]
fn components_are_left_out_by_their_use() {
    let folder = Scratch::new("foreign-3mf");
    let resources =
        object(1, "") + &object(2, "") + &components(3, "", &["objectid=\"1\"", "objectid=\"2\""]);
    let text = model(&resources, "<item objectid=\"3\"/>");
    for (_, kind, words) in USES {
        let config = format!(
            "<config><object id=\"3\"><part id=\"1\" subtype=\"normal_part\"/><part id=\"2\" subtype=\"{kind}\"/></object></config>"
        );
        let others = [("Metadata/model_settings.config", config.as_str())];
        let loaded = open(&folder.write("a.3mf", package(&text, &others)));
        assert_eq!(loaded.parts.len(), 1, "{kind}");
        must_say(&loaded, words, kind);
    }
}

#[test]
fn objects_are_left_out_by_their_settings() {
    let folder = Scratch::new("foreign-3mf");
    let read = |settings: &str| {
        let other = object(2, "").replacen("<mesh>", &format!("{settings}<mesh>"), 1);
        let resources = object(1, "") + &other;
        let items = "<item objectid=\"1\"/><item objectid=\"2\"/>";
        open(&folder.write("a.3mf", package(model(&resources, items), &[])))
    };
    let as_metadata = |name: &str, value: &str| {
        format!(
            "<metadatagroup><metadata name=\"cura:{name}\" type=\"xs:string\">{value}</metadata></metadatagroup>"
        )
    };
    for (name, words) in [
        ("infill_mesh", "a modifier"),
        ("cutting_mesh", "a modifier"),
        ("support_mesh", "supports"),
        ("anti_overhang_mesh", "supports"),
    ] {
        let old = format!(
            "<settings xmlns=\"http://software.ultimaker.com/xml/cura/3mf/2015/10\"><setting key=\"{name}\">True</setting></settings>"
        );
        for settings in [as_metadata(name, "True"), old] {
            let loaded = read(&settings);
            assert_eq!(loaded.parts.len(), 1, "{settings}");
            must_say(&loaded, words, &settings);
        }
        // The controls: it is off, or it is another.
        assert_eq!(read(&as_metadata(name, "False")).parts.len(), 2, "{name}");
    }
    assert_eq!(
        read(&as_metadata("infill_line_width", "True")).parts.len(),
        2
    );
    assert_eq!(read("<metadatagroup/>").parts.len(), 2);
}
