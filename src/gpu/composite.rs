//! A frame in the attachments of a host: its colours where the model is, tested by the host's depth, and its depth beside them.
//!
//! One triangle over the frame reads picture and layers from the buffers that the passes wrote: nothing is copied, nothing read back. Of
//! a band it draws the band's rows. Costs a pass of 4 bytes of picture and 12 of layers a pixel.
//!
//! Cannot: show edges finer than pixels where the target has several samples; all samples of a pixel are alike.

use std::sync::Arc;

use glam::DVec4;

use super::Gpu;
use crate::plan::pack::Composite;
use crate::scene::HostDepth;
use crate::shader::{self, Shader};
use crate::{Error, Result};

/// Where a host wants a frame.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// The colour attachment; what is there stays where the frame shows nothing.
    pub color: &'a wgpu::TextureView,
    /// Its format. Formats that are sRGB or floats get linear light, others sRGB as it is.
    pub color_format: wgpu::TextureFormat,
    /// The depth attachment that the frame is tested against and written to; without one the frame covers what is there.
    pub depth: Option<TargetDepth<'a>>,
    /// Samples of a pixel of the attachments.
    pub sample_count: u32,
    /// Upper left corner of the frame in the attachments, in pixels.
    pub origin_px: [u32; 2],
    /// Whether the sky is drawn where no model is seen.
    pub background: bool,
}

/// The depth attachment of a host.
#[derive(Clone, Copy, Debug)]
pub struct TargetDepth<'a> {
    /// The attachment.
    pub view: &'a wgpu::TextureView,
    /// Its format.
    pub format: wgpu::TextureFormat,
    /// What distances become in it.
    pub convention: HostDepth,
}

/// What a pipeline is made for.
#[derive(Clone, Copy, PartialEq)]
struct Attachments {
    color: wgpu::TextureFormat,
    /// Format, and whether what is nearer has the greater depth.
    depth: Option<(wgpu::TextureFormat, bool)>,
    sample_count: u32,
}

/// The pipelines that composite, by attachments.
#[derive(Default)]
pub(super) struct Compositors {
    made: Vec<(Attachments, Arc<wgpu::RenderPipeline>)>,
}

impl Target<'_> {
    /// Refuses a frame that reaches beyond the attachments.
    pub(crate) fn must_hold(&self, size_px: [u32; 2]) -> Result<()> {
        let have = self.color.texture().size();
        let reach = [0, 1].map(|i| self.origin_px[i].saturating_add(size_px[i]));
        if reach[0] <= have.width && reach[1] <= have.height {
            return Ok(());
        }
        let ([width, height], [x, y]) = (size_px, self.origin_px);
        Err(Error::input(
            "the target of the host",
            format!(
                "a frame of {width} x {height} px at ({x}, {y}) does not fit into {} x {} px",
                have.width, have.height
            ),
            "give attachments as large as the view",
        ))
    }
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

/// A frame, or a band of one, ready to be put into the attachments of a host.
pub(crate) struct Compositor {
    attachments: Attachments,
    pipeline: Arc<wgpu::RenderPipeline>,
    group: wgpu::BindGroup,
    uniform: wgpu::Buffer,
    written: Option<Composite>,
}

impl Compositor {
    /// Of the buffers of picture and layers.
    pub(super) fn new(
        gpu: &Gpu,
        target: &Target<'_>,
        [picture, layers]: [&wgpu::Buffer; 2],
    ) -> Result<Self> {
        let attachments = attachments(target);
        let pipeline = gpu.compositors().get(gpu, attachments)?;
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("composite"),
            size: size_of::<Composite>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bound = [&uniform, picture, layers];
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(bound)
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

    /// Whether it draws into attachments like these.
    pub(crate) fn fits(&self, target: &Target<'_>) -> bool {
        self.attachments == attachments(target)
    }

    /// Draws a frame of some pixels, whose first row is so many rows below the corner of the target, of a scene that is `scale` times as
    /// large as the host's world.
    pub(crate) fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Target<'_>,
        first_row: u32,
        size_px: [u32; 2],
        scale: f64,
    ) {
        let origin_px = [target.origin_px[0], target.origin_px[1] + first_row];
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
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("composite"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target.color,
                depth_slice: None,
                resolve_target: None,
                ops: kept,
            })],
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
        let [width, height] = size_px.map(|p| p as f32);
        pass.set_viewport(x, y, width, height, 0.0, 1.0);
        pass.set_scissor_rect(origin_px[0], origin_px[1], size_px[0], size_px[1]);
        pass.draw(0..3, 0..1);
    }
}

fn attachments(target: &Target<'_>) -> Attachments {
    Attachments {
        color: target.color_format,
        depth: (target.depth.as_ref()).map(|d| (d.format, d.convention.is_reversed())),
        sample_count: target.sample_count,
    }
}

fn composite(target: &Target<'_>, origin_px: [u32; 2], size_px: [u32; 2], scale: f64) -> Composite {
    let depth = target.depth.as_ref().map(|d| d.convention);
    let [a, b, c, d] = depth.map_or([0.0, 0.0, 0.0, 1.0], |d| d.coefficients);
    // Only their ratio matters: they are kept within what f32 holds.
    let coefficients = DVec4::new(a / scale, b, c / scale, d);
    let coefficients = coefficients / coefficients.abs().max_element();
    let format = target.color_format;
    let is_linear = format.is_srgb() || is_float(format);
    Composite {
        origin_px,
        size_px,
        depth: coefficients.as_vec4().to_array(),
        far: depth.map_or(0.0, |d| d.far() as f32),
        is_linear: u32::from(is_linear),
        has_background: u32::from(target.background),
        padding: 0,
    }
}

fn is_float(format: wgpu::TextureFormat) -> bool {
    use wgpu::TextureFormat::{Rg11b10Ufloat, Rgba16Float, Rgba32Float};
    matches!(format, Rg11b10Ufloat | Rgba16Float | Rgba32Float)
}

fn pipeline(gpu: &Gpu, attachments: Attachments) -> Result<wgpu::RenderPipeline> {
    let features = attachments
        .color
        .guaranteed_format_features(gpu.device.features());
    let usable = features.allowed_usages;
    if !usable.contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
        return Err(Error::input(
            "the target of the host",
            format!(
                "{:?} is no format that can be drawn into",
                attachments.color
            ),
            "give a colour attachment, for example Rgba8UnormSrgb",
        ));
    }
    let shader = Shader::from(match attachments.depth {
        Some(_) => "gpu/composite/depth.wgsl",
        None => "gpu/composite/color.wgsl",
    });
    let composed = shader::compose(&shader)?;
    gpu.scoped(|| {
        let module = gpu.module(shader.path, composed);
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
                        // Sky is as far as a cleared buffer.
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
                    targets: &[Some(attachments.color.into())],
                }),
                multiview_mask: None,
                cache: None,
            }))
    })
}
