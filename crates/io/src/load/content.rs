//! Detection of a mesh format from the file content, for data without a file name.
//!
//! Binary formats are recognized by their first bytes, except binary STL, whose header is arbitrary. A binary STL is recognized if its
//! length matches its triangle count. Text formats are recognized by their first words.

use super::lines::lines;
use super::{stl, without_mark};

/// Number of bytes that are inspected at the start of a text.
const HEAD_BYTES: usize = 64 << 10;

/// First words of lines by which an OBJ is recognized.
const OBJ: [&str; 13] = [
    "v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl", "cstype",
];

/// Returns the format of bytes that are not gzipped, as a file extension. Returns `None` if the format is not recognized.
pub fn mesh_format(bytes: &[u8]) -> Option<&'static str> {
    if bytes.starts_with(b"glTF") {
        return Some("glb");
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Some("3mf");
    }
    if stl::is_binary(bytes) {
        return Some("stl");
    }
    let text = without_mark(bytes);
    if text.starts_with(b"ply\n") || text.starts_with(b"ply\r") {
        return Some("ply");
    }
    let text = &text[..text.len().min(HEAD_BYTES)];
    if text.contains(&0) {
        return None;
    }
    let text = String::from_utf8_lossy(text);
    let mut lines = lines(&text).map(str::trim).filter(|l| !l.is_empty());
    let first = lines.clone().next()?;
    if first.starts_with('{') {
        return Some("gltf");
    }
    let word = |line: &str| line.split_whitespace().next().map(str::to_lowercase);
    if word(first).as_deref() == Some("solid") {
        return Some("stl");
    }
    let said = lines.find(|line| !line.starts_with('#'))?;
    let word = said.split_whitespace().next()?;
    OBJ.contains(&word).then_some("obj")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_apart() {
        let mut binary = b"solid but binary".to_vec();
        binary.resize(80, b' ');
        binary.extend(1_u32.to_le_bytes());
        binary.resize(84 + 50, 0);
        for (bytes, format) in [
            (&b"glTF\x02\0\0\0"[..], Some("glb")),
            (b"PK\x03\x04\x14\0", Some("3mf")),
            (&binary, Some("stl")),
            (&binary[..133], None),
            (b"solid a\n facet normal 0 0 1\n", Some("stl")),
            (b"\n  SOLID\n", Some("stl")),
            (b"ply\r\nformat ascii 1.0\r\n", Some("ply")),
            (b"ply\nformat binary_little_endian 1.0\n\0", Some("ply")),
            (b"plywood\n", None),
            (b"\xef\xbb\xbf\n { \"asset\": {} }", Some("gltf")),
            (b"# made by hand\n\nmtllib a.mtl\nv 0 0 0\n", Some("obj")),
            (b"v 0 0 0\n", Some("obj")),
            (b"ISO-10303-21;\nHEADER;\n", None),
            (b"<html>", None),
            (b"# nothing else", None),
            (b"", None),
        ] {
            assert_eq!(
                mesh_format(bytes),
                format,
                "{}",
                String::from_utf8_lossy(bytes)
            );
        }
    }
}
