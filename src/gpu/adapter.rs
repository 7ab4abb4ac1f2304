//! Adapters: the properties that are known before a device is opened on them.

/// All adapters, through every graphics interface.
pub(super) async fn all() -> Vec<wgpu::Adapter> {
    let instance =
        wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    instance.enumerate_adapters(wgpu::Backends::all()).await
}

/// Description of an adapter, for reports.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AdapterReport {
    /// Name of the device.
    pub name: String,
    /// Graphics interface.
    pub backend: String,
    /// Driver and its version.
    pub driver: String,
    /// True if it runs on the CPU.
    pub software: bool,
    /// Number of bits such that the rasteriser snaps vertices to 2^-bits of a pixel. None if it could not be measured, as in a browser,
    /// and in reports older than this measurement.
    #[cfg_attr(feature = "serde", serde(default))]
    pub sub_pixel_bits: Option<u32>,
}

impl AdapterReport {
    /// The part of the description that is available before a device is open.
    pub(super) fn of(info: &wgpu::AdapterInfo) -> Self {
        Self {
            name: info.name.clone(),
            backend: info.backend.to_string(),
            driver: format!("{} {}", info.driver, info.driver_info)
                .trim()
                .to_owned(),
            software: info.device_type == wgpu::DeviceType::Cpu,
            sub_pixel_bits: None,
        }
    }

    /// Name, graphics interface and driver, on one line.
    pub fn in_words(&self) -> String {
        format!("{} ({}, {})", self.name, self.backend, self.driver)
    }
}
