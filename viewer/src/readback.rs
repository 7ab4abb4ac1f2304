//! The pixels of a texture, waited for: for tests and files, never in a frame.

use cutaway::{Error, Result};
use egui_wgpu::{RenderState, wgpu};
use image::RgbaImage;

/// The pixels of an RGBA8 texture.
///
/// # Errors
///
/// A device that fails.
pub fn read(host: &RenderState, texture: &wgpu::Texture) -> Result<RgbaImage> {
    let [width, height] = [texture.width(), texture.height()];
    let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = host.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder =
        (host.device).create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    host.queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    let failed = |what: String| Error::Adapter {
        what,
        help: "restart the viewer, or choose another adapter with --adapter".to_owned(),
    };
    (host.device.poll(wgpu::PollType::wait_indefinitely())).map_err(|e| failed(e.to_string()))?;
    let mapped = (buffer.get_mapped_range(..)).map_err(|e| failed(e.to_string()))?;
    let rows = mapped.chunks_exact(row as usize);
    let rgba: Vec<u8> = rows
        .flat_map(|r| r[..width as usize * 4].to_vec())
        .collect();
    Ok(RgbaImage::from_raw(width, height, rgba).unwrap_or_default())
}
