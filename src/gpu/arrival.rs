//! Words in transfer from the device after a frame, submitted by the host or by a session.

use std::future::poll_fn;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Poll, Waker};

use crate::{Error, Result};

/// A copy that is mapped for reading once its commands have been submitted.
#[derive(Debug)]
pub(super) struct Arrival {
    staging: wgpu::Buffer,
    state: Arc<Mutex<ArrivalState>>,
}

#[derive(Debug)]
enum ArrivalState {
    UnderWay(Option<Waker>),
    Arrived,
    Lost,
}

impl Arrival {
    /// Starts to wait for a copy that was encoded in this encoder.
    pub(super) fn new(encoder: &wgpu::CommandEncoder, staging: wgpu::Buffer) -> Self {
        let state = Arc::new(Mutex::new(ArrivalState::UnderWay(None)));
        let shared = state.clone();
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |mapped| {
            let how = match mapped {
                Ok(()) => ArrivalState::Arrived,
                Err(_) => ArrivalState::Lost,
            };
            let before = std::mem::replace(&mut *lock(&shared), how);
            if let ArrivalState::UnderWay(Some(waker)) = before {
                waker.wake();
            }
        });
        Self { staging, state }
    }

    /// Returns true if the copy may still arrive.
    pub(super) fn is_under_way(&self) -> bool {
        matches!(*lock(&self.state), ArrivalState::UnderWay(_))
    }

    /// Resolves when the copy has arrived or has failed.
    async fn ended(&self) {
        poll_fn(|context| match &mut *lock(&self.state) {
            ArrivalState::UnderWay(waker) => {
                *waker = Some(context.waker().clone());
                Poll::Pending
            }
            ArrivalState::Arrived | ArrivalState::Lost => Poll::Ready(()),
        })
        .await;
    }

    /// Waits for the values. A browser polls its devices by itself; elsewhere this blocks until the device is done.
    ///
    /// # Errors
    ///
    /// A lost device; `name` is the name of its adapter.
    pub(super) async fn awaited<T: bytemuck::Pod>(
        &self,
        device: &wgpu::Device,
        name: &str,
    ) -> Result<Vec<T>> {
        let lost = || Error::Adapter {
            what: format!("{name} lost a frame during read-back"),
            help: "run again".to_owned(),
        };
        if cfg!(not(target_arch = "wasm32")) {
            let waited = device.poll(wgpu::PollType::wait_indefinitely());
            waited.map_err(|_| lost())?;
        }
        self.ended().await;
        self.values().ok_or_else(lost)
    }

    /// The values, if they have arrived.
    pub(super) fn values<T: bytemuck::Pod>(&self) -> Option<Vec<T>> {
        if !matches!(*lock(&self.state), ArrivalState::Arrived) {
            return None;
        }
        let mapped = self.staging.get_mapped_range(..).ok()?;
        Some(bytemuck::pod_collect_to_vec(&mapped))
    }
}

/// Locks. A poisoned lock only means that another thread panicked while it held plain data.
fn lock(state: &Mutex<ArrivalState>) -> MutexGuard<'_, ArrivalState> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}
