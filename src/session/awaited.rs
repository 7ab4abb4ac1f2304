//! Layers of a frame where nothing may be waited for, such as on a page of a browser: the frame is encoded as for a host, and its layers are
//! awaited.
//!
//! Costs what [`Session::draw`] and [`Session::layers`] cost together, less one wait. Takes no times.

use super::bands::Band;
use super::encode::Encoded;
use super::{MOST_TRIES, Session};
use crate::Result;
use crate::gpu::CommandEncoder;
use crate::layers::Layers;
use crate::passes::Model;
use crate::scene::View;
use crate::strategies::{Method, Refusal};

impl Session {
    /// Draws a frame by a method and awaits its layers. A bounded buffer that was too small is made larger, as in [`Session::draw`]; the pixels
    /// of what still overflows are marked as unreliable.
    ///
    /// Elsewhere than in a browser it waits, before it is first pending.
    ///
    /// # Errors
    ///
    /// Those of [`Session::encode`], and a device that is lost.
    pub async fn layers_async(
        &mut self,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
    ) -> Result<Result<Layers, Refusal>> {
        let method = method.into();
        let mut tries = 1;
        loop {
            let descriptor = Default::default();
            let mut encoder = self.gpu.device().create_command_encoder(&descriptor);
            if let Encoded::Refused(refusal) =
                self.encode_passes(&mut encoder, model, view, method)?
            {
                return Ok(Err(refusal));
            }
            let layers = self.send_layers(encoder, method).await?;
            let overflows = self.poll()?;
            let is_mended = overflows.iter().any(|(by, o)| *by == method && o.is_mended);
            if !is_mended || tries == MOST_TRIES {
                return Ok(Ok(layers));
            }
            tries += 1;
        }
    }

    /// Submits a frame, with its layers on their way back.
    async fn send_layers(&self, mut encoder: CommandEncoder, method: Method) -> Result<Layers> {
        let slot = self.slot(method)?;
        let send = |band: &Band| band.program.send_layers(&self.gpu, &mut encoder);
        let sent = slot.bands.iter().map(send).collect::<Result<Vec<_>>>()?;
        self.gpu.queue().submit([encoder.finish()]);
        let size_px = slot.size_px;
        let mut pixels = Vec::with_capacity(size_px.map(|s| s as usize).iter().product());
        for (band, arriving) in slot.bands.iter().zip(sent) {
            let drawn = arriving.pixels(&self.gpu).await?;
            pixels.extend(band.rows.own(&drawn, size_px[0] as usize));
        }
        Ok(Layers { size_px, pixels })
    }
}
