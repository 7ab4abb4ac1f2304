//! What each kind does to edges, faces and places.

use std::collections::BTreeSet;
use std::sync::Arc;

use cutaway::generate::defects::{DefectKind, break_parts};
use cutaway::scene::{Mesh, Motion, Part, Topology};
use cutaway_io::document::parse_defect;
use glam::DVec3;

use crate::common::meshes::{block, joined, parts, shape};

const SPHERE: &str = "sphere?subdivisions=4";

/// A mesh with defects.
pub(crate) fn broken(mesh: &Mesh, defects: &[&str]) -> Mesh {
    defects.iter().fold(mesh.clone(), |mesh, text| {
        let defect = parse_defect(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        defect
            .apply(&mesh)
            .unwrap_or_else(|e| panic!("{text}: {e}"))
    })
}

fn facts(defect: &str) -> (Topology, Topology) {
    let whole = shape(SPHERE);
    let spoilt = broken(&whole, &[defect]);
    assert_eq!(spoilt.defect(), None, "{defect}: a mesh none the less");
    (Topology::new(&whole), Topology::new(&spoilt))
}

/// Faces by the places of their corners, so that meshes of other numbers compare.
fn places(mesh: &Mesh) -> BTreeSet<[[u64; 3]; 3]> {
    (0..mesh.triangles.len())
        .map(|t| mesh.corners(t).map(|p| p.to_array().map(f64::to_bits)))
        .collect()
}

#[test]
fn holes_are_as_many_faces_as_they_say_and_patches_have_shorter_rims() {
    let (whole, single) = facts("holes:amount=5%");
    assert!(whole.closed && !single.closed);
    let gone = (whole.faces as f64 * 0.05).round() as usize;
    assert_eq!(single.faces, whole.faces - gone);
    assert!(
        single.boundary_edges <= 3 * gone && single.boundary_edges > 2 * gone,
        "{} edges around {gone} holes",
        single.boundary_edges
    );
    let (_, patches) = facts("holes:amount=5%,patch=20");
    assert_eq!(patches.faces, single.faces);
    assert!(
        2 * patches.boundary_edges < single.boundary_edges,
        "{} edges around patches",
        patches.boundary_edges
    );
    let larger = places(&broken(&shape(SPHERE), &["holes:amount=8%"]));
    let smaller = places(&broken(&shape(SPHERE), &["holes:amount=3%"]));
    assert!(larger.is_subset(&smaller), "a sweep is of one thing");
}

#[test]
fn flipped_faces_disagree_with_their_neighbours_and_leave_no_hole() {
    let (whole, flipped) = facts("flipped:amount=5%");
    assert!(flipped.closed && flipped.faces == whole.faces);
    let turned = (whole.faces as f64 * 0.05).round() as usize;
    assert_eq!(whole.inconsistent_edges, 0);
    assert!(
        (2 * turned..=3 * turned).contains(&flipped.inconsistent_edges),
        "{} edges for {turned} faces",
        flipped.inconsistent_edges
    );
    assert!(
        flipped.volume < whole.volume,
        "they count against the solid"
    );
    let all = broken(&shape(SPHERE), &["flipped:amount=100%"]);
    assert!((Topology::new(&all).volume + whole.volume).abs() < 1e-12);
}

#[test]
fn duplicated_faces_have_edges_with_more_than_two_uses() {
    let (whole, twice) = facts("duplicated:amount=5%");
    let more = (whole.faces as f64 * 0.05).round() as usize;
    assert_eq!(twice.faces, whole.faces + more);
    assert!(
        (2 * more..=3 * more).contains(&twice.non_manifold_edges),
        "{} edges",
        twice.non_manifold_edges
    );
    let all = Topology::new(&broken(&shape(SPHERE), &["duplicated:amount=100%"]));
    assert!(all.closed, "twice of all is even");
    assert!((all.volume - 2.0 * whole.volume).abs() < 1e-12);
}

#[test]
fn t_junctions_open_three_edges_each_and_leave_the_surface_where_it_is() {
    let (whole, split) = facts("t-junctions:amount=5%");
    let faces = split.faces - whole.faces;
    assert_eq!(faces, (whole.faces as f64 * 0.05).round() as usize);
    // The edge that is split has one use left, and its halves one each.
    assert_eq!(split.boundary_edges, 3 * faces);
    assert!((split.area - whole.area).abs() < 1e-12);
    assert!((split.volume - whole.volume).abs() < 1e-12);
    let (_, all) = facts("t-junctions:amount=100%");
    assert!(all.faces > 3 * whole.faces / 2, "{} faces", all.faces);
    assert_eq!(
        all.boundary_edges,
        3 * (all.faces - whole.faces),
        "no edge is split twice"
    );
}

#[test]
fn gaps_are_as_wide_as_they_say() {
    let whole = shape(SPHERE);
    let width = 0.01;
    let apart = broken(&whole, &["gaps:amount=0.01,charts=6"]);
    let facts = Topology::new(&apart);
    assert_eq!(facts.components, 6, "charts do not hang together");
    assert_eq!(facts.faces, whole.triangles.len());
    assert!(facts.boundary_edges > 0 && facts.non_manifold_edges == 0);
    let old = whole.positions.len();
    let moved = &apart.positions[old..];
    assert!(moved.len() > 100, "{} vertices on rims", moved.len());
    for p in moved {
        let off = (whole.positions.iter())
            .map(|q| p.distance(*q))
            .fold(f64::INFINITY, f64::min);
        assert!((off - 0.5 * width).abs() < 1e-9, "{off} off");
    }
    // Pieces that are there already are charts of their own.
    let cubes = [0.0, 2.0].map(|x| block(DVec3::X * x, DVec3::X * x + 1.0));
    let both = broken(&joined(&cubes), &["gaps:amount=1%,charts=1"]);
    assert_eq!(
        both,
        joined(&cubes),
        "nothing hangs together that could part"
    );
}

#[test]
fn copies_that_overlap_are_closed_and_in_the_box() {
    let (whole, overlap) = facts("overlap:amount=10%,copies=3");
    assert!(overlap.closed);
    assert_eq!(overlap.faces, 4 * whole.faces);
    assert_eq!(overlap.components, 4);
    assert_eq!(overlap.bounds, whole.bounds);
    let more = overlap.volume / whole.volume;
    assert!(
        (more - 1.003).abs() < 1e-9,
        "three thousandths more: {more}"
    );
}

#[test]
fn an_open_shell_lacks_all_beyond_its_plane() {
    for (axis, low, high) in [("z", -0.5, 0.2), ("-z", -0.2, 0.5)] {
        let (whole, bowl) = facts(&format!("open:amount=30%,axis={axis}"));
        assert!(bowl.faces < whole.faces && !bowl.closed);
        let (min, max) = (bowl.bounds.min[2], bowl.bounds.max[2]);
        assert!(
            (min - low).abs() < 0.05 && (max - high).abs() < 0.05,
            "{min}..{max}"
        );
        assert_eq!(bowl.components, 1);
    }
}

#[test]
fn soup_shares_no_vertex_and_stays_close() {
    let whole = shape(SPHERE);
    let soup = broken(&whole, &["soup:amount=0.02"]);
    let facts = Topology::new(&soup);
    assert_eq!(facts.components, facts.faces, "every face is a piece");
    assert_eq!(facts.boundary_edges, 3 * facts.faces);
    let far = (0..facts.faces)
        .flat_map(|t| {
            let (old, new) = (whole.corners(t), soup.corners(t));
            [0, 1, 2].map(|i| old[i].distance(new[i]))
        })
        .fold(0.0, f64::max);
    assert!((0.01..=0.02).contains(&far), "moved by {far}");
}

#[test]
fn every_kind_is_the_identity_at_0_and_keeps_the_box_and_its_word() {
    for spec in ["sphere?subdivisions=3", "knot", "crank"] {
        let whole = &parts(spec)[0].mesh;
        for name in DefectKind::NAMES {
            let none = broken(whole, &[&format!("{name}:amount=0%")]);
            assert_eq!(none, **whole, "{name} of nothing");
            let text = format!("{name}:amount=7%");
            let once = broken(whole, &[&text]);
            assert_ne!(once, **whole, "{name} does nothing to {spec}");
            assert_eq!(once, broken(whole, &[&text]), "{name} twice");
            assert_eq!(once.bounds(), whole.bounds(), "{name} moves the frame");
            let normals = once.corner_normals.as_ref();
            assert!(
                normals.is_none_or(|n| n.len() == once.triangles.len()),
                "{name}: normals"
            );
            if name != "open" {
                let other = broken(whole, &[&format!("{name}:amount=7%,seed=2")]);
                assert_ne!(once, other, "the seed of {name} does nothing");
            }
        }
    }
}

#[test]
fn parts_that_move_still_move_and_parts_that_share_a_mesh_still_do() {
    let mut parts = parts("cube");
    let count = parts[0].mesh.positions.len();
    let push = |i: usize| DVec3::X * i as f64;
    parts[0].motion = Some(Arc::new(Motion {
        targets: vec![(0..count).map(push).collect()],
        ..Motion::default()
    }));
    parts[0].pose.weights = vec![0.5];
    parts.push(parts[0].clone());
    let rest: Vec<DVec3> = parts[0].mesh.positions.clone();
    let defects = ["soup:amount=1%", "holes:amount=10%"].map(|d| parse_defect(d).unwrap());
    let notes = break_parts(&mut parts, &defects).unwrap();
    assert_eq!(notes.len(), 4, "two defects of two parts: {notes:?}");
    assert!(
        notes[1].to_string().contains("1 of 12 faces are missing"),
        "{notes:?}"
    );
    assert!(Arc::ptr_eq(&parts[0].mesh, &parts[1].mesh));
    let part: &Part = &parts[0];
    let posed = part.posed_mesh();
    for (at, moved) in part.mesh.positions.iter().zip(&posed.positions) {
        // A vertex goes as the one it was made of, which is the nearest.
        let near =
            |a: &usize, b: &usize| (rest[*a].distance(*at)).total_cmp(&rest[*b].distance(*at));
        let from = (0..count).min_by(near).unwrap();
        assert!((*moved - *at - 0.5 * push(from)).length() < 1e-12);
    }
}
