//! The experiments of this project: each file is one, and each is read and has words that are understood.

use std::path::{Path, PathBuf};

use cutaway_lab::experiment::Definition;

use super::command::Scratch;
use crate::common::root;

fn folder() -> PathBuf {
    root().join("experiments/curated")
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    files.sort();
    files
}

/// Files that are no experiments: nothing would ever run them.
fn strays(folder: &Path) -> Vec<String> {
    let stray = |path: &PathBuf| Definition::load(path).err().map(|e| e.to_string());
    files(folder).iter().filter_map(stray).collect()
}

#[test]
fn every_file_is_an_experiment() {
    let found = files(&folder());
    assert!(!found.is_empty(), "there are experiments");
    assert_eq!(strays(&folder()), Vec::<String>::new());
    let planted = Scratch::new("strays");
    let good = std::fs::read_to_string(&found[0]).unwrap();
    planted.write("01-good.toml", &good);
    assert_eq!(strays(&planted.path("")).len(), 0, "the control");
    planted.write("02-lost.tml", &good);
    planted.write("03-note.md", "of no use");
    planted.write("04-key.toml", good.replace("analysis", "analisis"));
    let seen = strays(&planted.path(""));
    assert_eq!(seen.len(), 3, "{seen:?}");
    assert!(seen[2].contains("did you mean `analysis`"), "{seen:?}");
}

#[test]
fn all_words_are_understood() {
    let scratch = Scratch::new("curated");
    let run = |files: &[PathBuf], quick: &str| {
        let mut command = scratch.command(&format!("measure --dry-run {quick}"));
        // The words of curated experiments are seen from the root of the project.
        let output = command.args(files).current_dir(root());
        super::command::Ran::of("measure --dry-run", output.output().unwrap())
    };
    for quick in ["", "--quick"] {
        let ran = run(&files(&folder()), quick).exits(0);
        assert!(ran.text().contains("01-paper, crank"), "{}", ran.text());
    }
    let good = std::fs::read_to_string(folder().join("01-paper.toml")).unwrap();
    scratch.write("01-planted.toml", good.replace("section = ", "sektion = "));
    let ran = run(&[scratch.path("01-planted.toml")], "").exits(2);
    for phrase in ["01-planted.toml", "run `crank`", "did you mean `section`"] {
        assert!(ran.stderr.contains(phrase), "{}", ran.stderr);
    }
}
