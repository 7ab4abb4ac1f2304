//! The WGSL tree as data: its files, the shaders composed from them, and their bindings.
//!
//! Files under `shaders/lib` are modules with a `#define_import_path`; all others are whole shaders. They are joined into one text,
//! which naga parses, validates and reflects. None of this needs an adapter, so a test composes and checks all shaders.

mod bounds;
mod compose;
mod file;
mod hold;
mod join;
mod lints;
mod loops;
mod reflect;
mod tree;

pub use compose::{
    Composed, Shader, compose, compose_text, compose_text_with, compositions, validate,
};
pub use lints::{Finding, INVOCATIONS_PER_WORKGROUP, Rule, STORAGE_BUFFERS_PER_STAGE, lint};
pub use reflect::{BindingKind, ShaderBinding, StructLayout, bindings, struct_layout};
pub use tree::{FILES, LIBRARY, NATIVE, SHADERS, source};
