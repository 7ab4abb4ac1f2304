//! One pass made real: its pipeline, its bind groups, its attachments.
//!
//! Bind groups are made by name: the composed shader is reflected, and each of its variables takes the resource that the
//! pass gives under that name.

use std::collections::BTreeMap;
use std::ops::Range;

use super::Gpu;
use super::program::{Real, texel_format};
use super::timing::Stopwatch;
use crate::plan::{DepthCompare, Format, Pass, Plan, ResourceId, Shape, Vertices, Work};
use crate::shader::{self, BindingKind, ShaderBinding};
use crate::{Error, Result};

enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

/// Pipelines by everything they are made of.
#[derive(Default)]
pub(super) struct Pipelines {
    made: BTreeMap<String, (std::sync::Arc<Pipeline>, Vec<ShaderBinding>)>,
}

/// A pass ready to be encoded.
pub(super) struct Step {
    name: String,
    pipeline: std::sync::Arc<Pipeline>,
    groups: Vec<wgpu::BindGroup>,
    work: RealWork,
}

#[allow(
    clippy::large_enum_variant,
    reason = "a plan has a dozen steps, not thousands"
)]
enum RealWork {
    Compute([u32; 3]),
    Draw {
        color: Option<(wgpu::TextureView, bool)>,
        depth: (wgpu::TextureView, bool, f32),
        vertices: Option<wgpu::Buffer>,
        indices: wgpu::Buffer,
        draws: Vec<(Range<u32>, i32, u32)>,
    },
}

type Reals = BTreeMap<String, (Shape, Real)>;

impl Step {
    pub(super) fn new(
        gpu: &Gpu,
        pipelines: &mut Pipelines,
        plan: &Plan,
        pass: &Pass,
        real: &Reals,
    ) -> Result<Self> {
        let (pipeline, bindings) = pipelines.get(gpu, plan, pass)?;
        let groups = bind_groups(gpu, plan, pass, &pipeline, &bindings, real)?;
        let work = match &pass.work {
            Work::Compute { groups } => RealWork::Compute(*groups),
            Work::Draw {
                color,
                depth,
                vertices,
                indices,
                draws,
            } => RealWork::Draw {
                color: match color {
                    Some(c) => Some((layer_view(texture(plan, c.resource, real)?, 0), c.clear)),
                    None => None,
                },
                depth: (
                    layer_view(texture(plan, depth.resource, real)?, depth.layer),
                    depth.clear,
                    if depth.compare == DepthCompare::Greater {
                        0.0
                    } else {
                        1.0
                    },
                ),
                vertices: match vertices {
                    Vertices::Mesh(id) => Some(buffer(plan, *id, real)?.clone()),
                    Vertices::None => None,
                },
                indices: buffer(plan, *indices, real)?.clone(),
                draws: draws
                    .iter()
                    .map(|d| (d.indices.clone(), d.base_vertex, d.instance))
                    .collect(),
            },
        };
        Ok(Self {
            name: pass.name.clone(),
            pipeline,
            groups,
            work,
        })
    }

    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stopwatch: Option<&Stopwatch>,
        index: usize,
    ) {
        let (begin, end) = (Some(index as u32 * 2), Some(index as u32 * 2 + 1));
        match (&self.work, &*self.pipeline) {
            (RealWork::Compute([x, y, z]), Pipeline::Compute(pipeline)) => {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(&self.name),
                    timestamp_writes: stopwatch.map(|s| wgpu::ComputePassTimestampWrites {
                        query_set: &s.queries,
                        beginning_of_pass_write_index: begin,
                        end_of_pass_write_index: end,
                    }),
                });
                pass.set_pipeline(pipeline);
                for (i, group) in self.groups.iter().enumerate() {
                    pass.set_bind_group(i as u32, group, &[]);
                }
                pass.dispatch_workgroups(*x, *y, *z);
            }
            (
                RealWork::Draw {
                    color,
                    depth,
                    vertices,
                    indices,
                    draws,
                },
                Pipeline::Render(pipeline),
            ) => {
                let (depth_view, clear_depth, far) = depth;
                let color = color.as_ref().map(|(view, clear)| {
                    Some(wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: if *clear {
                                wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
                            } else {
                                wgpu::LoadOp::Load
                            },
                            store: wgpu::StoreOp::Store,
                        },
                    })
                });
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some(&self.name),
                    color_attachments: color.as_slice(),
                    depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                        view: depth_view,
                        depth_ops: Some(wgpu::Operations {
                            load: if *clear_depth {
                                wgpu::LoadOp::Clear(*far)
                            } else {
                                wgpu::LoadOp::Load
                            },
                            store: wgpu::StoreOp::Store,
                        }),
                        stencil_ops: None,
                    }),
                    timestamp_writes: stopwatch.map(|s| wgpu::RenderPassTimestampWrites {
                        query_set: &s.queries,
                        beginning_of_pass_write_index: begin,
                        end_of_pass_write_index: end,
                    }),
                    occlusion_query_set: None,
                    multiview_mask: None,
                });
                pass.set_pipeline(pipeline);
                for (i, group) in self.groups.iter().enumerate() {
                    pass.set_bind_group(i as u32, group, &[]);
                }
                if let Some(vertices) = vertices {
                    pass.set_vertex_buffer(0, vertices.slice(..));
                }
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
                for (range, base_vertex, instance) in draws {
                    pass.draw_indexed(range.clone(), *base_vertex, *instance..*instance + 1);
                }
            }
            // A pipeline is made from the same pass as its work.
            _ => {}
        }
    }
}

