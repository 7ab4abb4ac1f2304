//! Layers and pictures for callers that must not block, such as a web page. Frames are encoded as for a host, and results are awaited.
//!
//! Costs as much as [`Session::draw`], [`Session::layers`] and [`Session::picture`] together, without the waits. Measures no times.

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
    /// Draws a frame by a method and awaits its layers. A bounded buffer that was too small grows, as in [`Session::draw`]; pixels that
    /// still overflow are marked as unreliable.
    ///
    /// Outside a browser it blocks before it first returns pending.
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
        let drawn = self.awaited(model, view, method.into(), false).await?;
        Ok(drawn.map(|(layers, _)| layers))
    }

    /// As [`Session::layers_async`], with the picture: RGBA8, rows from the top.
    ///
    /// # Errors
    ///
    /// Those of [`Session::layers_async`].
    pub async fn frame_async(
        &mut self,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
    ) -> Result<Result<(Layers, Vec<u8>), Refusal>> {
        self.awaited(model, view, method.into(), true).await
    }

    /// As [`Session::shade`], asynchronous.
    ///
    /// # Errors
    ///
    /// Layers that are too large for the device, and a lost device.
    pub async fn shade_async(
        &self,
        model: &Model,
        view: &View,
        layers: &Layers,
    ) -> Result<Vec<u8>> {
        let sent = self.in_bands(
            model,
            view,
            layers,
            self.most_bytes(),
            |session, band, view, layers| {
                let gpu = &session.gpu;
                let mut encoder = gpu.device().create_command_encoder(&Default::default());
                let program = session.finished(&mut encoder, model, view, layers)?;
                let sent = program.send_picture(gpu, &mut encoder)?;
                gpu.queue().submit([encoder.finish()]);
                Ok((*band, sent))
            },
        )?;
        let mut picture = Vec::new();
        for (band, sent) in sent {
            let drawn = sent.picture(&self.gpu).await?;
            picture.extend(band.own(&drawn, layers.size_px[0] as usize * 4));
        }
        Ok(picture)
    }

    async fn awaited(
        &mut self,
        model: &Model,
        view: &View,
        method: Method,
        has_picture: bool,
    ) -> Result<Result<(Layers, Vec<u8>), Refusal>> {
        let mut tries = 1;
        loop {
            let descriptor = Default::default();
            let mut encoder = self.gpu.device().create_command_encoder(&descriptor);
            if let Encoded::Refused(refusal) =
                self.encode_passes(&mut encoder, model, view, method)?
            {
                return Ok(Err(refusal));
            }
            let drawn = self.send(encoder, method, has_picture).await?;
            let overflows = self.poll()?;
            let is_mended = overflows.iter().any(|(by, o)| *by == method && o.is_mended);
            if !is_mended || tries == MOST_TRIES {
                return Ok(Ok(drawn));
            }
            tries += 1;
        }
    }

    /// Submits a frame, and starts reading back its layers and its picture.
    async fn send(
        &self,
        mut encoder: CommandEncoder,
        method: Method,
        has_picture: bool,
    ) -> Result<(Layers, Vec<u8>)> {
        let slot = self.slot(method)?;
        let gpu = &self.gpu;
        let send = |band: &Band| {
            let layers = band.program.send_layers(gpu, &mut encoder)?;
            let picture = has_picture.then(|| band.program.send_picture(gpu, &mut encoder));
            Ok((layers, picture.transpose()?))
        };
        let sent = slot.bands.iter().map(send).collect::<Result<Vec<_>>>()?;
        gpu.queue().submit([encoder.finish()]);
        let size_px = slot.size_px;
        let in_a_row = size_px[0] as usize;
        let (mut pixels, mut picture) = (Vec::new(), Vec::new());
        for (band, (layers, pictured)) in slot.bands.iter().zip(sent) {
            pixels.extend(band.rows.own(&layers.layers(gpu).await?, in_a_row));
            if let Some(pictured) = pictured {
                let drawn = pictured.picture(gpu).await?;
                picture.extend(band.rows.own(&drawn, in_a_row * 4));
            }
        }
        Ok((Layers { size_px, pixels }, picture))
    }
}
