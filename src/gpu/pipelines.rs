//! Pipelines by everything they are made of: shader, constants and, for draws, the state of the attachments.

use std::collections::BTreeMap;

use super::Gpu;
use super::real::texel_format;
use crate::Result;
use crate::plan::{
    DepthCompare, Format, Pass, Plan, ResourceId, Shape, StencilStep, Vertices, Work,
};
use crate::shader::{self, ShaderBinding};

/// A pipeline of either kind.
pub(super) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

/// Pipelines by everything they are made of.
#[derive(Default)]
pub(super) struct Pipelines {
    made: BTreeMap<String, (std::sync::Arc<Pipeline>, Vec<ShaderBinding>)>,
}

impl Pipelines {
    /// The pipeline of a pass, made at first mention, and what it binds.
    pub(super) fn get(
        &mut self,
        gpu: &Gpu,
        plan: &Plan,
        pass: &Pass,
    ) -> Result<(std::sync::Arc<Pipeline>, Vec<ShaderBinding>)> {
        let state = match &pass.work {
            Work::Compute { .. } => String::new(),
            Work::Draw {
                color,
                depth,
                vertices,
                ..
            } => {
                let has_vertices = matches!(vertices, Vertices::Mesh(_));
                let step = depth.stencil.map(|s| s.step);
                let format = format_of(plan, depth.resource);
                format!(
                    "{} {:?} {step:?} {format:?} {has_vertices}",
                    color.is_some(),
                    depth.compare
                )
            }
        };
        let key = format!("{} {:?} {state}", pass.shader, pass.constants);
        if let Some((pipeline, bindings)) = self.made.get(&key) {
            return Ok((pipeline.clone(), bindings.clone()));
        }
        let composed = shader::compose(&pass.shader)?;
        let bindings = shader::bindings(&composed);
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(pass.shader.path),
                source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(composed)),
            });
        let pipeline = std::sync::Arc::new(if matches!(pass.work, Work::Draw { .. }) {
            Pipeline::Render(render_pipeline(gpu, plan, pass, &module))
        } else {
            Pipeline::Compute(gpu.device.create_compute_pipeline(
                &wgpu::ComputePipelineDescriptor {
                    label: Some(&pass.name),
                    layout: None,
                    module: &module,
                    entry_point: Some("main"),
                    compilation_options: options(pass),
                    cache: None,
                },
            ))
        });
        gpu.complaint()?;
        self.made.insert(key, (pipeline.clone(), bindings.clone()));
        Ok((pipeline, bindings))
    }
}

fn options(pass: &Pass) -> wgpu::PipelineCompilationOptions<'_> {
    wgpu::PipelineCompilationOptions {
        constants: &pass.constants,
        ..wgpu::PipelineCompilationOptions::default()
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
                compilation_options: options(pass),
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
                compilation_options: options(pass),
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

/// Both faces are told: what is left out of one of them counts nothing of it.
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
            // The reference is 0, as it is where nobody sets another.
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
