//! 3MF: what is wrong with the archive, its relationships, the XML, the objects or the numbers is refused with the part and the line.

use cutaway_io::load::load_mesh_file;

use super::{Scratch, must_be_refused, must_load};
use crate::common::package::{
    archive, components, model, object, package, relationships, tetrahedron,
};

fn whole() -> String {
    model(&object(1, "name=\"a\""), "<item objectid=\"1\"/>")
}

#[test]
fn intact_packages_load() {
    let folder = Scratch::new("package");
    must_load(&folder.write("a.3mf", package(whole(), &[])));
    must_load(&folder.write("A.3MF", package(format!("\u{feff}{}", whole()), &[])));
    let wide = format!("\u{feff}{}", whole()).replace("UTF-8", "UTF-16");
    let wide: Vec<u8> = wide.encode_utf16().flat_map(u16::to_le_bytes).collect();
    must_load(&folder.write("wide.3mf", package(wide, &[])));
    // What is not built may be wrong.
    let resources = object(1, "") + &object(2, "").replace("x=\"1\"", "x=\"nan\"");
    let text = model(&resources, "<item objectid=\"1\"/>");
    must_load(&folder.write("other.3mf", package(&text, &[])));
    let built = text.replace("objectid=\"1\"", "objectid=\"2\"");
    must_be_refused(&folder.write("built.3mf", package(built, &[])), "nan");
}

#[test]
fn changed_models_are_refused_with_their_line() {
    let folder = Scratch::new("package");
    let place = "a.3mf/3D/3dmodel.model:";
    for (from, to, words) in [
        ("x=\"1\"", "x=\"nan\"", &[":8: ", "nan"][..]),
        ("x=\"1\"", "x=\"1e999\"", &[":8: ", "1e999"]),
        ("x=\"1\"", "x=\"one\"", &[":8: ", "`one`"]),
        ("x=\"1\"", "w=\"1\"", &[":8: ", "lacks `x`"]),
        ("v1=\"1\"", "v1=\"4\"", &[":15: ", "vertex 4"]),
        ("v1=\"1\"", "v1=\"-1\"", &[":15: ", "`-1`"]),
        ("v1=\"1\"", "v1=\"4294967296\"", &[":15: ", "4294967296"]),
        ("v1=\"1\"", "", &[":15: ", "lacks `v1`"]),
        ("id=\"1\" name", "name", &[":4: ", "lacks `id`"]),
        (
            "objectid=\"1\"",
            "objectid=\"2\"",
            &[":23: ", "no object 2"],
        ),
        ("objectid=\"1\"", "objectid=\"x\"", &[":23: ", "\"x\""]),
        ("objectid=\"1\"", "", &[":23: ", "lacks `objectid`"]),
        (
            "objectid=\"1\"",
            "objectid=\"1\" transform=\"1 0 0\"",
            &[":23: ", "3 of 12"],
        ),
        (
            "objectid=\"1\"",
            "objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 inf\"",
            &[":23: ", "not finite"],
        ),
        (
            "objectid=\"1\"",
            "objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"",
            &[":23: ", "flat"],
        ),
        ("</mesh>", "</mash>", &[":18: ", "XML"]),
        ("</build>\n</model>", "", &["while 2 elements are open"]),
        ("</model>", "</model><model/>", &[":25: ", "second root"]),
        (
            "<resources>",
            "<!DOCTYPE a [<!ENTITY b \"c\">]>\n<resources>",
            &[":3: ", "document type"],
        ),
        ("name=\"a\"", "name=\"&b;\"", &[":4: ", "name"]),
        ("UTF-8", "ISO-8859-1", &[":1: ", "ISO-8859-1"]),
        ("millimeter", "furlong", &[":2: ", "furlong"]),
        ("<model ", "<modal ", &[":2: ", "<modal>"]),
        (
            "<model ",
            "<model requiredextensions=\"m s\" ",
            &[":2: ", "`s`", "slices"],
        ),
        (
            "<model ",
            "<model requiredextensions=\"b\" ",
            &["`b`", "beams"],
        ),
        (
            "<model ",
            "<model requiredextensions=\"o\" ",
            &["`o`", "intersections of meshes"],
        ),
        (
            "<model ",
            "<model requiredextensions=\"u\" ",
            &["`u`", "example.org", "not known"],
        ),
        (
            "<model ",
            "<model requiredextensions=\"q\" ",
            &["`q`", "does not declare"],
        ),
        ("name=\"a\"", "type=\"solid\"", &["object 1", "\"solid\""]),
        (
            "name=\"a\"",
            "type=\"support\"",
            &["its build contains no solid"],
        ),
    ] {
        assert!(whole().contains(from), "{from} is not there");
        let text = whole().replacen(from, to, 1);
        let path = folder.write("a.3mf", package(text, &[]));
        for word in words {
            must_be_refused(&path, word);
        }
        if words[0].starts_with(':') {
            must_be_refused(&path, place);
        }
    }
    must_be_refused(
        &folder.write("b.3mf", package(whole().replace("build>", "built>"), &[])),
        "no <build>",
    );
    let bytes = whole()
        .replace("name=\"a\"", "name=\"\u{e9}\"")
        .into_bytes();
    let latin: Vec<u8> = bytes.into_iter().filter(|byte| *byte != 0xc3).collect();
    must_be_refused(
        &folder.write("latin.3mf", package(latin, &[])),
        ":4: it is not UTF-8",
    );
    let wide: Vec<u8> = [0xfeff]
        .into_iter()
        .chain(whole().chars().map(u32::from))
        .flat_map(u32::to_le_bytes)
        .collect();
    must_be_refused(&folder.write("wide.3mf", package(wide, &[])), "UTF-32");
    let empty = tetrahedron([""; 4]);
    let empty = whole().replace(&empty, "<mesh><vertices/><triangles/></mesh>");
    must_be_refused(
        &folder.write("none.3mf", package(&empty, &[])),
        "its build contains no solid",
    );
    let other = empty.replace("<mesh><vertices/><triangles/></mesh>", "<o:booleanshape/>");
    must_be_refused(
        &folder.write("other.3mf", package(other, &[])),
        "<o:booleanshape>",
    );
}

