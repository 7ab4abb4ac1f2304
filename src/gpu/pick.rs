//! Pixels of a frame in transfer to the CPU: one, or all. A pick reads the layers, so it returns the visible surface of the cut scene.
//!
//! Costs a copy of 12 bytes a pixel. Cannot: detect that a frame was never submitted.

use super::Gpu;
use super::arrival::Arrival;
use super::layer_words::{layer_from_words, layers_from_words};
use crate::Result;
use crate::layers::Layer;

/// A requested pixel, in transfer to the CPU.
#[derive(Debug)]
pub struct Pick(Arrival);

impl Pick {
    /// Starts to wait for a copy that was encoded in this encoder.
    pub(super) fn new(encoder: &wgpu::CommandEncoder, staging: wgpu::Buffer) -> Self {
        Self(Arrival::new(encoder, staging))
    }

    /// Returns true if the pixel may still arrive; [`Session::poll`](crate::Session::poll) detects the arrival.
    pub fn is_under_way(&self) -> bool {
        self.0.is_under_way()
    }

    /// The layer of the pixel; none until it has arrived.
    pub fn layer(&self) -> Option<Layer> {
        let words: [u32; 3] = self.0.values()?.try_into().ok()?;
        Some(layer_from_words(&words))
    }
}

/// The layers or the picture of a program's frame, in transfer to the CPU.
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

    /// Waits for the layers, row by row: asynchronous on a web page, blocking elsewhere.
    ///
    /// # Errors
    ///
    /// A lost device.
    pub(crate) async fn layers(self, gpu: &Gpu) -> Result<Vec<Layer>> {
        let words = self.0.awaited(&gpu.device, gpu.name()).await?;
        Ok(layers_from_words(&words))
    }

    /// As [`Arriving::layers`], for the picture as RGBA8.
    ///
    /// # Errors
    ///
    /// A lost device.
    pub(crate) async fn picture(self, gpu: &Gpu) -> Result<Vec<u8>> {
        self.0.awaited(&gpu.device, gpu.name()).await
    }
}
