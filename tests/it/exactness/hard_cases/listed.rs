//! The list of hard cases: every number is on it, has pictures or tests, and the tests that it names are there.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use cutaway_lab::hard_cases::{cases, list};

use crate::common::root;

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of tests");
    let mut found = Vec::new();
    for entry in entries {
        let path = entry.expect("a file").path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found
}

/// Tests by module and name, as the list writes them: functions right after a line that makes them tests.
fn tests() -> BTreeSet<String> {
    let root = root().join("tests/it");
    let mut found = BTreeSet::new();
    for path in sources(&root) {
        let below = path.strip_prefix(&root).expect("below the folder");
        // What lies in a room has its module after it.
        let in_room = |first: &&std::ffi::OsStr| root.join(first).join("mod.rs").is_file();
        let module = below.iter().find(|first| !in_room(first)).expect("a name");
        let module = module.to_string_lossy();
        let module = module.trim_end_matches(".rs");
        let text = std::fs::read_to_string(&path).expect("a source");
        found.extend(
            names(&text)
                .into_iter()
                .map(|name| format!("{module} {name}")),
        );
    }
    found
}

fn names(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let tests = lines.windows(2).filter(|pair| pair[0] == "#[test]");
    let name = |line: &str| {
        line.strip_prefix("fn ")?
            .split('(')
            .next()
            .map(str::to_owned)
    };
    tests.filter_map(|pair| name(pair[1])).collect()
}

fn missing<'a>(named: impl Iterator<Item = &'a str>, there: &BTreeSet<String>) -> Vec<String> {
    let gone = named.filter(|name| !there.contains(*name));
    gone.map(str::to_owned).collect()
}

#[test]
fn every_test_that_is_named_is_there() {
    let there = tests();
    assert!(there.len() > 500, "only {} tests were found", there.len());
    let named = list().flat_map(|l| l.tests.iter().map(String::as_str));
    assert_eq!(missing(named, &there), [""; 0], "tests that are not there");
    let planted = [
        "hard_cases case_99_of_nothing",
        "nowhere case_38_and_or_differ_and_have_both_caps",
    ];
    assert_eq!(missing(planted.into_iter(), &there).len(), 2, "planted");
    assert_eq!(names("#[test]\nfn a() {}\nfn b() {}\n"), ["a"], "planted");
}

/// Numbers that the list lacks, or has twice.
fn unlisted(ids: &[&str]) -> Vec<String> {
    let expected = (1..=61).map(|n| n.to_string());
    let all = expected.chain((1..=14).map(|n| format!("B{n}")));
    all.filter(|id| ids.iter().filter(|i| *i == id).count() != 1)
        .collect()
}

#[test]
fn every_number_is_listed_once_and_has_a_keeper() {
    let ids: Vec<&str> = list().map(|l| l.id.as_str()).collect();
    assert_eq!(unlisted(&ids), [""; 0]);
    assert_eq!(unlisted(&ids[1..]), ["1"], "planted");
    for listed in list() {
        let has_pictures = cases().any(|c| c.id == listed.id);
        assert!(
            has_pictures || !listed.tests.is_empty(),
            "{} is held by nobody",
            listed.id
        );
    }
    for case in cases() {
        assert!(
            ids.contains(&&*case.id),
            "case {} is not on the list",
            case.id
        );
    }
}

/// The cases that a test is named after: `case_b02_...` after B2, `case_04_and_05_...` after 4 and 5.
fn cases_of(test: &str) -> Vec<String> {
    let Some((_, name)) = test.split_once(" case_") else {
        return Vec::new();
    };
    let id = |word: &str| {
        let (letter, number) = match word.strip_prefix('b') {
            Some(number) => ("B", number),
            None => ("", word),
        };
        let number: u32 = number.parse().ok()?;
        Some(format!("{letter}{number}"))
    };
    let words = name.split('_').filter(|word| *word != "and");
    words.map_while(id).collect()
}

/// Tests that are named after a case whose line does not name them.
fn unnamed<'a>(
    tests: impl IntoIterator<Item = &'a String>,
    names: impl Fn(&str) -> Vec<&'static str>,
) -> Vec<&'a str> {
    let is_unnamed = |test: &&str| cases_of(test).iter().any(|id| !names(id).contains(test));
    tests
        .into_iter()
        .map(String::as_str)
        .filter(is_unnamed)
        .collect()
}

#[test]
fn a_test_that_is_named_after_a_case_is_on_its_line() {
    let there = tests();
    let of_line = |id: &str| {
        let lines = list().filter(|l| l.id == id);
        lines
            .flat_map(|l| l.tests.iter().map(String::as_str))
            .collect()
    };
    assert_eq!(unnamed(&there, of_line), [""; 0]);
    let is_after_a_case = there.iter().filter(|t| !cases_of(t).is_empty()).count();
    assert!(is_after_a_case > 30, "only {is_after_a_case} tests are");
    let lacks_one = |id: &str| of_line(id).into_iter().skip(1).collect();
    assert!(unnamed(&there, lacks_one).len() > 20, "planted");
    let of_no_case = ["hard_cases case_99_of_nothing".to_owned()];
    assert_eq!(unnamed(&of_no_case, of_line).len(), 1, "planted");
}
