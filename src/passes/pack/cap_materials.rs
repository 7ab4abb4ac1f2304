//! Cap materials and surface vertex paints, packed for upload: all textures one after the other, and a row for each
//! part.
//!
//! Unchanged texture objects are packed only once. A bent part keeps the material of the unbent part: its solid texture follows the
//! part's placement, not its vertices.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::packed::{Packed, Room};
use super::vertex_paint::{self, VertexPaints};
use crate::plan::pack::{self, FILLED_STACK, NO_TEXTURE};
use crate::plan::{Contents, Piece};
use crate::scene::{Amount, Bounds, Part, Scene, SceneSpace, SolidTexture, Texture, TextureKind};

/// Size of repeating textures whose size is not given, in percent of the scene's diagonal.
const USUAL_SIZE: Amount = Amount::Percent(10.0);

/// The materials and vertex paints of a scene.
#[derive(Clone, Debug)]
pub(crate) struct CapMaterials {
    textures: Vec<Arc<Texture>>,
    table: Contents,
    texels: Contents,
    /// Materials by part number in the scene.
    materials: Vec<pack::CapMaterial>,
    /// True if some part has a material.
    has_materials: bool,
    /// Repeats per scene unit for textures whose size is not given.
    default_per_unit: f32,
    /// Vertex paints of surfaces.
    pub(crate) vertex_paints: Option<VertexPaints>,
}

impl CapMaterials {
    /// Materials of a scene with the given bounds, reusing unchanged textures; none if no part has a material or shows a vertex paint.
    pub(crate) fn of(
        scene: &Scene,
        space: &SceneSpace,
        (world, places): (&Bounds, (&[Packed], &[Room])),
        before: Option<&Arc<Self>>,
    ) -> Option<Arc<Self>> {
        let materials = scene
            .parts
            .iter()
            .filter_map(|part| part.material.cap.as_ref());
        let has_materials = materials.clone().next().is_some();
        let mut textures: Vec<Arc<Texture>> =
            (materials.flat_map(|m| m.textures().cloned())).collect();
        let vertex_paints = scene.style.surface.vertex_paint.then(|| {
            let known = before.and_then(|b| b.vertex_paints.as_ref());
            VertexPaints::of(scene, places, textures.len() as u32, known)
        });
        let vertex_paints = vertex_paints.flatten();
        if !has_materials && vertex_paints.is_none() {
            return None;
        }
        if vertex_paints.is_some() {
            let shown = scene.parts.iter().filter_map(vertex_paint::shown);
            textures.extend(shown.flat_map(|vertex_paint| vertex_paint.images.iter().cloned()));
        }
        let is_same = |before: &&Arc<Self>| {
            let pairs = before.textures.iter().zip(&textures);
            before.textures.len() == textures.len()
                && pairs.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
        };
        let [table, texels] = match before.filter(is_same) {
            Some(before) => [before.table.clone(), before.texels.clone()],
            None => packed(&textures),
        };
        let diagonal = world.size().length();
        let length = |size: Amount| size.between(0.0, diagonal);
        let mut first = 0;
        let rows = scene.parts.iter().map(|part| {
            let row = row_of(part, space, first, length);
            first += part
                .material
                .cap
                .as_ref()
                .map_or(0, |m| m.textures().count()) as u32;
            row
        });
        Some(Arc::new(Self {
            materials: rows.collect(),
            has_materials,
            vertex_paints,
            default_per_unit: (1.0 / (length(USUAL_SIZE) * space.scale)) as f32,
            textures,
            table,
            texels,
        }))
    }

    /// Returns true if some part has a material.
    pub(crate) fn has_materials(&self) -> bool {
        self.has_materials
    }

    /// Material of each part, indexed by part number in the scene.
    pub(crate) fn materials(&self) -> Contents {
        Contents::from_values(&self.materials)
    }

    /// Table of the textures' positions among the texels, followed by the texels.
    pub(crate) fn textures(&self) -> [Contents; 2] {
        [self.table.clone(), self.texels.clone()]
    }

    /// Repeats per scene unit for textures whose size is not given.
    pub(crate) fn default_per_unit(&self) -> f32 {
        self.default_per_unit
    }
}

/// Maximum number of texels in all textures: what one binding holds on any device. Larger images lack their largest mip levels.
const MOST_TEXELS_OF_TEXTURES: usize = 30 << 20;

/// Number of largest mip levels to leave out, the same for all textures.
fn left_out(textures: &[Arc<Texture>]) -> u32 {
    let count = |level: u32| {
        let all = textures.iter();
        all.map(|t| t.level_on(level).1.len()).sum::<usize>()
    };
    (0..14)
        .find(|level| count(*level) <= MOST_TEXELS_OF_TEXTURES)
        .unwrap_or(14)
}

/// Packs textures; a texture that several parts share is stored once.
fn packed(textures: &[Arc<Texture>]) -> [Contents; 2] {
    if textures.is_empty() {
        // WebGPU has no empty bindings.
        return [
            Contents::from_values(&[[0_u32; 4]]),
            Contents::from_values(&[0_u32]),
        ];
    }
    let mut different: Vec<Arc<Texture>> = Vec::new();
    let numbers = (textures.iter()).map(|t| Texture::number_among(&mut different, t));
    let numbers: Vec<usize> = numbers.collect();
    let level = left_out(&different);
    let (mut rows, mut pieces, mut count) = (Vec::new(), Vec::new(), 0_u64);
    for texture in &different {
        let (size, texels) = texture.level_on(level);
        rows.push(pack::Texture {
            first: count as u32,
            is_color: u32::from(texture.kind() == TextureKind::Color),
            size,
        });
        pieces.push(Piece::from_values(count * 4, texels));
        count += texels.len() as u64;
    }
    let rows: Vec<pack::Texture> = numbers.iter().map(|number| rows[*number]).collect();
    [
        Contents::from_values(&rows),
        Contents::in_pieces(count * 4, pieces, false),
    ]
}

