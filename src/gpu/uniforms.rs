//! Uniforms, and the storage buffers in their place on a driver that recompiles its shaders for each of their values.
//!
//! llvmpipe of Mesa before 25 puts uniforms on which branches or loops hang into the shader whenever it is bound, and keeps the copy that it
//! makes for that as long as the pipeline: 1 MB a frame of a cube. What is read from storage it leaves alone. A shader that would then
//! have more storage buffers than the device allows stays as it is.

/// The first release of Mesa that keeps no copies.
const MENDED_IN_MESA: u32 = 25;

/// Returns true if the driver keeps a copy of a shader each time that it is bound.
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

/// Puts uniforms into storage, if it then holds at most `most` buffers. Their layout is the same in both.
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
