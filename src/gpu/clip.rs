//! What the shaders of a host ask: whether a point of a part is kept.
//!
//! The host draws its surfaces with materials of its own and leaves out what the one list of crossings says is removed; the caps are
//! composed beside them. The question is WGSL text for the host's shaders ([`clip_wgsl`]) and a bind group of the very lists that the
//! caps come from, so that both are cut at the same depths. Costs what ranking a fragment costs: a look at each crossing before it.
//!
//! Cannot: serve frames drawn in bands, whose lists are several.

use super::Gpu;
use super::program::Program;
use crate::shader::{self, BindingKind, ShaderBinding};
use crate::{Error, Result};

/// The shader that asks.
const KEPT: &str = "gpu/clip/kept.wgsl";

/// Its variable that is no resource of the plan: the [table](ClipTable).
const TABLE: &str = "cutaway_clip";

/// Zeros in the place of what a frame in which nothing is cut does not have: no crossing, no cut.
const NOTHING_BYTES: u64 = size_of::<crate::plan::pack::CutTable>() as u64;

/// WGSL for the shaders of a host, with its bindings in a group of the host's choice. It declares
///
/// ```wgsl
/// // The depth that `cutaway_is_kept` compares, of a point so far ahead of the eye, along the viewing direction, in world units.
/// fn cutaway_depth(distance: f32) -> f32
/// // Whether a point of a part is kept: `pixel` counts from the upper left corner of the frame, `part` is its index in the scene.
/// fn cutaway_is_kept(pixel: vec2<u32>, depth: f32, part: u32) -> bool
/// ```
pub fn clip_wgsl(group: u32) -> Result<String> {
    let fault = |what: String| Error::Shader {
        name: KEPT.to_owned(),
        what,
    };
    let mut module = shader::compose(&KEPT.into())?;
    module.entry_points.clear();
    for (_, variable) in module.global_variables.iter_mut() {
        if let Some(binding) = &mut variable.binding {
            binding.group = group;
        }
    }
    let info = shader::validate(&module).map_err(fault)?;
    let flags = naga::back::wgsl::WriterFlags::empty();
    naga::back::wgsl::write_string(&module, &info, flags).map_err(|e| fault(e.to_string()))
}

/// What the shader binds, by name.
fn bound() -> Result<Vec<ShaderBinding>> {
    Ok(shader::bindings(&shader::compose(&KEPT.into())?))
}

impl Gpu {
    /// The layout of the bind group that goes with [`clip_wgsl`], for the pipelines of the host.
    pub fn clip_layout(&self) -> Result<wgpu::BindGroupLayout> {
        let entries: Vec<wgpu::BindGroupLayoutEntry> = (bound()?.iter())
            .map(|b| wgpu::BindGroupLayoutEntry {
                binding: b.binding,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: match b.kind {
                        BindingKind::Uniform => wgpu::BufferBindingType::Uniform,
                        _ => wgpu::BufferBindingType::Storage { read_only: true },
                    },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            })
            .collect();
        let layout = wgpu::BindGroupLayoutDescriptor {
            label: Some("clip"),
            entries: &entries,
        };
        Ok(self.device.create_bind_group_layout(&layout))
    }
}

/// What is known of the parts of a scene beside the lists.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClipTable {
    /// By how much scene space is larger than the world.
    pub(crate) scene_from_world: f32,
    /// Bits of the cuts that apply to each part, by its index in the scene; all of them where it is removed altogether.
    pub(crate) cuts_of_part: Vec<u32>,
}

impl Program {
    /// The bind group of its lists, with a table of the parts.
    pub(crate) fn clip_group(&self, gpu: &Gpu, table: &ClipTable) -> Result<wgpu::BindGroup> {
        let mut words = vec![table.scene_from_world.to_bits()];
        words.extend(&table.cuts_of_part);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM;
        let buffer = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        gpu.scoped(|| {
            let table = buffer(TABLE, words.len() as u64 * 4);
            gpu.queue
                .write_buffer(&table, 0, bytemuck::cast_slice(&words));
            let nothing = buffer("nothing is cut", NOTHING_BYTES);
            let bound = bound()?;
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (bound.iter())
                .map(|b| {
                    let buffer = match b.name.as_str() {
                        TABLE => &table,
                        name => self.buffer_named(name).unwrap_or(&nothing),
                    };
                    wgpu::BindGroupEntry {
                        binding: b.binding,
                        resource: buffer.as_entire_binding(),
                    }
                })
                .collect();
            Ok(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("clip"),
                layout: &gpu.clip_layout()?,
                entries: &entries,
            }))
        })
    }
}
