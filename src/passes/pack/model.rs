//! A scene packed for upload: vertices, indices and heights do not change with the view or the strategy.
//!
//! A moving scene is packed once by [`Model::new`] and then updated frame by frame by [`Model::updated`], which processes only objects
//! whose identity has changed: its cost does not depend on the triangles of parts that keep their mesh.

use std::borrow::Cow;
use std::sync::Arc;

use rayon::prelude::*;

use super::cap_materials::CapMaterials;
use super::cutters::Cutters;
use super::ground::GroundShadow;
use super::heights::{Heights, PackedMap};
use super::packed::{self, Packed, Room};
use super::packed_closing::PackedClosing;
use super::packed_pose::{Moving, PackedPose};
use super::preclassified::PreclassifiedTriangles;
use super::relief_sky::ReliefSky;
use super::rest_pose::{Moved, RestPose};
use super::sliced::Sliced;
use super::vertex::MeshRange;
use crate::plan::Contents;
use crate::plan::pack::NO_RELIEF;
use crate::scene::memo::Memo;
use crate::scene::{
    Cutter, Part, Prepared, PreparedPart, PreparedVolume, Scene, SceneSpace, SharedPlanes, Style,
};

/// A scene ready for recording.
#[derive(Clone, Debug)]
pub struct Model {
    /// The scene in scene space, without the vertices of moving parts; [`Model::truth`] has all of them.
    pub prepared: Prepared,
    /// Vertices of all parts, with room for those written by the pose pass.
    pub vertices: Contents,
    /// Indices of all parts.
    pub indices: Contents,
    /// Range of each part, indexed by rank.
    pub ranges: Vec<MeshRange>,
    /// For each rank, the part as input of the pose pass; `None` if that pass does not place it.
    pub moving: Vec<Option<Moving>>,
    /// Heights of all reliefs, one after the other; parts that share a map share its texels.
    pub heights: Contents,
    /// First texel of each clip-surface, or [`NO_RELIEF`] for planes and flat reliefs.
    pub first_texel: Vec<u32>,
    pub cutters: Cutters,
    /// The maps that `heights` holds.
    maps: Vec<PackedMap>,
    /// The packed parts, indexed as in the scene.
    packed: Arc<Vec<Packed>>,
    rooms: Vec<Room>,
    /// Triangles whose sides of clip-surfaces are known in advance; `None` if there are none.
    pub(crate) preclassified: Option<PreclassifiedTriangles>,
    /// Grid indices, which belong to no scene but are requested in every frame.
    pub grid_indices: Arc<Memo<u32, Contents>>,
    /// Rest-pose inputs of its hatches.
    pub(crate) at_rest: Arc<RestPose>,
    /// Sky hidden by reliefs.
    pub(crate) relief_sky: Arc<ReliefSky>,
    /// Cap materials and surface vertex paints that are more than a single colour.
    pub(crate) cap_materials: Option<Arc<CapMaterials>>,
    /// The ground shadow, if there is one.
    pub(crate) ground: Option<Arc<GroundShadow>>,
    /// Motion of each part since the rest pose, indexed as in the scene.
    pub(crate) moved: Vec<Option<Moved>>,
    lineage: Arc<()>,
    /// Identity that this model shares only with its copies.
    identity: Arc<()>,
}

impl Model {
    /// Packs a scene.
    pub fn new(scene: &Scene) -> Self {
        Self::after(scene, None)
    }

    /// The scene at another time, sharing unchanged data with this model. Meshes, motions and maps are compared by
    /// identity, so an animated scene must keep the objects that do not change.
    #[must_use]
    pub fn updated(&self, scene: &Scene) -> Self {
        Self::after(scene, Some(self))
    }

    /// The scene as if seen for the first time, sharing data with this model: hatches then depend on the current positions of the scene's
    /// parts and eye.
    #[must_use]
    pub fn anew(&self, scene: &Scene) -> Self {
        let updated = self.updated(scene);
        let at_rest = Arc::new(self.at_rest.anew(scene, &updated.prepared));
        Self {
            moved: at_rest.moved(scene, &updated.prepared),
            at_rest,
            ..updated
        }
    }

