//! Clips a section by half-planes.
//!
//! The outline of the section, the convex region in which it is kept, and the convex regions that are removed are drawn
//! into one triangulation ([`super::fill`]): the section and the kept region count 1 each, removed regions count -1, and the
//! result is where the sum is at its maximum. So coincident edges need no separate rule, and the cost is n log n in
//! the points.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec2;

use super::fill::{Filled, fill};
use super::half_plane::{HalfPlane, in_common, stretch};
use super::{Loop, Section, SectionDefect, SlicePlane};

/// Clip of a section: keeps points that are in all half-planes of `within`, and not in all half-planes of any set in `without`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trim {
    /// The section is kept where all of these intersect.
    pub within: Vec<HalfPlane>,
    /// Regions that are removed, each the intersection of its half-planes.
    pub without: Vec<Vec<HalfPlane>>,
}

impl Trim {
    /// The remaining part of a section by a plane; `None` if the whole section remains.
    pub fn of(&self, section: &Section, plane: &SlicePlane) -> Option<Section> {
        let points = &section.points;
        let size = points
            .iter()
            .fold(0.0, |m: f64, p| m.max(p.abs().max_element()));
        let cuts = |h: &&HalfPlane| !h.holds(points, size);
        let within: Vec<HalfPlane> = self.within.iter().filter(cuts).copied().collect();
        let meets = |region: &&Vec<HalfPlane>| !region.iter().any(|h| h.misses(points, size));
        let without: Vec<&Vec<HalfPlane>> = self.without.iter().filter(meets).collect();
        if within.is_empty() && without.is_empty() {
            return None;
        }
        let reach = 2.0 * size;
        let mut all = points.clone();
        let mut loops = chained(&section.boundary, points);
        let mut least = 1;
        let mut add = |mut polygon: Vec<DVec2>, is_taken: bool| {
            if is_taken {
                polygon.reverse();
            }
            let first = all.len() as u32;
            loops.push((first..first + polygon.len() as u32).collect());
            all.append(&mut polygon);
        };
        if !within.is_empty() {
            least = 2;
            add(in_common(&within, reach), false);
        }
        for region in &without {
            add(in_common(region, reach), true);
        }
        let Filled {
            added,
            triangles,
            boundary,
            left_out,
            ..
        } = fill(&all, &loops, |sum| sum >= least);
        all.extend(added);
        let open = self.left_of(section, section.open.iter().map(Vec::as_slice), &mut all);
        let bridges = section.bridges.iter().map(<[u32; 2]>::as_slice);
        let bridges = self.left_of(section, bridges, &mut all).into_iter();
        let lost: Vec<&[u32]> = left_out.iter().map(|i| loops[*i].as_slice()).collect();
        let mut trimmed = Section {
            defects: defects(section, plane, &all, &open, &lost),
            bridges: bridges.map(|ends| [ends[0], ends[1]]).collect(),
            loops: (chained(&boundary, &all).into_iter())
                .map(|points| Loop { points })
                .collect(),
            points: all,
            open,
            triangles,
            boundary,
        };
        trimmed
            .defects
            .extend(trimmed.bridged(|at| plane.point(at)));
        compact(&mut trimmed);
        Some(trimmed)
    }

    /// The remaining parts of open curves.
    fn left_of<'a>(
        &self,
        section: &Section,
        curves: impl Iterator<Item = &'a [u32]>,
        points: &mut Vec<DVec2>,
    ) -> Vec<Vec<u32>> {
        let mut left = Vec::new();
        for chain in curves {
            let mut run: Vec<DVec2> = Vec::new();
            let mut end = |run: &mut Vec<DVec2>| {
                let run = std::mem::take(run);
                if run.len() > 1 {
                    let first = points.len() as u32;
                    left.push((first..first + run.len() as u32).collect());
                    points.extend(run);
                }
            };
            for ends in chain.windows(2) {
                let [a, b] = [ends[0], ends[1]].map(|i| section.points[i as usize]);
                for [from, to] in self.stretches([a, b]) {
                    if from > 0.0 || run.is_empty() {
                        end(&mut run);
                        run.push(a.lerp(b, from));
                    }
                    run.push(a.lerp(b, to));
                    if to < 1.0 {
                        end(&mut run);
                    }
                }
            }
            end(&mut run);
        }
        left
    }

    /// The remaining stretches of a segment, in order.
    fn stretches(&self, ends: [DVec2; 2]) -> Vec<[f64; 2]> {
        let mut left: Vec<[f64; 2]> = stretch(&self.within, ends).into_iter().collect();
        for region in &self.without {
            if let Some([from, to]) = stretch(region, ends) {
                let around = left
                    .iter()
                    .flat_map(|[a, b]| [[*a, b.min(from)], [a.max(to), *b]]);
                left = around.filter(|[a, b]| a < b).collect();
            }
        }
        left
    }
}

