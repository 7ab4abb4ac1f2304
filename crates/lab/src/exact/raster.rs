//! All crossings of all samples with all triangles, band by band.
//!
//! A band is [`BAND_ROWS`] rows of pixels. Triangles are sorted into bands once; the crossings of a band are listed by pixel
//! and dropped after use, so memory holds the triangles, and the crossings of one band per thread. Within a row, the three
//! edge functions bound the columns to test, with a margin above their rounding error; [`EdgeFunction::side`] decides each sample.
//!
//! Rays also cross the triangles behind the eye, at negative depths: so a closed part has an even number of crossings in every
//! pixel, wherever the camera is.

use cutaway::scene::{Fill, PreparedPart, PreparedVolume, ShadingMesh, View};
use glam::{DVec2, Vec3};
use rayon::prelude::*;

use super::facet::Facet;
use super::screen::{Corner, EdgeFunction, facing};

/// Rows of pixels in a band.
pub(super) const BAND_ROWS: u32 = 8;

/// A part or a cutter, projected into the picture.
pub(super) struct Projected<'a> {
    /// Its vertices in scene space.
    pub(super) positions: &'a [Vec3],
    /// Corners of its triangles.
    pub(super) triangles: &'a [[u32; 3]],
    /// Fill rule of the mesh.
    pub(super) fill: Fill,
    /// Shading normals; a cutter that is not smooth has none.
    pub(super) shading: Option<&'a ShadingMesh>,
    /// Projected vertices.
    pub(super) corners: Vec<Corner>,
    /// [`facing`] of its triangles.
    pub(super) facing: Vec<i8>,
}

impl<'a> Projected<'a> {
    /// Projects a part; a part that a cut removes entirely has no triangles to cross.
    pub(super) fn of(view: &View, part: &'a PreparedPart) -> Self {
        let triangles = match part.is_removed {
            true => &[],
            false => part.triangles.as_slice(),
        };
        Self {
            fill: part.fill,
            shading: Some(&*part.shading),
            ..Self::of_mesh(view, &part.positions, triangles)
        }
    }

    /// Projects a cutter.
    pub(super) fn of_volume(view: &View, volume: &'a PreparedVolume) -> Self {
        Self {
            shading: volume.shading.as_deref(),
            ..Self::of_mesh(view, &volume.positions, volume.triangles())
        }
    }

    fn of_mesh(view: &View, positions: &'a [Vec3], triangles: &'a [[u32; 3]]) -> Self {
        let corners: Vec<Corner> = positions
            .par_iter()
            .map(|p| Corner::of(view, p.as_dvec3()))
            .collect();
        let facing = triangles
            .par_iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| &corners[i as usize]);
                facing(a, b, c)
            })
            .collect();
        Self {
            positions,
            triangles,
            fill: Fill::EvenOdd,
            shading: None,
            corners,
            facing,
        }
    }

    /// Projected corners of a triangle.
    pub(super) fn corners(&self, triangle: u32) -> [&Corner; 3] {
        self.triangles[triangle as usize].map(|i| &self.corners[i as usize])
    }

    /// The plane of a triangle.
    pub(super) fn facet(&self, triangle: u32) -> Facet {
        let points =
            self.triangles[triangle as usize].map(|i| self.positions[i as usize].as_dvec3());
        let depths = self.corners(triangle).map(|c| c.depth);
        Facet::of(points, depths)
    }
}

/// One crossing of a sample with a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// Number of the pixel in its band.
    pub(super) pixel: u32,
    /// Index of the triangle in its part.
    pub(super) triangle: u32,
    /// Depth, possibly before the near plane or behind the eye.
    pub(super) depth: f64,
    /// Rank of the part.
    pub(super) rank: u16,
    /// True if the triangle faces away from the eye.
    pub(super) back_face: bool,
    /// Order relative to clip-surface crossings at the same depth: -1 before them, 1 after them; 0 if the triangle lies in no clip-surface.
    pub(super) place: i8,
}

impl Crossing {
    /// Change of the winding number along the ray: 1 where the ray enters the mesh, -1 where it leaves.
    pub(super) fn step(&self) -> i8 {
        if self.back_face { -1 } else { 1 }
    }
}

/// Items sorted into bands of rows.
pub(super) struct Bands {
    starts: Vec<usize>,
    items: Vec<(u16, u32)>,
}

impl Bands {
    /// Sorts items `(rank, index)` into bands by the inclusive range of rows each touches.
    pub(super) fn of(height: u32, ranges: &[Vec<Option<[u32; 2]>>]) -> Self {
        let count = height.div_ceil(BAND_ROWS) as usize;
        let each = || {
            ranges.iter().enumerate().flat_map(|(rank, rows)| {
                rows.iter().enumerate().filter_map(move |(index, rows)| {
                    rows.map(|[lo, hi]| {
                        let bands = (lo / BAND_ROWS) as usize..=(hi / BAND_ROWS) as usize;
                        (rank as u16, index as u32, bands)
                    })
                })
            })
        };
        let mut starts = vec![0; count + 1];
        for (_, _, bands) in each() {
            for band in bands {
                starts[band + 1] += 1;
            }
        }
        for band in 0..count {
            starts[band + 1] += starts[band];
        }
        let mut next = starts.clone();
        let mut items = vec![(0, 0); starts[count]];
        for (rank, index, bands) in each() {
            for band in bands {
                items[next[band]] = (rank, index);
                next[band] += 1;
            }
        }
        Self { starts, items }
    }

    /// Items that touch a band.
    pub(super) fn items(&self, band: usize) -> &[(u16, u32)] {
        &self.items[self.starts[band]..self.starts[band + 1]]
    }
}

