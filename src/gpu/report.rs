//! Needs of bounded buffers, being read back from a frame that a host submits.

use super::arrival::Arrival;
use crate::plan::Bounded;

/// A copy of the needs, mapped once the host has submitted it.
pub(crate) struct Report {
    arrival: Arrival,
    bounded: Vec<Bounded>,
}

impl Report {
    /// Awaits a copy encoded in the same encoder.
    pub(super) fn new(
        encoder: &wgpu::CommandEncoder,
        staging: wgpu::Buffer,
        bounded: Vec<Bounded>,
    ) -> Self {
        Self {
            arrival: Arrival::new(encoder, staging),
            bounded,
        }
    }

    /// Returns true if it may still arrive.
    pub(crate) fn is_under_way(&self) -> bool {
        self.arrival.is_under_way()
    }

    /// The bounded buffers, each with the capacity it needed; empty until the copy has arrived.
    pub(crate) fn needs(&self) -> Vec<(&Bounded, u32)> {
        let Some(words) = self.arrival.values::<u32>() else {
            return Vec::new();
        };
        let need = |b: &Bounded| words.get(b.slot as usize).copied().unwrap_or(0);
        self.bounded.iter().map(|b| (b, need(b))).collect()
    }
}
