//! Reads buffers back, only after a frame and never during it.

use super::Gpu;
use super::arrival::Arrival;
use crate::{Error, Result};

impl Gpu {
    /// Creates a buffer to copy into and then map for reading.
    pub(super) fn staging(&self, bytes: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("staging"),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        })
    }

    /// Waits for the device, then maps a staging buffer and returns its values.
    pub(super) fn map<T: bytemuck::Pod>(&self, staging: &wgpu::Buffer) -> Result<Vec<T>> {
        staging.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let lost = |what: String| Error::Adapter {
            what,
            help: "the device was lost; run again".to_owned(),
        };
        let values = {
            let view = staging
                .get_mapped_range(..)
                .map_err(|e| lost(format!("reading back failed: {e}")))?;
            bytemuck::pod_collect_to_vec(&view)
        };
        staging.unmap();
        Ok(values)
    }

    /// The values of a buffer on the device.
    pub(super) fn read<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer) -> Result<Vec<T>> {
        let staging = self.staging(buffer.size());
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        self.map(&staging)
    }

    /// Submits commands that copy into a mappable buffer, and awaits its bytes. Outside a browser it blocks before it first returns
    /// pending.
    ///
    /// # Errors
    ///
    /// A lost device.
    pub fn submit_and_read(
        &self,
        encoder: wgpu::CommandEncoder,
        staging: wgpu::Buffer,
    ) -> impl Future<Output = Result<Vec<u8>>> + use<> {
        let arrival = Arrival::new(&encoder, staging);
        self.queue.submit([encoder.finish()]);
        let (device, name) = (self.device.clone(), self.name().to_owned());
        async move { arrival.awaited(&device, &name).await }
    }

    /// Makes the device report completed work, without waiting.
    pub(crate) fn poll(&self) -> Result<()> {
        self.polled(wgpu::PollType::Poll)
    }

    /// Waits until the device has finished all submitted work.
    pub(super) fn wait(&self) -> Result<()> {
        self.polled(wgpu::PollType::wait_indefinitely())
    }

    fn polled(&self, how: wgpu::PollType) -> Result<()> {
        self.device.poll(how).map_err(|e| Error::Adapter {
            what: format!("waiting failed: {e}"),
            help: "run again".to_owned(),
        })?;
        self.complaint()
    }
}
