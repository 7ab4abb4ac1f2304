//! The device that egui and sessions share. It can be lost by a driver reset or update, a removed card, or a frame that
//! exceeds the system's time limit.
//!
//! After a loss the device and all its resources are unusable: everything has to be created again on another device.

use std::sync::{Arc, OnceLock};

use cutaway::Gpu;
use egui_wgpu::{WgpuConfiguration, WgpuSetup, wgpu};

/// Makes egui create its device with the features that sessions need.
pub fn on_our_device(options: &mut WgpuConfiguration) {
    if let WgpuSetup::CreateNew(setup) = &mut options.wgpu_setup {
        setup.device_descriptor = Arc::new(Gpu::descriptor);
    }
}

/// Records that a device was lost, with the reason. Clones share the record.
#[derive(Clone, Debug, Default)]
pub struct DeviceLoss(Arc<OnceLock<String>>);

impl DeviceLoss {
    /// Watches a device, replacing any earlier loss callback; `wake` is called once when it is lost.
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

    /// Reason for the loss; `None` while the device is not lost.
    pub fn reason(&self) -> Option<&str> {
        self.0.get().map(String::as_str)
    }
}
