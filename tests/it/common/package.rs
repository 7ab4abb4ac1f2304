//! 3MF packages of a few parts.

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

const RELATIONSHIP: &str = "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>";

/// An archive of parts by their names.
pub(crate) fn archive(parts: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in parts {
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        archive.start_file(*name, options).expect("a name");
        archive.write_all(bytes).expect("memory");
    }
    archive.finish().expect("memory").into_inner()
}

/// What `_rels/.rels` is with these relationships.
pub(crate) fn relationships(all: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">{all}</Relationships>"
    )
}

/// A package of a model, and of other parts.
pub(crate) fn package(model: impl AsRef<[u8]>, others: &[(&str, &str)]) -> Vec<u8> {
    let others = others.iter().map(|(name, text)| (*name, text.as_bytes()));
    package_of_bytes(model, &others.collect::<Vec<_>>())
}

/// The same with others that are no text.
pub(crate) fn package_of_bytes(model: impl AsRef<[u8]>, others: &[(&str, &[u8])]) -> Vec<u8> {
    let relationships = relationships(RELATIONSHIP);
    let mut parts = vec![
        ("_rels/.rels", relationships.as_bytes()),
        ("3D/3dmodel.model", model.as_ref()),
    ];
    parts.extend_from_slice(others);
    archive(&parts)
}

/// A model of resources and items, each on lines of its own.
pub(crate) fn model(resources: &str, items: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" \
         xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" \
         xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" \
         xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" \
         xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" \
         xmlns:o=\"http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07\" \
         xmlns:u=\"http://example.org/unknown\">\n\
         <resources>\n{resources}\n</resources>\n<build>\n{items}\n</build>\n</model>\n"
    )
}

/// The mesh of a tetrahedron; `of_triangles` is added to each of its triangles.
pub(crate) fn tetrahedron(of_triangles: [&str; 4]) -> String {
    let [a, b, c, d] = of_triangles;
    format!(
        "<mesh>\n<vertices>\n<vertex x=\"0\" y=\"0\" z=\"0\"/>\n<vertex x=\"1\" y=\"0\" z=\"0\"/>\n\
         <vertex x=\"0\" y=\"1\" z=\"0\"/>\n<vertex x=\"0\" y=\"0\" z=\"1\"/>\n</vertices>\n<triangles>\n\
         <triangle v1=\"0\" v2=\"2\" v3=\"1\"{a}/>\n<triangle v1=\"0\" v2=\"1\" v3=\"3\"{b}/>\n\
         <triangle v1=\"1\" v2=\"2\" v3=\"3\"{c}/>\n<triangle v1=\"0\" v2=\"3\" v3=\"2\"{d}/>\n</triangles>\n</mesh>"
    )
}

/// An object of this number that is a tetrahedron.
pub(crate) fn object(id: u32, attributes: &str) -> String {
    let mesh = tetrahedron([""; 4]);
    format!("<object id=\"{id}\" {attributes}>\n{mesh}\n</object>\n")
}

/// An object of this number that is made of components: what stands in their elements.
pub(crate) fn components(id: u32, attributes: &str, of: &[&str]) -> String {
    let of = of.iter().map(|text| format!("<component {text}/>\n"));
    let of: String = of.collect();
    format!("<object id=\"{id}\" {attributes}>\n<components>\n{of}</components>\n</object>\n")
}
