//! A texture that egui shows and a session draws into.

use cutaway::gpu::Target;
use eframe::egui::TextureId;
use egui_wgpu::{RenderState, wgpu};

/// Format of user textures in egui: sRGB values without conversion.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Render target of [`FORMAT`] for a session, whose frame overwrites it completely.
pub(super) fn covered(color: &wgpu::TextureView) -> Target<'_> {
    Target {
        color,
        color_format: FORMAT,
        depth: None,
        sample_count: 1,
        origin_px: [0, 0],
        background: true,
        caps_only: false,
    }
}

/// A texture that egui shows.
pub(super) struct ShownTexture {
    pub(super) id: TextureId,
    pub(super) texture: wgpu::Texture,
    pub(super) view: wgpu::TextureView,
}

impl ShownTexture {
    pub(super) fn new(host: &RenderState, size_px: [u32; 2]) -> Self {
        let texture = host.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("slot"),
            size: wgpu::Extent3d {
                width: size_px[0],
                height: size_px[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let filter = wgpu::FilterMode::Linear;
        let id = (host.renderer.write()).register_native_texture(&host.device, &view, filter);
        Self { id, texture, view }
    }

    /// The render target for a session, whose frame overwrites it completely.
    pub(super) fn target(&self) -> Target<'_> {
        covered(&self.view)
    }

    /// Releases the texture's device memory.
    pub(super) fn free(self, host: &RenderState) {
        host.renderer.write().free_texture(&self.id);
        self.texture.destroy();
    }

    pub(super) fn size_px(&self) -> [u32; 2] {
        [self.texture.width(), self.texture.height()]
    }
}
