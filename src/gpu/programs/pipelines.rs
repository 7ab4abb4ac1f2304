//! Pipelines, keyed by everything they depend on: shader, constants and, for draws, the state of the attachments.
//!
//! All programs of a device share them, so a method whose shaders have been used before starts without a stall. Constants are substituted
//! into the shader first, because the WGSL that wgpu passes to a browser has other names for them.

use std::collections::BTreeMap;
use std::sync::Arc;

use naga::back::PipelineConstants;
use naga::back::pipeline_constants::process_overrides;

use crate::gpu::Gpu;
use crate::gpu::resource::texel_format;
use crate::gpu::timing::timed;
use crate::plan::{
    DepthCompare, Format, Pass, Plan, ResourceId, Shape, StencilStep, Vertices, Work,
};
use crate::shader::{self, Composed, Shader};
use crate::{Error, Result};

/// A pipeline of either kind.
pub(in crate::gpu) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

/// Maximum number of pipelines that are kept although no program currently uses them.
const MOST_IDLE: usize = 256;

/// Pipelines, keyed by everything they depend on.
#[derive(Default)]
pub(in crate::gpu) struct Pipelines {
    made: BTreeMap<PipelineKey, (Arc<Pipeline>, Arc<Composed>)>,
}

/// Everything a pipeline depends on.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct PipelineKey {
    shader: Shader,
    /// Name and value of each constant, the value as bits.
    constants: Vec<(&'static str, u64)>,
    /// State of the attachments; none for compute pipelines.
    draw: Option<DrawState>,
}

/// Attachment state that a render pipeline depends on.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct DrawState {
    color: Option<Format>,
    depth: Format,
    compare: DepthCompare,
    stencil: Option<StencilStep>,
    has_vertices: bool,
}

impl PipelineKey {
    fn of(plan: &Plan, pass: &Pass) -> Self {
        let draw = match &pass.work {
            Work::Compute { .. } | Work::ComputeIndirect { .. } => None,
            Work::Draw {
                color,
                depth,
                vertices,
                ..
            } => Some(DrawState {
                color: color.map(|c| format_of(plan, c.resource)),
                depth: format_of(plan, depth.resource),
                compare: depth.compare,
                stencil: depth.stencil.map(|s| s.step),
                has_vertices: matches!(vertices, Vertices::Mesh(_)),
            }),
        };
        let constants = pass.constants.iter();
        Self {
            shader: pass.shader.clone(),
            constants: constants.map(|(name, v)| (*name, v.to_bits())).collect(),
            draw,
        }
    }
}

impl Pipelines {
    /// The pipeline of a pass and its bindings; created on first use.
    pub(in crate::gpu) fn get(
        &mut self,
        gpu: &Gpu,
        plan: &Plan,
        pass: &Pass,
    ) -> Result<(Arc<Pipeline>, Arc<Composed>)> {
        let recipe = PipelineKey::of(plan, pass);
        if let Some(made) = self.made.get(&recipe) {
            return Ok(made.clone());
        }
        let composed = shader::compose(&pass.shader)?;
        let constants: PipelineConstants = (pass.constants.iter())
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect();
        let (resolved, _) = process_overrides(&composed.module, &composed.info, None, &constants)
            .map_err(|e| Error::Shader {
            name: pass.shader.to_string(),
            what: e.to_string(),
        })?;
        let compile = || {
            let module = gpu.module(pass.shader.path, resolved.into_owned());
            Ok(match pass.work {
                Work::Draw { .. } => Pipeline::Render(render_pipeline(gpu, plan, pass, &module)),
                Work::Compute { .. } | Work::ComputeIndirect { .. } => Pipeline::Compute(
                    gpu.device
                        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                            label: Some(&pass.name),
                            layout: None,
                            module: &module,
                            entry_point: Some("main"),
                            compilation_options: wgpu::PipelineCompilationOptions::default(),
                            cache: None,
                        }),
                ),
            })
        };
        let mut preparing = gpu.preparing();
        preparing.pipelines += 1;
        let made = timed(&mut preparing.compiling, || gpu.scoped(compile))?;
        drop(preparing);
        if self.made.len() >= MOST_IDLE {
            let is_held = |p: &Arc<Pipeline>| Arc::strong_count(p) > 1;
            if self.made.values().filter(|(p, _)| !is_held(p)).count() >= MOST_IDLE {
                self.made.retain(|_, (p, _)| is_held(p));
            }
        }
        let made = (Arc::new(made), composed);
        self.made.insert(recipe, made.clone());
        Ok(made)
    }
}

