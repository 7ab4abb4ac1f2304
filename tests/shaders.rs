//! Every composition is valid under naga's default capabilities, and every file is known to the tree.

use cutaway::shader;

#[test]
fn every_shader_composes() {
    let mut faults = Vec::new();
    for (path, _) in shader::SHADERS {
        match shader::compose(path) {
            Ok(module) => assert!(!module.entry_points.is_empty(), "{path} has no entry point"),
            Err(e) => faults.push(e.to_string()),
        }
    }
    assert!(
        shader::SHADERS.len() > 10,
        "the list of shaders is suspiciously short"
    );
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
