//! Pictures in strips: rows of a picture, drawn one after another as frames of their own, so that memory holds the buffers of one strip.
//!
//! A frame takes some 30 to 180 bytes per pixel on the device, which a large picture multiplies. The strips of a picture are views of equal
//! size with the same rays, so they use the same buffers, and the caller keeps what it needs of each: its rows of the picture or of the
//! layers. Bands (`bands.rs`) are rows too, but all of them stay on the device with buffers of their own, as a host's frame requires.
//!
//! Effects read the rows around a strip, which are drawn for it too. Where they read far, as occlusion by horizons does, strips of the layers
//! are drawn without effects, and the layers of the whole picture are then shaded in bands.
//!
//! Cost: the mesh is swept once per strip, and the rows around strips are drawn twice. Pixels match those of one frame, except where the
//! rounding of a rasteriser matters, or where the triangles of a cap depend on the view. Layers that are shaded later are kept on the CPU, 32
//! bytes per pixel.

use super::rows::Rows;
use super::{Drawn, Outcome, Session};
use crate::effects;
use crate::layers::Layers;
use crate::passes::Model;
use crate::plan::{Capacities, Clock};
use crate::scene::{Style, View};
use crate::strategies::{self, Method, Refusal};
use crate::{Error, Result};

/// Bytes of a frame's buffers above which a picture is drawn in strips, unless the scene takes more: then as many as the scene takes, because
/// every strip reads the whole mesh.
pub(super) const STRIP_BYTES: u64 = 160 << 20;
/// A picture whose effects read far is one frame up to so many times those bytes, if the device's limits permit.
pub(super) const MOST_STRIPS_OF_FRAME: u64 = 8;
/// Least height of a strip, as a multiple of the rows on each side that its effects read.
const LEAST_HALOS: u32 = 4;
/// Rows of the view whose plan is measured.
const MEASURED_ROWS: u32 = 1024;

/// Some rows of a picture, and the view that draws them.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// The view of the strip's rows, and of the rows around it that effects read.
    pub view: View,
    rows: Rows,
}

impl Strip {
    /// The whole picture.
    pub fn whole(view: &View) -> Self {
        let rows = Rows::whole(view.size_px[1]);
        Self { view: *view, rows }
    }

    /// The first row of the strip in the picture, and the number of its rows.
    pub fn rows(&self) -> [u32; 2] {
        [self.rows.first, self.rows.count]
    }

    /// The strip's own values among those of a frame of its view, with `per_pixel` values per pixel.
    pub fn own<'a, T>(&self, drawn: &'a [T], per_pixel: usize) -> &'a [T] {
        self.rows
            .own(drawn, self.view.size_px[0] as usize * per_pixel)
    }

    /// The strip's own rows of the layers of a frame of its view.
    #[must_use]
    pub fn own_layers(&self, drawn: Layers) -> Layers {
        match self.rows.drawn().1 == self.rows.count {
            true => drawn,
            false => drawn.rows(self.rows.above, self.rows.count),
        }
    }
}

impl Session {
    /// The strips in which a picture by a method is best drawn, from the top: one, unless the buffers of a frame are large. `None` if effects
    /// read too many rows around a strip: then [`Session::draw_layers`] draws the layers, and [`Session::shade`] the picture. Nothing is
    /// drawn here.
    pub fn strips(
        &self,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
    ) -> Option<Vec<Strip>> {
        let rows = view.size_px[1];
        let measured = view.rows(0, rows.min(MEASURED_ROWS));
        let method = self.asked(method.into());
        let plan = strategies::plan(model, &measured, method, &Capacities::UNKNOWN);
        // A refusal is reported by the frame.
        let Ok(plan) = plan else {
            return Some(vec![Strip::whole(view)]);
        };
        let of_scene: u64 = Clock::ALL.map(|c| plan.scene_bytes_on(c)).iter().sum();
        let most_bytes = self.strip_bytes.max(of_scene);
        let per_row = plan.bytes_on(Clock::Frame) / u64::from(measured.size_px[1].max(1));
        let within = |bytes: u64| u32::try_from(bytes / per_row.max(1)).unwrap_or(u32::MAX);
        let most = within(most_bytes);
        if rows <= most {
            return Some(vec![Strip::whole(view)]);
        }
        let halo = effects::halo_rows(model, view);
        let most_of_frame = within(most_bytes.saturating_mul(MOST_STRIPS_OF_FRAME));
        let least = (LEAST_HALOS + 2) * halo;
        // Higher strips than memory suggests are better than layers of the whole picture.
        let most = match least <= most_of_frame && u64::from(least) * 3 <= u64::from(rows) * 2 {
            true => most.max(least),
            false => most,
        };
        if most < least {
            let fits = || {
                let plan = strategies::plan(model, view, method, &Capacities::UNKNOWN);
                plan.is_ok_and(|plan| plan.check(self.gpu.limits()).is_ok())
            };
            return (rows <= most_of_frame && fits()).then(|| vec![Strip::whole(view)]);
        }
        let strips = Rows::strips(rows, most, halo);
        let strips = strips.map(|rows| Strip {
            view: rows.view(view),
            rows,
        });
        Some(strips.collect())
    }

