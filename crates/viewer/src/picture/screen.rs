//! Draws the slots' pictures into textures for egui. The session uses egui's own device and encoder, without waiting
//! and without readback.
//!
//! The layers of a slot drawn on the CPU come from the [judge](crate::judge), and are shaded here. Two slots with the same method share one
//! picture. The queue reports when a frame is done; until then no other frame is drawn, so that frames do not queue up on a slow device.
//!
//! While nothing moves, more [samples](Sample) of the picture are drawn. When all are complete, they are combined to smooth its edges.
//!
//! Cannot: show a picture larger than the device's maximum texture size.

mod difference;
mod picture;
mod samples;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use cutaway::gpu::{ClockSet, Gpu, Pick};
use cutaway::layers::Layer;
use cutaway::scene::View;
use cutaway::session::Encoded;
use cutaway::strategies::Method;
use cutaway::{Layers, Result, Session};
use cutaway_lab::experiment::{Renderer, Stopwatch};
use eframe::egui::{TextureId, TextureOptions};
use egui_wgpu::{RenderState, wgpu};
use image::RgbaImage;

use crate::judge::Subject;
use crate::picture::pace::Detail;
use crate::picture::readback;
use crate::picture::shown::Shown;
use crate::picture::slot::SlotSide;
use difference::Difference;
use picture::ShownTexture;
pub use samples::Sample;
use samples::SlotSamples;

/// A frame that the device has not completed yet.
struct PendingFrame {
    divisor: u32,
    /// Time of the frame in milliseconds, as the bits of a float; 0 until the frame is done.
    took: Arc<AtomicU64>,
}

/// The pictures of the slots.
pub struct Screen {
    session: Session,
    host: RenderState,
    pictures: BTreeMap<SlotSide, ShownTexture>,
    /// Renderer of each picture.
    painted_by: [Option<Renderer>; 2],
    difference: Difference,
    samples: SlotSamples,
    /// View of the last frame drawn by a method.
    view: Option<View>,
    under_way: Option<PendingFrame>,
    /// The requested pixel, and its pending readback.
    pick: Option<([u32; 2], Pick)>,
    /// Reason why a slot shows nothing.
    refusals: [Option<String>; 2],
    took_ms: Option<f64>,
    passes: usize,
    /// The clocks on which passes ran in each slot's last full-resolution frame.
    clocks: [Option<ClockSet>; 2],
}

impl Screen {
    /// Creates the pictures on the device that egui draws with.
    ///
    /// # Errors
    ///
    /// The device does not support core WebGPU.
    pub fn on(host: &RenderState) -> Result<Self> {
        let info = host.adapter.get_info();
        let gpu = Gpu::from_device(&info, host.device.clone(), host.queue.clone())?;
        Ok(Self {
            session: Session::new(gpu),
            host: host.clone(),
            pictures: BTreeMap::new(),
            painted_by: [None; 2],
            difference: Difference::new(&host.device),
            samples: SlotSamples::new(&host.device),
            view: None,
            under_way: None,
            pick: None,
            refusals: [None, None],
            took_ms: None,
            passes: 0,
            clocks: [None; 2],
        })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        self.session.gpu()
    }

    /// Time of the last frame in milliseconds, from its submission until it was done.
    pub fn took_ms(&self) -> Option<f64> {
        self.took_ms
    }

    /// Number of passes of the last frame.
    pub fn passes(&self) -> usize {
        self.passes
    }

    /// The clocks on which passes ran in the slot's last full-resolution frame; `None` unless a method draws the slot.
    pub fn clocks(&self, side: SlotSide) -> Option<ClockSet> {
        self.clocks[side.index()]
    }

    /// Reason why a slot shows nothing.
    pub fn refusal(&self, side: SlotSide) -> Option<&str> {
        self.refusals[side.index()].as_deref()
    }

    /// The picture of a slot.
    pub fn picture(&self, side: SlotSide) -> Option<TextureId> {
        self.pictures.get(&side).map(|p| p.id)
    }

    /// Picture of the colour difference between the slots.
    pub fn difference(&self) -> Option<TextureId> {
        self.difference.id()
    }

