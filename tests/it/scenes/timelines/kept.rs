//! A document that is opened again after a change keeps what the change does not concern: a cut that is dragged opens one for each frame.

use std::sync::Arc;

use cutaway::generate::shapes::shape;
use cutaway::scene::{Mesh, OffsetMap, Scene};
use cutaway_io::document::{Document, cut, part, section};
use cutaway_io::load::Assets;

fn scene(document: &Document, assets: &mut Assets) -> Scene {
    document.resolve(0.0, assets).expect("a scene")
}

fn meshes(scene: &Scene) -> Vec<Arc<Mesh>> {
    scene.parts.iter().map(|part| part.mesh.clone()).collect()
}

fn map(scene: &Scene) -> Arc<OffsetMap> {
    let relief = scene.cuts[0].surfaces[0].relief.as_ref();
    relief.expect("a relief").clone()
}

fn are_same(a: &[Arc<Mesh>], b: &[Arc<Mesh>]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b))
}

#[test]
fn bodies_closed_holes_and_reliefs_are_not_made_again() {
    let mut assets = Assets::default();
    let mut document = Document::new();
    let gears = part("shape:gears").with("split", true);
    document.add_part(gears).expect("a part");
    let closed = part("shape:sphere").defect("holes:amount=2%,patch=4,seed=1");
    let closed = closed.with("close_holes", true);
    document.add_part(closed).expect("a part");
    let ragged = section("-z=50%").relief("fractal:size=32");
    document.add_cut(cut([ragged])).expect("a cut");
    let first = scene(&document, &mut assets);

    document
        .set("cut.0.surfaces.0.section", "-z=40%")
        .expect("a section");
    let moved = scene(&document, &mut assets);
    assert!(are_same(&meshes(&first), &meshes(&moved)), "meshes");
    assert!(Arc::ptr_eq(&map(&first), &map(&moved)), "the relief");

    // What a change concerns is made anew.
    document.set("relief.fractal.seed", 3_i64).expect("a seed");
    document
        .set("part.1.defects.0.seed", 5_i64)
        .expect("another seed");
    let changed = scene(&document, &mut assets);
    assert!(!Arc::ptr_eq(&map(&moved), &map(&changed)));
    let (before, after) = (meshes(&moved), meshes(&changed));
    let last = before.len() - 1;
    assert!(are_same(&before[..last], &after[..last]));
    assert!(!Arc::ptr_eq(&before[last], &after[last]));
}

#[test]
fn what_takes_the_place_of_a_shape_is_seen() {
    let mut assets = Assets::default();
    let mut document = Document::new();
    let cube = part("shape:cube").with("split", true);
    document.add_part(cube).expect("a part");
    let first = scene(&document, &mut assets);
    assets.insert_shape("cube", shape("sphere").expect("a shape"));
    let later = scene(&document, &mut assets);
    assert_ne!(first.parts[0].mesh, later.parts[0].mesh);
}

#[test]
fn what_is_said_of_an_entry_is_said_each_time() {
    let mut assets = Assets::default();
    let mut document = Document::new();
    let gears = part("shape:gears").with("split", true);
    document.add_part(gears).expect("a part");
    let notes = |document: &Document, assets: &mut Assets| {
        let timeline = document.timeline(assets).expect("a timeline");
        timeline.notes().to_vec()
    };
    let first = notes(&document, &mut assets);
    assert!(!first.is_empty());
    assert_eq!(notes(&document, &mut assets), first);
}
