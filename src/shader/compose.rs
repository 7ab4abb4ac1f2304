//! Composition of one shader from the tree.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, NagaModuleDescriptor, ShaderLanguage,
};

use super::reflect::{ShaderBinding, bindings};
use super::tree::{LIBRARY, source};
use crate::{Error, Result};

/// The bindings of the shaders that were asked for.
static REFLECTED: Mutex<BTreeMap<String, Arc<[ShaderBinding]>>> = Mutex::new(BTreeMap::new());

/// The bindings of a shader of the tree. Each is composed once in a process: plans are checked every frame, and to compose
/// takes milliseconds.
pub fn bindings_of(path: &str) -> Result<Arc<[ShaderBinding]>> {
    // A poisoned lock only means that another thread panicked while it held plain data.
    let mut reflected = REFLECTED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = reflected.get(path) {
        return Ok(known.clone());
    }
    let found: Arc<[ShaderBinding]> = bindings(&compose(path)?).into();
    reflected.insert(path.to_owned(), found.clone());
    Ok(found)
}

/// The composed and validated module of a shader, validated with naga's default capabilities: what core WebGPU offers.
pub fn compose(path: &str) -> Result<naga::Module> {
    let text = source(path).ok_or_else(|| Error::Shader {
        name: path.to_owned(),
        what: "there is no such shader".to_owned(),
    })?;
    compose_text(path, text)
}

/// As [`compose`], of a text that is not in the tree: tests wrap library functions in small shaders this way.
pub fn compose_text(name: &str, text: &str) -> Result<naga::Module> {
    let mut composer = Composer::default();
    let report = |composer: &Composer, e: ComposerError| Error::Shader {
        name: name.to_owned(),
        what: e.emit_to_string(composer),
    };
    for (path, source) in LIBRARY {
        let descriptor = ComposableModuleDescriptor {
            source,
            file_path: path,
            language: ShaderLanguage::Wgsl,
            ..ComposableModuleDescriptor::default()
        };
        if let Err(e) = composer.add_composable_module(descriptor) {
            return Err(report(&composer, e));
        }
    }
    let descriptor = NagaModuleDescriptor {
        source: text,
        file_path: name,
        ..NagaModuleDescriptor::default()
    };
    composer
        .make_naga_module(descriptor)
        .map_err(|e| report(&composer, e))
}
