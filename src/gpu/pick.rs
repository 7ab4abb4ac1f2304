//! What one pixel of a frame shows, on its way back: what a pointer picks is read from the layers, so that it is what is seen, cuts and all.
//!
//! Costs a copy of 12 bytes. Cannot: know of a frame that was not submitted.

use super::arrival::Arrival;
use super::layer_words::layer_from_words;
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
        let words: [u32; 3] = self.0.words()?.try_into().ok()?;
        Some(layer_from_words(&words))
    }
}
