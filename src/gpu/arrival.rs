//! Words on their way back from a frame that a host submits.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// A copy that is mapped once the host has submitted it.
#[derive(Debug)]
pub(super) struct Arrival {
    staging: wgpu::Buffer,
    state: Arc<AtomicU8>,
}

const UNDER_WAY: u8 = 0;
const ARRIVED: u8 = 1;
const LOST: u8 = 2;

impl Arrival {
    /// Of a copy that is made by commands of the same encoder.
    pub(super) fn new(encoder: &wgpu::CommandEncoder, staging: wgpu::Buffer) -> Self {
        let state = Arc::new(AtomicU8::new(UNDER_WAY));
        let shared = state.clone();
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |mapped| {
            let how = if mapped.is_ok() { ARRIVED } else { LOST };
            shared.store(how, Ordering::Release);
        });
        Self { staging, state }
    }

    /// Whether it may still come.
    pub(super) fn is_under_way(&self) -> bool {
        self.state.load(Ordering::Acquire) == UNDER_WAY
    }

    /// The words, once they are there.
    pub(super) fn words(&self) -> Option<Vec<u32>> {
        if self.state.load(Ordering::Acquire) != ARRIVED {
            return None;
        }
        let mapped = self.staging.get_mapped_range(..).ok()?;
        Some(bytemuck::pod_collect_to_vec(&mapped))
    }
}
