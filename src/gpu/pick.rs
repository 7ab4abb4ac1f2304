//! Pixels of a frame in transfer: one, or all. A pointer picks from the layers, and so picks the visible surface,
//! with all cuts applied.
//!
//! Costs a copy of 12 bytes a pixel. Cannot: know of a frame that was not submitted.

use super::Gpu;
use super::arrival::Arrival;
use super::layer_words::{layer_from_words, layers_from_words};
use crate::Result;
use crate::layers::Layer;

/// A requested pixel.
#[derive(Debug)]
pub struct Pick(Arrival);

impl Pick {
    /// Awaits a copy that commands of the same encoder make.
    pub(super) fn new(encoder: &wgpu::CommandEncoder, staging: wgpu::Buffer) -> Self {
        Self(Arrival::new(encoder, staging))
    }

    /// Returns true if it may still arrive; [`Session::poll`](crate::Session::poll) detects the arrival.
    pub fn is_under_way(&self) -> bool {
        self.0.is_under_way()
    }

    /// Layer of the pixel, once it has arrived.
    pub fn layer(&self) -> Option<Layer> {
        let words: [u32; 3] = self.0.values()?.try_into().ok()?;
        Some(layer_from_words(&words))
    }
}

/// The layers of a program's frame or its picture, on their way back.
#[derive(Debug)]
pub(crate) struct Arriving(Arrival);

impl Arriving {
    /// Reads a buffer, which is copied after the encoded commands.
    pub(super) fn new(
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        buffer: &wgpu::Buffer,
    ) -> Self {
        let staging = gpu.staging(buffer.size());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        Self(Arrival::new(encoder, staging))
    }

    /// The pixels, row by row, when they have come: what a page of a browser awaits is waited for elsewhere.
    ///
    /// # Errors
    ///
    /// A device that is lost.
    pub(crate) async fn layers(self, gpu: &Gpu) -> Result<Vec<Layer>> {
        let words = self.0.awaited(&gpu.device, gpu.name()).await?;
        Ok(layers_from_words(&words))
    }

    /// RGBA8 of the pixels, in the same way.
    ///
    /// # Errors
    ///
    /// A device that is lost.
    pub(crate) async fn picture(self, gpu: &Gpu) -> Result<Vec<u8>> {
        self.0.awaited(&gpu.device, gpu.name()).await
    }
}
