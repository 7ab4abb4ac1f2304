//! Draws a frame into a host's attachments: colour and depth where the model is visible and passes the host's depth test.
//!
//! One triangle over the frame reads layers, and picture or base colours, from the buffers that the passes wrote, without copies or
//! read-back. For a band it draws only the band's rows. Costs a pass over 4 bytes of picture and 12 of layers per pixel.
//!
//! Cannot: show edges finer than pixels in a multisampled target; all samples of a pixel are alike.

use std::sync::Arc;

use glam::DVec4;

use super::Gpu;
use super::target::{Destination, MOST_COLORS};
use crate::plan::pack::Composite;
use crate::shader::{self, Shader};
use crate::{Error, Result};

/// Properties of the attachments that a pipeline is made for.
#[derive(Clone, Copy, PartialEq)]
struct Attachments {
    colors: [Option<wgpu::TextureFormat>; MOST_COLORS],
    /// Format, and true if greater values are nearer.
    depth: Option<(wgpu::TextureFormat, bool)>,
    sample_count: u32,
}

/// The compositing pipelines, by the properties of their attachments.
#[derive(Default)]
pub(super) struct Compositors {
    made: Vec<(Attachments, Arc<wgpu::RenderPipeline>)>,
}

impl Compositors {
    fn get(&mut self, gpu: &Gpu, attachments: Attachments) -> Result<Arc<wgpu::RenderPipeline>> {
        if let Some((_, made)) = self.made.iter().find(|(a, _)| *a == attachments) {
            return Ok(made.clone());
        }
        let made = Arc::new(pipeline(gpu, attachments)?);
        self.made.push((attachments, made.clone()));
        Ok(made)
    }
}

/// Buffers of a frame that are composited into attachments.
pub(super) struct CompositeBuffers<'a> {
    pub(super) picture: &'a wgpu::Buffer,
    pub(super) layers: &'a wgpu::Buffer,
    pub(super) parts: &'a wgpu::Buffer,
}

/// A frame, or a band of one, ready to be composited into a host's attachments.
pub(crate) struct Compositor {
    attachments: Attachments,
    pipeline: Arc<wgpu::RenderPipeline>,
    group: wgpu::BindGroup,
    uniform: wgpu::Buffer,
    written: Option<Composite>,
}

impl Compositor {
    /// Makes a compositor from the buffers of a frame.
    pub(super) fn new(
        gpu: &Gpu,
        target: &Destination<'_>,
        frame: &CompositeBuffers<'_>,
    ) -> Result<Self> {
        let attachments = attachments(target);
        let pipeline = gpu.compositors().get(gpu, attachments)?;
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("composite"),
            size: size_of::<Composite>() as u64,
            usage: gpu.uniform_usage() | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let read = match attachments.is_g_buffer() {
            false => vec![(1, frame.picture), (2, frame.layers)],
            true => vec![(2, frame.layers), (3, frame.parts)],
        };
        let bound = [(0, &uniform)].into_iter().chain(read);
        let entries: Vec<wgpu::BindGroupEntry<'_>> = bound
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("composite"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Ok(Self {
            attachments,
            pipeline,
            group,
            uniform,
            written: None,
        })
    }

    /// Returns true if the compositor can draw into these attachments.
    pub(crate) fn fits(&self, target: &Destination<'_>) -> bool {
        self.attachments == attachments(target)
    }

    /// Draws rows of a frame whose scene is `scale` times as large as the host's world. `held` is the range of rows in the buffers, `drawn`
    /// the range to draw; a range is its first row, counted from the target's corner, and a number of rows.
    pub(crate) fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Destination<'_>,
        (held, drawn): ((u32, u32), (u32, u32)),
        width: u32,
        scale: f64,
    ) {
        let origin_px = [target.origin_px[0], target.origin_px[1] + held.0];
        let size_px = [width, held.1];
        let composite = composite(target, origin_px, size_px, scale);
        if self.written != Some(composite) {
            gpu.queue
                .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&composite));
            self.written = Some(composite);
        }
        let kept = wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store: wgpu::StoreOp::Store,
        };
        let colors = target.colors.map(|attachment| {
            attachment.map(|a| wgpu::RenderPassColorAttachment {
                view: a.view,
                depth_slice: None,
                resolve_target: None,
                ops: kept,
            })
        });
        let count = colors.iter().flatten().count();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("composite"),
            color_attachments: &colors[..count],
            depth_stencil_attachment: target.depth.as_ref().map(|depth| {
                let has_stencil = depth.format.has_stencil_aspect();
                wgpu::RenderPassDepthStencilAttachment {
                    view: depth.view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Load,
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: has_stencil.then_some(wgpu::Operations {
                        load: wgpu::LoadOp::Load,
                        store: wgpu::StoreOp::Store,
                    }),
                }
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        let [x, y] = origin_px.map(|p| p as f32);
        let height = held.1 as f32;
        pass.set_viewport(x, y, width as f32, height, 0.0, 1.0);
        pass.set_scissor_rect(origin_px[0], target.origin_px[1] + drawn.0, width, drawn.1);
        pass.draw(0..3, 0..1);
    }
}

