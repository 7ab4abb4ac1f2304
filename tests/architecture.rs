//! The maps of the crates, held against their source: who imports whom, what files are called, how long they are, what they begin
//! with, and what must not be in them.
//!
//! Every rule is a function of text that returns its violations, so that a planted violation proves that it can fail.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use cutaway::shader;

#[path = "architecture/imports.rs"]
mod imports;
#[path = "architecture/prose.rs"]
mod prose;
#[path = "architecture/shape.rs"]
mod shape;

/// Files may be this long without their unit tests: what is longer has more than one subject.
const MOST_LINES: usize = 400;

/// Longer files that are known, with the reason why they are not split; the list may only shrink.
const LONG_FILES: &[(&str, usize, &str)] = &[];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Files below a folder with an extension, by their path in it with `/`, sorted.
fn files(folder: &str, extension: &str) -> BTreeMap<String, String> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{folder:?}: {e}"));
        for entry in entries {
            let path = entry.unwrap_or_else(|e| panic!("{folder:?}: {e}")).path();
            if path.is_dir() {
                walk(&path, found);
            } else {
                found.push(path);
            }
        }
    }
    let base = root().join(folder);
    let mut found = Vec::new();
    walk(&base, &mut found);
    found
        .into_iter()
        .filter(|p| p.extension().is_some_and(|e| e == extension))
        .map(|p| {
            let name = p.strip_prefix(&base).unwrap_or(&p).to_string_lossy();
            let text = std::fs::read_to_string(&p).unwrap_or_else(|e| panic!("{p:?}: {e}"));
            (name.replace('\\', "/"), text)
        })
        .collect()
}

/// Files of several folders, by their path in the project.
fn sources_of(folders: &[&str]) -> BTreeMap<String, String> {
    let files = folders.iter().flat_map(|folder| {
        let named = move |(name, text)| (format!("{folder}/{name}"), text);
        files(folder, "rs").into_iter().map(named)
    });
    files.collect()
}

/// Sources of the core, and of what loads, judges and commands.
fn sources() -> BTreeMap<String, String> {
    let sources = sources_of(&["src", "crates/io/src", "crates/lab/src", "crates/cli/src"]);
    assert!(sources.len() > 500, "only {} sources", sources.len());
    sources
}

/// Those, and the window and the Python module.
fn all_sources() -> BTreeMap<String, String> {
    let mut all = sources();
    all.extend(sources_of(&["crates/viewer/src", "python/src"]));
    all
}

/// Source without comments and without what `#[cfg(test)]` guards to the end of its item.
fn code(text: &str) -> Vec<(usize, &str)> {
    let mut lines = Vec::new();
    // Braces still open in a skipped item; `None` before its first brace.
    let mut skipping: Option<Option<i32>> = None;
    for (number, line) in text.lines().enumerate() {
        let trimmed = line.trim_start();
        if trimmed.starts_with("#[cfg(test)]") {
            skipping = Some(None);
            continue;
        }
        if let Some(depth) = &mut skipping {
            let braces = line.matches('{').count() as i32 - line.matches('}').count() as i32;
            match depth {
                Some(open) => *open += braces,
                None if line.contains('{') => *depth = Some(braces),
                None if line.contains(';') => *depth = Some(0),
                None => {}
            }
            if *depth == Some(0) {
                skipping = None;
            }
            continue;
        }
        let bare = line.split("//").next().unwrap_or(line);
        if !bare.trim().is_empty() {
            lines.push((number + 1, bare));
        }
    }
    lines
}

#[track_caller]
fn none(violations: &[String]) {
    assert!(violations.is_empty(), "{}", violations.join("\n"));
}

// What a file holds.

/// Calls that end the program, and notes to oneself.
fn shortcuts(name: &str, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (line, code) in code(text) {
        for banned in [".unwrap()", "todo!", "unimplemented!", "dbg!("] {
            if code.contains(banned) {
                found.push(format!("{name}:{line}: {banned}"));
            }
        }
    }
    for (line, text) in text.lines().enumerate() {
        if ["TODO", "FIXME", "XXX"].iter().any(|n| text.contains(n)) {
            found.push(format!("{name}:{}: a note to oneself", line + 1));
        }
    }
    found
}

