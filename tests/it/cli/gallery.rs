//! The gallery: its page shows pictures that are there, small enough for the repository, and its commands draw.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::command::Scratch;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/gallery")
}

fn page() -> String {
    fs::read_to_string(folder().join("README.md")).expect("the page of the gallery")
}

/// Commands of the page, without the name of the program and quotes.
fn commands() -> Vec<String> {
    let page = page();
    let lines = page
        .lines()
        .filter_map(|line| line.strip_prefix("cutaway "));
    lines.map(|line| line.replace('\'', "")).collect()
}

/// The pictures that the page shows, from its folder.
fn shown() -> Vec<String> {
    let page = page();
    let pieces = page.split("](").skip(1);
    let names = pieces.filter_map(|piece| piece.split(')').next());
    let pictures = names.filter(|name| name.ends_with(".png"));
    pictures.map(str::to_owned).collect()
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
fn every_picture_is_there_and_drawn_by_a_command_of_the_page() {
    let commands = commands();
    let shown = shown();
    assert!(shown.len() > 30, "{} pictures", shown.len());
    for name in &shown {
        assert!(folder().join(name).is_file(), "{name} is not there");
        let drawn = format!("-o docs/gallery/{name} ");
        let maps = name
            .rsplit_once('/')
            .map(|(maps, _)| format!("--maps docs/gallery/{maps}"));
        let is_drawn = |c: &String| {
            c.contains(&drawn) || maps.as_ref().is_some_and(|maps| c.ends_with(maps.as_str()))
        };
        assert!(commands.iter().any(is_drawn), "no command draws {name}");
    }
    assert!(
        bytes_below(&folder()) < 6_000_000,
        "the gallery is too large"
    );
}

#[test]
fn every_command_of_the_page_draws() {
    let scratch = Scratch::new("gallery");
    for command in commands() {
        let (said, target) = match command.split_once(" -o docs/gallery/") {
            Some((said, rest)) => {
                let (name, _) = rest.split_once(' ').unwrap_or((rest, ""));
                (
                    format!("{said} -o {name} --resolution 64,48 --supersample 1"),
                    name.to_owned(),
                )
            }
            None => {
                let (said, maps) = command.split_once(" --maps docs/gallery/").expect("maps");
                (
                    format!("{said} --maps {maps}"),
                    format!("{maps}/normal.png"),
                )
            }
        };
        // From wherever it is run.
        let scenes = format!("{}/", folder().display());
        let ran = scratch.run(&said.replace("docs/gallery/", &scenes));
        assert_eq!(ran.code, Some(0), "{command}: {}", ran.stderr);
        assert!(scratch.path(&target).is_file(), "{command}: no {target}");
    }
}
