//! Embeds the files of `shaders/`: each as its path in the tree and its text, modules of `lib/` apart from whole shaders.
//!
//! Lines of comments are embedded as empty lines: a third of the text, which a page in a browser would send, and lines keep their numbers.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed=shaders");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("shaders");
    let mut files = Vec::new();
    walk(&root, &mut files)?;
    files.sort();
    let mut source = String::new();
    for (name, is_library, about) in [
        (
            "LIBRARY",
            true,
            "Modules. A module path that several files define is *open*: who composes a shader says which of them fills it.",
        ),
        ("SHADERS", false, "Whole shaders."),
    ] {
        writeln!(
            source,
            "/// {about}\npub const {name}: &[(&str, &str)] = &["
        )?;
        for file in &files {
            let path = file
                .strip_prefix(&root)?
                .to_string_lossy()
                .replace('\\', "/");
            if path.starts_with("lib/") == is_library {
                let text = without_comments(&fs::read_to_string(file)?);
                writeln!(source, "    ({path:?}, {text:?}),")?;
            }
        }
        writeln!(source, "];")?;
    }
    fs::write(
        PathBuf::from(env::var("OUT_DIR")?).join("shaders.rs"),
        source,
    )?;
    Ok(())
}

fn without_comments(text: &str) -> String {
    let is_comment = |line: &str| line.trim_start().starts_with("//");
    let kept = text
        .lines()
        .map(|line| if is_comment(line) { "" } else { line });
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// Adds the files of WGSL below a folder.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else if path.extension().is_some_and(|e| e == "wgsl") {
            files.push(path);
        }
    }
    Ok(())
}
