//! Cases 32 and 33: tessellated caps, by the paper's rule and by one list.

use cutaway::compare::Comparison;
use cutaway::layers::{Kind, Layers};
use cutaway::scene::{Cut, Scene, Wrap};
use glam::DVec3;

use crate::common::{Judged, Question, meshes, scenes, strategy};

fn back_faces(layers: &Layers) -> usize {
    layers.pixels.iter().filter(|p| p.back_face).count()
}

/// Decided pixels that show the background where exact has a solid, or the other way round.
fn silhouette_px(judged: &Judged) -> usize {
    let is_sky = |kind: Kind| kind == Kind::Background;
    let pairs = judged.layers.pixels.iter().zip(&judged.exact.layers.pixels);
    let undecided = &judged.exact.undecided;
    pairs
        .zip(undecided)
        .filter(|((a, b), undecided)| !**undecided && is_sky(a.kind) != is_sky(b.kind))
        .count()
}

/// A ring under hills of a few texels, deep enough that the cut makes much of the silhouette.
fn hills(camera: usize) -> Scene {
    let mut scene = scenes::of_parts("hills", meshes::parts("torus?segments=96&sides=48"), vec![]);
    let heights = scenes::map([8, 8], |x, y| {
        ((x * 5 + y * 3 + x * y) % 7) as f32 / 6.0 - 0.5
    });
    let normal = DVec3::new(-0.3, -0.25, -1.0);
    let surface = scenes::mapped(DVec3::ZERO, normal, heights, (1.1, 0.35), Wrap::Repeat);
    scene.cuts = vec![Cut::of("cut", vec![surface])];
    let (azimuth, elevation) = [(35.0, 25.0), (120.0, 8.0), (250.0, 15.0)][camera];
    scene.camera = scenes::orbit(azimuth, elevation, camera == 1);
    scene
}

#[test]
fn case_33_no_level_of_a_grid_shows_a_back_face_and_errors_fall_with_it() {
    let levels = [8, 16, 32, 64, 128, 256, 512, 1024];
    let questions: Vec<Question> = (0..3).map(|c| Question::of(&hills(c), [512; 2])).collect();
    let mut silhouettes = Vec::new();
    for cells in levels {
        let strategy = strategy(&format!("grid:{cells}+mask"));
        let mut wrong = 0;
        for question in &questions {
            let judged = question.answer(&strategy);
            assert_eq!(back_faces(&judged.layers), 0, "{strategy}");
            assert_eq!(judged.comparison.odd_parity_px, 0, "{strategy}: marked");
            wrong += silhouette_px(&judged);
        }
        silhouettes.push(wrong);
    }
    println!("silhouettes of {levels:?} cells are wrong in {silhouettes:?} pixels");
    // The box is about two repeats of 8 texels wide: from 32 cells on a cell is no larger than a texel.
    let resolved = silhouettes[2..].windows(2).filter(|pair| pair[0] >= 30);
    let mut doublings = 0;
    for pair in resolved {
        doublings += 1;
        assert!(
            pair[0] >= 3 * pair[1],
            "from {} to {} in one doubling: {silhouettes:?}",
            pair[0],
            pair[1]
        );
    }
    assert!(doublings >= 2, "too few errors to compare: {silhouettes:?}");
    assert!(silhouettes[7] * 100 < silhouettes[0], "{silhouettes:?}");
}

/// The faces of a slab that a relief meets at an angle: waves of half a thousandth.
fn near_tangent(angle_deg: f64) -> Scene {
    let slope = angle_deg.to_radians().tan();
    let normal = DVec3::new(slope, -1.0, 0.5 * slope);
    let waves = scenes::map([16, 16], |x, y| ((x + y) % 2) as f32 * WAVE);
    let surface = scenes::mapped(
        DVec3::new(0.0, 0.25 - 0.5 * f64::from(WAVE), 0.0),
        normal,
        waves,
        (1.3, 1.0),
        Wrap::Repeat,
    );
    let slab = meshes::block(DVec3::new(-0.5, -0.25, -0.5), DVec3::new(0.5, 0.25, 0.5));
    let mut scene = scenes::scene("slab", slab, vec![surface]);
    scene.camera = scenes::orbit(35.0, 50.0, false);
    scene
}

const WAVE: f32 = 5e-4;

#[test]
fn case_32_near_tangency_the_gap_of_the_paper_stays_under_its_bound_and_the_list_has_none() {
    let size = 256;
    for angle_deg in [0.1_f64, 0.01] {
        let question = Question::of(&near_tangent(angle_deg), [size; 2]);
        let raycast = question.answer(&strategy("raycast+mask"));
        assert_eq!(raycast.fault_of_exact(), None, "at {angle_deg} degrees");
        for cells in [12, 48, 192] {
            let listed = question.answer(&strategy(&format!("grid:{cells}+mask")));
            assert_eq!(
                back_faces(&listed.layers),
                0,
                "{cells} cells at {angle_deg}"
            );
            assert_eq!(
                listed.comparison.odd_parity_px, 0,
                "{cells} cells at {angle_deg}"
            );
            let paper = question.answer(&strategy(&format!("grid:{cells}+vds:1024")));
            let gap = gap_px(&paper);
            println!("at {angle_deg} degrees, {cells} cells: a gap of {gap} px");
            assert!(gap > 0, "no gap of {cells} cells at {angle_deg} degrees");
        }
    }
}

/// Pixels that look through the gap between mesh and cap.
fn gap_px(judged: &Judged) -> usize {
    let Comparison { crack_px, .. } = judged.comparison;
    crack_px
}