#[test]
fn nothing_is_left_for_later() {
    let all: Vec<String> = all_sources()
        .iter()
        .flat_map(|(name, text)| shortcuts(name, text))
        .collect();
    none(&all);
    for (planted, found) in [
        ("fn f() { g().unwrap(); }", 1),
        ("fn f() { todo!() }", 1),
        ("// TODO: mend", 1),
        ("fn f() {} // .unwrap() in words", 0),
        (
            "#[cfg(test)]\nmod tests {\n    fn f() { g().unwrap(); }\n}",
            0,
        ),
        (
            "#[cfg(test)]\nmod tests {\n    fn f() {}\n}\nfn g() { h().unwrap(); }",
            1,
        ),
        ("#[cfg(test)]\nmod tests;\nfn g() { h().unwrap(); }", 1),
    ] {
        assert_eq!(shortcuts("planted", planted).len(), found, "{planted}");
    }
}

/// Whether a file says what it is for. Files of modules and re-exports alone, and of one line, need not.
fn has_header(text: &str) -> bool {
    let lines = code(text);
    let is_list = lines.iter().all(|(_, line)| {
        let line = line.trim();
        ["mod ", "pub mod ", "use ", "pub use "]
            .iter()
            .any(|w| line.starts_with(w))
            || !line.contains(['(', '='])
    });
    text.starts_with("//!") || is_list || lines.len() < 2
}

#[test]
fn every_file_says_what_it_is_for() {
    let without: Vec<String> = all_sources()
        .into_iter()
        .filter(|(_, text)| !has_header(text))
        .map(|(name, _)| format!("{name} does not begin with //!"))
        .collect();
    none(&without);
    for (name, text) in files("shaders", "wgsl") {
        assert!(
            text.starts_with("// "),
            "{name} does not begin with a comment"
        );
    }
    assert!(!has_header("use a::b;\nfn f() {}\n"), "planted");
    assert!(
        has_header("mod a;\npub use a::{\n    B,\n    C,\n};\n"),
        "a list"
    );
}

/// Files that are too long, or allowed to be longer than they are.
fn lengths<'a>(
    lengths: impl Iterator<Item = (&'a str, usize)>,
    long: &[(&str, usize, &str)],
) -> Vec<String> {
    let mut found = Vec::new();
    for (name, length) in lengths {
        let known = long.iter().find(|(n, ..)| *n == name);
        match known {
            None if length > MOST_LINES => found.push(format!("{name} has {length} lines")),
            Some((_, most, reason)) if length > *most => found.push(format!(
                "{name} has {length} lines; {most} were allowed: {reason}"
            )),
            Some(_) if length <= MOST_LINES => {
                found.push(format!("{name} has only {length} lines: allow it no more"));
            }
            _ => {}
        }
    }
    found
}

/// Lines up to the unit tests, which may be as long as they like.
fn length(text: &str) -> usize {
    let lines = text.lines().take_while(|l| !l.starts_with("#[cfg(test)]"));
    lines.count()
}

#[test]
fn files_are_short() {
    let mut all = all_sources();
    all.extend(files("shaders", "wgsl"));
    none(&lengths(
        all.iter().map(|(name, text)| (name.as_str(), length(text))),
        LONG_FILES,
    ));
    for (name, ..) in LONG_FILES {
        assert!(
            all.contains_key(*name),
            "{name} may be long, but is not there"
        );
    }
    let planted = |name, length| lengths([(name, length)].into_iter(), &[("b.rs", 500, "long")]);
    assert_eq!(planted("a.rs", 401).len(), 1, "planted");
    assert_eq!(planted("a.rs", 400).len(), 0, "planted");
    assert_eq!(planted("b.rs", 500).len(), 0, "planted");
    assert_eq!(planted("b.rs", 501).len(), 1, "planted");
    assert_eq!(planted("b.rs", 10).len(), 1, "planted");
}

/// What of the viewer may know of a window or a device; the rest is tested without either.
const OF_WINDOWS: [&str; 7] = [
    "ui/",
    "picture/screen.rs",
    "picture/screen/",
    "picture/device.rs",
    "web/mod.rs",
    "window.rs",
    "main.rs",
];

