//! Conversion of a file's triangles to solids: validity checks, welding, and grouping.
//!
//! A *group* is a unit that a file separates, such as an object, a material or a glTF primitive. A group is not always a solid, because an
//! exporter that writes one group per material tears closed solids open. Therefore groups that share an open edge are joined, and closed
//! groups stay apart. A closed group that is inside out is a cavity. It is joined with the smallest group that encloses it, so that both
//! form one solid by parity.

use std::mem::take;
use std::path::Path;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::Edges;
use cutaway::scene::topology::Sets;
use cutaway::scene::weld::{has_three, renumber, thousands, weld};
use cutaway::scene::{Mesh, MeshDefect, Motion, VertexPaint, range};
use glam::Vec3;

use super::welded;

pub(super) const UNITS: &str = "scale the model, or export it in another length unit";

/// Maximum number of vertices. Of the 32 bits of an index, one is used for the direction of an edge.
const MOST_VERTICES: usize = 1 << 31;

/// Triangles as the file stores them.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) mesh: Mesh,
    /// Motion data of the mesh's positions.
    pub(super) motion: Motion,
    /// Index into `groups` for each triangle. Empty if there is at most one group.
    pub(super) group_of_triangle: Vec<u32>,
    pub(super) groups: Vec<Group>,
    /// `None` if the mesh has not been welded.
    pub(super) welding: Option<DraftWelding>,
}

/// Result of welding by the reader of a format.
#[derive(Debug)]
pub(super) struct DraftWelding {
    /// Summary of the changes, if there are any.
    pub(super) note: Option<String>,
    /// Number of open edges.
    pub(super) open: usize,
}

/// Properties that a file gives a group of triangles.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    pub(super) name: Option<String>,
    pub(super) color: Option<Vec3>,
    /// Name of the group's material.
    pub(super) material: Option<String>,
    /// True if the group's material transmits light.
    pub(super) is_transparent: bool,
}

/// A mesh that will become a part.
#[derive(Debug)]
pub(super) struct DraftSolid {
    pub(super) name: Option<String>,
    pub(super) color: Option<Vec3>,
    /// Names of the materials of the solid's groups.
    pub(super) materials: Vec<String>,
    /// True if the materials of all groups transmit light.
    pub(super) is_transparent: bool,
    /// True if the mesh is known to have no open edges.
    pub(super) is_closed: bool,
    pub(super) mesh: Mesh,
    pub(super) motion: Motion,
}

impl Draft {
    /// Checks, welds and splits the triangles, and adds a note to `notes` for each change.
    pub(super) fn into_solids(
        mut self,
        path: &Path,
        notes: &mut Vec<Diagnostic>,
    ) -> Result<Vec<DraftSolid>> {
        refuse_defects(path, &self.mesh)?;
        let unused = self.mesh.positions.len() - self.drop_unused();
        if unused > 0 {
            notes.push(Diagnostic::note(
                "unused-vertices",
                format!(
                    "left out {} vertices that no triangle uses",
                    thousands(unused)
                ),
            ));
        }
        let welding = self.welding.take();
        let welding = welding.unwrap_or_else(|| self.weld(notes));
        if let Some(note) = welding.note {
            notes.push(Diagnostic::note("welded", note));
        }
        let faces = self.mesh.triangles.len();
        self.keep(has_three);
        let flat = faces - self.mesh.triangles.len();
        if flat > 0 {
            notes.push(Diagnostic::note(
                "flat-triangles",
                format!(
                    "left out {} triangles with a repeated corner: they have no area",
                    thousands(flat)
                ),
            ));
            self.drop_unused();
        }
        refuse_defects(path, &self.mesh)?;
        Ok(self.split(welding.open == 0, notes))
    }

