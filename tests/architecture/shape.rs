//! The shape of the source tree: how many files lie side by side, and which files import each other in a cycle.
//!
//! An import is followed through re-exports to the file that defines what it names: a `mod.rs` that exports what its children define is in
//! no cycle for that. What tests within a file import does not count, nor paths through an imported module (`scene::View` after
//! `use crate::scene`), nor what macros are given.

use std::collections::{BTreeMap, BTreeSet};

use syn::visit::Visit;
use syn::{Attribute, Item, UseTree};

use super::{all_sources, files, none, sources};

/// Files of source that may lie in one folder.
const MOST_SIDE_BY_SIDE: usize = 20;

/// Files that may import each other in a cycle.
const MOST_IN_A_CYCLE: usize = 6;

/// Folders with too many files of one kind, of paths.
fn crowded<'a>(paths: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for path in paths {
        *counts
            .entry(path.rsplit_once('/').map_or("", |(folder, _)| folder))
            .or_default() += 1;
    }
    let many = counts.into_iter().filter(|(_, n)| *n > MOST_SIDE_BY_SIDE);
    many.map(|(folder, n)| format!("{folder} has {n} files side by side"))
        .collect()
}

#[test]
fn no_folder_has_many_files_side_by_side() {
    let rust = all_sources();
    none(&crowded(rust.keys().map(String::as_str)));
    let shaders = files("shaders", "wgsl");
    none(&crowded(shaders.keys().map(String::as_str)));
    let planted: Vec<String> = (0..=MOST_SIDE_BY_SIDE)
        .map(|i| format!("a/{i}.rs"))
        .collect();
    assert_eq!(crowded(planted.iter().map(String::as_str)).len(), 1);
    assert!(crowded(planted[1..].iter().map(String::as_str)).is_empty());
}

/// A path as a list of names.
type Names = Vec<String>;

/// A file as a module: its place in its crate, and the names that it takes from elsewhere.
#[derive(Default)]
struct Module {
    file: String,
    /// What each name of an import stands for, from the root of the crate.
    names: BTreeMap<String, Names>,
    /// All that it imports or names by a path, from the root of the crate.
    taken: BTreeSet<Names>,
}

/// The modules of a crate by their paths: `src/scene/mod.rs` is `[scene]`.
type Modules = BTreeMap<Names, Module>;

/// The path of the module that a file below the folder of a crate is.
fn module_of(file: &str) -> Names {
    let stem = file.strip_suffix(".rs").unwrap_or(file);
    let mut names: Names = stem.split('/').map(str::to_owned).collect();
    if names.last().is_some_and(|n| n == "mod") || names == ["lib"] {
        names.pop();
    }
    names
}

/// A path as it is written in a module, from the root of the crate; `None` where it begins in another crate.
fn from_root(path: &[String], here: &[String], children: &BTreeSet<Names>) -> Option<Names> {
    let first = path.first()?.as_str();
    let rest = path[1..].iter().cloned();
    match first {
        "crate" => Some(rest.collect()),
        "self" => Some(here.iter().cloned().chain(rest).collect()),
        "super" => {
            let ups = path.iter().take_while(|n| *n == "super").count();
            let base = here.len().checked_sub(ups)?;
            let rest = path[ups..].iter().cloned();
            Some(here[..base].iter().cloned().chain(rest).collect())
        }
        _ => {
            let own: Names = here.iter().chain([&path[0]]).cloned().collect();
            let is_child = children.contains(&own);
            is_child.then(|| own.into_iter().chain(rest).collect())
        }
    }
}

/// The leaves of an import: the name that each has here, and its path.
fn leaves(tree: &UseTree, path: &[String], found: &mut Vec<(String, Names)>) {
    let with = |name: String| [path, &[name]].concat();
    match tree {
        UseTree::Path(p) => leaves(&p.tree, &with(p.ident.to_string()), found),
        UseTree::Name(n) if n.ident == "self" => {
            found.push((path.last().cloned().unwrap_or_default(), path.to_vec()));
        }
        UseTree::Name(n) => found.push((n.ident.to_string(), with(n.ident.to_string()))),
        UseTree::Rename(r) => found.push((r.rename.to_string(), with(r.ident.to_string()))),
        UseTree::Glob(_) => found.push(("*".to_owned(), path.to_vec())),
        UseTree::Group(g) => g.items.iter().for_each(|t| leaves(t, path, found)),
    }
}

/// Collects imports and paths, but those of tests.
#[derive(Default)]
struct Collector {
    /// How many modules of this file what is visited is in.
    depth: usize,
    imports: Vec<(String, Names)>,
    paths: Vec<Names>,
}

fn is_of_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| {
        a.path().is_ident("cfg")
            && a.parse_args::<syn::Path>()
                .is_ok_and(|p| p.is_ident("test"))
    })
}

