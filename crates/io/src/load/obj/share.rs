//! What a share of the lines of an OBJ file defines, and the whole file as shares joined.
//!
//! The object, group and material that a share begins with depend on the shares before it; its labels leave them open.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::vertex_paint::ObjVertexPaint;
use crate::load::Group;

/// What triangles are labelled with. Those with the same label belong to the same group. In a share, an entry is `None` if it is that of
/// the share before it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Label {
    pub(super) object: Option<String>,
    pub(super) group: Option<String>,
    pub(super) material: Option<String>,
}

impl Label {
    /// The label at the start of a file.
    fn unnamed() -> Self {
        let empty = Some(String::new());
        Self {
            object: empty.clone(),
            group: empty.clone(),
            material: empty,
        }
    }

    /// The label with the entries of `before` where it has none.
    fn after(&self, before: &Self) -> Self {
        let or = |own: &Option<String>, before: &Option<String>| own.clone().or(before.clone());
        Self {
            object: or(&self.object, &before.object),
            group: or(&self.group, &before.group),
            material: or(&self.material, &before.material),
        }
    }

    /// The group of the triangles with this label.
    pub(super) fn group(&self) -> Group {
        let mut names = [&self.object, &self.group, &self.material].into_iter();
        let is_named = |name: &&String| !name.is_empty();
        Group {
            name: names.find_map(|name| name.as_ref().filter(is_named).cloned()),
            material: self.material.clone().filter(|name| !name.is_empty()),
            ..Group::default()
        }
    }
}

/// Labels of triangles, numbered in the order of their first triangle.
#[derive(Debug, Default)]
pub(super) struct Labels {
    all: Vec<Label>,
    numbers: HashMap<Label, u32>,
}

impl Labels {
    pub(super) fn all(&self) -> &[Label] {
        &self.all
    }

    pub(super) fn number(&mut self, label: &Label) -> u32 {
        if let Some(number) = self.numbers.get(label) {
            return *number;
        }
        let next = self.all.len() as u32;
        self.all.push(label.clone());
        self.numbers.insert(label.clone(), next);
        next
    }
}

/// The largest index that a face used before it was defined, and the line of that face.
pub(super) type ForwardReference = Option<(usize, usize)>;

/// A kind of element that is left out, with the line and text of its first occurrence, and its total count.
#[derive(Debug, Default)]
pub(super) struct LeftOut {
    pub(super) first: Option<(usize, String)>,
    pub(super) count: usize,
}

impl LeftOut {
    pub(super) fn add(&mut self, line: usize, what: &str) {
        self.first.get_or_insert_with(|| (line, what.to_owned()));
        self.count += 1;
    }

    fn append(&mut self, next: Self) {
        self.first = self.first.take().or(next.first);
        self.count += next.count;
    }
}

/// What a share of the lines defines.
#[derive(Debug, Default)]
pub(super) struct ObjShare {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<Vec3>,
    /// Indices of positions of the whole file.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Number of the label of each triangle.
    pub(super) label_of_triangle: Vec<u32>,
    /// For each corner, its index into the normals of the whole file. Resolved at the end, because a face may precede its normals. Empty
    /// if no face has normals.
    pub(super) normal_of_corner: Vec<Option<[u32; 3]>>,
    pub(super) paint: ObjVertexPaint,
    pub(super) labels: Labels,
    /// The label after the last line.
    pub(super) label: Label,
    pub(super) libraries: Vec<String>,
    pub(super) ahead: [ForwardReference; 2],
    pub(super) unknown_words: LeftOut,
    pub(super) no_normals: LeftOut,
}

impl ObjShare {
    /// The whole file.
    pub(super) fn joined(shares: Vec<Self>) -> Self {
        let count = |of: fn(&Self) -> usize| shares.iter().map(of).sum();
        let mut whole = Self {
            positions: Vec::with_capacity(count(|s| s.positions.len())),
            triangles: Vec::with_capacity(count(|s| s.triangles.len())),
            label: Label::unnamed(),
            ..Self::default()
        };
        shares.into_iter().for_each(|share| whole.append(share));
        whole
    }

    fn append(&mut self, next: Self) {
        let (positions, triangles) = (self.positions.len(), self.triangles.len());
        self.positions.extend(next.positions);
        self.triangles.extend(next.triangles);
        self.normals.extend(next.normals);
        if !next.normal_of_corner.is_empty() {
            self.normal_of_corner.resize(triangles, None);
            self.normal_of_corner.extend(next.normal_of_corner);
        }
        self.paint.append(next.paint, positions, triangles);
        let labels = next.labels.all.iter().map(|label| label.after(&self.label));
        let numbers: Vec<u32> = labels.map(|label| self.labels.number(&label)).collect();
        let of_triangle = next.label_of_triangle.iter();
        let of_triangle = of_triangle.map(|label| numbers[*label as usize]);
        self.label_of_triangle.extend(of_triangle);
        self.label = next.label.after(&self.label);
        self.libraries.extend(next.libraries);
        for (known, ahead) in self.ahead.iter_mut().zip(next.ahead) {
            // Of equal indices, the first line.
            if ahead.is_some_and(|(index, _)| known.is_none_or(|(largest, _)| largest < index)) {
                *known = ahead;
            }
        }
        self.unknown_words.append(next.unknown_words);
        self.no_normals.append(next.no_normals);
    }
}
