//! Opens a device that no host provides: chooses an adapter, and lists all adapters.

use std::sync::Arc;

use super::Gpu;
use super::adapter;
use super::device::lock;
use crate::{Error, Result};

/// Options that select the adapter.
#[derive(Clone, Debug, Default)]
pub struct GpuOptions {
    /// Part of the adapter's name, case-insensitive; `None` takes the fastest.
    pub adapter: Option<String>,
    /// True to prefer a software adapter, which gives the same results on every machine, for tests.
    pub prefer_software: bool,
}

impl Gpu {
    /// Opens a device, and waits for it.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open(options: &GpuOptions) -> Result<Self> {
        pollster::block_on(Self::open_async(options))
    }

    /// Descriptions of all adapters of this machine, each [in words](super::AdapterReport::in_words).
    #[cfg(not(target_arch = "wasm32"))]
    pub fn adapters() -> Vec<String> {
        let adapters = pollster::block_on(adapter::all());
        let in_words = |a: &wgpu::Adapter| adapter::AdapterReport::of(&a.get_info()).in_words();
        adapters.iter().map(in_words).collect()
    }

    /// As [`Gpu::open`], for callers that must not block.
    pub async fn open_async(options: &GpuOptions) -> Result<Self> {
        let mut adapters = adapter::all().await;
        let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
        if let Some(wanted) = &options.adapter {
            adapters.retain(|a| {
                a.get_info()
                    .name
                    .to_lowercase()
                    .contains(&wanted.to_lowercase())
            });
            if adapters.is_empty() && !names.is_empty() {
                return Err(Error::input(
                    format!("--adapter {wanted}"),
                    "no adapter name contains this",
                    format!("use part of one of: {}", names.join(", ")),
                ));
            }
        }
        let rank = |a: &wgpu::Adapter| match a.get_info().device_type {
            wgpu::DeviceType::Cpu => u8::from(!options.prefer_software) * 4,
            wgpu::DeviceType::DiscreteGpu => 1,
            wgpu::DeviceType::IntegratedGpu => 2,
            _ => 3,
        };
        let Some(adapter) = adapters.into_iter().min_by_key(rank) else {
            return Err(Error::Adapter {
                what: "there is no graphics adapter, not even a software one".to_owned(),
                help: "install a Vulkan driver; the software one is the package mesa-vulkan-drivers (Debian, Ubuntu, \
                       Fedora) or vulkan-swrast (Arch)"
                    .to_owned(),
            });
        };
        let (device, queue) = adapter
            .request_device(&Self::descriptor(&adapter))
            .await
            .map_err(|e| Error::Adapter {
                what: format!(
                    "{} offers no device that can run core WebGPU: {e}",
                    adapter.get_info().name
                ),
                help: format!(
                    "choose another with --adapter; there are: {}",
                    names.join(", ")
                ),
            })?;
        let gpu = Self::from_device(&adapter.get_info(), device, queue)?;
        // Records errors outside any scope, such as a lost device; by default wgpu panics on them.
        let listener = gpu.complaint.clone();
        let record = move |e: wgpu::Error| {
            lock(&listener).get_or_insert(e.to_string());
        };
        gpu.device.on_uncaptured_error(Arc::new(record));
        Ok(gpu)
    }
}
