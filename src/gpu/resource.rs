//! Resources of a plan on the device: buffers, textures and samplers, made with their contents.

use super::Gpu;
use crate::plan::{BufferRole, Format, Resource, Shape};
use crate::scene::Wrap;

/// A resource on the device.
pub(super) enum GpuResource {
    Buffer(wgpu::Buffer),
    Texture(wgpu::Texture),
    Sampler(wgpu::Sampler),
}

impl GpuResource {
    /// Bytes of device memory, without the driver's padding.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Buffer(buffer) => buffer.size(),
            Self::Texture(texture) => {
                let size = texture.size();
                let texels = u64::from(size.width) * u64::from(size.height);
                let texel_bytes = texel_bytes(texture.format());
                texels * u64::from(size.depth_or_array_layers) * u64::from(texel_bytes)
            }
            Self::Sampler(_) => 0,
        }
    }
}

/// Bytes of a texel, without padding; for a depth-stencil format, the sum over its aspects.
fn texel_bytes(format: wgpu::TextureFormat) -> u32 {
    let of = |aspect| format.block_copy_size(aspect).unwrap_or(0);
    match format {
        // For this format wgpu gives no size of its depth, which cannot be copied: the sum of 32 bits of depth and 8 of stencil.
        wgpu::TextureFormat::Depth32FloatStencil8 => 4 + of(Some(wgpu::TextureAspect::StencilOnly)),
        _ => of(None),
    }
}

/// Creates a resource with its contents.
pub(super) fn make(gpu: &Gpu, resource: &Resource) -> GpuResource {
    let usage = |role| match role {
        BufferRole::Storage => wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        BufferRole::Uniform => gpu.uniform_usage(),
        // The compute rasteriser reads the mesh from the same buffers as the hardware rasteriser.
        BufferRole::Vertex => {
            wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC
        }
        BufferRole::Index => {
            wgpu::BufferUsages::INDEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC
        }
        BufferRole::Arguments => {
            wgpu::BufferUsages::INDIRECT
                | wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
        }
    };
    match (resource.shape, &resource.contents) {
        (Shape::Buffer { role, .. }, Some(contents)) => {
            GpuResource::Buffer(gpu.buffer_with(&resource.name, contents, usage(role)))
        }
        (Shape::Buffer { bytes, role }, None) => {
            GpuResource::Buffer(gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(&resource.name),
                size: bytes,
                usage: usage(role) | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }))
        }
        (Shape::Texture { .. }, _) => GpuResource::Texture(texture(gpu, resource)),
        (Shape::Sampler { wrap }, _) => {
            let address = match wrap {
                Wrap::Repeat => wgpu::AddressMode::Repeat,
                Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
                Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
            };
            GpuResource::Sampler(gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(&resource.name),
                address_mode_u: address,
                address_mode_v: address,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            }))
        }
    }
}

/// Creates a texture that passes draw into, or a texture with uploaded contents.
fn texture(gpu: &Gpu, resource: &Resource) -> wgpu::Texture {
    let Shape::Texture {
        size: [width, height],
        layers,
        format,
    } = resource.shape
    else {
        unreachable!("only textures are made here")
    };
    let usage = match resource.contents {
        Some(_) => wgpu::TextureUsages::COPY_DST,
        None => wgpu::TextureUsages::RENDER_ATTACHMENT,
    };
    let extent = |layers| wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: layers,
    };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&resource.name),
        size: extent(layers),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: texel_format(format),
        usage: usage | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let row_bytes = width * format.texel_bytes() as u32;
    let layer_bytes = u64::from(row_bytes) * u64::from(height);
    for piece in resource.contents.iter().flat_map(|c| c.pieces()) {
        // Each upload chunk consists of whole layers.
        let mut to = texture.as_image_copy();
        to.origin.z = (piece.offset / layer_bytes) as u32;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row_bytes),
            rows_per_image: Some(height),
        };
        let count = piece.bytes.len() as u64 / layer_bytes;
        gpu.queue
            .write_texture(to, &piece.bytes, layout, extent(count as u32));
    }
    texture
}

pub(super) fn texel_format(format: Format) -> wgpu::TextureFormat {
    match format {
        Format::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
        Format::R32Float => wgpu::TextureFormat::R32Float,
        Format::Depth32Float => wgpu::TextureFormat::Depth32Float,
        Format::Depth32FloatStencil8 => wgpu::TextureFormat::Depth32FloatStencil8,
    }
}
