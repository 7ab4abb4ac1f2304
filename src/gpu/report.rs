//! Capacities that bounded buffers needed, in transfer from a frame that a host submits.

use super::arrival::Arrival;
use crate::plan::Bounded;

/// A copy of the needed capacities, mapped for reading once the host has submitted the frame.
pub(crate) struct Report {
    arrival: Arrival,
    bounded: Vec<Bounded>,
}

impl Report {
    /// Starts to wait for a copy that was encoded in this encoder.
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

    /// Returns true if the copy may still arrive.
    pub(crate) fn is_under_way(&self) -> bool {
        self.arrival.is_under_way()
    }

    /// The bounded buffers, each with the capacity that it needed; empty until the copy has arrived.
    pub(crate) fn needs(&self) -> Vec<(&Bounded, u32)> {
        let Some(words) = self.arrival.values::<u32>() else {
            return Vec::new();
        };
        let need = |b: &Bounded| words.get(b.slot as usize).copied().unwrap_or(0);
        self.bounded.iter().map(|b| (b, need(b))).collect()
    }
}
