//! The crossings of one ray as a list: why a pixel shows what it shows.
//!
//! Cost: all meshes are projected as for a whole picture, and the rays of one row are followed.

use cutaway::layers::Layer;
use cutaway::scene::{Prepared, View};
use glam::DVec2;

use super::clip::Ray;
use super::raster::{self, BAND_ROWS};
use super::ray_scratch::RayScratch;
use super::walk::{Cause, Event, RayState};
use super::winding::open_parts::OpenParts;
use super::{BandedScene, Outlining};

/// Object that a ray crosses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossed {
    /// The mesh of a part, by its index in the scene.
    Part(usize),
    /// A clip-surface, by its index in [`Prepared::surfaces`].
    ClipSurface(usize),
    /// The near plane, where it lies inside a solid.
    NearPlane,
}

/// A crossing of a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct RayCrossing {
    /// Distance from the eye along the viewing direction, in scene units.
    pub depth: f64,
    /// The crossed object.
    pub what: Crossed,
    /// True if the ray enters the mesh, or leaves the removed side of the clip-surface.
    pub enters: bool,
    /// Indices of the parts whose kept solid begins or ends here; empty if the crossing is removed or bounds no kept solid.
    pub bounds: Vec<usize>,
    /// True for the crossing that the pixel shows.
    pub is_seen: bool,
}

/// The ray of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Layer of the pixel, equal to that of [`evaluate`](super::evaluate).
    pub layer: Layer,
    /// Crossings beyond the near plane, in order: with the meshes of all parts and, near these crossings, with clip-surfaces.
    pub crossings: Vec<RayCrossing>,
}

impl Trace {
    /// The crossing that the pixel shows; none for the background.
    pub fn seen(&self) -> Option<&RayCrossing> {
        self.crossings.iter().find(|c| c.is_seen)
    }
}

/// Traces the ray through the centre of a pixel of a view. The scene must be whole: [`Prepared::must_be_whole`].
///
/// ```
/// use cutaway_lab::exact::{Crossed, trace};
/// use cutaway::scene::{ClipSurface, Cut, Prepared, Scene};
///
/// let mut scene = Scene { parts: cutaway::generate::shapes::shape("cube")?, ..Scene::default() };
/// let surface = ClipSurface::parse("x=50%", &scene.bounds())?;
/// scene.cuts.push(Cut::new("half", vec![surface]));
/// let prepared = Prepared::new(&scene);
/// let trace = trace(&prepared, &prepared.view([64, 48]), [32, 24]);
/// let seen = trace.seen().ok_or("the middle shows the cube")?;
/// assert_eq!(seen.depth, trace.layer.depth);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Panics
///
/// If the pixel lies beyond the view.
pub fn trace(prepared: &Prepared, view: &View, [x, y]: [u32; 2]) -> Trace {
    prepared.must_be_whole();
    let [width, height] = view.size_px;
    assert!(
        x < width && y < height,
        "pixel ({x}, {y}) of a picture of {width} x {height}"
    );
    let lines = BandedScene::with(prepared, view, OpenParts::of(prepared), Outlining::Without);
    let triangles = lines.triangles.items((y / BAND_ROWS) as usize);
    let (found, starts) = raster::crossings_of_band(view, &lines.parts, triangles, [y, y + 1]);
    let found = &found[starts[x as usize]..starts[x as usize + 1]];
    let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
    let mut bench = RayScratch::of(prepared, &lines.open_parts);
    let followed = lines.follow(at, &Ray::through(view, at), found, &[], &mut bench);
    let near_cap = followed.sight.filter(|sight| sight.event.is_none());
    let mut crossings = Vec::new();
    if let Some(sight) = near_cap {
        crossings.push(RayCrossing {
            depth: sight.depth,
            what: Crossed::NearPlane,
            enters: true,
            bounds: vec![prepared.parts[usize::from(sight.rank)].part],
            is_seen: true,
        });
    }
    let mut state = bench.start.clone();
    for events in bench.events.chunk_by(happen_at_once) {
        let before: Vec<bool> = shown(prepared, &bench.ranks, &state);
        events.iter().for_each(|event| state.apply(event));
        let after = shown(prepared, &bench.ranks, &state);
        let changed = (bench.ranks.iter().zip(before.iter().zip(&after)))
            .filter(|(_, (before, after))| before != after);
        let changed: Vec<usize> = changed.map(|(rank, _)| usize::from(*rank)).collect();
        for event in events.iter().filter(|event| event.depth > view.near) {
            let is_seen = followed.sight.and_then(|sight| sight.event);
            crossings.push(RayCrossing {
                is_seen: is_seen.is_some_and(|seen| is_same(&seen, event)),
                ..crossing(prepared, event, &changed)
            });
        }
    }
    Trace {
        layer: followed.layer,
        crossings,
    }
}

