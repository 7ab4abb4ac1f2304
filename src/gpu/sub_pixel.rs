//! Measures sub-pixel bits: the number of bits such that an adapter's rasteriser snaps vertices to 2^-bits of a pixel.
//!
//! Vulkan and WebGPU guarantee 4 bits and have no query for the actual number. So sixteen rectangles are drawn that end ever closer to
//! a column of samples; those that cover it give the number (`shaders/gpu/sub_pixel.wgsl`). One draw into 16 x 16 pixels, once per
//! device, when its report is first read.
//!
//! Cannot: distinguish more than [`MOST_BITS`] bits, nor run in a browser, where nothing may block.

use super::Gpu;
use crate::shader::{self, Shader};
use crate::{Error, Result};

/// Sub-pixel bits that Vulkan and WebGPU guarantee.
const LEAST_BITS: u32 = 4;
/// Greatest number of bits that can be measured: a rectangle for more would end closer to the column than f32 can express.
const MOST_BITS: u32 = 12;
/// Side of the target in pixels; also in `shaders/gpu/sub_pixel.wgsl`.
const SIZE_PX: u32 = 16;
/// Pixel column of the samples.
const COLUMN: usize = 8;
/// The number of bytes per row in a texture copy is a multiple of this.
const ROW_BYTES: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// Measures the number of fractional bits of a pixel coordinate in the adapter's rasteriser.
///
/// # Errors
///
/// A device that refuses the draw or is lost, or that snaps to coarser steps than Vulkan and WebGPU guarantee.
pub(super) fn measure(gpu: &Gpu) -> Result<u32> {
    let composed = shader::compose(&Shader::from("gpu/sub_pixel.wgsl"))?;
    let staging = gpu.staging(u64::from(ROW_BYTES * SIZE_PX));
    gpu.scoped(|| {
        let module = gpu.module("sub-pixel bits", composed.module.clone());
        submit(gpu, &module, &staging);
        Ok(())
    })?;
    let texels: Vec<u8> = gpu.map(&staging)?;
    let covered = texels
        .chunks(ROW_BYTES as usize)
        .take(MOST_BITS as usize)
        .take_while(|row| row[COLUMN] != 0);
    let bits = covered.count() as u32;
    match bits >= LEAST_BITS {
        true => Ok(bits),
        false => Err(Error::Adapter {
            what: format!("it snaps vertices to 1/{} px", 1_u32 << bits),
            help: "use another adapter, or update its driver".to_owned(),
        }),
    }
}

fn submit(gpu: &Gpu, module: &wgpu::ShaderModule, staging: &wgpu::Buffer) {
    let device = &gpu.device;
    let size = wgpu::Extent3d {
        width: SIZE_PX,
        height: SIZE_PX,
        depth_or_array_layers: 1,
    };
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("sub-pixel bits"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("sub-pixel bits"),
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("sub-pixel bits"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&pipeline);
        pass.draw(0..6, 0..MOST_BITS);
    }
    encoder.copy_texture_to_buffer(
        target.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(ROW_BYTES),
                rows_per_image: Some(SIZE_PX),
            },
        },
        size,
    );
    gpu.queue.submit([encoder.finish()]);
}