/// Files that name the toolkit and should not.
fn toolkit_in_state(files: &BTreeMap<String, String>) -> Vec<String> {
    let is_of_windows = |name: &str| OF_WINDOWS.iter().any(|w| name.starts_with(w));
    let names_it = |text: &str| code(text).iter().any(|(_, line)| line.contains("egui"));
    (files.iter())
        .filter(|(name, text)| !is_of_windows(name) && names_it(text))
        .map(|(name, _)| format!("crates/viewer/src/{name} names egui"))
        .collect()
}

#[test]
fn state_and_actions_know_of_no_window() {
    none(&toolkit_in_state(&files("crates/viewer/src", "rs")));
    let planted =
        |name: &str| BTreeMap::from([(name.to_owned(), "use eframe::egui;\n".to_owned())]);
    assert_eq!(
        toolkit_in_state(&planted("picture/slot.rs")).len(),
        1,
        "planted"
    );
    assert_eq!(toolkit_in_state(&planted("ui/menu.rs")).len(), 0, "a panel");
}

/// Names of constants that a text declares outside of implementations, where a trait may ask for them.
fn constants(text: &str) -> Vec<&str> {
    let declared = code(text).into_iter().filter_map(|(_, line)| {
        let line = line
            .trim_start_matches("pub ")
            .trim_start_matches("pub(crate) ");
        let line = line.trim_start_matches("pub(super) ");
        line.strip_prefix("const ")
            .filter(|rest| !rest.starts_with("fn "))
    });
    declared
        .filter_map(|rest| rest.split([':', ' ']).next())
        .filter(|name| *name != "_")
        .collect()
}

/// Constants of one name and two values: what one of them says will drift from the other.
fn stated_twice(texts: &BTreeMap<String, String>) -> Vec<String> {
    let mut seen: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (file, text) in texts {
        for name in constants(text) {
            seen.entry(name).or_default().push(file);
        }
    }
    seen.into_iter()
        .filter(|(_, files)| files.len() > 1)
        .map(|(name, files)| format!("{name} is stated in {}", files.join(" and ")))
        .collect()
}

/// Rooms without a device.
const DATA: [&str; 5] = [
    "src/scene/",
    "src/generate/",
    "crates/io/src/load/",
    "crates/io/src/document/",
    "crates/cli/src/",
];

#[test]
fn numbers_are_stated_once() {
    // On the CPU and in the shaders apart: `tests/it/plans/shaders.rs` holds one to the other.
    none(&stated_twice(&files("shaders", "wgsl")));
    // A limit of the device is stated by whoever is held to it first; others take it from there.
    let of_modules: BTreeMap<String, String> = sources()
        .into_iter()
        .filter(|(name, _)| !DATA.iter().any(|room| name.starts_with(room)))
        .collect();
    none(&stated_twice(&of_modules));
    let planted = [
        ("a.rs", "const MOST: u32 = 3;\n"),
        ("b.rs", "pub const MOST: u32 = 4;\n"),
    ];
    let planted = planted.map(|(n, t)| (n.to_owned(), t.to_owned()));
    assert_eq!(stated_twice(&BTreeMap::from(planted)).len(), 1, "planted");
}

// What files are called.

/// Shaders of strategies without the Rust file that records them.
fn unmirrored<'a>(
    shaders: impl Iterator<Item = &'a str>,
    sources: &BTreeSet<String>,
) -> Vec<String> {
    shaders
        .filter_map(|path| {
            let rest = path.strip_prefix("strategies/")?;
            // strategies/KIND/NAME.wgsl or strategies/KIND/NAME/PASS.wgsl
            let mut words = rest.trim_end_matches(".wgsl").split('/');
            let (kind, name) = (words.next()?, words.next().unwrap_or_default());
            let mirror = format!("src/strategies/{kind}/{name}.rs");
            let folder = format!("src/strategies/{kind}/{name}/mod.rs");
            let is_there = sources.contains(&mirror) || sources.contains(&folder);
            (!is_there).then(|| format!("shaders/{path} has no {mirror}"))
        })
        .collect()
}

#[test]
fn shaders_are_called_like_the_source_that_records_them() {
    let names: BTreeSet<String> = sources().into_keys().collect();
    let paths = shader::SHADERS.iter().map(|(path, _)| *path);
    none(&unmirrored(paths, &names));
    let planted = [
        "strategies/surface/nowhere/cap.wgsl",
        "strategies/inside/mask.wgsl",
    ];
    assert_eq!(
        unmirrored(planted.into_iter(), &names),
        ["shaders/strategies/surface/nowhere/cap.wgsl has no src/strategies/surface/nowhere.rs"],
        "planted"
    );
}

