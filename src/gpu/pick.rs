//! Pixels of a frame in transfer: one, or all. A pointer pick reads the layers, so it returns the visible surface, with all cuts applied.
//!
//! Costs a copy of 12 bytes a pixel. Cannot: detect that a frame was never submitted.

use super::Gpu;
use super::arrival::Arrival;
use super::layer_words::{layer_from_words, layers_from_words};
use crate::Result;
use crate::layers::Layer;

/// A requested pixel.
#[derive(Debug)]
pub struct Pick(Arrival);

impl Pick {
    /// Awaits a copy encoded in the same encoder.
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

/// The layers of a program's frame or its picture, being read back.
#[derive(Debug)]
pub(crate) struct Arriving(Arrival);

impl Arriving {
    /// Starts reading back a buffer, copied after the commands encoded so far.
    pub(super) fn new(
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        buffer: &wgpu::Buffer,
    ) -> Self {
        let staging = gpu.staging(buffer.size());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        Self(Arrival::new(encoder, staging))
    }

    /// The pixels, row by row, once they have arrived: asynchronous on a web page, blocking elsewhere.
    ///
    /// # Errors
    ///
    /// A lost device.
    pub(crate) async fn layers(self, gpu: &Gpu) -> Result<Vec<Layer>> {
        let words = self.0.awaited(&gpu.device, gpu.name()).await?;
        Ok(layers_from_words(&words))
    }

    /// RGBA8 of the pixels, likewise.
    ///
    /// # Errors
    ///
    /// A lost device.
    pub(crate) async fn picture(self, gpu: &Gpu) -> Result<Vec<u8>> {
        self.0.awaited(&gpu.device, gpu.name()).await
    }
}
