//! Solids of known volume with triangles taken out.

use std::collections::BTreeSet;

use cutaway::generate::shapes::shape;
use cutaway::slice::HoleDefect;
use proptest::prelude::*;

use super::*;

/// A wall between outlines at two heights, each seen from above: an outer one goes round counter-clockwise, an inner one the other way.
fn wall(mesh: &mut Mesh, outline: &[[f64; 2]]) {
    let first = mesh.positions.len() as u32;
    let count = outline.len() as u32;
    for z in [0.0, 1.0] {
        mesh.positions
            .extend(outline.iter().map(|[x, y]| DVec3::new(*x, *y, z)));
    }
    for i in 0..count {
        let [a, b] = [i, (i + 1) % count].map(|k| first + k);
        mesh.triangles
            .extend([[a, b, b + count], [a, b + count, a + count]]);
    }
}

fn polygon(corners: u32, radius: f64) -> Vec<[f64; 2]> {
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(corners);
    (0..corners)
        .map(|i| [radius * angle(i).cos(), radius * angle(i).sin()])
        .collect()
}

#[test]
fn closed_meshes_are_left_alone() {
    for spec in ["cube", "crank", "torus", "sponge"] {
        for part in shape(spec).expect(spec) {
            assert_eq!(close_holes(&part.mesh), Closing::default(), "{spec}");
        }
    }
}

#[test]
fn a_missing_side_is_closed_in_its_plane_whatever_its_size() {
    let mut open = cube(20);
    let is_top = |t: &[u32; 3]| t.iter().all(|i| open.positions[*i as usize].z >= 1.0);
    let kept: Vec<[u32; 3]> = open
        .triangles
        .iter()
        .copied()
        .filter(|t| !is_top(t))
        .collect();
    open.triangles = kept;
    let (closed, closing) = closed(&open);
    assert_eq!(closing.holes.len(), 1);
    assert_eq!(closing.holes[0].vertices.len(), 80);
    assert_eq!(closing.triangles.len(), 78);
    let facts = Topology::new(&closed);
    assert!(
        is_sound(&facts) && (facts.volume - 1.0).abs() < 1e-12,
        "{facts:?}"
    );
    assert_eq!(closed.positions, open.positions, "no vertex is added");
    assert_eq!(closed.triangles[..open.triangles.len()], open.triangles);
}

/// A pipe of 48 sides around a bore of 36, open at both ends.
fn pipe() -> Mesh {
    let mut pipe = mesh(Vec::new(), Vec::new());
    wall(&mut pipe, &polygon(48, 2.0));
    let inner: Vec<_> = polygon(36, 1.0).into_iter().rev().collect();
    wall(&mut pipe, &inner);
    pipe
}

#[test]
fn the_ends_of_a_pipe_are_rings() {
    let (closed, closing) = closed(&pipe());
    assert_eq!(closing.holes.len(), 4);
    // A ring between n and m corners has n + m triangles.
    assert_eq!(closing.triangles.len(), 2 * (48 + 36));
    let area = |n: f64, r: f64| 0.5 * n * r * r * (std::f64::consts::TAU / n).sin();
    let expected = area(48.0, 2.0) - area(36.0, 1.0);
    let facts = Topology::new(&closed);
    assert!(
        is_sound(&facts) && (facts.volume - expected).abs() < 1e-12,
        "{facts:?}"
    );
    let deepest = facts.depth_complexity.largest;
    assert_eq!(deepest, 4, "no disc lies on another");
}

/// What lies in the plane of an end, and cannot be closed itself, once had each rim of the end closed alone: two disks across the bore.
#[test]
fn a_sheet_beside_the_end_of_a_pipe_leaves_the_end_a_ring() {
    let mut pipe = pipe();
    let first = pipe.positions.len() as u32;
    let sheet = [[3.0, 0.0], [4.0, 0.0], [4.0, 1.0], [3.0, 1.0]];
    (pipe.positions).extend(sheet.map(|[x, y]| DVec3::new(x, y, 1.0)));
    (pipe.triangles).extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i: u32| first + i)));
    let closing = close_holes(&pipe);
    assert_eq!(closing.triangles.len(), 2 * (48 + 36));
    let open = closing.holes.iter().filter(|hole| hole.defect.is_some());
    assert_eq!(open.count(), 1, "the rim of the sheet");
}

#[test]
fn outlines_that_cross_themselves_are_refused() {
    let mut tie = mesh(Vec::new(), Vec::new());
    wall(
        &mut tie,
        &[[0.0, 0.0], [3.0, 0.0], [1.0, 2.0], [2.0, -2.0], [0.5, 2.0]],
    );
    let closing = close_holes(&tie);
    let defects: Vec<_> = closing.holes.iter().map(|h| h.defect).collect();
    assert_eq!(defects, [Some(HoleDefect::Crossing); 2]);
    assert!(closing.triangles.is_empty());
    // The control: the same corners in the order of their angles.
    let mut plain = mesh(Vec::new(), Vec::new());
    wall(&mut plain, &polygon(5, 1.0));
    assert!(is_sound(&Topology::new(&closed(&plain).0)));
}

