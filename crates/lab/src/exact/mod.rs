//! The exact reference: what every pixel shows, in f64, from the definition alone.
//!
//! Along the ray through a pixel centre, the visible point is the first point beyond the near plane at which the ray enters what is kept
//! of a solid. The pixel shows a *surface* if the ray crosses the mesh there, and a *cap* if it leaves the removed region there. This
//! module lists every crossing of the ray with every triangle (`raster`) and with every clip-surface (`clip`, `relief`, `cutter`), walks
//! them in order (`follow`, `walk`), and marks answers that depend on differences below a picture's precision (`ambiguity`). [`trace`]
//! lists one pixel's crossings. With the strategies that it judges, this module shares no algorithm, only the scene, which includes
//! the detection of coplanar faces.
//!
//! The part's [`Fill`](cutaway::scene::Fill) decides what is *inside*. All crossings of the line count, also those behind the eye: the
//! crossings before the near plane decide whether the near plane is inside. In an open part, generalised winding numbers decide, which the
//! crossings and the holes make up together (`winding/open_parts`). Pixels where the line ends inside a part are listed ([`Exact::odd_parity`]):
//! methods that count crossings alone are unreliable there. An eye exactly on a mesh is neither inside nor outside, and its pixels
//! are marked.
//!
//! Cost: time and memory proportional to the crossings, plus one step per texel border near the relief between the first and the
//! last crossing of a ray. Rows are processed in bands, each with its own lists, on all threads.

mod ambiguity;
mod blocks;
mod classify;
mod clip;
mod cutter;
mod facet;
mod follow;
mod order;
mod outline;
mod quadratic;
mod raster;
mod ray_scratch;
mod relief;
mod screen;
mod shading;
mod table;
mod trace;
mod truth;
mod walk;
mod winding;

use cutaway::layers::{Kind, Layer, Layers};
use cutaway::scene::{Prepared, View};
use glam::DVec2;
use rayon::prelude::*;

use self::ambiguity::{Openness, RayCase};
use self::classify::PreclassifiedFaces;
use self::clip::{Ray, RayClipSurface};
use self::cutter::CutterMeshes;
use self::follow::Followed;
use self::outline::{Brush, SilhouetteEdge};
use self::raster::{BAND_ROWS, Bands, Crossing, Projected};
use self::ray_scratch::RayScratch;
use self::winding::open_parts::OpenParts;

pub use trace::{Crossed, RayCrossing, Trace, trace};
pub use truth::Truth;
pub use winding::Windings;

/// The right answer for every pixel of a view, rows from the top.
#[derive(Clone, Debug)]
pub struct Exact {
    /// Layer of each pixel.
    pub layers: Layers,
    /// True where sampling itself is ambiguous: within [`View::doubt_px`] of an outline, or two events too close to order.
    pub undecided: Vec<bool>,
    /// True where kind, part and clip-surface are decided but the depth is not, because it jumps within [`View::doubt_px`], as between two
    /// folds of a relief. False for undecided pixels.
    pub depth_open: Vec<bool>,
    /// True where it is open whether solids overlap at the cap, possibly because the cap's depth is open. False for undecided pixels.
    pub overlap_open: Vec<bool>,
    /// True where some part has an odd number of crossings along the line or, for the nonzero rule, crossings whose sum is not 0:
    /// the part is open there, or its faces are oriented inconsistently.
    pub odd_parity: Vec<bool>,
}

impl Exact {
    /// Number of pixels that do not show the background.
    pub fn covered_px(&self) -> usize {
        self.layers.pixels.len() - self.layers.count(Kind::Background)
    }

    /// Number of undecided pixels.
    pub fn undecided_px(&self) -> usize {
        self.undecided.iter().filter(|u| **u).count()
    }

    /// Number of pixels that show something and are decided.
    pub fn judged_px(&self) -> usize {
        let pixels = self.layers.pixels.iter().zip(&self.undecided);
        let is_judged =
            |(layer, undecided): &(&Layer, &bool)| layer.kind != Kind::Background && !**undecided;
        pixels.filter(is_judged).count()
    }

    /// Undecided pixels per covered pixel; 0 if no pixel is covered or undecided.
    pub fn undecided_share(&self) -> f64 {
        self.undecided_px() as f64 / (self.covered_px().max(1)) as f64
    }
}

/// Evaluates a scene for a view. The scene must be whole: [`Prepared::must_be_whole`].
pub fn evaluate(prepared: &Prepared, view: &View) -> Exact {
    prepared.must_be_whole();
    let [width, height] = view.size_px;
    let scene = BandedScene::with(prepared, view, OpenParts::of(prepared), Outlining::With);
    let mut exact = Exact {
        layers: Layers::background(view.size_px),
        undecided: vec![false; width as usize * height as usize],
        depth_open: vec![false; width as usize * height as usize],
        overlap_open: vec![false; width as usize * height as usize],
        odd_parity: vec![false; width as usize * height as usize],
    };
    let band_pixels = (width * BAND_ROWS) as usize;
    exact
        .layers
        .pixels
        .par_chunks_mut(band_pixels)
        .zip(exact.undecided.par_chunks_mut(band_pixels))
        .zip(exact.depth_open.par_chunks_mut(band_pixels))
        .zip(exact.overlap_open.par_chunks_mut(band_pixels))
        .zip(exact.odd_parity.par_chunks_mut(band_pixels))
        .enumerate()
        .for_each(
            |(band, ((((layers, undecided), depth_open), overlap), odd))| {
                scene.band(band, |pixel, answer| {
                    layers[pixel] = answer.layer;
                    undecided[pixel] = answer.open == Openness::All;
                    depth_open[pixel] = answer.open == Openness::Depth;
                    overlap[pixel] = matches!(answer.open, Openness::Depth | Openness::Overlap);
                    odd[pixel] = answer.is_odd;
                });
            },
        );
    exact
}

