//! The host without a window: three frames, of which the last is read back.

use cutaway::gpu::wgpu;

use super::host::{Host, texture};

pub(crate) const SIZE_PX: [u32; 2] = [640, 480];
const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

pub(crate) fn draw() -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let instance =
        wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let wanted = wgpu::RequestAdapterOptions::default();
    let adapter = pollster::block_on(instance.request_adapter(&wanted))?;
    let mut host = Host::new(&adapter, SIZE_PX, COLOR)?;
    let color = texture(&host.device, SIZE_PX, COLOR);
    for _ in 0..3 {
        host.draw(&color.create_view(&Default::default()), 0.0)?;
    }
    read_back(&host, &color)
}

/// The picture, for a file.
fn read_back(host: &Host, color: &wgpu::Texture) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let [width, height] = SIZE_PX;
    let staging = host.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(width * height * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = host.device.create_command_encoder(&Default::default());
    encoder.copy_texture_to_buffer(
        color.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * 4),
                rows_per_image: None,
            },
        },
        color.size(),
    );
    host.queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |_| {});
    host.device.poll(wgpu::PollType::wait_indefinitely())?;
    let rgba = staging.get_mapped_range(..)?.to_vec();
    Ok(rgba)
}