fn render_pipeline(
    gpu: &Gpu,
    plan: &Plan,
    pass: &Pass,
    module: &wgpu::ShaderModule,
) -> wgpu::RenderPipeline {
    let Work::Draw {
        color,
        depth,
        vertices,
        ..
    } = &pass.work
    else {
        unreachable!("only draws have render pipelines")
    };
    let attributes = [
        wgpu::VertexAttribute {
            format: wgpu::VertexFormat::Float32x3,
            offset: 0,
            shader_location: 0,
        },
        wgpu::VertexAttribute {
            format: wgpu::VertexFormat::Uint32,
            offset: 12,
            shader_location: 1,
        },
    ];
    let mesh = Some(wgpu::VertexBufferLayout {
        array_stride: 16,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    });
    let buffers = if matches!(vertices, Vertices::Mesh(_)) {
        std::slice::from_ref(&mesh)
    } else {
        &[]
    };
    let targets = color.map(|c| {
        Some(wgpu::ColorTargetState {
            format: texel_format(format_of(plan, c.resource)),
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
        })
    });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&pass.name),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: None,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: texel_format(format_of(plan, depth.resource)),
                depth_write_enabled: Some(depth.compare.writes()),
                depth_compare: Some(match depth.compare {
                    DepthCompare::Greater => wgpu::CompareFunction::Greater,
                    DepthCompare::Less | DepthCompare::Behind => wgpu::CompareFunction::Less,
                    DepthCompare::Always | DepthCompare::Replace => wgpu::CompareFunction::Always,
                }),
                stencil: depth
                    .stencil
                    .map(|s| stencil_state(s.step))
                    .unwrap_or_default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: targets.as_slice(),
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn format_of(plan: &Plan, id: ResourceId) -> Format {
    match plan.resource(id).shape {
        Shape::Texture { format, .. } => format,
        Shape::Buffer { .. } | Shape::Sampler { .. } => Format::Rg32Uint,
    }
}

/// Converts a stencil step; a face that it does not mention leaves the stencil unchanged.
fn stencil_state(step: StencilStep) -> wgpu::StencilState {
    use wgpu::StencilOperation::{DecrementWrap, IncrementWrap, Invert, Keep, Zero};
    let face = |compare, fail, hidden, shown| wgpu::StencilFaceState {
        compare,
        fail_op: fail,
        depth_fail_op: hidden,
        pass_op: shown,
    };
    let all = wgpu::CompareFunction::Always;
    let (front, back, read, write) = match step {
        StencilStep::Flip { bits } => {
            let both = face(all, Keep, Keep, Invert);
            (both, both, 0xff, bits)
        }
        StencilStep::Wind => (
            face(all, Keep, Keep, DecrementWrap),
            face(all, Keep, Keep, IncrementWrap),
            0xff,
            0xff,
        ),
        StencilStep::WindAll => (
            face(all, Keep, DecrementWrap, DecrementWrap),
            face(all, Keep, IncrementWrap, IncrementWrap),
            0xff,
            0xff,
        ),
        StencilStep::Take { bits } => {
            // The stencil reference is 0, the default.
            let both = face(wgpu::CompareFunction::NotEqual, Zero, Zero, Zero);
            (both, both, bits, 0xff)
        }
    };
    wgpu::StencilState {
        front,
        back,
        read_mask: u32::from(read),
        write_mask: u32::from(write),
    }
}
