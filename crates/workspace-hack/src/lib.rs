//! An empty crate whose dependencies enable features: see its `Cargo.toml`.
