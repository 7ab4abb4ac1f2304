//! Promise: what makes no sense is refused: by an error that says what is wrong and what helps, with exit code 2, nothing on standard
//! output, and no file that is new or changed.
//!
//! The refusals are data: `tests/refusals/*.toml`, each with the files that its commands find, commands that are accepted (the negative
//! control), and commands that are refused, each with what standard error has to contain.

use std::collections::BTreeMap;
use std::fs;

use serde_json::{Value, json};

use crate::common::command::Scratch;
use crate::common::root;

/// A file of `tests/refusals`, by its name.
fn table(name: &str) -> Value {
    let path = root().join(format!("tests/refusals/{name}.toml"));
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
    toml_edit::de::from_str(&text).unwrap_or_else(|e| panic!("{path:?}: {e}"))
}

/// The texts of an array; none where there is no array.
fn texts(value: &Value) -> Vec<&str> {
    let all = value.as_array().into_iter().flatten();
    all.map(|v| v.as_str().expect("a text")).collect()
}

/// A folder with the files of a table.
fn folder_of(table: &Value) -> Scratch {
    let folder = Scratch::new("refusals");
    for (name, text) in table["files"].as_object().into_iter().flatten() {
        folder.write(name, text.as_str().expect("a text"));
    }
    folder
}

/// What is in a folder.
fn contents(folder: &Scratch) -> BTreeMap<String, Vec<u8>> {
    let files = folder.files().into_iter();
    files
        .map(|name| {
            let bytes = fs::read(folder.path(&name)).unwrap_or_default();
            (name, bytes)
        })
        .collect()
}

/// What is wrong with how the commands of a table end.
fn faults(table: &Value) -> Vec<String> {
    let mut faults = Vec::new();
    for line in texts(&table["commands"]["accepted"]) {
        let folder = folder_of(table);
        let before = folder.files().len();
        let ran = folder.run(line);
        if ran.code != Some(0) || folder.files().len() == before {
            faults.push(format!("{line} is not accepted: {}", ran.stderr));
        }
    }
    let folder = folder_of(table);
    let before = contents(&folder);
    let rows = table["commands"]["refused"].as_array().expect("refusals");
    for row in rows {
        let row = texts(row);
        let [line, said @ ..] = &row[..] else {
            panic!("an empty row");
        };
        let ran = folder.run(line);
        let mut found = ran.faults_of_refusal(said);
        // Errors of usage name `--help`, all others say what helps.
        let of_usage = "For more information, try '--help'";
        if !["help:", of_usage].iter().any(|h| ran.stderr.contains(h)) {
            found.push("no help".to_owned());
        }
        if contents(&folder) != before {
            found.push(format!("files: {:?}", folder.files()));
        }
        let found = found.iter();
        faults.extend(found.map(|what| format!("{line}: {what}\n{}", ran.stderr)));
    }
    faults
}

#[track_caller]
fn all_are_refused(name: &str) {
    let faults = faults(&table(name));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A test for each file, so that none is forgotten.
macro_rules! a_test_of_each {
    ($($name:ident)*) => {
        $(#[test]
        fn $name() {
            all_are_refused(stringify!($name));
        })*

        #[test]
        fn every_file_has_a_test() {
            let folder = fs::read_dir(root().join("tests/refusals")).expect("a folder");
            let names = folder.map(|e| e.expect("an entry").file_name().into_string());
            let mut names: Vec<String> = names.map(|n| n.expect("UTF-8")).collect();
            names.sort();
            assert_eq!(names, [$(concat!(stringify!($name), ".toml")),*]);
        }
    };
}

a_test_of_each!(animate export pictures section settings usage);

#[test]
fn planted_faults_are_found() {
    let planted = |accepted: &str, refused: [&str; 2]| {
        let commands = json!({ "accepted": [accepted], "refused": [refused] });
        faults(&json!({ "files": { "a.txt": "x" }, "commands": commands })).join("\n")
    };
    let fine = "export shape:cube --section x=50% -o a.stl";
    let bad = ["inspect shape:crnak", "did you mean `crank`"];
    assert_eq!(planted(fine, bad), "");
    for (accepted, refused, faults) in [
        (bad[0], bad, vec!["is not accepted"]),
        ("inspect shape:cube", bad, vec!["is not accepted"]),
        (fine, [bad[0], "no such words"], vec!["no `no such words`"]),
        (
            fine,
            [fine, "error:"],
            vec!["exit code", "no `error:`", "no help", "files: "],
        ),
        (
            fine,
            ["inspect shape:cube", "error:"],
            vec!["something on standard output"],
        ),
    ] {
        let found = planted(accepted, refused);
        for fault in faults {
            assert!(
                found.contains(fault),
                "{accepted}, {refused:?}: no `{fault}` in {found}"
            );
        }
    }
}
