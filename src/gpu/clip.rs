//! Clip test for a host's shaders: tests whether the cuts keep a point of a part.
//!
//! The host draws its surfaces with its own materials, and discards the fragments that the per-pixel list of crossings removes; the caps
//! are composited with these surfaces. The test is WGSL text for the host's shaders ([`clip_wgsl`]) and a bind group with the lists from
//! which the caps are made, so surfaces and caps are cut at the same depths. Reads each crossing in front of a fragment.
//!
//! Cannot: work with frames drawn in bands, which have several lists; decide the side of a face that lies in a clip-surface, unlike our own
//! passes; report that a pixel's list was too short ([`Session::poll`](crate::Session::poll) does that); show caps behind surfaces that
//! the host discards or draws as glass.

use super::Gpu;
use super::clip_layout::ClipLayout;
use super::programs::program::Program;
use crate::shader::{self, BindingKind, Shader};
use crate::{Error, Result};

/// Shader with the clip test.
const KEPT: &str = "gpu/clip/kept.wgsl";

/// Composes the clip test with the list of crossings, which contains those of all clip-surfaces.
fn kept() -> Shader {
    Shader::from(KEPT).with_all(&crate::passes::LISTED)
}

/// Name of the only shader variable that is not a resource of the plan: the [table](ClipTable).
const TABLE: &str = "cutaway_clip";

/// Size of a buffer of zeros that replaces missing buffers in an uncut frame: no crossing, no cut.
const NOTHING_BYTES: u64 = size_of::<crate::plan::pack::CutTable>() as u64;

/// WGSL for a host's shaders, with its bindings in the given group. It declares
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
    let mut module = shader::compose(&kept())?.module.clone();
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

impl Gpu {
    /// Layout of the bind group that [`clip_wgsl`] uses, for the host's pipelines: 2 uniform and 4 storage buffers, visible to all stages.
    pub fn clip_layout(&self) -> Result<wgpu::BindGroupLayout> {
        Ok(self.clip()?.layout.clone())
    }

    fn clip(&self) -> Result<&ClipLayout> {
        if let Some(known) = self.clip.get() {
            return Ok(known);
        }
        let composed = shader::compose(&kept())?;
        let entries: Vec<wgpu::BindGroupLayoutEntry> = (composed.bindings.iter())
            .map(|b| wgpu::BindGroupLayoutEntry {
                binding: b.binding,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
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
        let descriptor = wgpu::BindGroupLayoutDescriptor {
            label: Some("clip"),
            entries: &entries,
        };
        let layout = self.device.create_bind_group_layout(&descriptor);
        Ok(self.clip.get_or_init(|| ClipLayout { composed, layout }))
    }
}

/// Data about the parts of a scene that the clip test needs in addition to the lists.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClipTable {
    /// Scale factor from world space to scene space.
    pub(crate) scene_from_world: f32,
    /// For each part, by its index in the scene: one bit per cut that reaches it, and true if a cut removes the whole part.
    pub(crate) parts: Vec<(u32, bool)>,
}

impl ClipTable {
    /// The table as words, in the shader's layout.
    fn words(&self) -> Vec<u32> {
        let head = [self.scene_from_world.to_bits(), 0];
        let rows = self.parts.iter();
        let rows = rows.flat_map(|(cuts, is_removed)| [*cuts, u32::from(*is_removed)]);
        head.into_iter().chain(rows).collect()
    }
}

/// The clip bind group of a program, valid as long as the program keeps its buffers.
pub(crate) struct ClipBindGroup {
    generation: u64,
    table: ClipTable,
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl ClipBindGroup {
    pub(crate) fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }
}

impl Program {
    /// The bind group of the program's lists and a table of the parts; a previous bind group is reused if it is still valid.
    pub(crate) fn clip(
        &self,
        gpu: &Gpu,
        table: ClipTable,
        before: Option<ClipBindGroup>,
    ) -> Result<ClipBindGroup> {
        let fits = |b: &ClipBindGroup| {
            b.generation == self.generation() && b.table.parts.len() == table.parts.len()
        };
        if let Some(clip) = before.filter(fits) {
            if clip.table != table {
                let words = table.words();
                (gpu.queue).write_buffer(&clip.buffer, 0, bytemuck::cast_slice(&words));
            }
            return Ok(ClipBindGroup { table, ..clip });
        }
        let words = table.words();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM;
        let new_buffer = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let ClipLayout { composed, layout } = gpu.clip()?;
        gpu.scoped(|| {
            let buffer = new_buffer(TABLE, words.len() as u64 * 4);
            (gpu.queue).write_buffer(&buffer, 0, bytemuck::cast_slice(&words));
            let nothing = new_buffer("nothing is cut", NOTHING_BYTES);
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (composed.bindings.iter())
                .map(|b| wgpu::BindGroupEntry {
                    binding: b.binding,
                    resource: match b.name.as_str() {
                        TABLE => buffer.as_entire_binding(),
                        name => (self.buffer_named(name).unwrap_or(&nothing)).as_entire_binding(),
                    },
                })
                .collect();
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("clip"),
                layout,
                entries: &entries,
            });
            Ok(ClipBindGroup {
                generation: self.generation(),
                table,
                buffer,
                group,
            })
        })
    }
}