#[test]
fn a_package_leads_to_one_model() {
    let folder = Scratch::new("package");
    let model = whole();
    let to = |target: &str, kind: &str| {
        format!(
            "<Relationship Target=\"{target}\" Id=\"a\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/{kind}\"/>"
        )
    };
    let with = |name: &str, all: &str| {
        let all = relationships(all);
        let parts = [
            ("_rels/.rels", all.as_bytes()),
            ("3d/My model.MODEL", model.as_bytes()),
        ];
        folder.write(name, archive(&parts))
    };
    must_load(&with("a.3mf", &to("/3D/my%20model.model", "3dmodel")));
    for (all, word) in [
        (String::new(), "no relationship"),
        (to("/3d/My model.MODEL", "thumbnail"), "no relationship"),
        (to("/3D/b.model", "3dmodel"), "no part \"/3D/b.model\""),
        (to("../b", "3dmodel"), "no part \"../b\""),
        (to("/a", "3dmodel") + &to("/b", "3dmodel"), "2 3D models"),
        ("<Relationship".to_owned(), "XML"),
    ] {
        must_be_refused(&with("b.3mf", &all), word);
    }
    must_be_refused(&folder.write("c.3mf", archive(&[])), "_rels/.rels");
    must_be_refused(
        &folder.write("a.3mf.gz", super::gzipped(&package(whole(), &[]))),
        "gzipped",
    );
}