/// Returns true if two consecutive events are one step of the walk, as crossings of clip-surfaces at one depth are.
fn happen_at_once(a: &Event, b: &Event) -> bool {
    let is_clip = |e: &Event| matches!(e.cause, Cause::Clip { .. });
    a.depth == b.depth && is_clip(a) && is_clip(b)
}

fn is_same(a: &Event, b: &Event) -> bool {
    (a.cause, a.source) == (b.cause, b.source)
}

fn shown(prepared: &Prepared, ranks: &[u16], state: &RayState) -> Vec<bool> {
    let shows = |rank: &u16| state.is_inside(*rank) && !state.removes(prepared, *rank);
    ranks.iter().map(shows).collect()
}

/// Converts an event to a crossing. `changed` holds the ranks of the parts whose kept solid begins or ends at this step of the walk.
fn crossing(prepared: &Prepared, event: &Event, changed: &[usize]) -> RayCrossing {
    let part = |rank: usize| prepared.parts[rank].part;
    let (what, enters, bounds) = match event.cause {
        Cause::Mesh { rank, step } => (
            Crossed::Part(part(usize::from(rank))),
            step > 0,
            changed.iter().map(|rank| part(*rank)).collect(),
        ),
        Cause::Clip { surface, to_kept } => {
            let surface = usize::from(surface);
            let cut = prepared.surfaces[surface].cut;
            let is_cut = |rank: &&usize| prepared.parts[**rank].cuts.contains(&cut);
            (
                Crossed::ClipSurface(surface),
                to_kept,
                changed.iter().filter(is_cut).map(|r| part(*r)).collect(),
            )
        }
    };
    RayCrossing {
        depth: event.depth,
        what,
        enters,
        bounds,
        is_seen: false,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec3;

    use super::*;
    use crate::exact::evaluate;
    use cutaway::generate::shapes;
    use cutaway::layers::Kind;
    use cutaway::scene::{ClipSurface, Cut, OffsetMap, Scene};

    /// A shape whose nearer half is cut away along a wavy surface.
    fn prepared(shape: &str) -> Prepared {
        let mut scene = Scene {
            parts: shapes::shape(shape).unwrap(),
            ..Scene::default()
        };
        let bounds = scene.bounds();
        let waves = (0..64 * 64).map(|i| (f64::from(i) * 0.31).sin() as f32);
        let forward = Prepared::new(&scene).view([48, 36]).forward;
        let normal = forward + DVec3::new(0.2, 0.1, -0.1);
        let mut surface = ClipSurface::plane(bounds.centre(), normal);
        surface.relief = Some(Arc::new(OffsetMap::new([64, 64], waves.collect()).unwrap()));
        surface.scale.z = 0.02 * (bounds.max - bounds.min).length();
        scene.cuts.push(Cut::new("half", vec![surface]));
        Prepared::new(&scene)
    }

    #[test]
    fn what_is_seen_is_what_a_picture_shows() {
        for shape in ["cube", "crank", "gears"] {
            let prepared = prepared(shape);
            let view = prepared.view([48, 36]);
            let exact = evaluate(&prepared, &view);
            let mut caps = 0;
            for (x, y) in (0..48).flat_map(|x| (0..36).map(move |y| (x, y))) {
                let traced = trace(&prepared, &view, [x, y]);
                let layer = exact.layers.at(x, y);
                assert_eq!(traced.layer, *layer, "({x}, {y}) of {shape}");
                let seen = traced.seen();
                assert_eq!(seen.map_or(f64::INFINITY, |c| c.depth), layer.depth);
                let what = match layer.kind {
                    Kind::Background => None,
                    Kind::Surface => Some(Crossed::Part(usize::from(layer.part))),
                    Kind::Cap => Some(Crossed::ClipSurface(usize::from(layer.clip_surface))),
                };
                assert_eq!(seen.map(|c| c.what), what, "({x}, {y}) of {shape}");
                caps += usize::from(layer.kind == Kind::Cap);
            }
            assert!(caps > 50, "{caps} pixels of {shape} show a cap");
        }
    }

    #[test]
    fn what_is_left_begins_and_ends_in_turns() {
        let prepared = prepared("cube");
        let view = prepared.view([48, 36]);
        let mut removed = 0;
        for x in 0..48 {
            let crossings = trace(&prepared, &view, [x, 18]).crossings;
            assert!(crossings.is_sorted_by(|a, b| a.depth <= b.depth), "{x}");
            let bounds = crossings.iter().filter(|c| !c.bounds.is_empty());
            for (place, crossing) in bounds.enumerate() {
                assert_eq!(crossing.enters, place % 2 == 0, "{x}: {crossings:?}");
                assert_eq!(crossing.is_seen, place == 0, "{x}: {crossings:?}");
            }
            removed += crossings.iter().filter(|c| c.bounds.is_empty()).count();
        }
        assert!(removed > 10, "a half is gone: {removed}");
    }
}
