//! Who imports whom: the map at the head of each `lib.rs` is read, and every `crate::` path is held against it. Between crates the manifests
//! are the map, but for what judges.

use std::collections::{BTreeMap, BTreeSet};

use super::{code, none, sources};

/// Modules from left to right, one list for each chain of the map: `scene <- exact`.
fn chains(lib: &str) -> Vec<Vec<Vec<String>>> {
    let lines = lib.lines().filter_map(|l| l.strip_prefix("//!"));
    lines
        .filter(|l| l.contains(" <- "))
        .map(|l| {
            let places = l.trim().trim_start_matches("imports").split("<-");
            places
                .map(|p| p.split(',').map(|m| m.trim().to_owned()).collect())
                .collect()
        })
        .collect()
}

/// Modules of the core that everybody may import.
const FAR_LEFT: [&str; 2] = ["error", "layers"];

/// What a module may import of its own crate, by the map.
fn allowed(chains: &[Vec<Vec<String>>], module: &str) -> Option<BTreeSet<String>> {
    if FAR_LEFT.contains(&module) {
        return Some(FAR_LEFT.map(str::to_owned).into());
    }
    let mut left: BTreeSet<String> = BTreeSet::new();
    let mut is_on_map = false;
    for chain in chains {
        if let Some(place) = chain.iter().position(|ms| ms.iter().any(|m| m == module)) {
            is_on_map = true;
            left.extend(chain[..place].iter().flatten().cloned());
        }
    }
    left.extend(FAR_LEFT.map(str::to_owned));
    left.insert(module.to_owned());
    is_on_map.then_some(left)
}

/// Modules that judge: they share little with what they judge, so that they are not wrong in the same way. Others may import what is
/// public; which crate may import which is said by the manifests.
const JUDGES: [&str; 2] = ["exact", "compare"];

/// What judges may import of the core.
const FOR_JUDGES: [&str; 7] = [
    "scene", "layers", "error", "Error", "Layers", "Result", "Scene",
];

/// The modules that paths of a crate name in a text, with lines; `root` is `crate` or the name of another.
fn imported(text: &str, root: &str) -> Vec<(usize, String)> {
    let root = format!("{root}::");
    let lines = code(text);
    // Groups may span lines: the text is joined, and each name keeps the line of its path.
    let mut found = Vec::new();
    for (index, (number, line)) in lines.iter().enumerate() {
        for (at, _) in line.match_indices(&root) {
            let is_path = line[..at]
                .chars()
                .next_back()
                .is_none_or(|c| !c.is_alphanumeric() && c != '_' && c != '$');
            if !is_path {
                continue;
            }
            let rest: String = std::iter::once(&line[at + root.len()..])
                .chain(lines[index + 1..].iter().map(|(_, l)| *l))
                .take(40)
                .collect::<Vec<_>>()
                .join(" ");
            for name in heads(&rest) {
                found.push((*number, name));
            }
        }
    }
    found
}

/// The first words of a path or of each path of a group: `a::b` is `a`, `{a::{b, c}, D}` is `a`, `D`.
fn heads(rest: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.trim()
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    let Some(group) = rest.strip_prefix('{') else {
        return vec![word(rest)];
    };
    let (mut depth, mut start, mut names) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                names.push(word(&group[start..at]));
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                names.push(word(&group[start..at]));
                start = at + 1;
            }
            _ => {}
        }
    }
    names.retain(|n| !n.is_empty());
    names
}

/// The folder of the sources of a crate, and the top-level module, of `crates/io/src/load/stl.rs`.
fn place_of(file: &str) -> (&str, &str) {
    let (folder, rest) = match file.strip_prefix("src/") {
        Some(rest) => ("src", rest),
        None => {
            let end = file.find("/src/").map_or(0, |at| at + "/src".len());
            (&file[..end], file[end..].trim_start_matches('/'))
        }
    };
    let first = rest.split('/').next().unwrap_or(rest);
    (folder, first.strip_suffix(".rs").unwrap_or(first))
}

/// The crates that have a map at the head of their `lib.rs`: within the command everything may import everything.
const MAPPED: [&str; 3] = ["src", "crates/io/src", "crates/lab/src"];

type Maps = BTreeMap<&'static str, Vec<Vec<Vec<String>>>>;

/// Imports of a file that the map does not allow.
fn violations(maps: &Maps, file: &str, text: &str) -> Vec<String> {
    let (folder, module) = place_of(file);
    let mut found = Vec::new();
    let names_wgpu = code(text).iter().any(|(_, l)| {
        l.match_indices("wgpu").any(|(at, _)| {
            let before = l[..at].chars().next_back();
            let after = l[at + 4..].chars().next();
            let part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
            !part(before) && !part(after)
        })
    });
    if names_wgpu && (folder, module) != ("src", "gpu") {
        found.push(format!("{file} names wgpu"));
    }
    let Some(chains) = maps.get(folder) else {
        return found;
    };
    if module == "lib" {
        return found;
    }
    let Some(allowed) = allowed(chains, module) else {
        found.push(format!(
            "{file}: `{module}` is not on the map of {folder}/lib.rs"
        ));
        return found;
    };
    let mut all = imported(text, "crate");
    // `crate::Error` is `crate::error::Error` by its public name.
    all.retain(|(_, name)| !allowed.contains(name) && !name.starts_with(char::is_uppercase));
    if JUDGES.contains(&module) {
        let mut of_core = imported(text, "cutaway");
        of_core.retain(|(_, name)| !FOR_JUDGES.contains(&name.as_str()));
        all.extend(of_core);
        all.extend(imported(text, "cutaway_io"));
    }
    let all = all.into_iter();
    found.extend(all.map(|(line, name)| format!("{file}:{line}: `{module}` imports `{name}`")));
    found
}

