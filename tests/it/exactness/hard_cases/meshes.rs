//! Cases 4, 5, 6, 19 and 20: what awkward meshes ask beyond their outcome.

use cutaway::layers::Kind;
use cutaway::scene::ClipSurface;
use cutaway::strategies::Strategy;
use glam::DVec3;

use crate::common::{Judged, Question, class_of, coarseness, meshes, scenes};

#[test]
fn case_04_and_05_every_pixel_counts_even() {
    for px in [64, 256] {
        for shape in ["cube?divisions=8", "slivers", "sponge?level=2"] {
            for mut scene in scenes::of_case("04-rays-through-vertices", px) {
                scene.parts[0].mesh = meshes::shape(shape).into();
                let judged = Question::new(&scene, [px; 2]).answer(Strategy::RAYCAST_MASK);
                let odd = judged.layers.pixels.iter().filter(|p| p.unreliable).count();
                assert_eq!(odd, 0, "{shape}, {} at {px}", scene.name);
            }
        }
    }
}

#[test]
fn case_04_the_vertices_do_lie_at_pixel_centres() {
    let scene = &scenes::of_case("04-rays-through-vertices", 64)[0];
    let question = Question::new(scene, [64; 2]);
    let positions = &question.model.prepared.parts[0].positions;
    let off = positions
        .iter()
        .map(|p| question.view.project(p.as_dvec3()).0)
        .map(|at| (at - 0.5 - (at - 0.5).round()).abs().max_element())
        .fold(0.0, f64::max);
    assert!(off < 1e-12, "a vertex is {off} px from a pixel centre");
    assert!(
        question.exact.undecided_px() > 50,
        "samples on outlines are undecided"
    );
}

fn cut_cube(mesh: cutaway::scene::Mesh) -> cutaway::scene::Scene {
    let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(-0.2, -0.1, -1.0));
    scenes::scene("cube", mesh, vec![plane])
}

#[test]
fn case_06_triangles_without_area_change_nothing() {
    let cube = meshes::shape("cube");
    for px in [64, 256] {
        let plain = Question::new(&cut_cube(cube.clone()), [px; 2]).answer(Strategy::RAYCAST_MASK);
        let mesh = meshes::with_degenerate(&cube);
        assert!(
            mesh.triangles.len() > cube.triangles.len(),
            "nothing was added"
        );
        let mixed = Question::new(&cut_cube(mesh), [px; 2]).answer(Strategy::RAYCAST_MASK);
        let differing = |other: &Judged| {
            (0..plain.layers.pixels.len())
                .filter(|i| !plain.exact.undecided[*i] && !other.exact.undecided[*i])
                .filter(|i| {
                    class_of(&plain.layers.pixels[*i]) != class_of(&other.layers.pixels[*i])
                })
                .count()
        };
        // A corner on an edge that is moved off it by a sixteenth of a pixel leaves an area.
        match coarseness() > 1.0 {
            true => assert_eq!(differing(&mixed), 0, "at {px}"),
            false => assert_eq!(plain.layers, mixed.layers, "at {px}"),
        }
        // Needles move depths by a rounding, decisions not at all.
        let mesh = meshes::with_needles(&cube, 1e-6);
        let needles = Question::new(&cut_cube(mesh), [px; 2]).answer(Strategy::RAYCAST_MASK);
        assert_eq!(differing(&needles), 0, "needles at {px}");
    }
}

#[test]
fn case_19_nothing_is_inside_a_doubled_mesh() {
    let question = Question::new(&scenes::of_case("19-doubled", 256)[0], [256; 2]);
    let judged = question.answer(Strategy::RAYCAST_MASK);
    assert_eq!(
        judged.layers.count(Kind::Cap),
        0,
        "by parity there is no inside"
    );
    let single = Question::new(&scenes::torus_cut(), [256; 2]).answer(Strategy::RAYCAST_MASK);
    assert!(
        single.layers.count(Kind::Cap) > 1000,
        "of the single mesh there is"
    );
}

#[test]
fn case_20_the_missing_triangle_is_marked_pixel_by_pixel() {
    for px in [64, 256] {
        for scene in scenes::of_case("20-open", px) {
            let question = Question::new(&scene, [px; 2]);
            let judged = question.answer(Strategy::RAYCAST_MASK);
            let exact = &judged.exact;
            let odd = exact.odd_parity.iter().filter(|o| **o).count();
            assert!(
                odd > px as usize / 16,
                "{}: only {odd} odd pixels",
                scene.name
            );
            let mismarked = (0..judged.layers.pixels.len())
                .filter(|i| !exact.undecided[*i])
                .filter(|i| judged.layers.pixels[*i].unreliable != exact.odd_parity[*i])
                .count();
            assert_eq!(mismarked, 0, "{} at {px}", scene.name);
        }
    }
}
