//! Identity of a record: a hash of the point, the files it depends on, the program and the device. If a record on disk has a point's
//! identity, measuring the point again would give the same errors, so the record is kept.
//!
//! A scene is identified by its document, by the contents of the files that the document names, and by the contents of the files that
//! those files name in turn: glTF buffers and OBJ material libraries.

use std::path::Path;

use cutaway_io::document::Document;
use cutaway_io::load::Disk;

/// The 64-bit FNV-1a hash of Fowler, Noll and Vo: it is the same on all machines and with all compilers, and takes three lines of code.
#[derive(Clone, Copy, Debug)]
pub struct Identity(u64);

impl Default for Identity {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Identity {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds a property of the point. Two texts added separately give another hash than their concatenation.
    pub fn add(&mut self, text: impl AsRef<str>) {
        self.bytes(text.as_ref().as_bytes());
        self.bytes(&[0xff]);
    }

    /// Adds bytes that do not come from a file.
    pub fn add_bytes(&mut self, bytes: &[u8]) {
        self.bytes(bytes);
    }

    /// Adds a file by its contents, or by its name if it cannot be read.
    pub fn add_file(&mut self, path: &Path) {
        match std::fs::read(path) {
            Ok(bytes) => self.bytes(&bytes),
            Err(_) => self.add(path.to_string_lossy()),
        }
        self.bytes(&[0xff]);
    }

    /// Adds a document and the files that it names.
    pub fn add_document(&mut self, document: &Document) {
        self.add(document.to_string());
        for file in document.files(&Disk) {
            self.add_file(&file);
        }
    }

    /// The hash as text, as written into records.
    pub fn text(self) -> String {
        format!("{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(document: &Document) -> String {
        let mut identity = Identity::default();
        identity.add_document(document);
        identity.text()
    }

    #[test]
    fn the_hash_is_the_published_one() {
        let mut identity = Identity::default();
        identity.bytes(b"foobar");
        assert_eq!(identity.text(), "85944171f73967e8");
    }

    #[test]
    fn a_scene_is_its_document_and_its_files() {
        let folder = std::env::temp_dir().join(format!("cutaway-identity-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
        write("walk_1.ply", "frame");
        write(
            "a.gltf",
            "{ \"asset\": { \"version\": \"2.0\" }, \"buffers\": [{ \"byteLength\": 1, \"uri\": \"a.bin\" }] }",
        );
        write("a.obj", "mtllib a.mtl\n");
        for (key, file) in [
            ("part = [{ mesh = \"b.stl\" }]", "b.stl"),
            ("part = [{ mesh = \"walk_%d.ply\" }]", "walk_1.ply"),
            ("part = [{ mesh = \"a.gltf\" }]", "a.bin"),
            ("part = [{ mesh = \"a.obj\" }]", "a.mtl"),
            ("cut = [{ volume = \"b.stl\" }]", "b.stl"),
            ("relief.rock.image = \"b.stl\"", "b.stl"),
        ] {
            let document = Document::parse(folder.join("scene.toml"), key).unwrap();
            write(file, "solid");
            let before = of(&document);
            assert_eq!(before, of(&document), "{key}");
            write(file, "other");
            assert_ne!(before, of(&document), "{key} with another {file}");
            let mut other = document.clone();
            other.set("camera.azimuth_deg", 1.0).unwrap();
            assert_ne!(of(&other), of(&document), "{key} and a camera");
        }
        std::fs::remove_dir_all(folder).unwrap();
    }
}
