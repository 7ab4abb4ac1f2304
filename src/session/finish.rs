//! Pictures of external layers, and measurements of a style's effects over them.

use super::strips::MOST_STRIPS_OF_FRAME;
use super::{Rows, Session};
use crate::effects;
use crate::gpu::{ClockSet, CommandEncoder, Destination, Program, Target, words_from_layers};
use crate::layers::Layers;
use crate::passes::Model;
use crate::plan::{Capacities, Plan};
use crate::scene::View;
use crate::strategies::Refusal;
use crate::{Error, Result};

/// Bytes per pixel that layers and the effects over them take, about.
const EFFECT_BYTES: u64 = 128;

/// The effects of a style over layers as numbers per pixel, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StyleChannels {
    /// Fraction of the pixel that strokes cover; empty if the style has none.
    pub stroke: Vec<f32>,
    /// Fraction of the pixel that hatch lines cover, without their opacity; empty if the style has none, or no cap is visible.
    pub hatch: Vec<f32>,
    /// Position of the pixel on the hatched plane of its cap: distances to the right and up, in scene units; 0 where there is no hatch.
    pub cap_uv: Vec<[f32; 2]>,
    /// Fraction of light left after occlusion; empty if the style has none.
    pub visibility: Vec<f32>,
}

impl StyleChannels {
    fn append(&mut self, other: Self) {
        self.stroke.extend(other.stroke);
        self.hatch.extend(other.hatch);
        self.cap_uv.extend(other.cap_uv);
        self.visibility.extend(other.visibility);
    }
}

impl Session {
    /// Makes a picture from external layers, with the passes that make a strategy's picture; in bands if it exceeds the device's limits.
    pub fn shade(&mut self, model: &Model, view: &View, layers: &Layers) -> Result<Vec<u8>> {
        let width = layers.size_px[0] as usize;
        let pictures = self.in_bands(
            model,
            view,
            layers,
            self.most_bytes(),
            |session, band, view, layers| {
                let words = words_from_layers(layers);
                let program = session.run_once(effects::finish_of(model, view, &words))?;
                let picture = program.picture(&session.gpu)?;
                Ok(band.own(&picture, width * 4).to_vec())
            },
        );
        Ok(pictures?.concat())
    }

    /// Encodes the same picture for a host, into its encoder and its attachments, as [`Session::encode`] does for a method. Nothing is kept
    /// for the next frame.
    ///
    /// # Errors
    ///
    /// A target that the frame does not fit into, or layers that are too large for the device.
    pub fn encode_layers(
        &self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        layers: &Layers,
        target: &Target<'_>,
    ) -> Result<()> {
        let target = Destination::from(target);
        target.must_hold(view.size_px)?;
        let (width, scale) = (view.size_px[0], model.prepared.scale);
        self.gpu.scoped(|| {
            // The bands of a host's frame stay until it is submitted: more of them take more memory.
            self.in_bands(
                model,
                view,
                layers,
                u64::MAX,
                |session, band, view, layers| {
                    let gpu = &session.gpu;
                    let program = session.finished(encoder, model, view, layers)?;
                    let rows = (band.drawn(), (band.first, band.count));
                    let mut compositor = program.compositor(gpu, &target)?;
                    compositor.encode(gpu, encoder, &target, rows, width, scale);
                    Ok(())
                },
            )
        })?;
        Ok(())
    }

    /// Encodes the passes that make a picture from layers.
    pub(super) fn finished(
        &self,
        encoder: &mut CommandEncoder,
        model: &Model,
        view: &View,
        layers: &Layers,
    ) -> Result<Program> {
        let plan = effects::finish_of(model, view, &words_from_layers(layers));
        let mut program = Program::default();
        program.load(&self.gpu, plan.map_err(|r| Error::Plan(r.reason))?)?;
        program.encode_due(&self.gpu, encoder)?;
        Ok(program)
    }

    /// Measures the effects of a scene's style over layers, per pixel, so that tests can check a picture.
    pub fn style_channels(
        &mut self,
        model: &Model,
        view: &View,
        layers: &Layers,
    ) -> Result<StyleChannels> {
        let width = layers.size_px[0] as usize;
        let bands = self.in_bands(
            model,
            view,
            layers,
            self.most_bytes(),
            |session, band, view, layers| {
                let words = words_from_layers(layers);
                let program = session.run_once(effects::channels_of(model, view, &words))?;
                let read = |name: &str, in_a_pixel: usize| -> Result<Vec<f32>> {
                    if program.plan().resource_named(name).is_none() {
                        return Ok(Vec::new());
                    }
                    let words = program.words(&session.gpu, name)?;
                    let values: Vec<f32> = words.into_iter().map(f32::from_bits).collect();
                    Ok(band.own(&values, width * in_a_pixel).to_vec())
                };
                let hatched = read(effects::HATCH, 4)?;
                let pixels = || hatched.as_chunks::<4>().0.iter();
                Ok(StyleChannels {
                    stroke: read(effects::STROKE, 1)?,
                    hatch: pixels().map(|p| p[0]).collect(),
                    cap_uv: pixels().map(|p| [p[1], p[2]]).collect(),
                    visibility: read(effects::VISIBILITY, 1)?,
                })
            },
        )?;
        let mut all = StyleChannels::default();
        bands.into_iter().for_each(|band| all.append(band));
        Ok(all)
    }

    /// Bytes that the layers of a band and the effects over them may take.
    pub(super) fn most_bytes(&self) -> u64 {
        self.strip_bytes.saturating_mul(MOST_STRIPS_OF_FRAME)
    }

    /// Applies a function to bands of layers, with as few bands as the bytes and the device's limits permit.
    pub(super) fn in_bands<T>(
        &self,
        model: &Model,
        view: &View,
        layers: &Layers,
        most_bytes: u64,
        mut finish: impl FnMut(&Self, &Rows, &View, &Layers) -> Result<T>,
    ) -> Result<Vec<T>> {
        let [width, rows] = layers.size_px;
        let halo = effects::halo_rows(model, view);
        let most_rows = most_bytes / (EFFECT_BYTES * u64::from(width.max(1)));
        let own_rows = (u32::try_from(most_rows).unwrap_or(u32::MAX)).saturating_sub(2 * halo);
        let own_rows = own_rows.max(halo).max(Capacities::FEWEST_ROWS);
        let mut bands = match u64::from(rows) <= most_rows {
            true => 1,
            false => rows.div_ceil(own_rows),
        };
        loop {
            let all = Rows::bands(rows, bands, halo).map(|band| {
                let (first, count) = band.drawn();
                finish(self, &band, &band.view(view), &layers.rows(first, count))
            });
            match all.collect::<Result<Vec<_>>>() {
                Err(Error::Limit(_)) if rows / bands > Capacities::FEWEST_ROWS => bands *= 2,
                finished => return finished,
            }
        }
    }

    fn run_once(&self, plan: Result<Plan, Refusal>) -> Result<Program> {
        let plan = plan.map_err(|r| Error::Plan(r.reason))?;
        let mut program = Program::default();
        program.load(&self.gpu, plan)?;
        program.run(&self.gpu, ClockSet::ALL)?;
        Ok(program)
    }
}
