//! What pixels of a frame show, on their way back: one, or all. What a pointer picks is read from the layers, so that it is what is seen,
//! cuts and all.
//!
//! Costs a copy of 12 bytes a pixel. Cannot: know of a frame that was not submitted.

use super::Gpu;
use super::arrival::Arrival;
use super::layer_words::{layer_from_words, layers_from_words};
use crate::Result;
use crate::layers::Layer;

/// A pixel that was asked for.
#[derive(Debug)]
pub struct Pick(Arrival);

impl Pick {
    /// Of a copy that is made by commands of the same encoder.
    pub(super) fn new(encoder: &wgpu::CommandEncoder, staging: wgpu::Buffer) -> Self {
        Self(Arrival::new(encoder, staging))
    }

    /// Whether it may still come; that it has come is found out by [`Session::poll`](crate::Session::poll).
    pub fn is_under_way(&self) -> bool {
        self.0.is_under_way()
    }

    /// What the pixel shows, once it is known.
    pub fn layer(&self) -> Option<Layer> {
        let words: [u32; 3] = self.0.values()?.try_into().ok()?;
        Some(layer_from_words(&words))
    }
}

/// The layers of a program's frame or its picture, on their way back.
#[derive(Debug)]
pub(crate) struct Arriving(Arrival);

impl Arriving {
    /// Of a buffer, which is copied behind what is encoded.
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