/// Inclusive range of pixels whose centres lie between two coordinates, extended by `slack` on both sides.
pub(super) fn centres(lo: f64, hi: f64, slack: f64, size: u32) -> Option<[u32; 2]> {
    let first = (lo - 0.5 - slack).ceil().max(0.0);
    let last = (hi - 0.5 + slack).floor().min(f64::from(size) - 1.0);
    (first <= last).then_some([first as u32, last as u32])
}

/// Margin in pixels: far more than the rounding of a projected vertex, far less than a pixel.
const SLACK_PX: f64 = 1e-6;

/// Per triangle of a part: the rows with samples that it may cover.
pub(super) fn rows_of(view: &View, projected: &Projected<'_>) -> Vec<Option<[u32; 2]>> {
    let [width, height] = view.size_px;
    (0..projected.triangles.len() as u32)
        .into_par_iter()
        .map(|t| {
            if projected.facing[t as usize] == 0 {
                return None;
            }
            let corners = projected.corners(t);
            let before = corners.iter().filter(|c| c.at.z > 0.0).count();
            let behind = corners.iter().filter(|c| c.at.z < 0.0).count();
            if before < 3 && behind < 3 {
                return Some([0, height - 1]);
            }
            let p = corners.map(Corner::pixel);
            let (lo, hi) = (p[0].min(p[1]).min(p[2]), p[0].max(p[1]).max(p[2]));
            centres(lo.x, hi.x, SLACK_PX, width)?;
            centres(lo.y, hi.y, SLACK_PX, height)
        })
        .collect()
}

/// A band's crossings sorted by pixel, and the index of each pixel's first crossing, followed by the number of crossings.
pub(super) fn crossings_of_band(
    view: &View,
    parts: &[Projected<'_>],
    items: &[(u16, u32)],
    rows: [u32; 2],
) -> (Vec<Crossing>, Vec<usize>) {
    let mut found = Vec::new();
    for (rank, triangle) in items {
        cross_triangle(
            view,
            &parts[*rank as usize],
            (*rank, *triangle),
            rows,
            &mut found,
        );
    }
    let pixels = (rows[1] - rows[0]) as usize * view.size_px[0] as usize;
    sort_by_pixel(&found, pixels, |c| c.pixel)
}

/// Sorts stably by a small integer key.
pub(super) fn sort_by_pixel<T: Copy>(
    found: &[T],
    pixels: usize,
    pixel: impl Fn(&T) -> u32,
) -> (Vec<T>, Vec<usize>) {
    let mut starts = vec![0; pixels + 1];
    for one in found {
        starts[pixel(one) as usize + 1] += 1;
    }
    for i in 0..pixels {
        starts[i + 1] += starts[i];
    }
    let mut order = vec![0; found.len()];
    let mut next = starts.clone();
    for (i, one) in found.iter().enumerate() {
        let slot = &mut next[pixel(one) as usize];
        order[*slot] = i;
        *slot += 1;
    }
    (order.into_iter().map(|i| found[i]).collect(), starts)
}

fn cross_triangle(
    view: &View,
    part: &Projected<'_>,
    (rank, triangle): (u16, u32),
    [first_row, end_row]: [u32; 2],
    found: &mut Vec<Crossing>,
) {
    let [width, _] = view.size_px;
    let [a, b, c] = part.corners(triangle);
    let lines = [(b, c), (c, a), (a, b)].map(|(f, t)| EdgeFunction::through(f, t, view.size_px));
    let facing = part.facing[triangle as usize];
    let facet = part.facet(triangle);
    let weights = [a, b, c].map(|c| c.at.z);
    let mut rows = [first_row, end_row];
    if weights.iter().all(|w| *w > 0.0) || weights.iter().all(|w| *w < 0.0) {
        let y = [a, b, c].map(|c| c.pixel().y);
        let (lo, hi) = (y[0].min(y[1]).min(y[2]), y[0].max(y[1]).max(y[2]));
        let Some([lo, hi]) = centres(lo, hi, SLACK_PX, view.size_px[1]) else {
            return;
        };
        rows = [lo.max(first_row), (hi + 1).min(end_row)];
    }
    for (side, met) in [
        (1i8, weights.iter().any(|w| *w > 0.0)),
        (-1, weights.iter().any(|w| *w < 0.0)),
    ] {
        if !met {
            continue;
        }
        let wanted = facing * side;
        for row in rows[0]..rows[1] {
            let y = f64::from(row) + 0.5;
            let Some([lo, hi]) = columns(&lines, f64::from(wanted), y, width) else {
                continue;
            };
            for column in lo..=hi {
                let at = DVec2::new(f64::from(column) + 0.5, y);
                if lines.iter().all(|l| l.side(at) == wanted) {
                    let (origin, direction) = view.ray(at);
                    found.push(Crossing {
                        pixel: (row - first_row) * width + column,
                        triangle,
                        depth: facet.depth(origin, direction),
                        rank,
                        back_face: facing > 0,
                        place: 0,
                    });
                }
            }
        }
    }
}

/// Columns of a row that may lie in all three half-planes.
fn columns(lines: &[EdgeFunction; 3], wanted: f64, y: f64, width: u32) -> Option<[u32; 2]> {
    let (mut lo, mut hi) = (0.0f64, f64::from(width));
    for line in lines {
        let n = line.normal * wanted;
        let rest = n.y * y + n.z + line.error;
        if n.x > 0.0 {
            lo = lo.max(-rest / n.x);
        } else if n.x < 0.0 {
            hi = hi.min(-rest / n.x);
        } else if rest < 0.0 {
            return None;
        }
    }
    centres(lo, hi, SLACK_PX, width)
}