impl Pipelines {
    fn get(
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
                format!("{} {:?} {has_vertices}", color.is_some(), depth.compare)
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
        let format = match plan.resource(c.resource).shape {
            Shape::Texture { format, .. } => format,
            Shape::Buffer { .. } => Format::Rg32Uint,
        };
        Some(wgpu::ColorTargetState {
            format: texel_format(format),
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
                format: wgpu::TextureFormat::Depth32Float,
                depth_write_enabled: Some(depth.compare != DepthCompare::Always),
                depth_compare: Some(match depth.compare {
                    DepthCompare::Greater => wgpu::CompareFunction::Greater,
                    DepthCompare::Less => wgpu::CompareFunction::Less,
                    DepthCompare::Always => wgpu::CompareFunction::Always,
                }),
                stencil: wgpu::StencilState::default(),
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

fn bind_groups(
    gpu: &Gpu,
    plan: &Plan,
    pass: &Pass,
    pipeline: &Pipeline,
    wanted: &[ShaderBinding],
    real: &Reals,
) -> Result<Vec<wgpu::BindGroup>> {
    let groups = wanted.iter().map(|w| w.group + 1).max().unwrap_or(0);
    let mut made = Vec::with_capacity(groups as usize);
    for group in 0..groups {
        let layout = match pipeline {
            Pipeline::Compute(p) => p.get_bind_group_layout(group),
            Pipeline::Render(p) => p.get_bind_group_layout(group),
        };
        // Views must outlive the entries that borrow them.
        let mut views: Vec<(u32, wgpu::TextureView)> = Vec::new();
        let mut buffers: Vec<(u32, &wgpu::Buffer)> = Vec::new();
        for w in wanted.iter().filter(|w| w.group == group) {
            let Some(b) = pass.bindings.iter().find(|b| b.name == w.name) else {
                return Err(Error::Plan(format!(
                    "{}: `{}` is bound to nothing",
                    pass.name, w.name
                )));
            };
            match real.get(&plan.resource(b.resource).name) {
                Some((_, Real::Buffer(buffer))) => buffers.push((w.binding, buffer)),
                Some((_, Real::Texture(texture))) => {
                    let view = match w.kind {
                        BindingKind::TextureArray => array_view(texture),
                        _ => layer_view(texture, b.layer.unwrap_or(0)),
                    };
                    views.push((w.binding, view));
                }
                _ => {
                    return Err(Error::Plan(format!(
                        "{}: `{}` has no resource",
                        pass.name, w.name
                    )));
                }
            }
        }
        let textures = views.iter().map(|(binding, view)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
            .iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: buffer.as_entire_binding(),
            })
            .chain(textures)
            .collect();
        made.push(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&pass.name),
            layout: &layout,
            entries: &entries,
        }));
    }
    Ok(made)
}

fn texture<'a>(plan: &Plan, id: ResourceId, real: &'a Reals) -> Result<&'a wgpu::Texture> {
    match real.get(&plan.resource(id).name) {
        Some((_, Real::Texture(texture))) => Ok(texture),
        _ => Err(Error::Plan(format!(
            "{} is not a texture",
            plan.resource(id).name
        ))),
    }
}

fn buffer<'a>(plan: &Plan, id: ResourceId, real: &'a Reals) -> Result<&'a wgpu::Buffer> {
    match real.get(&plan.resource(id).name) {
        Some((_, Real::Buffer(buffer))) => Ok(buffer),
        _ => Err(Error::Plan(format!(
            "{} is not a buffer",
            plan.resource(id).name
        ))),
    }
}

fn layer_view(texture: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..wgpu::TextureViewDescriptor::default()
    })
}

fn array_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..wgpu::TextureViewDescriptor::default()
    })
}
