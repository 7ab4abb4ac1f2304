//! The samples of a picture: frames whose sample positions are shifted within the pixels. While nothing moves they are drawn in turn, and
//! combined when all are complete, which smooths edges.
//!
//! Cost: one frame per sample, and 4 bytes per pixel and sample until the samples are combined.

use std::collections::BTreeMap;

use cutaway::gpu::{Target, wgpu};
use cutaway::scene::View;
use egui_wgpu::RenderState;

use super::picture::{FORMAT, covered};
use crate::picture::full_screen::FullScreen;
use crate::picture::slot::SlotSide;

/// A sample of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// Index of the sample within the pixel.
    pub index: u32,
    /// Number of samples along each side of a pixel.
    pub per_side: u32,
}

impl Sample {
    /// Number of samples per pixel.
    pub fn count(self) -> u32 {
        self.per_side * self.per_side
    }

    /// The picture's view, shifted to this sample's position.
    pub(super) fn of(self, view: &View) -> View {
        let mut samples = view.samples(self.per_side);
        samples
            .nth(self.index as usize)
            .map_or(*view, |(_, view)| view)
    }

    /// Returns true if this is the last sample of a pixel.
    pub fn is_last(self) -> bool {
        self.index + 1 == self.count()
    }
}

/// The samples of the slots.
pub(super) struct SlotSamples {
    resolve: FullScreen,
    of_slots: BTreeMap<SlotSide, Stack>,
}

/// The samples of one slot, as texture array layers.
struct Stack {
    texture: wgpu::Texture,
    layers: Vec<wgpu::TextureView>,
    all: wgpu::TextureView,
}

impl SlotSamples {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let shader = wgpu::include_wgsl!("../../../shaders/resolve.wgsl");
        Self {
            resolve: FullScreen::new(device, shader, FORMAT),
            of_slots: BTreeMap::new(),
        }
    }

    /// Allocates the textures for a slot's samples.
    pub(super) fn make_room(
        &mut self,
        host: &RenderState,
        side: SlotSide,
        size_px: [u32; 2],
        count: u32,
    ) {
        let fits = |stack: &Stack| {
            let texture = &stack.texture;
            let has = [
                texture.width(),
                texture.height(),
                texture.depth_or_array_layers(),
            ];
            has == [size_px[0], size_px[1], count]
        };
        if !self.of_slots.get(&side).is_some_and(fits) {
            self.of_slots.insert(side, Stack::new(host, size_px, count));
        }
    }

    /// Render target of a sample of a slot.
    pub(super) fn target(&self, side: SlotSide, index: u32) -> Option<Target<'_>> {
        let layers = &self.of_slots.get(&side)?.layers;
        layers.get(index as usize).map(covered)
    }

    /// Combines the samples of a slot, and releases their memory.
    pub(super) fn resolve(
        &mut self,
        host: &RenderState,
        encoder: &mut wgpu::CommandEncoder,
        side: SlotSide,
        onto: &wgpu::TextureView,
    ) {
        if let Some(stack) = self.of_slots.remove(&side) {
            let samples = [wgpu::BindingResource::TextureView(&stack.all)];
            self.resolve.encode(&host.device, encoder, samples, onto);
        }
    }
}

impl Stack {
    fn new(host: &RenderState, [width, height]: [u32; 2], count: u32) -> Self {
        let texture = host.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("samples"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: count,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = |dimension, base_array_layer, count| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(dimension),
                base_array_layer,
                array_layer_count: Some(count),
                ..wgpu::TextureViewDescriptor::default()
            })
        };
        Self {
            layers: (0..count)
                .map(|i| view(wgpu::TextureViewDimension::D2, i, 1))
                .collect(),
            all: view(wgpu::TextureViewDimension::D2Array, 0, count),
            texture,
        }
    }
}