impl Collector {
    /// A path in a module of the file as the file itself would write it; `None` where it stays in the file.
    fn of_file(&self, path: &Names) -> Option<Names> {
        let ups = path.iter().take_while(|n| *n == "super").count();
        match ups {
            0 => Some(path.clone()),
            _ if ups <= self.depth => None,
            _ => Some(path[self.depth..].to_vec()),
        }
    }
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.depth += 1;
        syn::visit::visit_item_mod(self, item);
        self.depth -= 1;
    }

    fn visit_item(&mut self, item: &'ast Item) {
        let is_of_tests = match item {
            Item::Mod(m) => is_of_tests(&m.attrs),
            Item::Use(u) => is_of_tests(&u.attrs),
            Item::Fn(f) => is_of_tests(&f.attrs),
            _ => false,
        };
        if !is_of_tests {
            syn::visit::visit_item(self, item);
        }
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let mut all = Vec::new();
        leaves(&item.tree, &[], &mut all);
        let of_file = all
            .into_iter()
            .filter_map(|(name, path)| Some((name, self.of_file(&path)?)));
        let of_file: Vec<_> = of_file.collect();
        self.imports.extend(of_file);
    }

    // `pub(in crate::scene)` imports nothing.
    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.paths.extend(self.of_file(&names));
        syn::visit::visit_path(self, path);
    }
}

/// The modules of a crate, of its files by their paths below its folder.
fn modules<'a>(texts: impl Iterator<Item = (&'a str, &'a str)> + Clone) -> Modules {
    let all: BTreeSet<Names> = texts.clone().map(|(file, _)| module_of(file)).collect();
    let read = texts.map(|(file, text)| {
        let here = module_of(file);
        let parsed = syn::parse_file(text).unwrap_or_else(|e| panic!("{file}: {e}"));
        let mut collector = Collector::default();
        collector.visit_file(&parsed);
        let mut module = Module {
            file: file.to_owned(),
            ..Module::default()
        };
        for (name, path) in collector.imports {
            if let Some(path) = from_root(&path, &here, &all) {
                module.taken.insert(path.clone());
                module.names.insert(name, path);
            }
        }
        let named = collector.paths.iter().filter(|p| p.len() > 1);
        let named = named.filter_map(|p| from_root(p, &here, &all));
        module.taken.extend(named);
        (here, module)
    });
    read.collect()
}

/// The module that defines what a path names, through re-exports.
fn defined_in<'a>(path: &'a [String], modules: &'a Modules, depth: usize) -> Option<&'a [String]> {
    let end = (0..=path.len())
        .rev()
        .find(|n| modules.contains_key(&path[..*n]))?;
    let module = &path[..end];
    let name = path.get(end);
    let other = name.and_then(|n| modules[module].names.get(n));
    match other {
        Some(other) if depth > 0 => defined_in(other, modules, depth - 1),
        _ => Some(module),
    }
}

/// Cycles of more files than are allowed, each as the names of its files.
fn cycles(modules: &Modules) -> Vec<Vec<String>> {
    let edges: BTreeMap<&[String], BTreeSet<&[String]>> = modules
        .iter()
        .map(|(here, module)| {
            let taken = module.taken.iter();
            let defined = taken.filter_map(|path| defined_in(path, modules, 8));
            let others = defined.filter(|there| there != here);
            (here.as_slice(), others.collect())
        })
        .collect();
    let reached = |from: &[String]| {
        let mut seen: BTreeSet<&[String]> = BTreeSet::new();
        let mut next: Vec<&[String]> = edges[from].iter().copied().collect();
        while let Some(at) = next.pop() {
            if seen.insert(at) {
                next.extend(edges[at].iter().copied());
            }
        }
        seen
    };
    let all: BTreeMap<&[String], BTreeSet<&[String]>> =
        edges.keys().map(|at| (*at, reached(at))).collect();
    let mut found = BTreeSet::new();
    for (here, there) in &all {
        let cycle = there.iter().filter(|other| all[**other].contains(here));
        let cycle: Vec<String> = cycle.map(|m| modules[*m].file.clone()).collect();
        if cycle.len() > MOST_IN_A_CYCLE {
            found.insert(cycle);
        }
    }
    found.into_iter().collect()
}

#[test]
fn few_files_are_in_one_import_cycle() {
    let sources = sources();
    let folder_of = |file: &str| {
        let end = file.find("src/").map_or(0, |at| at + "src/".len());
        file[..end].to_owned()
    };
    let folders: BTreeSet<String> = sources.keys().map(|f| folder_of(f)).collect();
    let mut found = Vec::new();
    for folder in folders {
        let of_crate = sources
            .iter()
            .filter_map(|(file, text)| Some((file.strip_prefix(&folder)?, text.as_str())));
        let cycles = cycles(&modules(of_crate)).into_iter();
        found.extend(cycles.map(|cycle| {
            let (size, files) = (cycle.len(), cycle.join(", "));
            format!("a cycle of {size} files: {folder}{{{files}}}")
        }));
    }
    none(&found);
}

#[test]
fn a_planted_cycle_is_found() {
    let count = MOST_IN_A_CYCLE + 1;
    let planted = |by: &str| {
        let mut texts: Vec<(String, String)> = (0..count)
            .map(|i| {
                let next = (i + 1) % count;
                (
                    format!("a/m{i}.rs"),
                    format!("use {by}T{next};\nstruct T{i};\n"),
                )
            })
            .collect();
        let exports = (0..count).map(|i| format!("mod m{i};\npub use m{i}::T{i};\n"));
        texts.push(("a/mod.rs".to_owned(), exports.collect()));
        let pairs: Vec<_> = (texts.iter())
            .map(|(f, t)| (f.as_str(), t.as_str()))
            .collect();
        cycles(&modules(pairs.iter().copied()))
    };
    for by in ["super::", "crate::a::"] {
        let found = planted(by);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(
            found[0].len(),
            count,
            "the parent defines nothing: {found:?}"
        );
    }
    assert!(planted("other::").is_empty());
}
