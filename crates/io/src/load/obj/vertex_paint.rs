//! OBJ colours: `vt`, the texture indices of faces, and vertex colours, which scanners write after the coordinates of `v`.

use cutaway::scene::VertexPaint;
use glam::{Vec2, Vec3};

use crate::load::painted::{Paint, PaintedTriangle, vertex_paint};

/// Marks a missing index.
const NONE: u32 = u32::MAX;

/// Paint data of a file, or of a share of its lines.
#[derive(Debug, Default)]
pub(super) struct ObjVertexPaint {
    /// Texture coordinates, where (0, 0) is the upper left corner of the image.
    pub(super) places: Vec<Vec2>,
    /// For each corner of a triangle, its index into the places of the file. Empty until a triangle has one.
    place_of_corner: Vec<[u32; 3]>,
    /// Colour of each vertex. Empty until a vertex has a colour.
    colors: Vec<Option<Vec3>>,
    /// Largest channel value of all colours.
    greatest: f32,
}

impl ObjVertexPaint {
    /// Adds a `vt`. A coordinate that cannot be parsed becomes 0, because it affects only the paint.
    pub(super) fn place(&mut self, rest: &str) {
        let mut numbers = rest.split_ascii_whitespace().map(|word| word.parse().ok());
        let mut next = || numbers.next().flatten().filter(|n: &f32| n.is_finite());
        let (u, v) = (next().unwrap_or(0.0), next().unwrap_or(0.0));
        // V points up in the file, but down in rows of texels.
        self.places.push(Vec2::new(u, 1.0 - v));
    }

    /// Adds the colour of the vertex with this index, if three numbers follow its coordinates.
    pub(super) fn color(&mut self, vertex: usize, rest: &str) {
        let mut words = rest.split_ascii_whitespace().skip(3);
        let mut next = || words.next()?.parse::<f32>().ok();
        let Some((r, g, b)) = (|| Some((next()?, next()?, next()?)))() else {
            return;
        };
        // Four numbers are no colour.
        if next().is_some() {
            return;
        }
        let color = Some(Vec3::new(r, g, b)).filter(|c| c.is_finite());
        self.colors.resize(vertex + 1, None);
        self.colors[vertex] = color;
        self.greatest = self.greatest.max(color.unwrap_or_default().max_element());
    }

    /// Adds the corners of the triangle with this index, with the texture indices of its face.
    pub(super) fn corners(&mut self, triangle: usize, places: [Option<u32>; 3]) {
        if places != [None; 3] || !self.place_of_corner.is_empty() {
            self.place_of_corner.resize(triangle, [NONE; 3]);
            let places = places.map(|place| place.unwrap_or(NONE));
            self.place_of_corner.push(places);
        }
    }

    /// Adds the paint of the next share, which follows so many vertices and triangles.
    pub(super) fn append(&mut self, next: Self, vertices: usize, triangles: usize) {
        self.places.extend(next.places);
        if !next.place_of_corner.is_empty() {
            self.place_of_corner.resize(triangles, [NONE; 3]);
            self.place_of_corner.extend(next.place_of_corner);
        }
        if !next.colors.is_empty() {
            self.colors.resize(vertices, None);
            self.colors.extend(next.colors);
        }
        self.greatest = self.greatest.max(next.greatest);
    }

    /// Builds the vertex paint of the triangles of these groups.
    pub(super) fn finish(
        &self,
        triangles: &[[u32; 3]],
        group_of_triangle: &[u32],
        paints: &[Paint],
    ) -> Option<VertexPaint> {
        // The greatest channel shows whether a program writes 0 to 255 instead of 0 to 1.
        let most = if self.greatest > 1.0 { 255.0 } else { 1.0 };
        let painted = triangles.iter().zip(group_of_triangle).enumerate();
        let painted = painted.map(|(index, (triangle, group))| {
            let corners = self.place_of_corner.get(index).unwrap_or(&[NONE; 3]);
            let place = |i: u32| self.places.get(i as usize).copied();
            let color = |i: u32| {
                let color = self.colors.get(i as usize).copied().flatten()?;
                Some((color / most).clamp(Vec3::ZERO, Vec3::ONE))
            };
            PaintedTriangle {
                group: *group,
                uv: all(corners.map(place)),
                colors: all(triangle.map(color)),
            }
        });
        vertex_paint(paints, !self.colors.is_empty(), painted)
    }
}

/// Returns all three values, if none is missing.
fn all<T>([a, b, c]: [Option<T>; 3]) -> Option<[T; 3]> {
    Some([a?, b?, c?])
}
