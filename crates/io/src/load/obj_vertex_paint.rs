//! OBJ colours: `vt`, the texture indices of faces, and vertex colours, which scanners write after the coordinates of `v`.

use cutaway::scene::VertexPaint;
use glam::{Vec2, Vec3};

use super::painted::{Paint, PaintedTriangle, vertex_paint};

/// Marks a missing index.
const NONE: u32 = u32::MAX;

/// Paint data read so far.
#[derive(Debug, Default)]
pub(super) struct ObjVertexPaint {
    /// Texture coordinates, where (0, 0) is the upper left corner of the image.
    pub(super) places: Vec<Vec2>,
    /// For each corner, its index into `places`. Resolved at the end, because a face may precede its texture coordinates.
    place_of_corner: Vec<[u32; 3]>,
    /// Colour of each vertex. Empty until a vertex has a colour.
    colors: Vec<Option<Vec3>>,
    /// Largest channel value of all colours. It shows whether a program writes 0 to 255 instead of 0 to 1.
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
        let numbers: Vec<f32> = (rest.split_ascii_whitespace().skip(3))
            .map_while(|word| word.parse().ok())
            .collect();
        if let [r, g, b] = numbers[..] {
            let color = Some(Vec3::new(r, g, b)).filter(|c| c.is_finite());
            self.colors.resize(vertex + 1, None);
            self.colors[vertex] = color;
            self.greatest = self.greatest.max(color.unwrap_or_default().max_element());
        }
    }

    /// Adds the corners of a triangle, with the texture indices of its face.
    pub(super) fn corners(&mut self, places: [Option<u32>; 3]) {
        self.place_of_corner
            .push(places.map(|place| place.unwrap_or(NONE)));
    }

    /// Builds the vertex paint of the triangles of these groups.
    pub(super) fn finish(
        &self,
        triangles: &[[u32; 3]],
        group_of_triangle: &[u32],
        paints: &[Paint],
    ) -> Option<VertexPaint> {
        let most = if self.greatest > 1.0 { 255.0 } else { 1.0 };
        let painted = (triangles.iter().zip(group_of_triangle)).zip(&self.place_of_corner);
        let painted = painted.map(|((triangle, group), corners)| {
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
        vertex_paint(paints, &painted.collect::<Vec<_>>())
    }
}

/// Returns all three values, if none is missing.
fn all<T>([a, b, c]: [Option<T>; 3]) -> Option<[T; 3]> {
    Some([a?, b?, c?])
}
