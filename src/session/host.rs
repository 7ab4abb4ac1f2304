//! Session services for a host: frames in its encoder, pixel queries, and bindings for its own shaders.

use super::{Drawing, Encoded, Overflow, Session};
use crate::gpu::{BindGroup, ClockSet, CommandEncoder, Destination, GBuffer, Pick, Target};
use crate::passes::Model;
use crate::scene::View;
use crate::strategies::{self, Method};
use crate::{Error, Result};

impl Session {
    /// Encodes a frame into a host's encoder and attachments. Nothing is read back, nothing blocks and nothing is submitted; a frame of a
    /// static scene takes one pass. The host submits before it encodes another frame of the method.
    ///
    /// Overflows of bounded buffers become known some frames later, through [`Session::poll`]. Until then the affected pixels are marked.
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

    /// As [`Session::encode`], into attachments that the host's own lighting reads.
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

    /// As [`Session::encode`], but without attachments: the host draws surfaces itself, except what [`Session::clip_group`] removes and
    /// [hidden](crate::scene::PreparedPart::is_hidden) parts, and composites the caps with [`Session::encode`] and [`Target::caps_only`].
    /// Call [`Session::poll`] before this method or after the submission, because a poll may enlarge the lists.
    pub fn encode_passes(
        &mut self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
    ) -> Result<Encoded> {
        self.encode_into(encoder, model, view, method.into(), None)
    }

    /// Requests the layer of one pixel of the method's last encoded frame; (0, 0) is the upper left corner. The host submits the encoder;
    /// [`Session::poll`] detects when the result has arrived.
    ///
    /// # Errors
    ///
    /// No such frame, or a pixel outside it.
    pub fn pick(
        &self,
        encoder: &mut CommandEncoder,
        method: impl Into<Method>,
        at_px: [u32; 2],
    ) -> Result<Pick> {
        self.slot(method)?.pick(&self.gpu, encoder, at_px)
    }

    /// The clocks of the passes that ran for the method's last frame; a frame of a static scene that ran no pass is skipped.
    ///
    /// # Errors
    ///
    /// No such frame.
    pub fn clocks(&self, method: impl Into<Method>) -> Result<ClockSet> {
        Ok(self.slot(method)?.clocks)
    }

    /// The bind group for a host's shaders with [`clip_wgsl`](crate::gpu::clip_wgsl), of the last frame encoded by a method that lists
    /// crossings. Call it after each [`Session::encode_passes`]; it is rebuilt only when buffers are.
    ///
    /// # Errors
    ///
    /// No such frame, a frame so large that it is drawn in bands, or a method that keeps no list of crossings.
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
            // Passes that failed on the device have not run, so the next frame starts over.
            Err(error) => {
                self.slots.remove(&Drawing::By(method));
                Err(error)
            }
        }
    }

    /// Reads the device's reports on encoded frames, without waiting, and returns overflows with their methods. If
    /// [`is_mended`](Overflow::is_mended) is true, encode the frame again.
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
