//! Composes a shader from the files of the tree.
//!
//! A module that several library files define is *open*: `cutaway::store`, for example, stores the data of a fragment for
//! the inside test, and has one file per inside test. A [`Shader`] names the file that fills each open module that it needs.
//! So two shaders may differ in a single file, and a pass over the mesh is written once for all tests and both rasterisers.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use super::file::File;
use super::hold::hold_uniforms;
use super::join::join;
use super::reflect::{ShaderBinding, bindings};
use super::tree::{LIBRARY, NATIVE, SHADERS, source};
use crate::{Error, Result};

/// A shader of the tree and the files that fill its open modules.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Shader {
    /// Path in the tree.
    pub path: &'static str,
    /// Paths of library files, one for each open module that the shader needs, sorted.
    pub with: Vec<&'static str>,
}

impl Shader {
    /// Fills a further open module.
    #[must_use]
    pub fn with(mut self, file: &'static str) -> Self {
        self.with.push(file);
        self.with.sort_unstable();
        self.with.dedup();
        self
    }

    /// Fills further open modules.
    #[must_use]
    pub fn with_all(self, files: &[&'static str]) -> Self {
        files.iter().fold(self, |shader, file| shader.with(file))
    }
}

impl From<&'static str> for Shader {
    fn from(path: &'static str) -> Self {
        Self {
            path,
            with: Vec::new(),
        }
    }
}

impl fmt::Display for Shader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.path)?;
        if self.with.is_empty() {
            return Ok(());
        }
        write!(f, " with {}", self.with.join(", "))
    }
}

/// A shader of the tree composed with everything it imports.
#[derive(Debug)]
pub struct Composed {
    /// The module, validated with naga's default capabilities, those of core WebGPU; shaders with a file of [`NATIVE`] may also use
    /// 64-bit atomics.
    pub module: naga::Module,
    /// naga's analysis of the module.
    pub info: ModuleInfo,
    /// Bindings of its entry points, by group and number.
    pub bindings: Vec<ShaderBinding>,
    /// True if the shader needs 64-bit atomics.
    pub is_native: bool,
}

/// The shaders composed so far, so that plans are checked, reflected and compiled from the same composed shader.
static COMPOSED: Mutex<BTreeMap<Shader, Arc<Composed>>> = Mutex::new(BTreeMap::new());

/// Composes a shader, or returns the cached result.
pub fn compose(shader: &Shader) -> Result<Arc<Composed>> {
    let mut known = COMPOSED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(composed) = known.get(shader) {
        return Ok(Arc::clone(composed));
    }
    let text = source(shader.path).ok_or_else(|| Error::Shader {
        name: shader.path.to_owned(),
        what: "there is no such shader".to_owned(),
    })?;
    let (module, info, is_native) = compose_source(&shader.to_string(), text, &shader.with)?;
    let bindings = bindings(&module, &info);
    let composed = Arc::new(Composed {
        module,
        info,
        bindings,
        is_native,
    });
    known.insert(shader.clone(), Arc::clone(&composed));
    Ok(composed)
}

/// naga's analysis of a composed shader, or naga's error message if the shader is invalid. Accepts features beyond core WebGPU, because
/// these were already checked when the shader was composed.
pub fn validate(module: &naga::Module) -> Result<ModuleInfo, String> {
    let validated = validator(true).validate(module);
    validated.map_err(|e| chain(e.as_inner()))
}

fn validator(is_native: bool) -> Validator {
    Validator::new(ValidationFlags::all(), capabilities(is_native))
}

/// The message of an error, followed by those of its sources.
fn chain(error: &dyn std::error::Error) -> String {
    let mut what = error.to_string();
    let mut from = error.source();
    while let Some(cause) = from {
        what = format!("{what}: {cause}");
        from = cause.source();
    }
    what
}

/// As [`compose`], for a text that is not in the tree, so that tests can wrap library functions in small shaders.
pub fn compose_text(name: &str, text: &str) -> Result<naga::Module> {
    compose_text_with(name, text, &[])
}

/// As [`compose_text`], with files that fill open modules.
pub fn compose_text_with(name: &str, text: &str, with: &[&str]) -> Result<naga::Module> {
    compose_source(name, text, with).map(|(module, ..)| module)
}

/// Composes a text: returns its module, naga's analysis, and true if it needs 64-bit atomics.
fn compose_source(
    name: &str,
    text: &str,
    with: &[&str],
) -> Result<(naga::Module, ModuleInfo, bool)> {
    let fault = |what: String| Error::Shader {
        name: name.to_owned(),
        what,
    };
    let shader = File::read(name, text);
    let mut files = Vec::new();
    let mut idle: BTreeSet<&str> = with.iter().copied().collect();
    gather(&shader, with, &mut files, &mut idle).map_err(fault)?;
    if let Some(file) = idle.first() {
        return Err(fault(format!(
            "it has no open module that {file} could fill"
        )));
    }
    let is_native = (files.iter()).any(|f| NATIVE.iter().any(|(listed, _)| *listed == f.path));
    let joined = join(&shader, &files).map_err(fault)?;
    let whole = &joined.text;
    let mut module = naga::front::wgsl::parse_str(whole).map_err(|e| {
        let details = e.labels().map(|(_, label)| label).chain(e.notes());
        let said: Vec<&str> = [e.message()]
            .into_iter()
            .chain(details.filter(|d| !d.is_empty()))
            .collect();
        let line = e.location(whole).map(|l| l.line_number);
        fault(joined.complaint(line, &said.join(": ")))
    })?;
    let validated = |module: &naga::Module| {
        validator(is_native).validate(module).map_err(|e| {
            let line = e.location(whole).map(|l| l.line_number);
            fault(joined.complaint(line, &chain(e.as_inner())))
        })
    };
    let mut info = validated(&module)?;
    if hold_uniforms(&mut module, &info, with) {
        info = validated(&module)?;
    }
    Ok((module, info, is_native))
}