/// A scene sorted into bands of rows.
struct BandedScene<'a> {
    prepared: &'a Prepared,
    view: &'a View,
    /// Parts by rank, then cutters.
    parts: Vec<Projected<'a>>,
    cutters: CutterMeshes,
    /// Clips by number; those of cutters are unused.
    clips: Vec<RayClipSurface>,
    /// Preclassified faces of each part, by rank.
    preclassified: Vec<PreclassifiedFaces>,
    /// Planes shared by several parts, by number, as functions for the view's depth-buffer values; none for a plane seen edge-on.
    shared_in_view: Vec<Option<[f64; 3]>>,
    open_parts: OpenParts,
    triangles: Bands,
    outlines: Vec<Vec<SilhouetteEdge>>,
    outline_bands: Bands,
}

struct PixelResult {
    layer: Layer,
    is_odd: bool,
    open: Openness,
}

/// Selects whether outlines are built: they only mark where sampling is ambiguous.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outlining {
    With,
    Without,
}

impl<'a> BandedScene<'a> {
    fn with(
        prepared: &'a Prepared,
        view: &'a View,
        open_parts: OpenParts,
        outlining: Outlining,
    ) -> Self {
        let volumes = prepared.surfaces.iter().filter_map(|s| s.volume.as_deref());
        let solids = prepared.parts.iter().map(|p| Projected::of(view, p));
        let parts: Vec<Projected<'a>> = solids
            .chain(volumes.map(|v| Projected::of_volume(view, v)))
            .collect();
        let triangle_rows: Vec<_> = parts.iter().map(|p| raster::rows_of(view, p)).collect();
        let outlines: Vec<Vec<SilhouetteEdge>> = parts
            .par_iter()
            .enumerate()
            .filter(|_| outlining == Outlining::With)
            .map(|(rank, p)| outline::outlines(view, rank as u16, p))
            .collect();
        let outline_rows: Vec<Vec<_>> = outlines
            .iter()
            .map(|all| all.iter().map(|o| o.rows(view)).collect())
            .collect();
        let radius = prepared
            .bounds
            .corners()
            .map(|c| c.length())
            .into_iter()
            .fold(0.0, f64::max);
        Self {
            prepared,
            view,
            clips: prepared
                .surfaces
                .iter()
                .enumerate()
                .map(|(i, s)| RayClipSurface::of(i as u16, s, radius))
                .collect(),
            preclassified: (prepared.parts.par_iter().enumerate())
                .map(|part| PreclassifiedFaces::of(prepared, part))
                .collect(),
            shared_in_view: (prepared.shared.planes().iter())
                .map(|p| p.in_view(view))
                .collect(),
            triangles: Bands::of(view.size_px[1], &triangle_rows),
            outline_bands: Bands::of(view.size_px[1], &outline_rows),
            cutters: CutterMeshes::of(prepared),
            open_parts,
            parts,
            outlines,
        }
    }

    /// Passes on the result of each pixel of a band that is not plain background.
    fn band(&self, band: usize, mut answer: impl FnMut(usize, PixelResult)) {
        let [width, height] = self.view.size_px;
        let first_row = band as u32 * BAND_ROWS;
        let rows = [first_row, (first_row + BAND_ROWS).min(height)];
        let pixels = (rows[1] - rows[0]) as usize * width as usize;
        let (crossings, starts) =
            raster::crossings_of_band(self.view, &self.parts, self.triangles.items(band), rows);
        let mut brushes = Vec::new();
        for (rank, index) in self.outline_bands.items(band) {
            self.outlines[*rank as usize][*index as usize].brush(self.view, rows, &mut brushes);
        }
        let (brushes, brush_starts) = raster::sort_by_pixel(&brushes, pixels, |b| b.pixel);
        let mut bench = RayScratch::of(self.prepared, &self.open_parts);
        for pixel in 0..pixels {
            let crossings = &crossings[starts[pixel]..starts[pixel + 1]];
            let brushes = &brushes[brush_starts[pixel]..brush_starts[pixel + 1]];
            if crossings.is_empty() && brushes.is_empty() && self.open_parts.is_empty() {
                continue;
            }
            let at = DVec2::new(
                (pixel as u32 % width) as f64 + 0.5,
                f64::from(first_row + pixel as u32 / width) + 0.5,
            );
            answer(pixel, self.pixel(at, crossings, brushes, &mut bench));
        }
    }

    fn pixel(
        &self,
        at: DVec2,
        found: &[Crossing],
        brushes: &[Brush],
        bench: &mut RayScratch,
    ) -> PixelResult {
        let (brushes, cutter_brushes) = brushes.split_at(self.cutters.split(brushes, |b| b.rank));
        let ray = Ray::through(self.view, at);
        let Followed {
            layer,
            sight,
            is_odd,
            meets_something,
        } = self.follow(at, &ray, found, brushes, bench);
        let open = match meets_something {
            false => Openness::Nothing,
            true => {
                let case = RayCase {
                    prepared: self.prepared,
                    view: self.view,
                    parts: &self.parts,
                    ray,
                    ranks: &bench.ranks,
                    start: &bench.start,
                    events: &bench.events,
                    crossings: &bench.crossings,
                    roots: &bench.roots,
                    grazes: &bench.grazes,
                    brushes,
                    cutter_brushes,
                    cutters: &self.cutters,
                    sight,
                    preclassified: &bench.preclassified,
                    shared: &bench.shared,
                };
                case.openness(&mut bench.scratch)
            }
        };
        bench.clear();
        PixelResult {
            layer,
            is_odd,
            open,
        }
    }
}