    /// Draws the layers of a frame, strip by strip and without effects if the frame is large. Afterwards [`Session::layers`],
    /// [`Session::picture`], [`Session::bytes`] and [`Session::repeat`] are about the last strip alone.
    ///
    /// # Errors
    ///
    /// Those of [`Session::draw`].
    pub fn draw_layers(
        &mut self,
        model: &Model,
        view: &View,
        method: impl Into<Method>,
    ) -> Result<Result<(Drawn, Layers), Refusal>> {
        let method = method.into();
        let whole = || vec![Strip::whole(view)];
        let plain;
        let (model, strips) = match self.strips(model, view, method) {
            // A frame that may be followed by its picture keeps the passes of its style.
            Some(strips) if strips.len() == 1 => (model, strips),
            _ => {
                plain = model.in_style(Style::default());
                let strips = self.strips(&plain, view, method);
                (&plain, strips.unwrap_or_else(whole))
            }
        };
        let [width, height] = view.size_px;
        let mut pixels = Vec::new();
        let drawn = self.draw_strips(model, method, &strips, |session, strip| {
            let layers = strip.own_layers(session.layers(method)?).pixels;
            if pixels.is_empty() && layers.len() == width as usize * height as usize {
                pixels = layers;
            } else {
                pixels.reserve_exact(width as usize * height as usize - pixels.len());
                pixels.extend(layers);
            }
            Ok(())
        })?;
        let size_px = view.size_px;
        Ok(match drawn.outcome {
            Outcome::Refused(refusal) => Err(refusal),
            _ => Ok((drawn, Layers { size_px, pixels })),
        })
    }

    /// Draws the [strips](Session::strips) of a frame one after another. `each` gets every strip after its frame was drawn, while
    /// [`Session::picture`] and [`Session::layers`] return that frame. Stops at a refusal.
    ///
    /// # Errors
    ///
    /// Those of [`Session::draw`] and of `each`, and an error if there is no strip.
    pub fn draw_strips(
        &mut self,
        model: &Model,
        method: impl Into<Method>,
        strips: &[Strip],
        mut each: impl FnMut(&Self, &Strip) -> Result<()>,
    ) -> Result<Drawn> {
        let method = method.into();
        let mut all: Option<Drawn> = None;
        for strip in strips {
            let drawn = self.draw(model, &strip.view, method)?;
            let is_refused = matches!(drawn.outcome, Outcome::Refused(_));
            match &mut all {
                Some(all) => all.add(drawn),
                None => all = Some(drawn),
            }
            if is_refused {
                break;
            }
            each(self, strip)?;
        }
        all.ok_or_else(|| Error::Plan("a picture has no strip".into()))
    }
}

impl Drawn {
    /// Adds the result of other rows of the same frame: the first reason why it is not complete stays, but a refusal replaces it.
    pub fn add(&mut self, other: Self) {
        if self.outcome == Outcome::Complete || matches!(other.outcome, Outcome::Refused(_)) {
            self.outcome = other.outcome;
        }
        self.clocks = self.clocks.union(other.clocks);
        self.times.add(other.times);
    }
}