/// Capabilities that naga allows.
fn capabilities(native: bool) -> Capabilities {
    if native {
        Capabilities::default()
            | Capabilities::SHADER_INT64
            | Capabilities::SHADER_INT64_ATOMIC_MIN_MAX
    } else {
        Capabilities::default()
    }
}

/// All ways to fill the open modules of the tree's shaders. For a shader with more than 128 ways, a subset in which every pair of
/// compatible files occurs.
pub fn compositions() -> Vec<Shader> {
    let mut all = Vec::new();
    for (path, text) in SHADERS {
        let file = File::read(path, text);
        let mut open = vec![Shader::from(*path)];
        let mut ways = Vec::new();
        while let Some(shader) = open.pop() {
            match first_open(&file, &shader.with, &mut BTreeSet::new()) {
                Some(files) => open.extend(files.into_iter().map(|f| shader.clone().with(f))),
                None => ways.push(shader),
            }
        }
        ways.sort();
        all.extend(if ways.len() > FEW {
            with_all_pairs(&ways)
        } else {
            ways
        });
    }
    all.sort();
    all
}

/// Number of compositions up to which all those of a shader are included.
const FEW: usize = 128;

/// A small subset of the compositions in which every pair of files occurs. Greedily adds the composition with the most new pairs.
fn with_all_pairs(ways: &[Shader]) -> Vec<Shader> {
    let pairs = |shader: &Shader| -> Vec<[&'static str; 2]> {
        let with = &shader.with;
        let firsts = with.iter().enumerate();
        firsts
            .flat_map(|(i, a)| with[i + 1..].iter().map(move |b| [*a, *b]))
            .collect()
    };
    let mut missing: BTreeSet<[&str; 2]> = ways.iter().flat_map(pairs).collect();
    let mut chosen = Vec::new();
    while !missing.is_empty() {
        let added = |shader: &&Shader| {
            pairs(shader)
                .iter()
                .filter(|p| missing.contains(*p))
                .count()
        };
        let Some(best) = ways.iter().max_by_key(added) else {
            break;
        };
        pairs(best).iter().for_each(|pair| {
            missing.remove(pair);
        });
        chosen.push(best.clone());
    }
    chosen
}

/// The library files, grouped by the module that they define.
static MODULES: LazyLock<BTreeMap<&str, Vec<File<'static>>>> = LazyLock::new(|| {
    let mut modules = BTreeMap::<&str, Vec<File<'static>>>::new();
    for (path, text) in LIBRARY {
        let file = File::read(path, text);
        if let Some(module) = file.module {
            modules.entry(module).or_default().push(file);
        }
    }
    modules
});

/// The library files that define a module.
fn files_of(module: &str) -> &'static [File<'static>] {
    MODULES.get(module).map_or(&[], Vec::as_slice)
}

/// The files that a file imports, directly or not; each comes after its own imports.
fn gather<'a>(
    file: &File<'_>,
    with: &[&'a str],
    files: &mut Vec<&'static File<'static>>,
    idle: &mut BTreeSet<&'a str>,
) -> Result<(), String> {
    for module in file.modules() {
        let candidates = files_of(module);
        let chosen = with
            .iter()
            .find_map(|w| candidates.iter().find(|file| file.path == *w));
        let file = match (chosen, candidates) {
            (Some(file), _) => {
                idle.remove(file.path);
                file
            }
            (None, [only]) => only,
            (None, []) => return Err(format!("there is no module {module}")),
            (None, several) => {
                let paths: Vec<&str> = several.iter().map(|file| file.path).collect();
                return Err(format!(
                    "{module} is open: fill it with one of {}",
                    paths.join(", ")
                ));
            }
        };
        let is_there = |files: &[&File<'_>]| files.iter().any(|f| f.path == file.path);
        if !is_there(files) {
            gather(file, with, files, idle)?;
            if !is_there(files) {
                files.push(file);
            }
        }
    }
    Ok(())
}

/// The files that can fill the first open module that is not yet filled.
fn first_open(
    file: &File<'static>,
    with: &[&'static str],
    seen: &mut BTreeSet<&'static str>,
) -> Option<Vec<&'static str>> {
    for module in file.modules() {
        let candidates = files_of(module);
        let chosen = candidates.iter().find(|file| with.contains(&file.path));
        let file = match (chosen, candidates) {
            (Some(file), _) => file,
            (None, [only]) => only,
            (None, several) => return Some(several.iter().map(|file| file.path).collect()),
        };
        if seen.insert(file.path)
            && let Some(files) = first_open(file, with, seen)
        {
            return Some(files);
        }
    }
    None
}
