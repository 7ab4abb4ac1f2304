//! Composition of one shader from the tree.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, NagaModuleDescriptor, ShaderLanguage,
};

use super::tree::{LIBRARY, source};
use crate::{Error, Result};

/// Modules composed so far: plans are checked, reflected and compiled from the same one.
static COMPOSED: Mutex<BTreeMap<String, naga::Module>> = Mutex::new(BTreeMap::new());

/// The composed and validated module of a shader, validated with naga's default capabilities: what core WebGPU offers.
pub fn compose(path: &str) -> Result<naga::Module> {
    let mut composed = COMPOSED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(module) = composed.get(path) {
        return Ok(module.clone());
    }
    let text = source(path).ok_or_else(|| Error::Shader {
        name: path.to_owned(),
        what: "there is no such shader".to_owned(),
    })?;
    let module = compose_text(path, text)?;
    composed.insert(path.to_owned(), module.clone());
    Ok(module)
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
