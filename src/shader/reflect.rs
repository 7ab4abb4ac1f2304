//! Bindings and struct layouts of a composed module, from naga.

use super::join::undecorated;
use naga::valid::ModuleInfo;
use naga::{AddressSpace, Module, StorageAccess, TypeInner};

/// Kind of a bound resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingKind {
    /// `var<uniform>`.
    Uniform,
    /// `var<storage, read>`.
    StorageRead,
    /// `var<storage, read_write>`.
    StorageReadWrite,
    /// A texture without layers that is not a depth texture.
    Texture,
    /// A depth texture without layers.
    DepthTexture,
    /// A texture with layers.
    TextureArray,
    Sampler,
}

/// One `@group @binding` variable that an entry point uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderBinding {
    /// Name of the variable, without its module's name.
    pub name: String,
    pub group: u32,
    pub binding: u32,
    /// Kind of the resource.
    pub kind: BindingKind,
    /// True for each stage that uses the variable: vertex, fragment, compute.
    pub stages: [bool; 3],
}

/// The bindings used by a module's entry points, by group and number.
pub fn bindings(module: &Module, info: &ModuleInfo) -> Vec<ShaderBinding> {
    let mut found: Vec<ShaderBinding> = module
        .global_variables
        .iter()
        .filter_map(|(handle, variable)| {
            let at = variable.binding.as_ref()?;
            let kind = match variable.space {
                AddressSpace::Uniform => BindingKind::Uniform,
                AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) => {
                    BindingKind::StorageReadWrite
                }
                AddressSpace::Storage { .. } => BindingKind::StorageRead,
                _ => match module.types[variable.ty].inner {
                    TypeInner::Sampler { .. } => BindingKind::Sampler,
                    TypeInner::Image { arrayed: true, .. } => BindingKind::TextureArray,
                    TypeInner::Image {
                        class: naga::ImageClass::Depth { .. },
                        ..
                    } => BindingKind::DepthTexture,
                    _ => BindingKind::Texture,
                },
            };
            let mut stages = [false; 3];
            for (index, entry) in module.entry_points.iter().enumerate() {
                let used = !info.get_entry_point(index)[handle].is_empty();
                let stage = match entry.stage {
                    naga::ShaderStage::Vertex => 0,
                    naga::ShaderStage::Fragment => 1,
                    _ => 2,
                };
                stages[stage] |= used;
            }
            let name = undecorated(variable.name.as_deref().unwrap_or_default()).to_owned();
            let binding = ShaderBinding {
                name,
                group: at.group,
                binding: at.binding,
                kind,
                stages,
            };
            binding.stages.contains(&true).then_some(binding)
        })
        .collect();
    found.sort_by_key(|b| (b.group, b.binding));
    found
}

/// naga's layout of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructLayout {
    /// Name, offset and size in bytes of each field.
    pub fields: Vec<(String, u32, u32)>,
    /// Size in bytes.
    pub size: u32,
}

/// The layout of a module's struct.
pub fn struct_layout(module: &Module, name: &str) -> Option<StructLayout> {
    module.types.iter().find_map(|(_, ty)| match &ty.inner {
        TypeInner::Struct { members, span }
            if ty.name.as_deref().is_some_and(|n| undecorated(n) == name) =>
        {
            let fields = members.iter().map(|m| {
                let size = module.types[m.ty].inner.size(module.to_ctx());
                (m.name.clone().unwrap_or_default(), m.offset, size)
            });
            Some(StructLayout {
                fields: fields.collect(),
                size: *span,
            })
        }
        _ => None,
    })
}
