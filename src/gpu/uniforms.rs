//! Uniforms, and the storage buffers that replace them on drivers that recompile a shader for each uniform value.
//!
//! llvmpipe of Mesa before 25 inlines uniforms that control branches or loops into the shader on every bind, and keeps each compiled copy
//! as long as the pipeline: 1 MB per frame of a cube. It does not inline values read from storage buffers. A shader is left
//! unchanged if it would then exceed the device's limit on storage buffers.

/// First major release of Mesa that keeps no such copies.
const MENDED_IN_MESA: u32 = 25;

/// Returns true if the driver keeps a compiled copy of a shader on each bind.
pub(super) fn are_inlined(info: &wgpu::AdapterInfo) -> bool {
    let release = info.driver_info.strip_prefix("Mesa ");
    let major = release.and_then(|release| release.split('.').next()?.parse().ok());
    info.driver == "llvmpipe" && major.is_some_and(|major: u32| major < MENDED_IN_MESA)
}

/// Usage flags of uniform buffers.
pub(super) fn usage(inlined: bool) -> wgpu::BufferUsages {
    match inlined {
        true => wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE,
        false => wgpu::BufferUsages::UNIFORM,
    }
}

/// Moves uniforms to storage buffers, unless the shader would then have more than `most`. Their memory layout does not change.
pub(super) fn read_from_storage(module: &mut naga::Module, most: usize) {
    let is_buffer = |space| {
        matches!(
            space,
            naga::AddressSpace::Uniform | naga::AddressSpace::Storage { .. }
        )
    };
    let globals = module.global_variables.iter();
    if globals.filter(|(_, g)| is_buffer(g.space)).count() > most {
        return;
    }
    for (_, global) in module.global_variables.iter_mut() {
        if global.space == naga::AddressSpace::Uniform {
            global.space = naga::AddressSpace::Storage {
                access: naga::StorageAccess::LOAD,
            };
        }
    }
}