/// Shaders that no source names: nothing can run them.
fn unrecorded<'a>(
    shaders: impl Iterator<Item = &'a str>,
    sources: &BTreeMap<String, String>,
) -> Vec<String> {
    let text: String = sources
        .iter()
        .filter(|(name, _)| *name != "src/shader/tree.rs")
        .flat_map(|(_, text)| code(text).into_iter().map(|(_, l)| l.to_owned() + "\n"))
        .collect();
    shaders
        .filter(|path| !text.contains(&format!("\"{path}\"")))
        .map(|path| format!("no pass is recorded with {path}"))
        .collect()
}

#[test]
fn every_shader_is_recorded_by_some_pass() {
    let sources = sources();
    none(&unrecorded(
        shader::SHADERS.iter().map(|(path, _)| *path),
        &sources,
    ));
    let planted = unrecorded(["passes/idle.wgsl"].into_iter(), &sources);
    assert_eq!(planted.len(), 1, "planted");
}

/// Files in one of two lists and not in the other.
fn unclaimed(there: &BTreeSet<String>, claimed: &BTreeSet<String>) -> Vec<String> {
    there
        .symmetric_difference(claimed)
        .map(|path| match there.contains(path) {
            true => format!("shaders/{path} is not in src/shader/tree.rs"),
            false => format!("src/shader/tree.rs names {path}, which is not there"),
        })
        .collect()
}

#[test]
fn every_shader_is_claimed_by_the_tree() {
    let there: BTreeSet<String> = files("shaders", "wgsl").into_keys().collect();
    let all = shader::FILES.iter().copied().flatten();
    let claimed: BTreeSet<String> = all.map(|(path, _)| (*path).to_owned()).collect();
    none(&unclaimed(&there, &claimed));
    // Whatever else lies in the folder would be claimed by nothing.
    let every: usize = count_files(&root().join("shaders"));
    assert_eq!(every, there.len(), "files under shaders/ that are no .wgsl");
    let one = BTreeSet::from(["lib/one.wgsl".to_owned()]);
    assert_eq!(unclaimed(&one, &BTreeSet::new()).len(), 1, "planted");
    assert_eq!(unclaimed(&BTreeSet::new(), &one).len(), 1, "planted");
}

fn count_files(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{folder:?}: {e}"));
    entries
        .map(|e| e.unwrap_or_else(|e| panic!("{folder:?}: {e}")).path())
        .map(|p| if p.is_dir() { count_files(&p) } else { 1 })
        .sum()
}

/// Files of tests that no `cargo test` would run: not named by the manifest, and by no other file.
fn idle_tests(manifest: &str, tests: &BTreeMap<String, String>) -> Vec<String> {
    tests
        .iter()
        .filter(|(name, _)| {
            let stem = name.trim_end_matches(".rs").trim_end_matches("/mod");
            let stem = stem.rsplit('/').next().unwrap_or(stem);
            let is_named = tests.iter().any(|(other, text)| {
                other != *name
                    && (text.contains(&format!("{name}\""))
                        || text.contains(&format!("mod {stem};")))
            });
            !is_named && !manifest.contains(&format!("path = \"{name}\""))
        })
        .map(|(name, _)| format!("tests/{name} is run by nothing"))
        .collect()
}

#[test]
fn every_file_of_tests_is_run() {
    let manifest = std::fs::read_to_string(root().join("tests/Cargo.toml")).expect("a manifest");
    none(&idle_tests(&manifest, &files("tests", "rs")));
    let planted = [
        ("idle.rs", "fn f() {}"),
        ("whole.rs", "mod part;\n#[test]\nfn t() {}"),
        ("whole/part.rs", "#[test]\nfn t() {}"),
        ("whole/lost.rs", "#[test]\nfn t() {}"),
    ];
    let planted = planted.map(|(n, t)| (n.to_owned(), t.to_owned()));
    assert_eq!(
        idle_tests("path = \"whole.rs\"", &BTreeMap::from(planted)),
        [
            "tests/idle.rs is run by nothing",
            "tests/whole/lost.rs is run by nothing"
        ],
        "planted"
    );
}
