//! The colour difference between two pictures, amplified by 4 so that a difference of 1/64 of the range is visible.

use cutaway::gpu::wgpu;
use eframe::egui::TextureId;
use egui_wgpu::RenderState;

use super::picture::{FORMAT, ShownTexture};
use crate::picture::full_screen::FullScreen;

/// The difference of two pictures.
pub(super) struct Difference {
    pass: FullScreen,
    sampler: wgpu::Sampler,
    picture: Option<ShownTexture>,
}

impl Difference {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let shader = wgpu::include_wgsl!("../../../shaders/difference.wgsl");
        Self {
            pass: FullScreen::new(device, shader, FORMAT),
            sampler: device.create_sampler(&wgpu::SamplerDescriptor::default()),
            picture: None,
        }
    }

    /// Texture for egui, if there are two pictures.
    pub(super) fn id(&self) -> Option<TextureId> {
        self.picture.as_ref().map(|picture| picture.id)
    }

    /// Draws the difference of two pictures at the requested size, or removes it if there are fewer than two pictures.
    pub(super) fn encode(
        &mut self,
        host: &RenderState,
        encoder: &mut wgpu::CommandEncoder,
        pictures: [Option<&ShownTexture>; 2],
        size_px: [u32; 2],
    ) {
        let [Some(a), Some(b)] = pictures else {
            if let Some(old) = self.picture.take() {
                old.free(host);
            }
            return;
        };
        let old = self.picture.take_if(|picture| picture.size_px() != size_px);
        if let Some(old) = old {
            old.free(host);
        }
        let onto = (self.picture).get_or_insert_with(|| ShownTexture::new(host, size_px));
        let resources = [
            wgpu::BindingResource::TextureView(&a.view),
            wgpu::BindingResource::TextureView(&b.view),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        (self.pass).encode(&host.device, encoder, resources, &onto.view);
    }
}