fn maps() -> Maps {
    let sources = sources();
    let maps: Maps = (MAPPED.into_iter())
        .map(|folder| (folder, chains(&sources[&format!("{folder}/lib.rs")])))
        .collect();
    assert!(
        maps.values().all(|chains| !chains.is_empty()) && maps["src"].iter().any(|c| c.len() > 8),
        "the maps read as {maps:?}"
    );
    maps
}

#[test]
fn imports_go_to_the_left() {
    let maps = maps();
    let all: Vec<String> = sources()
        .iter()
        .flat_map(|(file, text)| violations(&maps, file, text))
        .collect();
    none(&all);
}

#[test]
fn every_module_is_declared_and_on_the_map() {
    let (sources, maps) = (sources(), maps());
    let places: BTreeSet<(&str, &str)> = sources.keys().map(|f| place_of(f)).collect();
    for (folder, module) in places {
        let Some(chains) = maps.get(folder).filter(|_| module != "lib") else {
            continue;
        };
        assert!(
            sources[&format!("{folder}/lib.rs")].contains(&format!("mod {module};")),
            "{folder}/lib.rs does not declare `{module}`"
        );
        assert!(
            allowed(chains, module).is_some(),
            "`{module}` is not on the map of {folder}/lib.rs"
        );
    }
    // What the design says of the order, whatever the maps say.
    let order = [
        "scene",
        "slice",
        "shader",
        "plan",
        "passes",
        "effects",
        "strategies",
        "gpu",
        "session",
    ];
    let chains = &maps["src"];
    for (place, module) in order.iter().enumerate() {
        let left = allowed(chains, module).unwrap_or_default();
        let expected: BTreeSet<&str> = order[..=place].iter().copied().chain(FAR_LEFT).collect();
        let found: BTreeSet<&str> = left.iter().map(String::as_str).collect();
        assert_eq!(found, expected, "what `{module}` may import");
    }
    let of = |module: &str| allowed(&maps["crates/lab/src"], module).unwrap_or_default();
    let alone = |module: &str| BTreeSet::from(["error", "layers", module].map(str::to_owned));
    assert_eq!(of("exact"), alone("exact"), "what `exact` may import");
    let compare = ["compare", "error", "exact", "layers"].map(str::to_owned);
    assert_eq!(of("compare"), compare.into(), "what `compare` may import");
}

#[test]
fn planted_imports_are_caught() {
    let maps = maps();
    for (file, text, caught) in [
        ("src/scene/a.rs", "use crate::plan::Plan;", 1),
        ("src/scene/a.rs", "use crate::{Error, plan::Plan};", 1),
        (
            "src/scene/a.rs",
            "use crate::{\n    Error,\n    gpu::{Gpu, Program},\n    exact,\n};",
            2,
        ),
        (
            "src/scene/a.rs",
            "fn f() { let x = crate::session::MOST_TRIES; }",
            1,
        ),
        (
            "src/scene/a.rs",
            "use crate::{Error, Result, error::did_you_mean};",
            0,
        ),
        (
            "src/scene/a.rs",
            "//! See [`crate::gpu`].\nuse crate::layers::Kind; // crate::gpu",
            0,
        ),
        (
            "crates/lab/src/exact/a.rs",
            "use cutaway::scene::View;\nuse cutaway::plan::pack;",
            1,
        ),
        ("src/strategies/a.rs", "use crate::exact;", 1),
        (
            "src/gpu/a.rs",
            "use crate::exact::Exact;\nuse crate::plan::Plan;",
            1,
        ),
        (
            "crates/lab/src/compare/a.rs",
            "use cutaway::{Outcome, session::Session};",
            2,
        ),
        (
            "crates/lab/src/exact/a.rs",
            "use cutaway_io::load::Assets;",
            1,
        ),
        ("crates/lab/src/compare/a.rs", "use crate::exact::Exact;", 0),
        ("src/error.rs", "use crate::scene::Scene;", 1),
        ("src/layers.rs", "use crate::scene::Scene;", 1),
        ("src/plan/a.rs", "fn f(d: &wgpu::Device) {}", 1),
        ("crates/cli/src/main.rs", "use wgpu::Device;", 1),
        ("src/gpu/a.rs", "fn f(d: &wgpu::Device) {}", 0),
        (
            "src/plan/a.rs",
            "// wgpu would do\nfn without_wgpu_at_all() {}",
            0,
        ),
        ("src/nowhere/a.rs", "fn f() {}", 1),
    ] {
        let found = violations(&maps, file, text);
        assert_eq!(found.len(), caught, "{file}: {text}\n{found:#?}");
    }
    let heads: BTreeMap<&str, Vec<&str>> = BTreeMap::from([
        ("a::b;", vec!["a"]),
        ("{a::{b, c}, D, e::f};", vec!["a", "D", "e"]),
        ("{ a, };", vec!["a"]),
    ]);
    for (text, expected) in heads {
        assert_eq!(super::imports::heads(text), expected, "{text}");
    }
}
