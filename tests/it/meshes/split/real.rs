//! Real meshes: how many bodies they have, that none of their triangles is lost, that strategies draw what exact says of bodies that
//! touch, and that bodies move as the whole does.

use std::path::Path;

use cutaway::Scene;
use cutaway::scene::{Bodies, Cut, Topology};
use cutaway::strategies::Strategy;
use cutaway_io::Document;
use cutaway_io::document::{Timeline, part, section};
use cutaway_io::load::Assets;

use super::*;
use crate::common::{Question, real};

fn timeline(file: &Path, is_split: bool) -> Timeline {
    let mut document = Document::new();
    let draft = part(&file.to_string_lossy()).with("split", is_split);
    document.add_part(draft).expect("a part");
    document
        .timeline(&mut Assets::default())
        .unwrap_or_else(|e| panic!("{}: {e}", file.display()))
}

/// A file taken apart.
pub(super) fn split(file: &Path) -> Scene {
    timeline(file, true).rest().clone()
}

#[test]
fn assemblies_have_as_many_bodies_as_others_count() {
    let Some(folder) = data::data() else { return };
    for (file, bodies) in [
        // Eighteen more than its vertices hold together: balls that touch their neighbours in a point.
        ("assembly/cycloidal_drive.ply", 118),
        ("assembly/cube_gears.glb", 17),
        ("assembly/dodeca_chain_loop.ply", 40),
        ("assembly/hull_body.obj", 3),
        ("assembly/generic_twin_left.obj", 12),
        ("assembly/box_10_bodies.stl", 10),
        ("assembly/car_tires.stl", 4),
        ("dense/garden_fence_panels.stl", 8),
        ("dense/menger_sponge_3.glb", 1),
        ("dense/cheese.obj", 1),
        ("large/stanford_dragon.ply.gz", 1),
        ("messy/triangle_soup.stl", 100),
    ] {
        let parts = split(&folder.join(file)).parts;
        assert_eq!(parts.len(), bodies, "{file}");
    }
}

#[test]
fn no_triangle_is_lost_and_closed_meshes_come_apart_into_closed_ones() {
    for file in real::files(&["assembly", "messy", "dense", "cad"]) {
        let whole = timeline(&file, false).rest().clone();
        let parts = split(&file).parts;
        let name = file.display();
        assert!(triangles_of(&whole.parts) == triangles_of(&parts), "{name}");
        // A part that is split is one body. Every face of the chair is there twice, once each way: it is split anew where a copy that is
        // inside out is taken for itself.
        let counts = parts.iter().map(|p| Bodies::of(&p.mesh).count());
        let is_twice_itself = file.ends_with("messy/chair.obj");
        assert!(
            is_twice_itself || counts.into_iter().all(|count| count == 1),
            "{name}"
        );
        if real::is_closed(&whole) {
            let open = parts.iter().find(|p| !Topology::new(&p.mesh).closed);
            assert!(open.is_none(), "{name}: {:?}", open.map(|p| &p.name));
        }
    }
}

#[test]
fn strategies_draw_bodies_that_touch_as_exact_does() {
    let mut faults = Vec::new();
    for file in real::files(&["assembly"]) {
        let mut scene = split(&file);
        if scene.parts.len() == timeline(&file, false).rest().parts.len() {
            continue;
        }
        let surface = section("-0.3,-0.25,-1@50%,50%,50%").on(&scene.bounds());
        scene.cuts = vec![Cut::new("middle", vec![surface.expect("a section")])];
        let question = Question::new(&scene, [320, 240]);
        for strategy in [
            Strategy::RAYCAST_MASK,
            Strategy::RAYCAST_STENCIL,
            Strategy::STENCIL,
        ] {
            if let Some(fault) = question.answer(strategy).fault_of_exact() {
                faults.push(format!("{} by {strategy}: {fault}", file.display()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn bodies_move_as_the_whole_does() {
    for file in real::files(&["animated"]) {
        let (whole, apart) = (timeline(&file, false), timeline(&file, true));
        let name = file.display();
        assert_eq!(whole.duration_s(), apart.duration_s(), "{name}");
        let mut stands = Vec::new();
        for time_s in [0.0, 0.31, 0.7] {
            let [whole, apart] = [&whole, &apart].map(|t| t.at(time_s).expect("a moment").parts);
            let stand = triangles_of(&whole);
            assert!(stand == triangles_of(&apart), "{name} at {time_s} s");
            stands.push(stand);
        }
        stands.dedup();
        assert!(
            stands.len() > 1,
            "{name} stands still: nothing was compared"
        );
    }
}
