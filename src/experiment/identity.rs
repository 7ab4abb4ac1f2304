//! What a record is of: the point, the files it is made of, the program, the device. A point whose identity is that of a record on
//! disk would be measured to the same errors, and is kept.
//!
//! Files are known by their contents. A word names one if there is one by that name, or by what follows a `=`, `:` or `,` in it;
//! and scene files, glTF and material lists name others in quotes or by lines, which are followed. Numbered frames
//! (`walk_%04d.ply`) are known by the names and lengths of the files beside them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Hash by Fowler, Noll and Vo (FNV-1a, 64 bits): the same on all machines and with all compilers, and written in three lines.
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

    /// Adds something that is said of the point. What is said apart is not the same as what is said in one.
    pub fn add(&mut self, text: impl AsRef<str>) {
        self.bytes(text.as_ref().as_bytes());
        self.bytes(&[0xff]);
    }

    /// Adds a file by its contents; one that cannot be read by its name.
    pub fn add_file(&mut self, path: &Path) {
        match std::fs::read(path) {
            Ok(bytes) => self.bytes(&bytes),
            Err(_) => self.add(path.to_string_lossy()),
        }
        self.bytes(&[0xff]);
    }

    /// Adds words of the command line, with the files that they name.
    pub fn add_words(&mut self, words: &[String]) {
        words.iter().for_each(|word| self.add(word));
        let (files, patterns) = followed(words);
        files.iter().for_each(|file| self.add_file(file));
        for frame in patterns.iter().flat_map(|pattern| frames_of(pattern)) {
            let bytes = frame.metadata().map_or(0, |m| m.len());
            let name = frame.file_name().unwrap_or_default().to_string_lossy();
            self.add(format!("{name} {bytes}"));
        }
    }

    /// As it is written into records.
    pub fn text(self) -> String {
        format!("{:016x}", self.0)
    }
}

/// The files that words of the command line name, and those that they name in turn.
pub fn files_of(words: &[String]) -> BTreeSet<PathBuf> {
    let (mut files, patterns) = followed(words);
    files.extend(patterns.iter().flat_map(|pattern| frames_of(pattern)));
    files
}

/// Files, and patterns of numbered ones.
fn followed(words: &[String]) -> (BTreeSet<PathBuf>, BTreeSet<PathBuf>) {
    let mut all = BTreeSet::new();
    for name in words.iter().flat_map(|word| pieces(word)) {
        follow(Path::new(name), &mut all);
    }
    all.into_iter().partition(|path| path.is_file())
}

/// The files that could be frames of a pattern, by name.
fn frames_of(pattern: &Path) -> BTreeSet<PathBuf> {
    let name = pattern.file_name().unwrap_or_default().to_string_lossy();
    let start = name.split('%').next().unwrap_or_default();
    let folder = match pattern.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let frames = entries.filter(|e| e.file_name().to_string_lossy().starts_with(start));
    frames.map(|e| e.path()).collect()
}

/// A word, and the parts of it that may be names.
fn pieces(word: &str) -> impl Iterator<Item = &str> {
    let after = word
        .match_indices(['=', ':', ','])
        .map(|(at, _)| &word[at + 1..]);
    let until = |rest: &'_ str, ends: &[char]| rest.find(ends).unwrap_or(rest.len());
    let after = after.flat_map(move |rest| {
        [
            rest,
            &rest[..until(rest, &[','])],
            &rest[..until(rest, &[',', ':'])],
        ]
    });
    std::iter::once(word).chain(after)
}

/// Adds a file, if it is one, and those that it names.
fn follow(path: &Path, files: &mut BTreeSet<PathBuf>) {
    let is_pattern = path.to_string_lossy().contains('%') && path.extension().is_some();
    if !(path.is_file() || is_pattern) || !files.insert(path.to_owned()) {
        return;
    }
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    let names_others = extension.is_some_and(|e| e == "toml" || e == "gltf" || e == "obj");
    let Some(text) = names_others
        .then(|| std::fs::read_to_string(path).ok())
        .flatten()
    else {
        return;
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    // Scene files and glTF name files in quotes, OBJ names its materials after a word.
    let quoted = text.split(['"', '\'']);
    let libraries = text.lines().filter_map(|l| l.strip_prefix("mtllib "));
    for name in quoted.chain(libraries.map(str::trim)) {
        if (1..256).contains(&name.len()) {
            follow(&folder.join(name), files);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(words: &[&str]) -> String {
        let mut identity = Identity::default();
        identity.add_words(&words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>());
        identity.text()
    }

    #[test]
    fn the_hash_is_the_published_one() {
        let mut identity = Identity::default();
        identity.bytes(b"foobar");
        assert_eq!(identity.text(), "85944171f73967e8");
    }

    #[test]
    fn words_are_told_apart() {
        assert_eq!(of(&["a", "b"]), of(&["a", "b"]));
        assert_ne!(of(&["a", "b"]), of(&["ab"]));
        assert_ne!(of(&["a", "b"]), of(&["b", "a"]));
    }

    #[test]
    fn files_count_by_what_is_in_them_wherever_they_are_named() {
        let folder = std::env::temp_dir().join(format!("cutaway-identity-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
        let write = |name: &str, text: &str| std::fs::write(path(name), text).unwrap();
        write("a.toml", "[[part]]\nmesh = \"b.stl\"\n");
        write("walk_1.ply", "frame");
        for (word, file) in [
            (path("b.stl"), "b.stl"),
            (
                format!("--relief=image:{},amplitude=2%", path("b.stl")),
                "b.stl",
            ),
            (format!("--relief={}", path("b.stl")), "b.stl"),
            (format!("--relief={}:wrap=mirror", path("b.stl")), "b.stl"),
            (path("a.toml"), "a.toml"),
            (path("a.toml"), "b.stl"),
            (path("walk_%d.ply"), "walk_2.ply"),
        ] {
            write("b.stl", "solid");
            let before = of(&[&word]);
            assert_eq!(before, of(&[&word]), "{word}");
            write(file, "[[part]]\nmesh = \"b.stl\"\n# other\n");
            assert_ne!(before, of(&[&word]), "{word} with another {file}");
        }
        std::fs::remove_dir_all(folder).unwrap();
    }
}
