//! Runs without a scene of their own: the library's hard cases, and the search through random scenes.

use cutaway::Result;
use cutaway::strategies::Method;
use cutaway_io::document::reader::{Entry, Table};

use super::Asked;
use super::scenes;
use crate::experiment::Renderer;

/// Selected hard cases.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedCases {
    /// Globs that match the ids of the selected cases.
    pub cases: Vec<String>,
    /// Methods to run; `None` means the methods that each case names.
    pub methods: Option<Vec<Method>>,
    /// Side lengths of the pictures in pixels; if empty, each case uses its own.
    pub sizes_px: Vec<u32>,
}

/// A search through random scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedSearch {
    /// Number of random scenes.
    pub scenes: usize,
    /// Seed of the first scene.
    pub seed: u64,
    /// Methods to run; `None` means all methods that should be exact.
    pub methods: Option<Vec<Method>>,
}

/// Reads a run of hard cases: the full task, and that of `--quick`.
pub(super) fn read_cases(entry: &Entry<'_>) -> Result<(Asked, Asked)> {
    let table = entry.table(&["name", "about", "cases", "strategies", "sizes", "quick"])?;
    let globs = table.need("cases", "[\"*\"]")?;
    let full = AskedCases {
        cases: scenes::some_texts(&globs)?,
        methods: methods(&table)?,
        sizes_px: sizes(&table)?.unwrap_or_default(),
    };
    let mut quick = full.clone();
    if let Some(entry) = table.get("quick") {
        let table = entry.table(&["sizes", "strategies"])?;
        quick.sizes_px = sizes(&table)?.unwrap_or(quick.sizes_px);
        quick.methods = methods(&table)?.or(quick.methods);
    }
    Ok((Asked::Cases(full), Asked::Cases(quick)))
}

/// Reads a search: the full task, and that of `--quick`.
pub(super) fn read_search(entry: &Entry<'_>) -> Result<(Asked, Asked)> {
    let table = entry.table(&["name", "about", "random", "strategies", "quick"])?;
    let random = table.need("random", "{ scenes = 200, seed = 1 }")?;
    let mut full = AskedSearch {
        scenes: 0,
        seed: 1,
        methods: methods(&table)?,
    };
    search(&random, &mut full)?;
    let mut quick = full.clone();
    if let Some(entry) = table.get("quick") {
        let table = entry.table(&["random", "strategies"])?;
        quick.methods = methods(&table)?.or(quick.methods);
        if let Some(random) = table.get("random") {
            search(&random, &mut quick)?;
        }
    }
    Ok((Asked::Search(full), Asked::Search(quick)))
}

fn search(entry: &Entry<'_>, asked: &mut AskedSearch) -> Result<()> {
    let table = entry.table(&["scenes", "seed"])?;
    let scenes = table.need("scenes", "200")?;
    asked.scenes = scenes.whole()?;
    if asked.scenes == 0 {
        return Err(scenes.fault("no scene is searched", "write at least 1"));
    }
    if let Some(seed) = table.get("seed") {
        asked.seed = seed.whole()?;
    }
    Ok(())
}

fn methods(table: &Table<'_>) -> Result<Option<Vec<Method>>> {
    let Some(entry) = table.get("strategies") else {
        return Ok(None);
    };
    let mut methods: Vec<Method> = Vec::new();
    for text in scenes::some_texts(&entry)? {
        for renderer in Renderer::named(&text).map_err(|f| entry.place(f))? {
            let Some(method) = renderer.method() else {
                let what = format!("hard cases cannot be run with {renderer}");
                return Err(entry.fault(&what, "name strategies, with any draw options after an @"));
            };
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
    }
    Ok(Some(methods))
}

fn sizes(table: &Table<'_>) -> Result<Option<Vec<u32>>> {
    let Some(entry) = table.get("sizes") else {
        return Ok(None);
    };
    let sizes: Vec<u32> = (entry.list()?.iter())
        .map(Entry::whole)
        .collect::<Result<_>>()?;
    if sizes.is_empty() || sizes.iter().any(|s| !(8..=4096).contains(s)) {
        let help = "write for example `sizes = [64, 256]`: whole numbers from 8 to 4096";
        return Err(entry.fault("it is not a list of picture sizes", help));
    }
    Ok(Some(sizes))
}