    fn after(scene: &Scene, before: Option<&Self>) -> Self {
        let world = scene.bounds();
        let space = SceneSpace::new(&world);
        let old = before.map_or(&[] as &[Packed], |b| &b.packed);
        let packed: Vec<Packed> = (scene.parts.par_iter().enumerate())
            .map(|(index, part)| Packed::of(index, part, &space, old.get(index)))
            .collect();
        let place = |index: usize, part: &Part, _: &SceneSpace, cuts: Vec<usize>| PreparedPart {
            name: part.name.clone(),
            material: part.material.clone(),
            fill: part.fill,
            cuts,
            ..packed[index].part.clone()
        };
        let place_volume = |cutter: &Cutter, space: &SceneSpace, surface: usize| {
            let before = before.and_then(|b| b.prepared.surfaces.get(surface)?.volume.as_deref());
            Arc::new(PreparedVolume::place(cutter, space, before))
        };
        let shared =
            |parts: &[PreparedPart]| SharedPlanes::of(parts, before.map(|b| &b.prepared.shared));
        let prepared = Prepared::with_parts(scene, &world, place, place_volume, shared);

        let rooms = packed::rooms(&packed, before.map_or(&[], |b| &b.rooms));
        let changes =
            before.is_some_and(|b| b.vertices.changes()) || packed.iter().any(|p| p.rest.is_some());
        let [mut vertices, mut indices] = packed::contents(&packed, &rooms, changes);
        if let Some(before) = before {
            // Contents that a concurrent call has made stay in use, because only at this point is it known that a mesh changed.
            if vertices != before.vertices || indices != before.indices {
                [vertices, indices] = packed::contents(&packed, &rooms, true);
            } else {
                vertices = before.vertices.clone();
                indices = before.indices.clone();
            }
        }
        let of_rank = |part: &PreparedPart| (&packed[part.part], &rooms[part.part]);
        let ranges = prepared.parts.iter().map(|part| {
            let (packed, room) = of_rank(part);
            MeshRange {
                indices: room.first_index..room.first_index + packed.index_count(),
                base_vertex: room.first_vertex.cast_signed(),
                vertex_count: packed.vertex_count,
            }
        });
        let moving = prepared.parts.iter().map(|part| {
            let (packed, room) = of_rank(part);
            let rest = packed.rest.clone()?;
            let of = &scene.parts[part.part];
            Some(Moving {
                packed_pose: PackedPose::of(of, &rest, &space, room.first_vertex),
                rest,
            })
        });
        let (ranges, moving) = (ranges.collect(), moving.collect());
        let Heights {
            contents: heights,
            first_texel,
            maps,
        } = Heights::of(&prepared, before.map(|b| (&b.heights, b.maps.as_slice())));
        let relief_sky = ReliefSky::of(&prepared, &first_texel, before.map(|b| &b.relief_sky));
        let known = before.and_then(|b| b.cap_materials.as_ref());
        let cap_materials = CapMaterials::of(scene, &space, (&world, (&packed, &rooms)), known);
        let cutters = Cutters::of(&prepared.surfaces, before.map(|b| &b.cutters));
        let known = before.and_then(|b| b.preclassified.as_ref());
        let preclassified = PreclassifiedTriangles::of(&prepared, &packed, &rooms, known);
        let at_rest = RestPose::of(scene, &prepared, before.map(|b| &b.at_rest));
        Self {
            cutters,
            ranges,
            moving,
            vertices,
            indices,
            heights,
            first_texel,
            maps,
            packed: Arc::new(packed),
            rooms,
            preclassified,
            grid_indices: before.map_or_else(
                || Arc::new(Memo::with_capacity(1)),
                |b| b.grid_indices.clone(),
            ),
            relief_sky,
            cap_materials,
            ground: None,
            moved: at_rest.moved(scene, &prepared),
            at_rest,
            lineage: before.map_or_else(Arc::default, |b| b.lineage.clone()),
            identity: Arc::default(),
            prepared,
        }
    }

