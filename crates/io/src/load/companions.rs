//! Companion files that a mesh file names, such as glTF buffers and OBJ material libraries. The mesh loader checks them, not this module.
//!
//! The whole file is read, because an OBJ may name a library on any line.

use std::path::{Path, PathBuf};

use super::{Files, format_and_stem, gltf, input_file, mtl};

/// Returns the files that a mesh file names, without the mesh file itself. If the mesh file cannot be read, the list is empty.
pub fn companions(path: &Path, store: &dyn Files) -> Vec<PathBuf> {
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let format = format_and_stem(path).map(|(format, _)| format);
    let bytes = || input_file::read_unpacked(path, store).unwrap_or_default();
    match format.as_deref() {
        Ok("gltf" | "glb") => gltf::named_files(folder, &bytes()),
        Ok("obj") => mtl::libraries(folder, &bytes(), store),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Disk;
    use std::fs;

    #[test]
    fn they_are_named_as_the_loaders_read_them() {
        let folder = std::env::temp_dir().join(format!("cutaway-beside-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let json = "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": 1, \"uri\": \"my%20mesh.bin\"}, {\"byteLength\": 1, \"uri\": \"data:,\"}]}";
        let mut glb = b"glTF\x02\0\0\0".to_vec();
        let padded = format!("{json:<0$}", json.len().next_multiple_of(4));
        glb.extend((padded.len() as u32 + 20).to_le_bytes());
        glb.extend((padded.len() as u32).to_le_bytes());
        glb.extend(b"JSON");
        glb.extend(padded.as_bytes());
        let obj = "# A mesh.\nmtllib\ta.mtl  b.mtl\nv 0 0 0\nmtllib sub\\c.mtl\n";
        for (name, bytes, expected) in [
            ("a.gltf", json.as_bytes(), &["my mesh.bin"][..]),
            ("a.glb", &glb, &["my mesh.bin"]),
            ("a.obj", obj.as_bytes(), &["a.mtl", "b.mtl", "sub/c.mtl"]),
            ("a.stl", obj.as_bytes(), &[]),
        ] {
            let path = folder.join(name);
            fs::write(&path, bytes).expect("a file");
            let expected: Vec<PathBuf> = expected.iter().map(|name| folder.join(name)).collect();
            assert_eq!(companions(&path, &Disk), expected, "{name}");
        }
        fs::remove_dir_all(&folder).expect("a folder");
    }
}