#[test]
fn components_in_a_ring_or_without_end_are_refused() {
    let folder = Scratch::new("package");
    let item = "<item objectid=\"1\"/>";
    let ring = components(1, "", &["objectid=\"2\""]) + &components(2, "", &["objectid=\"1\""]);
    let path = folder.write("ring.3mf", package(model(&ring, item), &[]));
    must_be_refused(&path, "object 1 is a component of itself: 1 > 2 > 1");
    must_be_refused(&path, "ring.3mf/3D/3dmodel.model:11: ");
    let twice = |id: u32| format!("objectid=\"{id}\"");
    let chain = |count: u32, of: usize| {
        let of_each = |id| components(id, "", &vec![twice(id + 1).as_str(); of]);
        (1..count).map(of_each).collect::<String>() + &object(count, "")
    };
    must_load(&folder.write("deep.3mf", package(model(&chain(60, 1), item), &[])));
    let deeper = package(model(&chain(300, 1), item), &[]);
    must_be_refused(&folder.write("deeper.3mf", deeper), "nested more than");
    let bomb = package(model(&chain(40, 2), item), &[]);
    must_be_refused(&folder.write("bomb.3mf", bomb), "more than 65536 objects");
    let twice = object(1, "") + &object(1, "");
    let path = folder.write("twice.3mf", package(model(&twice, item), &[]));
    must_be_refused(&path, "second object has the number 1");
    let far = "<item objectid=\"1\" transform=\"1e200 0 0 0 1e200 0 0 0 1e200 0 0 0\"/>";
    let far = components(
        1,
        "",
        &["objectid=\"2\" transform=\"1e200 0 0 0 1e200 0 0 0 1e200 0 0 0\""],
    ) + &object(2, "")
        + far;
    let far = far.split_at(far.find("<item").unwrap());
    must_be_refused(
        &folder.write("far.3mf", package(model(far.0, far.1), &[])),
        "combined transform of object",
    );
}

#[test]
fn elements_without_end_are_refused() {
    let folder = Scratch::new("package");
    let deep = "<a>".repeat(70_000);
    let text = whole().replace("<build>", &format!("{deep}<build>"));
    must_be_refused(
        &folder.write("deep.3mf", package(text, &[])),
        "nested more than",
    );
}

#[test]
fn an_archive_that_unpacks_without_end_is_refused() {
    let folder = Scratch::new("package");
    // The control: little may pack as well as it likes.
    let spaces = |count: usize| whole() + &" ".repeat(count);
    must_load(&folder.write("spaces.3mf", package(spaces(1 << 20), &[])));
    let bomb = package(spaces(65 << 20), &[]);
    assert!(bomb.len() * 250 < 65 << 20, "{} bytes", bomb.len());
    must_be_refused(&folder.write("bomb.3mf", bomb), "unpack to more than");
}

#[test]
fn sizes_that_the_archive_states_are_not_believed() {
    let folder = Scratch::new("package");
    let bytes = package(whole(), &[]);
    let starts = |mark: &[u8]| -> Vec<usize> {
        let all = bytes.windows(4).enumerate();
        all.filter(|(_, w)| *w == mark).map(|(at, _)| at).collect()
    };
    // Packed and unpacked sizes, in the headers and in the directory.
    let places = starts(b"PK\x03\x04")
        .into_iter()
        .flat_map(|at| [at + 18, at + 22]);
    let places = places.chain(
        starts(b"PK\x01\x02")
            .into_iter()
            .flat_map(|at| [at + 20, at + 24]),
    );
    for at in places {
        for size in [0, 1, 0x7fff_ffff, 0xffff_fffe_u32] {
            let mut lying = bytes.clone();
            lying[at..at + 4].copy_from_slice(&size.to_le_bytes());
            // Some of the numbers are there twice and only one is used.
            if let Err(e) = load_mesh_file(&folder.write("lying.3mf", lying)) {
                assert!(e.to_string().contains("help:"), "{e}");
            }
        }
    }
    let mut entries = bytes;
    let end = entries.len() - 22;
    entries[end + 8..end + 12].fill(0xff);
    must_be_refused(&folder.write("entries.3mf", entries), "ZIP");
}

#[test]
fn no_prefix_and_no_changed_byte_crashes() {
    let folder = Scratch::new("package");
    let bytes = package(whole(), &[]);
    for length in 0..bytes.len() {
        let path = folder.write("prefix.3mf", &bytes[..length]);
        must_be_refused(&path, "help:");
    }
    for at in 0..bytes.len() {
        for new in [0, 0xff] {
            let mut changed = bytes.clone();
            changed[at] = new;
            // Some bytes of an archive mean nothing; what matters is that this returns.
            let _ = load_mesh_file(&folder.write("changed.3mf", &changed));
        }
    }
    let text = whole();
    for length in (0..text.trim_end().len()).step_by(3) {
        let path = folder.write("text.3mf", package(&text[..length], &[]));
        must_be_refused(&path, "text.3mf/3D/3dmodel.model");
    }
}