    fn weld(&mut self, notes: &mut Vec<Diagnostic>) -> DraftWelding {
        let welding = weld(&self.mesh.positions, &self.mesh.triangles);
        let note = welding.weld.map(|welded| {
            self.motion = welded::motion(&self.mesh, &self.motion, &welded.new_from_old, notes);
            self.mesh.positions = welded.positions;
            renumber(&mut self.mesh.triangles, &welded.new_from_old);
            welded.note
        });
        DraftWelding {
            note,
            open: welding.open,
        }
    }

    fn keep(&mut self, wanted: impl Fn(&[u32; 3]) -> bool) {
        let kept: Vec<bool> = self.mesh.triangles.iter().map(wanted).collect();
        if kept.iter().all(|k| *k) {
            return;
        }
        retain(&mut self.mesh.triangles, &kept);
        retain(&mut self.group_of_triangle, &kept);
        if let Some(normals) = &mut self.mesh.corner_normals {
            retain(normals, &kept);
        }
        if let Some(vertex_paint) = &mut self.mesh.vertex_paint {
            retain(&mut vertex_paint.triangles, &kept);
        }
    }

    /// Drops vertices that no triangle uses. The other vertices keep their order, and their number is returned.
    fn drop_unused(&mut self) -> usize {
        let mesh = &mut self.mesh;
        let mut used = vec![false; mesh.positions.len()];
        for i in mesh.triangles.iter().flatten() {
            used[*i as usize] = true;
        }
        if used.iter().any(|u| !u) {
            let mut left = Vec::new();
            let mut number = Vec::with_capacity(used.len());
            for (i, used) in (0..).zip(&used) {
                number.push(left.len() as u32);
                if *used {
                    left.push(i);
                }
            }
            retain(&mut mesh.positions, &used);
            renumber(&mut mesh.triangles, &number);
            self.motion = self.motion.of_positions(&left);
        }
        self.mesh.positions.len()
    }

    /// Splits the mesh into solids. If it is closed, so is each of them: the groups that use an edge an odd number of times are one solid.
    fn split(mut self, is_closed: bool, notes: &mut Vec<Diagnostic>) -> Vec<DraftSolid> {
        if self.groups.is_empty() {
            self.groups.push(Group::default());
        }
        let groups = self.groups.len();
        let mut size = vec![0_usize; groups];
        let solid_of_group = if groups > 1 {
            (self.group_of_triangle.iter()).for_each(|group| size[*group as usize] += 1);
            self.solid_of_group()
        } else {
            size[0] = self.mesh.triangles.len();
            vec![0]
        };
        let is_seen = |(group, of): (&Group, &usize)| group.is_transparent && *of > 0;
        if self.groups.iter().zip(&size).any(is_seen) {
            notes.push(Diagnostic::note(
                "transparency-left-out",
                "drawn opaque, although its material transmits light",
            ));
        }
        let mut has_triangles = vec![false; groups];
        for (solid, size) in solid_of_group.iter().zip(&size) {
            has_triangles[*solid as usize] |= *size > 0;
        }
        let count = has_triangles.iter().filter(|has| **has).count();
        let filled = size.iter().filter(|s| **s > 0).count();
        if count < filled {
            notes.push(Diagnostic::note(
                "groups-joined",
                format!(
                    "{} groups make {} {}: groups that share open edges are one solid",
                    thousands(filled),
                    thousands(count),
                    if count == 1 { "part" } else { "parts" }
                ),
            ));
        }
        let mut triangles_of: Vec<Vec<u32>> = vec![Vec::new(); groups];
        if count > 1 {
            for (t, group) in (0..).zip(&self.group_of_triangle) {
                triangles_of[solid_of_group[*group as usize] as usize].push(t);
            }
        }
        let mut solids = Vec::with_capacity(count);
        for solid in (0..groups).filter(|solid| has_triangles[*solid]) {
            let members = || (0..groups).filter(|g| solid_of_group[*g] as usize == solid);
            let by_size = |g: &usize| (size[*g], std::cmp::Reverse(*g));
            let colored = members().filter(|g| self.groups[*g].color.is_some());
            let (mut mesh, motion) = if count == 1 {
                (take(&mut self.mesh), take(&mut self.motion))
            } else {
                let (mesh, vertices) = self.mesh.picked(&triangles_of[solid]);
                (mesh, self.motion.of_positions(&vertices))
            };
            // If all vertices have one colour, the part gets it. White is ignored, because many exporters write it by default.
            let one = mesh.vertex_paint.as_ref().and_then(VertexPaint::one_color);
            if one.is_some() {
                mesh.vertex_paint = None;
            }
            let one = one.filter(|[r, g, b, _]| [*r, *g, *b] != [255; 3]);
            let one = one.map(|[r, g, b, _]| Vec3::new(r.into(), g.into(), b.into()) / 255.0);
            let mut materials: Vec<String> = (members().filter(|g| size[*g] > 0))
                .filter_map(|g| self.groups[g].material.clone())
                .collect();
            materials.dedup();
            let mut filled = members().filter(|g| size[*g] > 0).peekable();
            solids.push(DraftSolid {
                materials,
                is_closed,
                is_transparent: filled.peek().is_some()
                    && filled.all(|g| self.groups[g].is_transparent),
                name: members().find_map(|g| self.groups[g].name.clone()),
                color: colored
                    .max_by_key(by_size)
                    .and_then(|g| self.groups[g].color)
                    .or(one),
                mesh,
                motion,
            });
        }
        solids
    }