    /// Polls the device. Returns the divisor and time in milliseconds of a finished frame, and true if a frame must be redrawn because
    /// a buffer was too small.
    ///
    /// # Errors
    ///
    /// A device that is lost.
    pub fn classify(&mut self) -> Result<(Option<(u32, f64)>, bool)> {
        let overflows = self.session.poll()?;
        let must_redraw = overflows.iter().any(|(_, overflow)| overflow.is_mended);
        let done = self.under_way.as_ref().and_then(|frame| {
            let took_ms = f64::from_bits(frame.took.load(Ordering::Acquire));
            (took_ms > 0.0).then_some((frame.divisor, took_ms))
        });
        if let Some((_, took_ms)) = done {
            self.under_way = None;
            self.took_ms = Some(took_ms);
        }
        Ok((done, must_redraw))
    }

    /// Returns true while a frame is in progress.
    pub fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }

    /// View of the last frame drawn by a method, which was a picture or one of its samples.
    pub fn view(&self) -> Option<&View> {
        self.view.as_ref()
    }

    /// Draws the slots that have methods, at a given detail. After the last sample, all samples are combined.
    ///
    /// # Errors
    ///
    /// A device that fails.
    pub fn draw(
        &mut self,
        shown: &Shown,
        renderers: [Option<Renderer>; 2],
        size_px: [u32; 2],
        detail: Detail,
        wants_difference: bool,
    ) -> Result<()> {
        let divisor = detail.divisor();
        let size_px = size_px.map(|s| (s / divisor).max(1));
        let sample = detail.sample();
        let view = match sample {
            None => shown.view(size_px),
            Some(sample) => sample.of(&shown.view(size_px)),
        };
        self.view = Some(view);
        let mut encoder =
            (self.host.device).create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.passes = 0;
        let mut drawn: Option<(Method, SlotSide)> = None;
        for side in SlotSide::BOTH {
            let renderer = renderers[side.index()];
            let is_new = self.painted_by[side.index()] != renderer;
            let Some(Renderer::Method(method)) = renderer else {
                self.clocks[side.index()] = None;
                // The slot must not show the picture of its previous renderer.
                if is_new {
                    self.refusals[side.index()] = None;
                    if let Some(old) = self.pictures.remove(&side) {
                        old.free(&self.host);
                    }
                }
                continue;
            };
            self.refusals[side.index()] = None;
            self.painted_by[side.index()] = renderer;
            self.make_room(side, size_px);
            if let Some((_, other)) = drawn.filter(|(drawn, _)| *drawn == method) {
                self.copy(&mut encoder, other, side);
                self.refusals[side.index()] = self.refusals[other.index()].clone();
                self.clocks[side.index()] = self.clocks[other.index()];
                continue;
            }
            drawn = drawn.or(Some((method, side)));
            if let Some(sample) = sample {
                (self.samples).make_room(&self.host, side, size_px, sample.count());
            }
            let Some(picture) = self.pictures.get(&side) else {
                continue;
            };
            let target = match sample {
                None => Some(picture.target()),
                Some(sample) => self.samples.target(side, sample.index),
            };
            let Some(target) = target else {
                continue;
            };
            clear(&mut encoder, target.color);
            let encoded =
                (self.session).encode(&mut encoder, &shown.at.model, &view, method, &target);
            let encoded = encoded.inspect_err(|_| {
                // Dropping the encoder also drops the frames recorded in it.
                self.session.forget();
            })?;
            match encoded {
                Encoded::Drawn { passes } => {
                    self.passes += passes;
                    if detail == Detail::WHOLE {
                        self.clocks[side.index()] = self.session.clocks(method).ok();
                    }
                }
                Encoded::Refused(refusal) => {
                    self.refusals[side.index()] = Some(refusal.reason);
                }
            }
            if sample.is_some_and(Sample::is_last) {
                (self.samples).resolve(&self.host, &mut encoder, side, &picture.view);
            }
        }
        if wants_difference {
            self.subtract(&mut encoder, size_px);
        }
        self.submit(encoder, divisor);
        Ok(())
    }

    /// Shades layers that the judge computed, and shows them in a slot.
    ///
    /// # Errors
    ///
    /// A device that fails.
    pub fn put(
        &mut self,
        side: SlotSide,
        by: Renderer,
        subject: &Subject,
        layers: &Layers,
        wants_difference: bool,
    ) -> Result<()> {
        self.painted_by[side.index()] = Some(by);
        self.make_room(side, layers.size_px);
        self.refusals[side.index()] = None;
        let Some(picture) = self.pictures.get(&side) else {
            return Ok(());
        };
        let model = &subject.at.model;
        let view = (model.prepared).view_of(&subject.camera, layers.size_px);
        let mut encoder =
            (self.host.device).create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        clear(&mut encoder, &picture.view);
        let target = picture.target();
        (self.session).encode_layers(&mut encoder, model, &view, layers, &target)?;
        if wants_difference {
            self.subtract(&mut encoder, layers.size_px);
        }
        self.host.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Requests the layer of a pixel in a method's last full-resolution frame.
    ///
    /// # Errors
    ///
    /// The same errors as [`Session::pick`].
    pub fn pick(&mut self, method: Method, at_px: [u32; 2]) -> Result<()> {
        let mut encoder =
            (self.host.device).create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let pick = self.session.pick(&mut encoder, method, at_px)?;
        self.host.queue.submit([encoder.finish()]);
        self.pick = Some((at_px, pick));
        Ok(())
    }

    /// Returns true while a requested pixel is pending.
    pub fn is_picking(&self) -> bool {
        self.pick
            .as_ref()
            .is_some_and(|(_, pick)| pick.is_under_way())
    }

    /// The requested pixel and its layer, once it has arrived.
    pub fn picked(&mut self) -> Option<([u32; 2], Layer)> {
        let (at_px, pick) = self.pick.take_if(|(_, pick)| !pick.is_under_way())?;
        Some((at_px, pick.layer()?))
    }

    /// Reads a slot's pixels back, and waits for the device: for tests and files.
    ///
    /// # Errors
    ///
    /// A device that is lost.
    pub fn read(&self, side: SlotSide) -> Option<impl Future<Output = Result<RgbaImage>> + use<>> {
        let picture = self.pictures.get(&side)?;
        Some(readback::read(self.gpu(), &picture.texture))
    }

    /// Marks a slot as showing nothing, with the reason.
    pub fn refuse(&mut self, side: SlotSide, why: String) {
        self.refusals[side.index()] = Some(why);
    }

    /// Replaces a slot's texture if it does not have the requested size.
    fn make_room(&mut self, side: SlotSide, size_px: [u32; 2]) {
        let fits = |picture: &ShownTexture| picture.size_px() == size_px;
        if self.pictures.get(&side).is_some_and(fits) {
            return;
        }
        let made = ShownTexture::new(&self.host, size_px);
        if let Some(old) = self.pictures.insert(side, made) {
            old.free(&self.host);
        }
    }

    fn copy(&self, encoder: &mut wgpu::CommandEncoder, from: SlotSide, to: SlotSide) {
        if let (Some(from), Some(to)) = (self.pictures.get(&from), self.pictures.get(&to)) {
            encoder.copy_texture_to_texture(
                from.texture.as_image_copy(),
                to.texture.as_image_copy(),
                from.texture.size(),
            );
        }
    }

    fn subtract(&mut self, encoder: &mut wgpu::CommandEncoder, size_px: [u32; 2]) {
        let pictures = SlotSide::BOTH.map(|side| self.pictures.get(&side));
        (self.difference).encode(&self.host, encoder, pictures, size_px);
    }

    fn submit(&mut self, encoder: wgpu::CommandEncoder, divisor: u32) {
        let queue = &self.host.queue;
        let took = Arc::new(AtomicU64::new(0));
        let tell = took.clone();
        let watch = Stopwatch::start();
        queue.submit([encoder.finish()]);
        queue.on_submitted_work_done(move || {
            tell.store(watch.ms().max(1e-3).to_bits(), Ordering::Release);
        });
        self.under_way = Some(PendingFrame { divisor, took });
    }
}

/// Texture options for loaded images: nearest-neighbour filtering.
pub const PLAIN: TextureOptions = TextureOptions::NEAREST;

fn clear(encoder: &mut wgpu::CommandEncoder, view: &wgpu::TextureView) {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("clear"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..wgpu::RenderPassDescriptor::default()
    });
}
