//! What bounded buffers needed, on its way back from a frame that a host submits.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use crate::plan::Bounded;

/// A copy of needs that is mapped once the host has submitted it.
pub(crate) struct Report {
    staging: wgpu::Buffer,
    state: Arc<AtomicU8>,
    bounded: Vec<Bounded>,
}

const UNDER_WAY: u8 = 0;
const ARRIVED: u8 = 1;
const LOST: u8 = 2;

impl Report {
    /// Of a copy that is made by commands of the same encoder.
    pub(super) fn new(
        encoder: &wgpu::CommandEncoder,
        staging: wgpu::Buffer,
        bounded: Vec<Bounded>,
    ) -> Self {
        let state = Arc::new(AtomicU8::new(UNDER_WAY));
        let shared = state.clone();
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |mapped| {
            let how = if mapped.is_ok() { ARRIVED } else { LOST };
            shared.store(how, Ordering::Release);
        });
        Self {
            staging,
            state,
            bounded,
        }
    }

    /// Whether it may still come.
    pub(crate) fn is_under_way(&self) -> bool {
        self.state.load(Ordering::Acquire) == UNDER_WAY
    }

    /// The bounded buffers, each with what it needed; none while that has not arrived.
    pub(crate) fn needs(&self) -> Vec<(&Bounded, u32)> {
        if self.state.load(Ordering::Acquire) != ARRIVED {
            return Vec::new();
        }
        let Ok(mapped) = self.staging.get_mapped_range(..) else {
            return Vec::new();
        };
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&mapped);
        let need = |b: &Bounded| words.get(b.slot as usize).copied().unwrap_or(0);
        self.bounded.iter().map(|b| (b, need(b))).collect()
    }
}