/// Material row of a part whose textures begin at `first`.
fn row_of(
    part: &Part,
    space: &SceneSpace,
    first: u32,
    length: impl Fn(Amount) -> f64,
) -> pack::CapMaterial {
    let Some(material) = &part.material.cap else {
        return bytemuck::Zeroable::zeroed();
    };
    let mut next = first;
    let mut number_of = |image: &Option<Arc<Texture>>| match image {
        Some(_) => {
            next += 1;
            next - 1
        }
        None => NO_TEXTURE,
    };
    let [diffuse, normal, light] =
        [&material.diffuse, &material.normal, &material.light].map(&mut number_of);
    let (solid, image_count) = match &material.solid {
        None => (0, 0),
        Some(SolidTexture::Wood) => (1, 0),
        Some(SolidTexture::Marble) => (2, 0),
        Some(SolidTexture::Granite) => (3, 0),
        Some(SolidTexture::Stack(images)) if material.size.is_some() => (4, images.len() as u32),
        Some(SolidTexture::Stack(images)) => (FILLED_STACK, images.len() as u32),
    };
    let size = length(material.size.unwrap_or(USUAL_SIZE));
    let is_filled = image_count > 0 && material.size.is_none();
    let rows = solid_from_scene(part, space, (!is_filled).then_some(size)).transpose_rows();
    pack::CapMaterial {
        x_row: rows[0],
        y_row: rows[1],
        z_row: rows[2],
        diffuse,
        normal,
        light,
        solid,
        first_image: next,
        image_count,
        per_unit: material
            .size
            .map_or(0.0, |size| (1.0 / (length(size) * space.scale)) as f32),
        is_there: 1,
    }
}

/// Map from scene space to solid-texture coordinates. With a size: repeats of that size around the part's middle, the third axis along its
/// longest side. Without one: a single repeat that fills the part's box, with image rows downwards.
fn solid_from_scene(part: &Part, space: &SceneSpace, size: Option<f64>) -> DAffine3 {
    let part_from_scene = (space.from_world() * part.world_from_part).inverse();
    let bounds = part.mesh.bounds();
    let solid_from_part = match size {
        Some(size) => {
            // The size is in world units, however the part is scaled.
            let m = part.world_from_part.matrix3;
            let lengths = DVec3::from([0, 1, 2].map(|i| m.col(i).length()));
            let sides = (bounds.size() * lengths).to_array();
            let longest = (0..3).max_by(|a, b| sides[*a].total_cmp(&sides[*b]));
            let longest = longest.unwrap_or(2);
            let rows = DMat3::from_diagonal(lengths / size);
            let [x, y, z] = [longest + 1, longest + 2, longest].map(|i| rows.col(i % 3));
            let turned = DMat3::from_cols(x, y, z).transpose();
            DAffine3::from_mat3_translation(turned, -(turned * bounds.centre()))
        }
        None => {
            let sides = bounds.size().max(DVec3::splat(1e-300));
            let scale = DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0) / sides);
            let corner = DVec3::new(bounds.min.x, bounds.max.y, bounds.min.z);
            DAffine3::from_mat3_translation(scale, -(scale * corner))
        }
    };
    solid_from_part * part_from_scene
}

trait AffineRows {
    /// The rows that take a point (x, y, z, 1) to each coordinate.
    fn transpose_rows(&self) -> [[f32; 4]; 3];
}

impl AffineRows for DAffine3 {
    fn transpose_rows(&self) -> [[f32; 4]; 3] {
        [0, 1, 2].map(|i| {
            let row = self.matrix3.row(i).extend(self.translation[i]);
            row.as_vec4().to_array()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;

    #[test]
    fn the_longest_side_is_along_the_grain_and_boxes_are_filled() {
        let parts = shape("cube").expect("a shape");
        let mut part = parts[0].clone();
        part.world_from_part = DAffine3::from_scale(DVec3::new(1.0, 4.0, 1.0));
        let mut mesh = (*part.mesh).clone();
        mesh.positions.iter_mut().for_each(|p| p.y *= 3.0);
        part.mesh = Arc::new(mesh);
        let world = part.bounds_in_world();
        let space = SceneSpace::new(&world);
        let scene = |p: DVec3| space.point(p);
        let once = solid_from_scene(&part, &space, None);
        assert!(
            once.transform_point3(scene(world.max))
                .abs_diff_eq(DVec3::new(1.0, 0.0, 1.0), 1e-9)
        );
        assert!(
            once.transform_point3(scene(world.min))
                .abs_diff_eq(DVec3::new(0.0, 1.0, 0.0), 1e-9)
        );
        let grain = solid_from_scene(&part, &space, Some(0.5));
        let up = grain.transform_vector3(DVec3::Y * space.scale);
        assert!(up.z.abs() > 0.0 && up.truncate().length() < 1e-9, "{up}");
    }
}
