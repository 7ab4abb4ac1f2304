//! The gallery, and the pictures of the other pages: they are there, small enough for the repository, and the commands beside them draw
//! them.

use std::fs;
use std::path::{Path, PathBuf};

use crate::command::cli::command::Scratch;
use crate::common::root;
use crate::common::shares::{Share, in_shares};
use crate::scenes::documents::commands::{run, small, words};

/// Pages that have commands which draw pictures into their folder.
const PAGES: [&str; 2] = ["docs/gallery/index.md", "docs/images/README.md"];

/// Pictures below `docs/images` that no command of its page draws; the page says where they are from.
const OTHERS: [&str; 5] = [
    "crank.png",
    "grid-256-wrong.png",
    "page.png",
    "window.png",
    "wipe.gif",
];

/// Commands of a page, as words without the name of the program.
fn commands(page: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(root().join(page)).expect("a page");
    let lines = text
        .lines()
        .filter_map(|line| line.strip_prefix("cutaway "));
    lines.map(words).collect()
}

/// What a command draws: a file, or a folder of files.
fn drawn(command: &[String]) -> &str {
    let mut options = command.windows(2);
    let found = options.find(|w| ["-o", "--maps", "--heatmaps"].contains(&w[0].as_str()));
    &found.unwrap_or_else(|| panic!("{command:?} draws nothing"))[1]
}

/// The pictures that the pages of a folder show, from the root.
fn shown(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(root().join(folder)).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|e| e != "md") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a page");
        let pieces = text.split("](").skip(1);
        let names = pieces.filter_map(|piece| piece.split(')').next());
        let is_picture = |n: &&str| [".png", ".gif", ".svg"].iter().any(|e| n.ends_with(e));
        found.extend(names.filter(is_picture).map(|n| Path::new(folder).join(n)));
    }
    found
}

/// Whether a command draws a picture.
fn draws(command: &[String], picture: &Path) -> bool {
    let target = Path::new(drawn(command));
    target == picture || picture.parent() == Some(target)
}

fn bytes_below(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).expect("a folder");
    let sizes = entries.map(|entry| {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => bytes_below(&path),
            false => fs::metadata(&path).expect("a file").len(),
        }
    });
    sizes.sum()
}

#[test]
fn every_picture_is_there_and_drawn_by_a_command_of_its_page() {
    let all: Vec<_> = PAGES.iter().flat_map(|page| commands(page)).collect();
    let mut pictures = shown("docs/gallery");
    assert!(pictures.len() > 30, "{} pictures", pictures.len());
    pictures.extend(shown("docs"));
    assert!(pictures.len() > 55, "{} pictures", pictures.len());
    let others = OTHERS.map(|name| Path::new("docs/images").join(name));
    let is_drawn = |picture: &Path| all.iter().any(|command| draws(command, picture));
    for picture in &pictures {
        assert!(root().join(picture).is_file(), "{picture:?} is not there");
        let by_hand = picture.starts_with("docs/images/algorithm");
        assert!(
            is_drawn(picture) || others.contains(picture) || by_hand,
            "no command draws {picture:?}"
        );
    }
    assert!(
        !is_drawn(Path::new("docs/gallery/nothing.png")),
        "the control"
    );
    for (folder, most) in [("docs/gallery", 6_000_000), ("docs/images", 4_500_000)] {
        let bytes = bytes_below(&root().join(folder));
        assert!(bytes < most, "{folder} holds {bytes} bytes");
    }
}

in_shares!(every_command_of_the_pages_draws, 4);

fn every_command_of_the_pages_draws(share: Share) {
    let scratch = Scratch::new("gallery");
    for folder in ["docs/gallery", "experiments/scenes"] {
        fs::create_dir_all(scratch.path(folder)).expect("a folder");
        for entry in fs::read_dir(root().join(folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|e| e == "toml") {
                let name = path.file_name().expect("a name");
                fs::copy(&path, scratch.path(folder).join(name)).expect("a copy");
            }
        }
    }
    for command in share.part(PAGES.iter().flat_map(|page| commands(page))) {
        let ran = run(&scratch, &small(&command));
        assert_eq!(ran.code, Some(0), "{command:?}: {}", ran.stderr);
        let target = scratch.path(drawn(&command));
        let is_there = match target.extension() {
            Some(_) => target.is_file(),
            None => fs::read_dir(&target).is_ok_and(|files| files.count() > 2),
        };
        assert!(is_there, "{command:?}: no {target:?}");
    }
}
