//! Magnifies a pixel: its neighbourhood in each slot and in the reference, at one sample per pixel, and all crossings of its ray.
//!
//! Cost: one frame with full readback per slot, unless it was the last frame drawn; the reference at full resolution, unless it is kept;
//! and one projection of all meshes for the list of crossings.

use std::borrow::Cow;

use cutaway::Result;
use cutaway::layers::{Kind, Layer, NEAR_PLANE};
use cutaway::scene::Prepared;
use cutaway_lab::exact::{Crossed, Trace, trace};
use cutaway_lab::experiment::{Evaluator, Renderer};
use image::RgbaImage;

use super::Subject;
use super::context::{JudgeContext, picture};
use crate::picture::slot::SlotSide;

/// Width and height of a neighbourhood, in pixels; the queried pixel is in the middle.
pub const SIDE_PX: u32 = 15;

/// A question about a pixel.
#[derive(Clone, Debug)]
pub struct MagnifyQuestion {
    /// Id of the question, repeated in the answer.
    pub id: u64,
    /// The picture.
    pub subject: Subject,
    /// Renderers of the slots; `None` for a slot that is not visible.
    pub renderers: [Option<Renderer>; 2],
    /// The pixel, from the upper left corner of the picture.
    pub at_px: [u32; 2],
}

/// A pixel, magnified.
#[derive(Clone, Debug)]
pub struct Magnified {
    /// The pixel.
    pub at_px: [u32; 2],
    /// Neighbourhoods in the slots, then in the reference.
    pub neighbourhoods: Vec<Neighbourhood>,
    /// All crossings of the pixel's ray, in order.
    pub depths: Vec<DepthRow>,
    /// True if the reference cannot decide the pixel, so that no result counts as wrong.
    pub is_undecided: bool,
}

/// Neighbourhood of a pixel in one picture.
#[derive(Clone, Debug)]
pub struct Neighbourhood {
    /// The slot; `None` for the reference.
    pub side: Option<SlotSide>,
    /// Name of the renderer.
    pub name: String,
    /// [`SIDE_PX`] pixels along each side, transparent outside the picture; or the reason why there are none.
    pub picture: Result<RgbaImage, String>,
    /// Content of the pixel, in words.
    pub says: String,
}

/// A crossing of the ray.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthRow {
    /// Distance from the eye along the viewing direction, in units of the model.
    pub depth: f64,
    /// The part, cut or cutter that is crossed.
    pub what: String,
    /// Direction of the crossing, in words.
    pub way: Cow<'static, str>,
    /// True if the ray enters or leaves what the cuts keep of some part there.
    pub is_kept: bool,
    /// True for the crossing visible in the reference.
    pub is_seen: bool,
}

/// Answers a question.
pub(super) async fn answer(
    context: &mut JudgeContext,
    question: &MagnifyQuestion,
) -> Result<Magnified> {
    let (subject, [x, y]) = (&question.subject, question.at_px);
    let (truth, view) = (subject.at.truth()?, subject.view());
    let exact = context.exact(subject)?;
    let mut neighbourhoods = Vec::new();
    for side in SlotSide::BOTH {
        let Some(renderer) = question.renderers[side.index()] else {
            continue;
        };
        let seen = match renderer {
            Renderer::Cpu(Evaluator::Exact) => None,
            renderer => Some(shown_by(context, subject, renderer, question.at_px).await?),
        };
        let (picture, says) = match seen {
            None => continue,
            Some(Ok((picture, layer))) => (Ok(picture), words(&layer, truth)),
            Some(Err(reason)) => (Err(reason), String::new()),
        };
        neighbourhoods.push(Neighbourhood {
            side: Some(side),
            name: renderer.to_string(),
            picture,
            says,
        });
    }
    let whole = context.exact_picture(subject).await?;
    neighbourhoods.push(Neighbourhood {
        side: None,
        name: Renderer::EXACT.to_string(),
        picture: Ok(around(&whole, question.at_px)),
        says: words(exact.layers.at(x, y), truth),
    });
    Ok(Magnified {
        at_px: question.at_px,
        neighbourhoods,
        depths: depths(&trace(truth, &view, question.at_px), truth),
        is_undecided: exact.undecided[(y * view.size_px[0] + x) as usize],
    })
}

/// Neighbourhood and layer of a pixel as a renderer draws it; or the reason why the renderer draws nothing.
async fn shown_by(
    context: &mut JudgeContext,
    subject: &Subject,
    renderer: Renderer,
    at_px @ [x, y]: [u32; 2],
) -> Result<Result<(RgbaImage, Layer), String>> {
    let (model, view) = (&subject.at.model, subject.view());
    let (layers, rgba) = match renderer {
        Renderer::Method(method) => {
            let session = context.session().await?;
            match session.frame_async(model, &view, method).await? {
                Ok(frame) => frame,
                Err(refusal) => return Ok(Err(refusal.reason)),
            }
        }
        Renderer::Cpu(evaluator) => {
            let layers = evaluator.evaluate(subject.at.truth()?, &view).layers;
            let session = context.session().await?;
            let shaded = session.shade_async(model, &view, &layers).await?;
            (layers, shaded)
        }
    };
    let whole = picture(view.size_px, rgba);
    Ok(Ok((around(&whole, at_px), *layers.at(x, y))))
}