#[test]
fn sheets_and_loose_triangles_are_no_holes() {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let corners = vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    let sheet = mesh(corners, vec![[0, 1, 2], [0, 2, 3]]);
    for (name, open) in [
        ("sheet", sheet.clone()),
        ("triangle", mesh(sheet.positions, vec![[0, 1, 2]])),
    ] {
        let closing = close_holes(&open);
        assert_eq!(closing.holes[0].defect, Some(HoleDefect::Folded), "{name}");
        assert!(closing.triangles.is_empty(), "{name}");
    }
}

#[test]
fn a_large_hole_that_is_not_planar_stays_open() {
    let rim: Vec<[f64; 2]> = polygon(40, 1.0);
    let mut tube = mesh(Vec::new(), Vec::new());
    wall(&mut tube, &rim);
    for (i, p) in tube.positions.iter_mut().enumerate().skip(40) {
        p.z += 0.2 * (i as f64).sin();
    }
    let closing = close_holes(&tube);
    let defects: Vec<_> = closing.holes.iter().map(|h| h.defect).collect();
    assert_eq!(defects, [None, Some(HoleDefect::Large)]);
}

#[test]
fn a_vertex_in_an_edge_that_one_side_knows_is_closed_by_a_flat_triangle() {
    let mut open = cube(1);
    let [a, b, c] = open.triangles[0];
    let middle = (open.positions[a as usize] + open.positions[b as usize]) * 0.5;
    open.positions.push(middle);
    open.triangles[0] = [a, 8, c];
    open.triangles.push([8, b, c]);
    assert_eq!(open.open_edges().len(), 3);
    let (closed, closing) = closed(&open);
    assert_eq!(closing.triangles.len(), 1);
    let facts = Topology::new(&closed);
    assert!(
        facts.closed && (facts.volume - 1.0).abs() < 1e-12,
        "{facts:?}"
    );
}

/// Whether a triangle shares no edge with another.
fn has_lone_triangles(mesh: &Mesh) -> bool {
    let edges = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let directed: BTreeSet<[u32; 2]> = mesh.triangles.iter().flat_map(|t| edges(*t)).collect();
    let is_alone = |t: &[u32; 3]| edges(*t).iter().all(|[a, b]| !directed.contains(&[*b, *a]));
    mesh.triangles.iter().any(is_alone)
}

#[test]
fn a_triangle_that_stands_alone_in_a_hole_stays_alone_and_is_told() {
    let whole = (*shape("sphere").unwrap()[0].mesh).clone();
    let out = [9543, 9544, 9584, 9585, 10055, 10056];
    let kept = (whole.triangles.iter().enumerate()).filter(|(t, _)| !out.contains(t));
    let open = Mesh {
        triangles: kept.map(|(_, t)| *t).collect(),
        corner_normals: None,
        ..whole.clone()
    };
    assert!(has_lone_triangles(&open) && !has_lone_triangles(&whole));
    let (closed, closing) = closed(&open);
    assert_eq!(Topology::new(&closed).boundary_edges, 3);
    let defects = closing.holes.iter().filter_map(|hole| hole.defect);
    assert_eq!(defects.collect::<Vec<_>>(), [HoleDefect::Folded]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn convex_solids_without_some_triangles_become_whole(
        out in proptest::collection::vec(0..1_000_usize, 1..60),
    ) {
        let whole = (*shape("sphere").unwrap()[0].mesh).clone();
        let faces = whole.triangles.len();
        // Two by two, so that holes have edges to choose.
        let first = out.iter().map(|i| i * faces / 1_000);
        let out: BTreeSet<usize> = first.flat_map(|t| [t, (t + 1) % faces]).collect();
        let kept = whole.triangles.iter().enumerate().filter(|(t, _)| !out.contains(t));
        let open = Mesh { triangles: kept.map(|(_, t)| *t).collect(), corner_normals: None, ..whole.clone() };
        // Triangles that stand alone in such a hole stay alone: that is a limit which is told.
        prop_assume!(!has_lone_triangles(&open));
        let (closed, closing) = closed(&open);
        let facts = Topology::new(&closed);
        prop_assert!(is_sound(&facts), "{:?}\n{:?}", facts, closing);
        prop_assert_eq!(closing.triangles.len(), out.len(), "a surface of the same genus");
        // What closes a hole of a convex surface between its vertices lies within.
        let (volume, exact) = (facts.volume, whole.volume());
        prop_assert!(volume <= exact * (1.0 + 1e-12), "{} of {}", volume, exact);
        prop_assert!(volume >= exact * 0.97, "{} of {}", volume, exact);
    }

    #[test]
    fn flat_sides_without_some_triangles_are_closed_exactly(
        out in proptest::collection::btree_set(0..128_usize, 1..100),
    ) {
        let mut open = cube(8);
        // The triangles of one side come one after the other.
        let kept = open.triangles.iter().enumerate().filter(|(t, _)| !out.contains(t));
        open.triangles = kept.map(|(_, t)| *t).collect();
        let (closed, closing) = closed(&open);
        let facts = Topology::new(&closed);
        prop_assert!(facts.closed, "{:?}\n{:?}", facts, closing);
        prop_assert!((facts.volume - 1.0).abs() < 1e-12, "{}", facts.volume);
        prop_assert!((facts.area - 6.0).abs() < 1e-12, "{}", facts.area);
    }
}