impl Attachments {
    fn is_g_buffer(&self) -> bool {
        self.colors[1].is_some()
    }

    fn shader(&self) -> Shader {
        Shader::from(match (self.is_g_buffer(), self.depth) {
            (true, _) => "gpu/composite/g_buffer.wgsl",
            (false, Some(_)) => "gpu/composite/depth.wgsl",
            (false, None) => "gpu/composite/color.wgsl",
        })
    }
}

fn attachments(target: &Destination<'_>) -> Attachments {
    Attachments {
        colors: target.colors.map(|a| a.map(|a| a.format)),
        depth: (target.depth.as_ref()).map(|d| (d.format, d.convention.is_reversed())),
        sample_count: target.sample_count,
    }
}

fn composite(
    target: &Destination<'_>,
    origin_px: [u32; 2],
    size_px: [u32; 2],
    scale: f64,
) -> Composite {
    let depth = target.depth.as_ref().map(|d| d.convention);
    let [a, b, c, d] = depth.map_or([0.0, 0.0, 0.0, 1.0], |d| d.coefficients);
    // Only the ratios of the coefficients matter: they are scaled to stay within the range of f32.
    let coefficients = DVec4::new(a / scale, b, c / scale, d);
    let coefficients = coefficients / coefficients.abs().max_element();
    let format = target.colors[0].map(|a| a.format);
    let is_linear = format.is_some_and(|f| f.is_srgb() || is_float(f));
    Composite {
        origin_px,
        size_px,
        depth: coefficients.as_vec4().to_array(),
        far: depth.map_or(0.0, |d| d.far() as f32),
        is_linear: u32::from(is_linear),
        has_background: u32::from(target.has_background),
        caps_only: u32::from(target.caps_only),
    }
}

fn is_float(format: wgpu::TextureFormat) -> bool {
    use wgpu::TextureFormat::{Rg11b10Ufloat, Rgba16Float, Rgba32Float};
    matches!(format, Rg11b10Ufloat | Rgba16Float | Rgba32Float)
}

fn pipeline(gpu: &Gpu, attachments: Attachments) -> Result<wgpu::RenderPipeline> {
    for format in attachments.colors.into_iter().flatten() {
        let features = format.guaranteed_format_features(gpu.device.features());
        if !(features.allowed_usages).contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
            return Err(Error::input(
                "the host's target",
                format!("the format {format:?} cannot be drawn into"),
                "give a colour attachment with a renderable format, for example Rgba8UnormSrgb",
            ));
        }
    }
    let shader = attachments.shader();
    let colors = (attachments.colors).map(|format| format.map(wgpu::ColorTargetState::from));
    let count = colors.iter().flatten().count();
    let composed = shader::compose(&shader)?;
    gpu.scoped(|| {
        let module = gpu.module(shader.path, composed.module.clone());
        Ok(gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("composite"),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vertex"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: attachments.depth.map(|(format, is_reversed)| {
                    wgpu::DepthStencilState {
                        format,
                        depth_write_enabled: Some(true),
                        // The depth of the sky equals that of a cleared depth buffer.
                        depth_compare: Some(match is_reversed {
                            true => wgpu::CompareFunction::GreaterEqual,
                            false => wgpu::CompareFunction::LessEqual,
                        }),
                        stencil: wgpu::StencilState::default(),
                        bias: wgpu::DepthBiasState::default(),
                    }
                }),
                multisample: wgpu::MultisampleState {
                    count: attachments.sample_count,
                    ..wgpu::MultisampleState::default()
                },
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fragment"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &colors[..count],
                }),
                multiview_mask: None,
                cache: None,
            }))
    })
}
