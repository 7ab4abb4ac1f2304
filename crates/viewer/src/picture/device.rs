//! The device that egui and sessions share, and whether it is lost: a driver that was reset or updated, a card that is gone, a frame that
//! took longer than the system allows.
//!
//! A lost device draws nothing any more, and neither does what was made on it: only another device helps.

use std::sync::{Arc, OnceLock};

use cutaway::Gpu;
use egui_wgpu::{WgpuConfiguration, WgpuSetup, wgpu};

/// Lets egui make its device as sessions want it.
pub fn on_our_device(options: &mut WgpuConfiguration) {
    if let WgpuSetup::CreateNew(setup) = &mut options.wgpu_setup {
        setup.device_descriptor = Arc::new(Gpu::descriptor);
    }
}

/// Shared flag that a device is lost, with the reason.
#[derive(Clone, Debug, Default)]
pub struct DeviceLoss(Arc<OnceLock<String>>);

impl DeviceLoss {
    /// Watches a device, in the place of any earlier callback for its loss; `wake` is called once when it is lost.
    pub fn watch(device: &wgpu::Device, wake: impl Fn() + Send + 'static) -> Self {
        let loss = Self::default();
        let own = loss.clone();
        device.set_device_lost_callback(move |reason, message| {
            let message = match (message.trim().trim_end_matches('.'), reason) {
                ("", wgpu::DeviceLostReason::Destroyed) => "it was destroyed",
                ("", _) => "the driver gives no reason",
                (message, _) => message,
            };
            own.0.get_or_init(|| message.to_owned());
            wake();
        });
        loss
    }

    /// Why it is lost, once it is.
    pub fn reason(&self) -> Option<&str> {
        self.0.get().map(String::as_str)
    }
}