/// Defects that concern the remaining part, each with one of its points.
fn defects(
    before: &Section,
    plane: &SlicePlane,
    points: &[DVec2],
    open: &[Vec<u32>],
    lost: &[&[u32]],
) -> Vec<SectionDefect> {
    let at = |curve: &[u32]| {
        let first = curve.first().map(|i| points[*i as usize]);
        plane.point(first.unwrap_or_default())
    };
    let kept = before.defects.iter().filter_map(|defect| match defect {
        SectionDefect::Open { .. } => open.first().map(|chain| SectionDefect::Open {
            chains: open.len(),
            at: at(chain),
        }),
        SectionDefect::Bridged { .. } => None,
        other => Some(other.clone()),
    });
    let lost = lost.first().map(|one| SectionDefect::LeftOut {
        loops: lost.len(),
        at: at(one),
    });
    kept.chain(lost).collect()
}

/// Joins directed edges, of which as many end in each point as begin there, into closed curves. Curves that touch are separated, so that no
/// two have the same area on their left.
pub(super) fn chained(edges: &[[u32; 2]], points: &[DVec2]) -> Vec<Vec<u32>> {
    let mut leaving: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (edge, [from, _]) in edges.iter().enumerate() {
        leaving.entry(*from).or_default().push(edge);
    }
    let way = |[from, to]: [u32; 2]| (points[to as usize] - points[from as usize]).to_angle();
    let next = |edge: usize| {
        let [from, to] = edges[edge];
        // Clockwise from the direction of arrival, which bounds the area on its left.
        let back = way([to, from]);
        let turn = |other: &usize| {
            let turn = (back - way(edges[*other])).rem_euclid(TAU);
            if turn > 0.0 { turn } else { TAU }
        };
        let leaving = leaving.get(&to).into_iter().flatten().copied();
        leaving.min_by(|a, b| turn(a).total_cmp(&turn(b)))
    };
    let mut passed = vec![false; edges.len()];
    let mut loops = Vec::new();
    for first in 0..edges.len() {
        let mut curve = Vec::new();
        let mut edge = Some(first);
        while let Some(at) = edge.filter(|e| !std::mem::replace(&mut passed[*e], true)) {
            curve.push(edges[at][0]);
            edge = next(at);
        }
        if !curve.is_empty() {
            loops.push(curve);
        }
    }
    loops
}

/// Removes unused points.
fn compact(section: &mut Section) {
    let mut number_of = vec![None; section.points.len()];
    let mut kept = Vec::new();
    let mut renumber = |i: &mut u32| {
        let slot = &mut number_of[*i as usize];
        *i = *slot.get_or_insert_with(|| {
            kept.push(section.points[*i as usize]);
            kept.len() as u32 - 1
        });
    };
    section
        .loops
        .iter_mut()
        .flat_map(|l| &mut l.points)
        .for_each(&mut renumber);
    section.open.iter_mut().flatten().for_each(&mut renumber);
    section.bridges.iter_mut().flatten().for_each(&mut renumber);
    section
        .triangles
        .iter_mut()
        .flatten()
        .for_each(&mut renumber);
    section
        .boundary
        .iter_mut()
        .flatten()
        .for_each(&mut renumber);
    section.points = kept;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_that_touch_are_told_apart() {
        // Two squares that share the corner 2, and a triangle in the second.
        let points = [(0, 0), (1, 0), (1, 1), (0, 1), (2, 1), (2, 2), (1, 2)];
        let points = points.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)));
        let edges = [
            [0, 1],
            [2, 4],
            [1, 2],
            [6, 2],
            [2, 3],
            [4, 5],
            [3, 0],
            [5, 6],
        ];
        let loops = chained(&edges, &points);
        assert_eq!(loops, [vec![0, 1, 2, 3], vec![2, 4, 5, 6]]);
    }
}
