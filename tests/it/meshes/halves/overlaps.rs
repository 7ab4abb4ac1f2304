//! Bodies of one mesh that overlap: each gets a cap of its own, so that halves are as manifold as the mesh.

use cutaway::scene::{Part, Topology};

use super::*;
use crate::common::meshes::{block, joined};

fn boxes() -> [Mesh; 2] {
    [
        block(DVec3::ZERO, DVec3::new(4.0, 4.0, 1.0)),
        block(DVec3::new(1.0, 1.0, 0.75), DVec3::new(2.0, 2.0, 2.75)),
    ]
}

fn facts(mesh: &Mesh) -> Topology {
    Topology::from_parts(&[Part::new("a", mesh.clone())])
}

#[test]
fn bodies_that_overlap_are_capped_one_by_one() {
    let mesh = joined(&boxes());
    let regions = [vec![plane(DVec3::X * 1.5, DVec3::X)]];
    let halves = checked("two boxes", &mesh, &regions);
    winds_as_the_mesh("two boxes", &mesh, &regions, &halves);
    assert!(
        halves.defects.is_empty(),
        "no loops cross: {:?}",
        halves.defects
    );
    for half in [&halves.kept, &halves.removed] {
        let facts = facts(&half.mesh);
        let odd = [facts.non_manifold_edges, facts.coincident_faces];
        assert_eq!(odd, [0, 0], "as of the mesh");
        assert!((half.cap_area() - 6.0).abs() < 1e-12, "4 x 1 and 1 x 2");
    }
}

#[test]
fn a_cavity_is_capped_with_its_body() {
    let turned = |mesh: Mesh| crate::common::meshes::turned(&mesh);
    let [outer, other] = boxes();
    let cavity = turned(block(DVec3::splat(0.5), DVec3::new(3.0, 3.0, 0.9)));
    let mesh = joined(&[outer, cavity, other]);
    let regions = [vec![plane(DVec3::X * 1.5, DVec3::X)]];
    let halves = checked("a cavity", &mesh, &regions);
    winds_as_the_mesh("a cavity", &mesh, &regions, &halves);
    assert!((halves.kept.cap_area() - (4.0 - 2.5 * 0.4 + 2.0)).abs() < 1e-12);
    assert_eq!(facts(&halves.kept.mesh).non_manifold_edges, 0);
}