    /// Returns, for each group, the lowest index of a group in the same solid.
    fn solid_of_group(&self) -> Vec<u32> {
        let groups = self.groups.len();
        let mut triangles_of: Vec<Vec<[u32; 3]>> = vec![Vec::new(); groups];
        for (t, g) in self.mesh.triangles.iter().zip(&self.group_of_triangle) {
            triangles_of[*g as usize].push(*t);
        }
        let mut open: Vec<([u32; 2], u32)> = Vec::new();
        for (g, triangles) in triangles_of.iter().enumerate() {
            open.extend(Edges::of(triangles).open().map(|edge| (edge, g as u32)));
        }
        open.sort_unstable();
        let mut sets = Sets::new(groups);
        for pair in open.windows(2).filter(|w| w[0].0 == w[1].0) {
            sets.join(pair[0].1, pair[1].1);
        }
        let mut pieces: Vec<Vec<u32>> = vec![Vec::new(); groups];
        for (t, g) in (0..).zip(&self.group_of_triangle) {
            pieces[sets.find(*g) as usize].push(t);
        }
        let measured: Vec<_> = pieces
            .iter()
            .enumerate()
            .filter(|(_, triangles)| !triangles.is_empty())
            .map(|(g, triangles)| {
                let (mesh, _) = self.mesh.picked(triangles);
                let closed = Edges::of(&mesh.triangles).count().open == 0;
                (g as u32, mesh.volume(), mesh.bounds(), closed)
            })
            .collect();
        for (cavity, volume, inner, closed) in &measured {
            if !closed || *volume >= 0.0 {
                continue;
            }
            let around = measured
                .iter()
                .filter(|(_, v, outer, closed)| {
                    *closed
                        && *v > volume.abs()
                        && outer.min.cmple(inner.min).all()
                        && outer.max.cmpge(inner.max).all()
                })
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((outer, ..)) = around {
                sets.join(*cavity, *outer);
            }
        }
        (0..groups as u32).map(|g| sets.find(g)).collect()
    }
}

