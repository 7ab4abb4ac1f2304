//! Who imports whom: the map at the head of `src/lib.rs` is read, and every `crate::` path is held against it.

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

/// Modules that everybody may import.
const FAR_LEFT: [&str; 2] = ["error", "layers"];

/// What a module may import, by the map and by the two sentences below it.
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
    if module == "compare" {
        // Judges layers against layers: it must not know who made them.
        left = BTreeSet::from(["scene".to_owned()]);
    }
    let judges = [
        "compare",
        "hard_cases",
        "experiment",
        "report",
        "cmd",
        "viewer",
    ];
    if judges.contains(&module) {
        left.insert("exact".to_owned());
    } else {
        // The strategies share nothing with what they are judged by.
        left.remove("exact");
    }
    left.extend(FAR_LEFT.map(str::to_owned));
    left.insert(module.to_owned());
    is_on_map.then_some(left)
}

/// The modules that `crate::` paths of a text name, with lines.
fn imported(text: &str) -> Vec<(usize, String)> {
    let lines = code(text);
    // Groups may span lines: the text is joined, and each name keeps the line of its path.
    let mut found = Vec::new();
    for (index, (number, line)) in lines.iter().enumerate() {
        for (at, _) in line.match_indices("crate::") {
            let is_path = line[..at]
                .chars()
                .next_back()
                .is_none_or(|c| !c.is_alphanumeric() && c != '_' && c != '$');
            if !is_path {
                continue;
            }
            let rest: String = std::iter::once(&line[at + "crate::".len()..])
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

fn module_of(file: &str) -> &str {
    let first = file.split('/').next().unwrap_or(file);
    first.strip_suffix(".rs").unwrap_or(first)
}

/// Imports of a file that the map does not allow.
fn violations(chains: &[Vec<Vec<String>>], file: &str, text: &str) -> Vec<String> {
    let module = module_of(file);
    let mut found = Vec::new();
    let names_wgpu = code(text).iter().any(|(_, l)| {
        l.match_indices("wgpu").any(|(at, _)| {
            let before = l[..at].chars().next_back();
            let after = l[at + 4..].chars().next();
            let part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
            !part(before) && !part(after)
        })
    });
    if names_wgpu && !["gpu", "viewer"].contains(&module) {
        found.push(format!("{file} names wgpu"));
    }
    if ["lib", "main"].contains(&module) {
        return found;
    }
    let Some(allowed) = allowed(chains, module) else {
        found.push(format!(
            "{file}: `{module}` is not on the map of src/lib.rs"
        ));
        return found;
    };
    for (line, name) in imported(text) {
        // `crate::Error` is `crate::error::Error` by its public name.
        let is_public_name = name.starts_with(char::is_uppercase);
        if !is_public_name && !allowed.contains(&name) {
            found.push(format!("src/{file}:{line}: `{module}` imports `{name}`"));
        }
    }
    found
}

fn map() -> Vec<Vec<Vec<String>>> {
    let sources = sources();
    let chains = chains(&sources["lib.rs"]);
    assert!(
        chains.len() == 3 && chains.iter().any(|c| c.len() > 8),
        "the map of src/lib.rs reads as {chains:?}"
    );
    chains
}

#[test]
fn imports_go_to_the_left() {
    let chains = map();
    let all: Vec<String> = sources()
        .iter()
        .flat_map(|(file, text)| violations(&chains, file, text))
        .collect();
    none(&all);
}

#[test]
fn every_module_is_declared_and_on_the_map() {
    let sources = sources();
    let lib = &sources["lib.rs"];
    let modules: BTreeSet<&str> = sources.keys().map(|f| module_of(f)).collect();
    for module in modules.into_iter().filter(|m| !["lib", "main"].contains(m)) {
        assert!(
            lib.contains(&format!("mod {module};")),
            "src/lib.rs does not declare `{module}`"
        );
        assert!(
            allowed(&map(), module).is_some(),
            "`{module}` is not on the map of src/lib.rs"
        );
    }
    // What the design says of the order, whatever the map says.
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
    let chains = map();
    for (place, module) in order.iter().enumerate() {
        let left = allowed(&chains, module).unwrap_or_default();
        let expected: BTreeSet<&str> = order[..=place].iter().copied().chain(FAR_LEFT).collect();
        let found: BTreeSet<&str> = left.iter().map(String::as_str).collect();
        assert_eq!(found, expected, "what `{module}` may import");
    }
    let of = |module: &str| allowed(&chains, module).unwrap_or_default();
    let exact = ["error", "exact", "layers", "scene"].map(str::to_owned);
    assert_eq!(of("exact"), exact.into(), "what `exact` may import");
    let compare = ["compare", "error", "exact", "layers", "scene"].map(str::to_owned);
    assert_eq!(of("compare"), compare.into(), "what `compare` may import");
}

#[test]
fn planted_imports_are_caught() {
    let chains = map();
    for (file, text, caught) in [
        ("scene/a.rs", "use crate::plan::Plan;", 1),
        ("scene/a.rs", "use crate::{Error, plan::Plan};", 1),
        (
            "scene/a.rs",
            "use crate::{\n    Error,\n    gpu::{Gpu, Program},\n    exact,\n};",
            2,
        ),
        (
            "scene/a.rs",
            "fn f() { let x = crate::session::MOST_TRIES; }",
            1,
        ),
        (
            "scene/a.rs",
            "use crate::{Error, Result, error::did_you_mean};",
            0,
        ),
        (
            "scene/a.rs",
            "//! See [`crate::gpu`].\nuse crate::layers::Kind; // crate::gpu",
            0,
        ),
        (
            "exact/a.rs",
            "use crate::scene::View;\nuse crate::plan::pack;",
            1,
        ),
        ("strategies/a.rs", "use crate::exact;", 1),
        (
            "gpu/a.rs",
            "use crate::exact::Exact;\nuse crate::plan::Plan;",
            1,
        ),
        ("compare/a.rs", "use crate::session::Session;", 1),
        ("compare/a.rs", "use crate::exact::Exact;", 0),
        ("error.rs", "use crate::scene::Scene;", 1),
        ("layers.rs", "use crate::scene::Scene;", 1),
        ("plan/a.rs", "fn f(d: &wgpu::Device) {}", 1),
        ("main.rs", "use wgpu::Device;", 1),
        ("gpu/a.rs", "fn f(d: &wgpu::Device) {}", 0),
        (
            "plan/a.rs",
            "// wgpu would do\nfn without_wgpu_at_all() {}",
            0,
        ),
        ("nowhere/a.rs", "fn f() {}", 1),
    ] {
        let found = violations(&chains, file, text);
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
