//! Services of a session for a host: frames in its encoder, their pixels, and the bindings for its own shaders.

use super::{Drawing, Encoded, Overflow, Session};
use crate::gpu::{BindGroup, ClockSet, CommandEncoder, Destination, GBuffer, Pick, Target};
use crate::passes::Model;
use crate::scene::View;
use crate::strategies::{self, Method};
use crate::{Error, Result};

impl Session {
    /// Encodes a frame for a host, into its encoder and its attachments. Nothing is read back, nothing is waited for and nothing is
    /// submitted; a frame of a scene that stands still takes one pass. The host submits before it encodes another frame of the method.
    ///
    /// What a bounded buffer lacked is known some frames later: [`Session::poll`] says so. Until then the pixels concerned are marked.
    pub fn encode(
        &mut self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
        target: &Target<'_>,
    ) -> Result<Encoded> {
        let target = Destination::from(target);
        self.encode_into(encoder, model, view, method.into(), Some(&target))
    }

    /// As [`Session::encode`], into attachments that the host's own lights read.
    pub fn encode_g_buffer(
        &mut self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
        buffer: &GBuffer<'_>,
    ) -> Result<Encoded> {
        let target = Destination::from(buffer);
        self.encode_into(encoder, model, view, method.into(), Some(&target))
    }

    /// As [`Session::encode`], into no attachments yet: the host draws surfaces itself, less what [`Session::clip_group`] removes and
    /// less the parts that are [hidden](crate::scene::PreparedPart::is_hidden),
    /// and has the caps composed with them by [`Session::encode`] with [`Target::caps_only`]. Call [`Session::poll`] before this or
    /// after the submission, because it may request longer lists.
    pub fn encode_passes(
        &mut self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
    ) -> Result<Encoded> {
        self.encode_into(encoder, model, view, method.into(), None)
    }

    /// Asks what a pixel of the frame that was last encoded by a method shows, counted from its upper left corner. The host submits the
    /// encoder; [`Session::poll`] finds out when it is known.
    ///
    /// # Errors
    ///
    /// No such frame, or a pixel beyond it.
    pub fn pick(
        &self,
        encoder: &mut CommandEncoder,
        method: impl Into<Method>,
        at_px: [u32; 2],
    ) -> Result<Pick> {
        self.slot(method)?.pick(&self.gpu, encoder, at_px)
    }

    /// The clocks of the passes that the last frame by a method took; a frame that stands still takes none, and does not count.
    ///
    /// # Errors
    ///
    /// No such frame.
    pub fn clocks(&self, method: impl Into<Method>) -> Result<ClockSet> {
        Ok(self.slot(method)?.clocks)
    }

    /// The bind group for shaders of a host with [`clip_wgsl`](crate::gpu::clip_wgsl), of the frame that was last encoded by a method: of
    /// one that lists crossings. Call it after each [`Session::encode_passes`]; it is rebuilt only where buffers are.
    ///
    /// # Errors
    ///
    /// No such frame, one so large that it is drawn in bands, or a method that keeps no list of crossings.
    pub fn clip_group(&mut self, method: impl Into<Method>) -> Result<BindGroup> {
        let method = method.into();
        let none = || Error::Plan(format!("{method} has encoded no frame to clip by"));
        let slot = self.slots.get_mut(&Drawing::By(method)).ok_or_else(none)?;
        slot.clip_group(&self.gpu)
    }

    fn encode_into(
        &mut self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        method: Method,
        target: Option<&Destination<'_>>,
    ) -> Result<Encoded> {
        if let Some(target) = target {
            target.must_hold(view.size_px)?;
        }
        let asked = self.asked(method);
        let slot = self.slots.entry(Drawing::By(method)).or_default();
        let gpu = &self.gpu;
        let encoded = gpu.scoped(|| {
            slot.encode(gpu, encoder, (model, view), target, |view, capacities| {
                strategies::record(model, view, asked, capacities)
            })
        });
        match encoded {
            Ok(Encoded::Refused(mut refusal)) => {
                self.name_what_works(&mut refusal, model, view);
                Ok(Encoded::Refused(refusal))
            }
            Ok(drawn) => Ok(drawn),
            // Passes that failed on the device have not run: the next frame starts over.
            Err(error) => {
                self.slots.remove(&Drawing::By(method));
                Err(error)
            }
        }
    }

    /// Takes in what the device has reported of frames that were encoded, without waiting: what overflowed, by method. Where that is
    /// mended, the frame is to be encoded again.
    pub fn poll(&mut self) -> Result<Vec<(Method, Overflow)>> {
        self.gpu.poll()?;
        let mut overflows = Vec::new();
        for (drawing, slot) in &mut self.slots {
            let Drawing::By(method) = drawing else {
                continue;
            };
            overflows.extend(slot.classify().into_iter().map(|o| (*method, o)));
        }
        Ok(overflows)
    }
}
