//! The device, its capabilities and its errors. It was opened by `open`, or belongs to a host.
//!
//! Everything runs on core WebGPU; native features are queried ([`Gpu::has_timestamps`]) and used if present.

use std::borrow::Cow;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::task::{Context, Poll, Waker};

use super::adapter::AdapterReport;
use super::clip_layout::ClipLayout;
use super::composite::Compositors;
use super::programs::pipelines::Pipelines;
use super::programs::preparation::Preparation;
use super::timing::timed;
use super::uniforms;
use crate::plan::{Contents, Limits};
use crate::strategies::AdapterTraits;
use crate::{Error, Result};

/// Features that [`Limits::wide_atomics`] requires.
const WIDE_ATOMICS: wgpu::Features =
    wgpu::Features::SHADER_INT64.union(wgpu::Features::SHADER_INT64_ATOMIC_MIN_MAX);

/// An open device.
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    /// The adapter's report without the measured sub-pixel bits.
    unmeasured: AdapterReport,
    /// The same report with the measured sub-pixel bits.
    measured: OnceLock<AdapterReport>,
    limits: Limits,
    timestamps: bool,
    /// True if the driver inlines uniforms, so that they are better read from storage buffers.
    inlines_uniforms: bool,
    pub(super) complaint: Arc<Mutex<Option<String>>>,
    /// Buffers with large contents that several programs share, looked up by the identity of the contents.
    shared: Mutex<Vec<(Contents, wgpu::BufferUsages, wgpu::Buffer)>>,
    /// The pipelines of all programs.
    pipelines: Mutex<Pipelines>,
    compositors: Mutex<Compositors>,
    preparation: Mutex<Preparation>,
    /// Bindings for a host's shaders, created on first use.
    pub(super) clip: OnceLock<ClipLayout>,
}

/// Size in bytes from which contents are shared between programs.
const SHARED_FROM_BYTES: u64 = 1 << 16;

impl Gpu {
    /// The limits that a device must have: those of core WebGPU.
    pub fn required_limits() -> wgpu::Limits {
        wgpu::Limits::default()
    }

    /// The features that are used if a device has them; none is required.
    ///
    /// `DEPTH32FLOAT_STENCIL8` is for strategies with a stencil, `FLOAT32_FILTERABLE` for heights through a sampler, `SHADER_INT64` with
    /// `SHADER_INT64_ATOMIC_MIN_MAX` to let the compute rasteriser make one sweep instead of two, `TIMESTAMP_QUERY` for times.
    pub fn wanted_features() -> wgpu::Features {
        WIDE_ATOMICS
            | wgpu::Features::DEPTH32FLOAT_STENCIL8
            | wgpu::Features::FLOAT32_FILTERABLE
            | wgpu::Features::TIMESTAMP_QUERY
    }

