//! Cases 32 and 33: tessellated caps, by the paper's rule and by one list.

use cutaway::layers::Kind;
use cutaway::scene::{Cut, Scene, Wrap};
use glam::{DVec2, DVec3};

use crate::common::{Judged, Question, meshes, scenes, strategy, tolerances};

/// Decided pixels that show a back face: on an outline the two faces of an edge lie within rounding of each other.
fn back_faces(judged: &Judged) -> usize {
    let pixels = judged.layers.pixels.iter().zip(&judged.exact.undecided);
    pixels
        .filter(|(p, undecided)| p.back_face && !**undecided)
        .count()
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
    scene.cuts = vec![Cut::new("cut", vec![surface])];
    let (azimuth, elevation) = [(35.0, 25.0), (120.0, 8.0), (250.0, 15.0)][camera];
    scene.camera = scenes::orbit(azimuth, elevation, camera == 1);
    scene
}

#[test]
fn case_33_no_level_of_a_grid_shows_a_back_face_and_errors_fall_with_it() {
    let levels = [8, 16, 32, 64, 128, 256, 512, 1024];
    let questions: Vec<Question> = (0..3).map(|c| Question::new(&hills(c), [512; 2])).collect();
    let mut silhouettes = Vec::new();
    for cells in levels {
        let strategy = strategy(&format!("grid:{cells}+mask"));
        let mut wrong = 0;
        for question in &questions {
            let judged = question.answer(strategy);
            assert_eq!(back_faces(&judged), 0, "{strategy}");
            assert_eq!(judged.comparison.odd_parity_px, 0, "{strategy}: marked");
            wrong += silhouette_px(&judged);
        }
        silhouettes.push(wrong);
    }
    println!("silhouettes of {levels:?} cells are wrong in {silhouettes:?} pixels");
    // The grid is about two repeats of 8 texels wide: from 64 cells on there are several to a texel.
    let resolved: Vec<&[usize]> = (silhouettes[3..].windows(2))
        .filter(|pair| pair[0] >= 16)
        .collect();
    let are_few = resolved.len() < 2 && tolerances::holds_lower_bounds();
    assert!(!are_few, "too few errors: {silhouettes:?}");
    for pair in resolved {
        let [before, after] = [pair[0], pair[1]];
        assert!(
            before as f64 * tolerances::coarse_room() >= 3.0 * after as f64,
            "from {before} to {after} in one doubling: {silhouettes:?}"
        );
    }
    assert!(silhouettes[7] * 100 < silhouettes[0], "{silhouettes:?}");
}

/// A slab and a relief that meets its upper face at an angle: heights of half a thousandth, even or rough, of so many texels along
/// a side.
fn near_tangent(angle_deg: f64, texels: u32) -> Scene {
    let slope = angle_deg.to_radians().tan();
    let normal = DVec3::new(slope, -1.0, 0.5 * slope);
    let height = |x: u32, y: u32| match texels {
        EVEN => ((x + y) % 2) as f32,
        _ => (x * 7 + y * 13 + x * y * 5) as f32 * 0.618 % 1.0,
    };
    let waves = scenes::map([texels; 2], |x, y| height(x, y) * WAVE);
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
const EVEN: u32 = 16;
const ROUGH: u32 = 200;

/// The largest distance from a relief to a grid of so many cells along a side of the box, in world units: a Lipschitz bound.
fn chord_error(cells: u32, texels: u32) -> f64 {
    // Neighbours differ by a wave in both directions; the footprint of the slab is a square turned by half a right angle at most.
    let slope = 2.0_f64.sqrt() * f64::from(WAVE) / (1.3 / f64::from(texels));
    let cell = 1.5 / f64::from(cells);
    (slope * cell / 2.0_f64.sqrt()).min(f64::from(WAVE))
}

/// By how much the clip-surface is beside the upper face at each pixel of it that is decided and wrong: the gap is this over the
/// sine of the angle, along the face.
fn gaps(question: &Question, judged: &Judged, scene: &Scene) -> Vec<f64> {
    let surface = &scene.cuts[0].surfaces[0];
    let scale = question.model.prepared.scale;
    let size = question.view.size_px[0] as usize;
    let on_face = |pixel: usize| {
        let at = DVec2::new((pixel % size) as f64 + 0.5, (pixel / size) as f64 + 0.5);
        let (origin, direction) = question.view.ray(at);
        let (origin, direction) = (origin / scale, direction / scale);
        let point = origin + direction * ((0.25 - origin.y) / direction.y);
        // A margin of some texels of the sprite, which errs along its edges.
        (point.x.abs().max(point.z.abs()) < 0.49).then_some(point)
    };
    let points = judged.decided_wrong().filter_map(on_face);
    points.map(|p| surface.kept_height(p).abs()).collect()
}

#[test]
fn case_32_near_tangency_the_gap_of_the_paper_stays_under_its_bound_and_the_list_shows_no_back() {
    let mut see_through = Vec::new();
    for (texels, angle_deg) in [(EVEN, 0.1), (EVEN, 0.01), (ROUGH, 0.1), (ROUGH, 0.01)] {
        let scene = near_tangent(angle_deg, texels);
        let question = Question::new(&scene, [256; 2]);
        let raycast = question.answer(strategy("raycast+mask"));
        assert_eq!(raycast.fault_of_exact(), None, "at {angle_deg} degrees");
        for cells in [12, 48, 192] {
            let what = format!("{cells} cells, {texels} texels at {angle_deg} degrees");
            let listed = question.answer(strategy(&format!("grid:{cells}+mask")));
            assert_eq!(back_faces(&listed), 0, "{what}");
            assert_eq!(listed.comparison.odd_parity_px, 0, "{what}");
            let paper = question.answer(strategy(&format!("grid:{cells}+vds:1024")));
            let gaps = gaps(&question, &paper, &scene);
            let widest = gaps.iter().copied().fold(0.0, f64::max);
            let bound = chord_error(cells, texels);
            let crack_px = paper.comparison.crack_px;
            println!(
                "{what}: {crack_px} px see through, {} wrong on the face by {widest:.1e} of {bound:.1e}",
                gaps.len()
            );
            assert!(widest < bound + ROUNDING, "{what}: {widest} over {bound}");
            see_through.push(crack_px);
        }
    }
    if !tolerances::holds_lower_bounds() {
        return;
    }
    // The same chord error gapes wider where the angle is less, and a relief with a texel to each cell of the finest level has gaps
    // at all of them.
    let [even, even_less, rough, rough_less] = [0, 3, 6, 9].map(|i| &see_through[i..i + 3]);
    assert!(
        even_less[0] > 4 * even[0] && even[0] > 50,
        "{see_through:?}"
    );
    for gaps in [rough, rough_less] {
        let falls = gaps[0] > gaps[1] && gaps[1] > gaps[2];
        assert!(falls && gaps[2] > 10, "{see_through:?}");
    }
}

/// Heights that f32 may be off by, where the surface and the face nearly agree.
const ROUNDING: f64 = 2e-6;