fn refuse_defects(path: &Path, mesh: &Mesh) -> Result<()> {
    if mesh.positions.len() > MOST_VERTICES {
        return Err(Error::file(
            path,
            format!("{} vertices are more than 2^31", mesh.positions.len()),
            "split the model into several files",
        ));
    }
    let Some(defect) = mesh.defect() else {
        return match range::defect(&mesh.bounds()) {
            Some(what) => Err(Error::file(path, format!("the mesh {what}"), UNITS)),
            None => Ok(()),
        };
    };
    let help = match &defect {
        MeshDefect::Empty => "export it with faces; points, lines and curves are not cut",
        MeshDefect::NotFinite { .. } => "export it again, or delete that vertex and its faces",
        _ => "the file is damaged or cut off: export it again",
    };
    Err(Error::file(path, defect.to_string(), help))
}

fn retain<T>(items: &mut Vec<T>, kept: &[bool]) {
    let mut flags = kept.iter();
    items.retain(|_| flags.next().is_none_or(|k| *k));
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

    /// Concentric tetrahedra of the given sizes; a negative size turns one inside out. `group` gives the group of each triangle.
    fn draft(sizes: &[f64], group: impl Fn(usize, usize) -> u32) -> Draft {
        let mut draft = Draft::default();
        for (k, size) in sizes.iter().enumerate() {
            let first = 4 * k as u32;
            let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
            let place = |p: &DVec3| (*p - DVec3::splat(0.25)) * size.abs();
            draft.mesh.positions.extend(corners.iter().map(place));
            for (i, t) in TETRAHEDRON.iter().enumerate() {
                let [a, b, c] = t.map(|i| i + first);
                let inside_out = *size < 0.0;
                let t = if inside_out { [a, c, b] } else { [a, b, c] };
                draft.mesh.triangles.push(t);
                draft.group_of_triangle.push(group(k, i));
            }
        }
        let count = draft.group_of_triangle.iter().max().map_or(0, |g| g + 1);
        draft.groups = (0..count)
            .map(|g| Group {
                name: Some(format!("g{g}")),
                color: Some(Vec3::splat(g as f32 / 8.0)),
                ..Group::default()
            })
            .collect();
        draft
    }

    fn solids(draft: Draft) -> (Vec<DraftSolid>, Vec<Diagnostic>) {
        let mut notes = Vec::new();
        let solids = draft.into_solids(Path::new("x.obj"), &mut notes).unwrap();
        (solids, notes)
    }

    #[test]
    fn closed_groups_stay_apart() {
        let (solids, notes) = solids(draft(&[1.0, 2.0], |k, _| k as u32));
        assert_eq!(solids.len(), 2);
        assert_eq!(solids[1].mesh.positions.len(), 4);
        assert_eq!(solids[1].name.as_deref(), Some("g1"));
        assert!(notes.is_empty(), "{notes:?}");
    }

    #[test]
    fn a_solid_in_two_materials_is_one_part() {
        let (solids, notes) = solids(draft(&[1.0], |_, t| u32::from(t > 0)));
        assert_eq!(solids.len(), 1);
        assert_eq!(
            solids[0].color,
            Some(Vec3::splat(0.125)),
            "the larger group's"
        );
        assert!(
            notes[0].to_string().starts_with("2 groups make 1 part"),
            "{notes:?}"
        );
    }

    #[test]
    fn a_cavity_goes_with_the_smallest_group_around_it() {
        let (solids, _) = solids(draft(&[1.0, -0.5, 3.0], |k, _| k as u32));
        assert_eq!(solids.len(), 2);
        assert!((solids[0].mesh.volume() - 0.875 / 6.0).abs() < 1e-12);
    }

    #[test]
    fn repeated_corners_and_unused_vertices_go() {
        let mut one = draft(&[1.0], |_, _| 0);
        one.mesh.triangles.push([1, 1, 2]);
        one.group_of_triangle.push(0);
        one.mesh.positions.push(DVec3::splat(1e12));
        let (solids, notes) = solids(one);
        assert_eq!(solids[0].mesh.triangles.len(), 4);
        assert_eq!(solids[0].mesh.positions.len(), 4);
        assert_eq!(notes.len(), 2, "{notes:?}");
    }
}