    /// Device descriptor with which every strategy that the adapter supports can run: the required limits, but bindings, buffers and
    /// textures as large as the adapter allows, and the wanted features that it offers. A host adds its own needs.
    pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        let have = adapter.limits();
        let mut required = Self::required_limits();
        if uniforms::are_inlined(&adapter.get_info()) {
            required.max_storage_buffers_per_shader_stage =
                have.max_storage_buffers_per_shader_stage;
        }
        wgpu::DeviceDescriptor {
            label: Some("cutaway"),
            required_features: adapter.features() & Self::wanted_features(),
            required_limits: wgpu::Limits {
                max_storage_buffer_binding_size: have.max_storage_buffer_binding_size,
                max_buffer_size: have.max_buffer_size,
                max_texture_dimension_2d: have.max_texture_dimension_2d,
                ..required
            },
            ..wgpu::DeviceDescriptor::default()
        }
    }

    /// Uses a host's device. The host keeps ownership: the device's error handlers stay as they are. The limits and features with
    /// which the device was created determine what plans may use.
    ///
    /// # Errors
    ///
    /// A device below the [required limits](Self::required_limits): the error lists each such limit with the value that the device offers.
    pub fn from_device(
        info: &wgpu::AdapterInfo,
        device: wgpu::Device,
        queue: wgpu::Queue,
    ) -> Result<Self> {
        let (have, features) = (device.limits(), device.features());
        let mut lacking = Vec::new();
        Self::required_limits().check_limits_with_fail_fn(&have, false, |name, needed, offered| {
            lacking.push(format!("{name}: {needed} are needed, {offered} offered"));
        });
        if !lacking.is_empty() {
            return Err(Error::Adapter {
                what: format!(
                    "the device of {} has less than core WebGPU: {}",
                    info.name,
                    lacking.join("; ")
                ),
                help: "create it with the limits of Gpu::required_limits(), or by Gpu::descriptor(&adapter)"
                    .to_owned(),
            });
        }
        let unmeasured = AdapterReport::of(info);
        Ok(Self {
            limits: Limits {
                storage_binding_bytes: have.max_storage_buffer_binding_size,
                buffer_bytes: have.max_buffer_size,
                texture_size: have.max_texture_dimension_2d,
                wide_atomics: features.contains(WIDE_ATOMICS),
                depth32_stencil8: features.contains(wgpu::Features::DEPTH32FLOAT_STENCIL8),
                filters_f32: features.contains(wgpu::Features::FLOAT32_FILTERABLE),
                ..Limits::CORE
            },
            timestamps: !unmeasured.software && features.contains(wgpu::Features::TIMESTAMP_QUERY),
            unmeasured,
            measured: OnceLock::new(),
            inlines_uniforms: uniforms::are_inlined(info),
            device,
            queue,
            complaint: Arc::default(),
            shared: Mutex::default(),
            pipelines: Mutex::default(),
            compositors: Mutex::default(),
            preparation: Mutex::default(),
            clip: OnceLock::new(),
        })
    }

    /// The device.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Name of the adapter.
    pub fn name(&self) -> &str {
        &self.unmeasured.name
    }

    /// Description of the adapter. The first call measures its sub-pixel bits by a small draw and waits for that, except in a browser.
    pub fn report(&self) -> &AdapterReport {
        self.measured.get_or_init(|| AdapterReport {
            // If the device refuses this small draw, the next frame reports the reason.
            #[cfg(not(target_arch = "wasm32"))]
            sub_pixel_bits: super::sub_pixel::measure(self).ok(),
            ..self.unmeasured.clone()
        })
    }

    /// Adapter properties for choosing a rasteriser. Sub-pixel bits of software adapters are not measured: they do not affect the choice.
    pub fn traits(&self) -> AdapterTraits<'_> {
        let software = self.unmeasured.software;
        AdapterTraits {
            limits: &self.limits,
            software,
            sub_pixel_bits: match software {
                true => None,
                false => self.report().sub_pixel_bits,
            },
        }
    }

    /// Limits for plans on this adapter.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Restricts plans to given limits, below those of the adapter, to imitate another adapter.
    #[must_use]
    pub fn held_to(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// Returns true if the device has reliable timestamps.
    pub fn has_timestamps(&self) -> bool {
        self.timestamps
    }

    /// Work done so far to prepare the device for its frames.
    pub fn preparation(&self) -> Preparation {
        *self.preparing()
    }

    /// The work done so far, for updates.
    pub(super) fn preparing(&self) -> MutexGuard<'_, Preparation> {
        lock(&self.preparation)
    }

    /// The pipelines of all programs.
    pub(super) fn pipelines(&self) -> MutexGuard<'_, Pipelines> {
        lock(&self.pipelines)
    }

    /// The compositing pipelines.
    pub(super) fn compositors(&self) -> MutexGuard<'_, Compositors> {
        lock(&self.compositors)
    }

    /// Runs a function that uses the device, and returns an error if the device refuses any of its calls.
    pub(crate) fn scoped<T>(&self, work: impl FnOnce() -> Result<T>) -> Result<T> {
        let filters = [
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let done = work();
        // The most recently opened scope is closed first.
        let refused = scopes.into_iter().rev().filter_map(|s| at_once(s.pop()));
        match refused.last() {
            Some(refused) => Err(self.refused(&refused.to_string())),
            None => done,
        }
    }

    /// The device errors that occurred outside any scope since the last call, as one error.
    pub(super) fn complaint(&self) -> Result<()> {
        match lock(&self.complaint).take() {
            None => Ok(()),
            Some(what) => Err(self.refused(&what)),
        }
    }

    fn refused(&self, what: &str) -> Error {
        Error::Adapter {
            what: format!("the adapter {} refused work: {what}", self.name()),
            help: "request a smaller picture (--resolution), or choose another adapter (--adapter)"
                .to_owned(),
        }
    }

    /// Usage flags of uniform buffers.
    pub(super) fn uniform_usage(&self) -> wgpu::BufferUsages {
        uniforms::usage(self.inlines_uniforms)
    }

    /// A shader module from a composed shader.
    pub(super) fn module(&self, label: &str, mut composed: naga::Module) -> wgpu::ShaderModule {
        if self.inlines_uniforms {
            let most = self.device.limits().max_storage_buffers_per_shader_stage;
            uniforms::read_from_storage(&mut composed, most as usize);
        }
        self.device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Naga(Cow::Owned(composed)),
            })
    }

    /// A buffer with contents. Programs share the buffers of large constant contents.
    pub(super) fn buffer_with(
        &self,
        label: &str,
        contents: &Contents,
        usage: wgpu::BufferUsages,
    ) -> wgpu::Buffer {
        let sharable = is_shared(contents);
        let mut shared = lock(&self.shared);
        if sharable {
            // Buffers whose contents no plan refers to any more are released.
            shared.retain(|(c, _, _)| c.is_held_elsewhere());
            let known = shared
                .iter()
                .find(|(c, u, _)| c.is_same(contents) && *u == usage);
            if let Some((_, _, buffer)) = known {
                return buffer.clone();
            }
        }
        let mut preparing = self.preparing();
        preparing.uploads += 1;
        preparing.bytes += contents.len();
        let buffer = timed(&mut preparing.uploading, || {
            let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: contents.len().next_multiple_of(4),
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            for piece in contents.pieces() {
                self.queue.write_buffer(&buffer, piece.offset, &piece.bytes);
            }
            buffer
        });
        drop(preparing);
        if sharable {
            shared.push((contents.clone(), usage, buffer.clone()));
        }
        buffer
    }
}

/// Returns true if all programs share one buffer of these contents, so that none may write to it.
pub(super) fn is_shared(contents: &Contents) -> bool {
    contents.len() >= SHARED_FROM_BYTES && !contents.changes()
}

/// The error that a scope caught, if it is available at once. A browser reports it later, and to its console.
fn at_once(caught: impl Future<Output = Option<wgpu::Error>>) -> Option<wgpu::Error> {
    let mut caught = std::pin::pin!(caught);
    let mut context = Context::from_waker(Waker::noop());
    match caught.as_mut().poll(&mut context) {
        Poll::Ready(error) => error,
        Poll::Pending => None,
    }
}

/// Locks. A poisoned lock only means that another thread panicked while it held plain data.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
