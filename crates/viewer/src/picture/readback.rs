//! Reads a texture back, and waits for the device: for tests and files, never during a frame.

use cutaway::Result;
use cutaway::gpu::Gpu;
use cutaway::gpu::wgpu;
use image::RgbaImage;

/// Reads an RGBA8 texture. The copy is submitted before this function returns; the future waits for the result.
///
/// # Errors
///
/// A device that is lost.
pub fn read(gpu: &Gpu, texture: &wgpu::Texture) -> impl Future<Output = Result<RgbaImage>> + use<> {
    let [width, height] = [texture.width(), texture.height()];
    let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let staging = gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let descriptor = wgpu::CommandEncoderDescriptor::default();
    let mut encoder = gpu.device().create_command_encoder(&descriptor);
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
    let bytes = gpu.submit_and_read(encoder, staging);
    async move {
        let bytes = bytes.await?;
        let rows = bytes.chunks_exact(row as usize);
        let own = rows.flat_map(|r| &r[..width as usize * 4]).copied();
        Ok(RgbaImage::from_raw(width, height, own.collect()).unwrap_or_default())
    }
}
