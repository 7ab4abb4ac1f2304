//! A host for tests: a device of its own, a colour and a depth attachment.

use cutaway::gpu::{Gpu, Target, TargetDepth, wgpu};
use cutaway::scene::HostDepth;
use cutaway::session::Session;

pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A device, and attachments of a size.
pub(crate) struct Host {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) info: wgpu::AdapterInfo,
    size_px: [u32; 2],
    color: wgpu::Texture,
    depth: wgpu::Texture,
}

/// A software adapter.
pub(crate) fn adapter() -> wgpu::Adapter {
    let instance =
        wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let is_cpu = |a: &wgpu::Adapter| a.get_info().device_type == wgpu::DeviceType::Cpu;
    let adapter = adapters.into_iter().min_by_key(|a| !is_cpu(a));
    adapter.expect("tests that draw need a graphics adapter")
}

fn texture(device: &wgpu::Device, size_px: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: size_px[0],
            height: size_px[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

impl Host {
    /// A host whose colours are of a format.
    pub(crate) fn new(size_px: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let adapter = adapter();
        let asked = adapter.request_device(&Gpu::descriptor(&adapter));
        let (device, queue) = pollster::block_on(asked).expect("a device");
        Self {
            color: texture(&device, size_px, format),
            depth: texture(&device, size_px, DEPTH),
            info: adapter.get_info(),
            size_px,
            device,
            queue,
        }
    }

    /// A session on its device.
    pub(crate) fn session(&self) -> Session {
        let (device, queue) = (self.device.clone(), self.queue.clone());
        Session::new(Gpu::from_device(&self.info, device, queue).expect("a device that will do"))
    }

    /// Another attachment, of some size.
    pub(crate) fn attachment(
        &self,
        size_px: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> wgpu::Texture {
        texture(&self.device, size_px, format)
    }

    pub(crate) fn views(&self) -> [wgpu::TextureView; 2] {
        [&self.color, &self.depth].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()))
    }

    /// The whole of its attachments, with depth where a convention is given.
    pub(crate) fn target<'a>(
        &self,
        [color, depth]: &'a [wgpu::TextureView; 2],
        convention: Option<HostDepth>,
    ) -> Target<'a> {
        Target {
            color,
            color_format: self.color.format(),
            depth: convention.map(|convention| TargetDepth {
                view: depth,
                format: DEPTH,
                convention,
            }),
            sample_count: 1,
            origin_px: [0, 0],
            background: true,
            caps_only: false,
        }
    }

    pub(crate) fn encoder(&self) -> wgpu::CommandEncoder {
        let descriptor = wgpu::CommandEncoderDescriptor::default();
        self.device.create_command_encoder(&descriptor)
    }

    pub(crate) fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.queue.submit([encoder.finish()]);
    }

    /// Clears both attachments.
    pub(crate) fn clear(&self, encoder: &mut wgpu::CommandEncoder, color: [f64; 3], depth: f32) {
        let [r, g, b] = color;
        let [color_view, depth_view] = self.views();
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("clear"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(depth),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
    }

    /// The colours, 4 bytes a pixel, and the depths.
    pub(crate) fn read(&self) -> (Vec<u8>, Vec<f32>) {
        let bytes = [&self.color, &self.depth].map(|texture| self.bytes_of(texture));
        let [color, depth] = bytes;
        (color, bytemuck::pod_collect_to_vec(&depth))
    }

    /// The bytes of an attachment, row after row.
    pub(crate) fn bytes_of(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let [width, height] = self.size_px;
        let texel = texture.format().block_copy_size(None).expect("texels");
        let row = (width * texel).next_multiple_of(256);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        self.submit(encoder);
        staging.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait();
        let mapped = staging.get_mapped_range(..).expect("a mapped buffer");
        let rows = mapped.chunks_exact(row as usize);
        rows.flat_map(|r| &r[..(width * texel) as usize])
            .copied()
            .collect()
    }

    pub(crate) fn wait(&self) {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        polled.expect("the device does what was submitted");
    }
}
