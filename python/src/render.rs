//! A picture and its layers, as `cutaway render` draws them: layers at the requested resolution, and the picture supersampled.

use cutaway::Session;
use cutaway::error::Diagnostic;
use cutaway::layers::{Kind, Layers};
use cutaway::scene::doubts;
use cutaway::session::Outcome;
use cutaway::strategies::{AUTO, Choice, choose};
use cutaway_lab::compare::may_be_wrong;
use cutaway_lab::experiment::{Renderer, draw_options, picture};
use image::RgbaImage;
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arrays::pixels;
use crate::device::with_session;
use crate::door::{Result, detached};
use crate::opened::{OpenedDocument, Purpose, shortfall, view};
use crate::scene::Scene;
use crate::state::CallSettings;

/// Default supersampling factor.
const USUAL_SUPERSAMPLE: u32 = 2;

/// A drawn frame.
struct RenderedFrame {
    rgba: Vec<u8>,
    size_px: [u32; 2],
    layers: Channels,
    strategy: String,
    /// Warnings for the user.
    doubts: Vec<String>,
    /// Names of the parts, by number.
    parts: Vec<String>,
    /// For each clip-surface, by number, the name of its cut.
    surfaces: Vec<String>,
}

/// One array per channel of the layers; depths are in units of the model.
#[derive(Default)]
struct Channels {
    kind: Vec<u8>,
    part: Vec<i32>,
    surface: Vec<i32>,
    depth: Vec<f32>,
    normal: Vec<f32>,
    unreliable: Vec<bool>,
    may_be_wrong: Vec<bool>,
    overlap: Vec<bool>,
}

impl Channels {
    /// Channels of layers whose depths are in units of `1 / scale`.
    fn of(layers: &Layers, may_be_wrong: Vec<bool>, scale: f64) -> Self {
        let mut channels = Self {
            may_be_wrong,
            ..Self::default()
        };
        for pixel in &layers.pixels {
            let or_none = |is_there, number| if is_there { number } else { -1 };
            let is_there = pixel.kind != Kind::Background;
            channels.kind.push(pixel.kind as u8);
            channels.part.push(or_none(is_there, i32::from(pixel.part)));
            let surface = i32::from(pixel.clip_surface);
            channels
                .surface
                .push(or_none(pixel.kind == Kind::Cap, surface));
            channels.depth.push((pixel.depth / scale) as f32);
            channels.normal.extend(pixel.normal.to_array());
            channels.unreliable.push(pixel.unreliable);
            channels.overlap.push(pixel.overlap);
        }
        channels
    }
}

/// Draws a scene.
pub(crate) fn render<'py>(
    scene: &Scene,
    py: Python<'py>,
    asked: CallSettings,
) -> PyResult<Bound<'py, PyDict>> {
    let scene = scene.shared();
    let drawn = detached(py, move || {
        let mut state = scene.state();
        let opened = state.open(asked, Purpose::Picture)?;
        with_session(|session| draw(session, opened))
    })?;
    let [width, height] = drawn.size_px;
    let [rows, columns] = [height as usize, width as usize];
    let result = PyDict::new(py);
    let rgba = drawn.rgba.into_pyarray(py).reshape([rows, columns, 4])?;
    result.set_item("rgba", rgba)?;
    let Channels {
        kind,
        part,
        surface,
        depth,
        normal,
        unreliable,
        may_be_wrong,
        overlap,
    } = drawn.layers;
    let layers = PyDict::new(py);
    layers.set_item("kind", pixels(py, drawn.size_px, kind)?)?;
    layers.set_item("part", pixels(py, drawn.size_px, part)?)?;
    layers.set_item("surface", pixels(py, drawn.size_px, surface)?)?;
    layers.set_item("depth", pixels(py, drawn.size_px, depth)?)?;
    let normal = normal.into_pyarray(py).reshape([rows, columns, 3])?;
    layers.set_item("normal", normal)?;
    layers.set_item("unreliable", pixels(py, drawn.size_px, unreliable)?)?;
    layers.set_item("may_be_wrong", pixels(py, drawn.size_px, may_be_wrong)?)?;
    layers.set_item("overlap", pixels(py, drawn.size_px, overlap)?)?;
    layers.set_item("parts", drawn.parts)?;
    layers.set_item("surfaces", drawn.surfaces)?;
    result.set_item("layers", layers)?;
    result.set_item("strategy", drawn.strategy)?;
    result.set_item("doubts", drawn.doubts)?;
    Ok(result)
}