/// Neighbourhood of a pixel of a picture.
fn around(whole: &RgbaImage, [x, y]: [u32; 2]) -> RgbaImage {
    RgbaImage::from_fn(SIDE_PX, SIDE_PX, |i, j| {
        let at = [x + i, y + j].map(|c| c.checked_sub(SIDE_PX / 2));
        let pixel = match at {
            [Some(x), Some(y)] => whole.get_pixel_checked(x, y).copied(),
            _ => None,
        };
        pixel.unwrap_or(image::Rgba([0; 4]))
    })
}

/// Descriptions of a ray's crossings, in model units.
fn depths(trace: &Trace, prepared: &Prepared) -> Vec<DepthRow> {
    let row = |crossing: &cutaway_lab::exact::RayCrossing| {
        let (what, ways) = match crossing.what {
            Crossed::Part(part) => (part_name(part, prepared), ["enters", "leaves"]),
            Crossed::ClipSurface(surface) => {
                let ways = ["to the kept side", "to the removed side"];
                (surface_name(surface, prepared), ways)
            }
            Crossed::NearPlane => ("the near plane".to_owned(), ["enters", "leaves"]),
        };
        DepthRow {
            depth: crossing.depth / prepared.scale,
            what,
            way: ways[usize::from(!crossing.enters)].into(),
            is_kept: !crossing.bounds.is_empty(),
            is_seen: crossing.is_seen,
        }
    };
    trace.crossings.iter().map(row).collect()
}

/// Content of a pixel, in words.
fn words(layer: &Layer, prepared: &Prepared) -> String {
    let part = || part_name(usize::from(layer.part), prepared);
    let depth = layer.depth / prepared.scale;
    match layer.kind {
        Kind::Background => "background".to_owned(),
        Kind::Surface => format!("{}: surface, {depth:.4} away", part()),
        Kind::Cap => {
            let by = match layer.clip_surface {
                NEAR_PLANE => "the near plane".to_owned(),
                surface => surface_name(usize::from(surface), prepared),
            };
            format!("{}: cap by {by}, {depth:.4} away", part())
        }
    }
}

fn part_name(part: usize, prepared: &Prepared) -> String {
    let named = prepared.parts.iter().find(|p| p.part == part);
    named.map(|p| p.name.clone()).unwrap_or_default()
}

/// Name of the cut to which a clip-surface belongs, with the surface's number if the cut has several, or the cutter's name.
fn surface_name(surface: usize, prepared: &Prepared) -> String {
    let Some(placed) = prepared.surfaces.get(surface) else {
        return String::new();
    };
    let cut = &prepared.cuts[placed.cut];
    let name = &cut.name;
    let number = cut.surfaces.iter().position(|s| *s == surface);
    match (&placed.volume, number) {
        (Some(volume), _) => format!("cutter {} of cut {name}", volume.name),
        (None, Some(number)) if cut.surfaces.len() > 1 => {
            format!("clip-surface {number} of cut {name}")
        }
        _ => format!("cut {name}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::generate::shapes::shape;
    use cutaway::scene::{ClipSurface, Cut, Scene};

    #[test]
    fn the_pixel_is_in_the_middle_and_beyond_the_border_there_is_nothing() {
        let whole = RgbaImage::from_fn(40, 30, |x, y| image::Rgba([x as u8, y as u8, 7, 255]));
        for at in [[20, 15], [0, 0], [39, 29], [3, 28]] {
            let part = around(&whole, at);
            let middle = part.get_pixel(SIDE_PX / 2, SIDE_PX / 2);
            assert_eq!(middle.0, [at[0] as u8, at[1] as u8, 7, 255]);
            let is_there = part.pixels().filter(|p| p.0[3] == 255).count() as u32;
            let within = |c: u32, size: u32| (c + 8).min(size) - c.saturating_sub(7);
            assert_eq!(is_there, within(at[0], 40) * within(at[1], 30), "{at:?}");
        }
    }

    #[test]
    fn depths_are_told_in_units_of_the_model_and_by_the_names_of_the_scene() {
        let mut scene = Scene {
            parts: shape("cube").unwrap(),
            ..Scene::default()
        };
        let bounds = scene.bounds();
        let corner = ["x=50%", "y=50%"].map(|p| ClipSurface::parse(p, &bounds).unwrap());
        scene.cuts.push(Cut::new("corner", corner.to_vec()));
        let prepared = Prepared::new(&scene);
        let view = prepared.view([64, 48]);
        let rows = depths(&trace(&prepared, &view, [32, 24]), &prepared);
        assert_eq!(rows.iter().filter(|r| r.is_seen).count(), 1, "{rows:?}");
        assert!(rows.is_sorted_by(|a, b| a.depth <= b.depth), "{rows:?}");
        let size = (bounds.max - bounds.min).length();
        let [first, last] = [&rows[0], &rows[rows.len() - 1]];
        assert!(last.depth - first.depth < size, "{rows:?}");
        assert!(last.depth - first.depth > size * 0.3, "{rows:?}");
        let of_cut = |r: &DepthRow| r.what.contains("of cut corner");
        assert!(rows.iter().any(of_cut), "{rows:?}");
        let own = part_name(0, &prepared);
        assert_eq!((first.what.as_str(), &*first.way), (own.as_str(), "enters"));
    }
}
