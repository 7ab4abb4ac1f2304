//! The pages of the reference are what the program makes of its tables.

use std::fs;

use super::command::Scratch;
use super::root;

const PAGES: [&str; 2] = ["commands.md", "scene.md"];

/// The first line that differs, with its number.
fn difference(committed: &str, made: &str) -> Option<String> {
    let mut pairs = committed.lines().zip(made.lines()).enumerate();
    let differs = pairs.find(|(_, (a, b))| a != b);
    match differs {
        Some((at, (a, b))) => Some(format!("line {}: {a}\nis by the tables: {b}", at + 1)),
        None => (committed != made).then(|| "one of them is longer".into()),
    }
}

#[test]
fn pages_of_the_reference_are_what_the_tables_give() {
    let folder = Scratch::new("reference");
    folder.run("man --markdown pages").exits(0);
    for name in PAGES {
        let made = fs::read_to_string(folder.path("pages").join(name)).unwrap();
        let page = root().join("docs/reference").join(name);
        let committed = fs::read_to_string(page).unwrap();
        let differs = difference(&committed, &made);
        assert!(
            differs.is_none(),
            "docs/reference/{name} is not what `cutaway man --markdown docs/reference` writes: {}",
            differs.unwrap()
        );
        assert!(
            difference(&committed.replacen("--section", "--sektion", 1), &made).is_some()
                || name == "scene.md",
            "the control"
        );
        assert!(difference(&committed, &format!("{made}more\n")).is_some());
    }
}

#[test]
fn the_reference_has_every_option_and_every_value() {
    let folder = Scratch::new("reference-whole");
    folder.run("man --markdown pages").exits(0);
    let read = |name: &str| fs::read_to_string(folder.path("pages").join(name)).unwrap();
    // Beside the page, as help prints them.
    let commands = read("commands.md");
    for command in ["render", "animate", "measure", "section"] {
        let help = folder.run(&format!("{command} --help")).exits(0);
        let start = format!("\n## cutaway {command}\n");
        let from = commands.find(&start).unwrap() + start.len();
        let section = &commands[from..];
        let section = &section[..section.find("\n## ").unwrap()];
        let words = help.text().split_whitespace();
        let options = words.filter(|w| w.starts_with("--") && w.len() > 4);
        let names = options.filter_map(|w| w.split(['=', '[', ',', ';', '.']).next());
        for name in names.filter(|n| *n != "--help") {
            assert!(section.contains(name), "{command}: {name} is not there");
        }
    }
    let scene = read("scene.md");
    let list = folder.run("scene --json -").exits(0).json();
    let paths = list.as_array().unwrap();
    assert!(paths.len() > 150, "{} paths", paths.len());
    for path in paths {
        let row = format!("| `{}` |", path["path"].as_str().unwrap());
        assert_eq!(scene.matches(&row).count(), 1, "{row}");
    }
    assert!(!scene.contains("| `part.*.nowhere` |"), "the control");
}