fn draw(session: &mut Session, opened: &OpenedDocument) -> Result<RenderedFrame> {
    let OpenedDocument {
        timeline,
        scene,
        at,
        ..
    } = opened;
    let settings = timeline.settings();
    let view = view(opened)?;
    let options = draw_options(settings)?;
    let renderer = match settings.strategy.name.as_deref() {
        None | Some(AUTO) => {
            let adapter = Some(session.gpu().traits());
            let Choice { method, .. } = choose(&at.model, &view, options, adapter);
            Renderer::from(method)
        }
        Some(name) => name.parse::<Renderer>()?.or(options),
    };
    let (layers, outcome) = match renderer {
        Renderer::Method(method) => {
            let drawn = session.draw_layers(&at.model, &view, method)?;
            let (drawn, layers) = drawn.map_err(|r| picture::refused(renderer, &r))?;
            (layers, drawn.outcome)
        }
        Renderer::Cpu(evaluator) => {
            let evaluated = evaluator.evaluate(at.truth()?, &view);
            (evaluated.layers, Outcome::Complete)
        }
    };
    let prepared = &at.model.prepared;
    let doubted = may_be_wrong(&layers, prepared, &view);
    let doubted_px = doubted.iter().filter(|w| **w).count();
    let mut said: Vec<String> = doubts(scene).iter().map(Diagnostic::to_string).collect();
    said.extend(shortfall(&outcome));
    if let Some(open) = renderer.open_parts_in_words(&at.model) {
        said.push(format!(
            "{open}; {doubted_px} px may be wrong\n  help: close the holes; layers.may_be_wrong says which pixels they are"
        ));
    } else if doubted_px > 0 && outcome == Outcome::Complete {
        said.push(format!(
            "{doubted_px} px may be wrong: the mesh is open along their rays, so that a cap may be missing there or shown where there is \
             none\n  help: close the holes; layers.may_be_wrong says which pixels they are"
        ));
    }
    let fineness = settings.supersample.unwrap_or(USUAL_SUPERSAMPLE);
    let image = picture::draw(session, at, &view, renderer, fineness)?.image;
    let of_cut = |number: usize| prepared.cuts.get(number).map(|cut| cut.name.clone());
    Ok(RenderedFrame {
        size_px: view.size_px,
        rgba: image.into_raw(),
        layers: Channels::of(&layers, doubted, prepared.scale),
        strategy: renderer.to_string(),
        doubts: said,
        parts: scene.parts.iter().map(|part| part.name.clone()).collect(),
        surfaces: (prepared.surfaces.iter())
            .map(|surface| of_cut(surface.cut).unwrap_or_default())
            .collect(),
    })
}

/// Encodes an RGBA array of shape (height, width, 4) as PNG.
#[pyfunction]
pub(crate) fn png<'py>(
    py: Python<'py>,
    rgba: PyReadonlyArray3<'_, u8>,
) -> PyResult<Bound<'py, PyBytes>> {
    let array = rgba.as_array();
    let (height, width, channels) = array.dim();
    let raw: Vec<u8> = array.iter().copied().collect();
    let sizes = [width, height].map(u32::try_from);
    let image = match (channels, sizes) {
        (4, [Ok(width), Ok(height)]) if width > 0 && height > 0 => {
            RgbaImage::from_raw(width, height, raw)
        }
        _ => None,
    };
    let Some(image) = image else {
        return Err(PyValueError::new_err(format!(
            "picture of shape ({height}, {width}, {channels}): it must be (height, width, 4), and not empty\n  \
             help: give the array of a picture"
        )));
    };
    let bytes = detached(py, move || picture::png(&image))?;
    Ok(PyBytes::new(py, &bytes))
}
