//! The device that egui and sessions share.

use std::sync::Arc;

use cutaway::Gpu;
use egui_wgpu::{WgpuConfiguration, WgpuSetup};

/// Lets egui make its device as sessions want it.
pub fn on_our_device(options: &mut WgpuConfiguration) {
    if let WgpuSetup::CreateNew(setup) = &mut options.wgpu_setup {
        setup.device_descriptor = Arc::new(Gpu::descriptor);
    }
}