    /// The same scene as input for the exact reference: posed in f64, with all vertices. `scene` is the one from which
    /// this model was made. The view may come from either.
    pub fn truth(&self, scene: &Scene) -> Cow<'_, Prepared> {
        if self.prepared.is_whole() {
            Cow::Borrowed(&self.prepared)
        } else {
            let shared = self.prepared.shared.clone();
            Cow::Owned(Prepared::in_planes(scene, |_| shared))
        }
    }

    /// The same scene with nothing removed, sharing the packed data: this is what `draw_only_ms` measures.
    #[must_use]
    pub fn without_cuts(&self) -> Self {
        let mut uncut = self.clone();
        uncut.prepared.cuts.clear();
        uncut.prepared.surfaces.clear();
        for part in &mut uncut.prepared.parts {
            part.cuts.clear();
            part.is_hidden = false;
            part.is_removed = false;
        }
        uncut.first_texel.clear();
        uncut.preclassified = None;
        uncut.identity = Arc::default();
        uncut
    }

    /// The same scene on a ground with a shadow.
    #[must_use]
    pub fn on_ground(&self, shadow: GroundShadow) -> Self {
        Self {
            ground: Some(Arc::new(shadow)),
            identity: Arc::default(),
            ..self.clone()
        }
    }

    /// The same scene in another style, with only the plain colours of its parts.
    #[must_use]
    pub(crate) fn in_style(&self, style: Style) -> Self {
        let mut styled = self.clone();
        styled.prepared.style = style;
        styled.cap_materials = None;
        styled.identity = Arc::default();
        styled
    }

    /// Reusable slicing data of the part with the given rank.
    pub(crate) fn sliced(&self, rank: usize) -> Arc<Sliced> {
        self.packed[self.prepared.parts[rank].part].sliced.clone()
    }

    /// The triangles that close a part, by rank; `None` if it is closed as its fill rule counts.
    pub(crate) fn closing(&self, rank: usize) -> Option<Arc<PackedClosing>> {
        let part = &self.prepared.parts[rank];
        let found = self.packed[part.part].closing();
        found.filter(|found| found.closing.is_needed(part.fill))
    }

    /// The tree of a part's closing triangles, by rank, where the part is now.
    pub(crate) fn closing_tree(&self, rank: usize, closing: &PackedClosing) -> Arc<[u8]> {
        self.sliced(rank)
            .closing_tree(&self.prepared.parts[rank], closing)
    }

    /// The parts, by index in the scene, to which a cut applies and whose mesh is not closed as their fill rule counts: an odd number of
    /// faces meets at some edge or, under the nonzero rule, the directions of the faces at some edge do not cancel.
    ///
    /// The first call for a mesh takes a sort of its edges.
    pub fn open_parts(&self) -> Vec<usize> {
        let parts = self.prepared.parts.par_iter().enumerate();
        let open = parts.filter(|(rank, p)| !p.cuts.is_empty() && self.closing(*rank).is_some());
        open.map(|(_, part)| part.part).collect()
    }

    /// Returns true if a clip-surface is a true relief rather than a plane, a flat map or a cutter.
    pub fn is_relief(&self, surface: usize) -> bool {
        self.first_texel[surface] != NO_RELIEF
    }

    /// Returns true if a clip-surface is a cutter.
    pub fn is_cutter(&self, surface: usize) -> bool {
        self.prepared.surfaces[surface].volume.is_some()
    }

    /// Returns true if one model is a copy of the other.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.identity, &other.identity)
    }

    /// Returns true if one model is the other at another time, or has the same solids.
    pub fn is_kin_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.lineage, &other.lineage) || self.vertices == other.vertices
    }
}
