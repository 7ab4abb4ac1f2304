//! One pass on the device: its pipeline, bind groups and attachments, and its encoding.

use std::ops::Range;

use super::Gpu;
use super::programs::bind::{GpuResources, bind_groups, buffer, layer_view, texture};
use super::programs::pipelines::Pipeline;
use super::timing::TimestampQueries;
use super::viewport::viewport_px;
use crate::Result;
use crate::plan::{DepthCompare, Pass, Plan, Vertices, Work};

/// A pass ready to be encoded.
pub(super) struct ReadyPass {
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
    Compute(Groups),
    Draw {
        color: Option<(wgpu::TextureView, bool)>,
        depth: Depth,
        vertices: Option<wgpu::Buffer>,
        indices: wgpu::Buffer,
        draws: Vec<RealDraw>,
    },
}

/// The workgroups of a dispatch.
enum Groups {
    /// Number of workgroups in x, y and z.
    Listed([u32; 3]),
    /// A buffer of arguments, and the offset in it.
    Indirect(wgpu::Buffer, u64),
}

enum RealDraw {
    /// Index range, base vertex, instance.
    Listed(Range<u32>, i32, u32),
    /// A buffer of arguments, and the offset in it.
    Indirect(wgpu::Buffer, u64),
}

/// The depth attachment of a draw.
struct Depth {
    view: wgpu::TextureView,
    /// Upper left corner, and size.
    viewport_px: [[f32; 2]; 2],
    clear: bool,
    far: f32,
    /// True if the stencil is cleared first; none if the stencil is not used.
    clear_stencil: Option<bool>,
}

impl ReadyPass {
    pub(super) fn new(
        gpu: &Gpu,
        plan: &Plan,
        pass: &Pass,
        resources: &GpuResources,
    ) -> Result<Self> {
        let (pipeline, composed) = gpu.pipelines().get(gpu, plan, pass)?;
        let groups = bind_groups(gpu, plan, pass, &pipeline, &composed.bindings, resources)?;
        let work = match &pass.work {
            Work::Compute { groups } => RealWork::Compute(Groups::Listed(*groups)),
            Work::ComputeIndirect { arguments } => RealWork::Compute(Groups::Indirect(
                buffer(plan, arguments.resource, resources)?.clone(),
                arguments.offset,
            )),
            Work::Draw {
                color,
                depth,
                vertices,
                indices,
                draws,
            } => RealWork::Draw {
                color: match color {
                    Some(c) => Some((
                        layer_view(texture(plan, c.resource, resources)?, 0),
                        c.clear,
                    )),
                    None => None,
                },
                depth: {
                    let target = texture(plan, depth.resource, resources)?;
                    Depth {
                        view: layer_view(target, depth.layer),
                        viewport_px: viewport_px([target.width(), target.height()]),
                        clear: depth.clear,
                        far: if depth.compare == DepthCompare::Greater {
                            0.0
                        } else {
                            1.0
                        },
                        clear_stencil: depth.stencil.map(|s| s.clear),
                    }
                },
                vertices: match vertices {
                    Vertices::Mesh(id) => Some(buffer(plan, *id, resources)?.clone()),
                    Vertices::None => None,
                },
                indices: buffer(plan, *indices, resources)?.clone(),
                draws: draws
                    .iter()
                    .map(|d| {
                        Ok(match d.arguments {
                            None => RealDraw::Listed(d.indices.clone(), d.base_vertex, d.instance),
                            Some(a) => RealDraw::Indirect(
                                buffer(plan, a.resource, resources)?.clone(),
                                a.offset,
                            ),
                        })
                    })
                    .collect::<Result<_>>()?,
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
        stopwatch: Option<&TimestampQueries>,
        index: usize,
    ) {
        let (begin, end) = (Some(index as u32 * 2), Some(index as u32 * 2 + 1));
        match (&self.work, &*self.pipeline) {
            (RealWork::Compute(dispatched), Pipeline::Compute(pipeline)) => {
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
                match dispatched {
                    Groups::Listed([x, y, z]) => pass.dispatch_workgroups(*x, *y, *z),
                    Groups::Indirect(arguments, offset) => {
                        pass.dispatch_workgroups_indirect(arguments, *offset);
                    }
                }
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
                        view: &depth.view,
                        depth_ops: Some(wgpu::Operations {
                            load: if depth.clear {
                                wgpu::LoadOp::Clear(depth.far)
                            } else {
                                wgpu::LoadOp::Load
                            },
                            store: wgpu::StoreOp::Store,
                        }),
                        stencil_ops: depth.clear_stencil.map(|clear| wgpu::Operations {
                            load: if clear {
                                wgpu::LoadOp::Clear(0)
                            } else {
                                wgpu::LoadOp::Load
                            },
                            store: wgpu::StoreOp::Store,
                        }),
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
                let [[x, y], [width, height]] = depth.viewport_px;
                pass.set_viewport(x, y, width, height, 0.0, 1.0);
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
                for draw in draws {
                    match draw {
                        RealDraw::Listed(range, base_vertex, instance) => {
                            let instances = *instance..*instance + 1;
                            pass.draw_indexed(range.clone(), *base_vertex, instances);
                        }
                        RealDraw::Indirect(arguments, offset) => {
                            pass.draw_indexed_indirect(arguments, *offset);
                        }
                    }
                }
            }
            // The kinds of the pipeline and of the pass's work always match.
            _ => {}
        }
    }
}
