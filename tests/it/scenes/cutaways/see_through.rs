//! Rules R6 and R7 of Diepstraten, Weiskopf and Ertl (2003): what is inside is not hidden from anywhere, by as many openings as there are
//! clusters.

use cutaway::scene::{Amount, Clusters};

use super::*;
use crate::common::{is_long, some};

const SIZE_PX: [u32; 2] = [96, 72];

/// How many decided pixels show an interior where there is nothing else, and how many of these do not in the scene with its openings.
fn hidden(scene: &Scene, open: &Question, camera: &Camera) -> [usize; 2] {
    let mut alone = scene.clone();
    alone.parts.retain(|p| p.role == Role::Interior);
    alone.cuts.clear();
    alone.camera = *camera;
    let truth = Question::new(&alone, SIZE_PX);
    let names: Vec<usize> = (scene.parts.iter().enumerate())
        .filter(|(_, p)| p.role == Role::Interior)
        .map(|(i, _)| i)
        .collect();
    let mut counts = [0; 2];
    for (i, wanted) in truth.exact.layers.pixels.iter().enumerate() {
        if wanted.kind != Kind::Surface || truth.exact.undecided[i] || open.exact.undecided[i] {
            continue;
        }
        counts[0] += 1;
        let shown = &open.exact.layers.pixels[i];
        let is_shown = shown.kind == Kind::Surface
            && usize::from(shown.part) == names[usize::from(wanted.part)];
        counts[1] += usize::from(!is_shown);
    }
    counts
}

#[test]
fn what_is_inside_is_seen_from_everywhere() {
    let mut wrong = 0;
    for scene in boxes_with_something_inside() {
        let bounds = scene.bounds();
        let mut seen = 0;
        // From far away, and from so near that the eye is within the opening.
        let near_and_far = cameras_around(&bounds, 64, 4.0).chain(cameras_around(&bounds, 16, 1.1));
        let near_and_far = some(near_and_far, 3);
        let mut before: Option<Question> = None;
        for camera in near_and_far {
            let mut scene = scene.clone();
            scene.camera = camera;
            let (_, question) = opened(&scene, SIZE_PX);
            let [all, missing] = hidden(&scene, &question, &camera);
            assert_eq!(missing, 0, "{}: {camera:?}", scene.name);
            seen += all;
            // The control: an opening for the camera before hides some.
            if let Some(before) = before {
                wrong += hidden(&scene, &before, &camera)[1];
            }
            before = Some(question);
        }
        assert!(
            seen > if is_long() { 5000 } else { 1500 },
            "{}: {seen} pixels",
            scene.name
        );
    }
    assert!(
        wrong > if is_long() { 1000 } else { 300 },
        "{wrong} pixels of wrong openings are noticed"
    );
}

#[test]
fn the_bearings_of_a_gearbox_are_seen_from_everywhere() {
    for file in real::files(&["assembly"]) {
        if !file.ends_with("cycloidal_drive.ply") {
            continue;
        }
        let folder = command::Scratch::new("gearbox");
        let text = format!(
            "roles = \"auto\"\npart = [{{ mesh = {file:?}, split = true }}]\ncut = [{{ breakaway = {{}} }}]"
        );
        let mut scene = folder.scene(&text);
        scene.stage = Some(scene.bounds());
        let (mut before, mut wrong): (Option<Question>, usize) = (None, 0);
        for camera in cameras_around(&scene.bounds(), 12, 3.0) {
            scene.camera = camera;
            let (_, question) = opened(&scene, SIZE_PX);
            let [all, missing] = hidden(&scene, &question, &camera);
            assert!(all > 50 && missing == 0, "{missing} of {all}: {camera:?}");
            if let Some(before) = before {
                wrong += hidden(&scene, &before, &camera)[1];
            }
            before = Some(question);
        }
        assert!(wrong > 100, "{wrong} pixels of wrong openings are noticed");
    }
}

/// Pixels that show something else than the scene without cuts does.
fn gone(scene: &Scene, open: &Layers) -> Vec<bool> {
    let mut whole = scene.clone();
    whole.cuts.clear();
    let uncut = Question::new(&whole, open.size_px).exact.layers.clone();
    let pairs = uncut.pixels.iter().zip(&open.pixels);
    pairs
        .map(|(a, b)| a.kind != b.kind || a.part != b.part || (a.depth - b.depth).abs() > 1e-6)
        .collect()
}

/// How many connected groups of more than a few pixels there are.
fn groups(mut pixels: Vec<bool>, width: usize) -> usize {
    let mut count = 0;
    while let Some(first) = pixels.iter().position(|p| *p) {
        let (mut queue, mut size) = (vec![first], 0);
        while let Some(at) = queue.pop() {
            if !std::mem::replace(&mut pixels[at], false) {
                continue;
            }
            size += 1;
            let x = at % width;
            let sides = [
                (x > 0).then(|| at - 1),
                (x + 1 < width).then_some(at + 1),
                at.checked_sub(width),
                Some(at + width),
            ];
            queue.extend(sides.into_iter().flatten().filter(|i| *i < pixels.len()));
        }
        count += usize::from(size > 4);
    }
    count
}

#[test]
fn there_are_as_many_openings_as_clusters_and_they_shrink_with_the_distance() {
    let scenes = boxes_with_something_inside();
    let two = scenes.iter().find(|s| s.name == "two").expect("it");
    let mut last = usize::MAX;
    for distance in [20.0, 8.0, 4.0, 1.0, 0.0] {
        let mut areas = Vec::new();
        for (clusters, count) in [(Clusters::Auto, 2), (Clusters::One, 1)] {
            let mut scene = two.clone();
            scene.camera = Camera {
                viewpoint: Viewpoint::Orbit {
                    azimuth_deg: 20.0,
                    elevation_deg: 10.0,
                },
                ..Camera::default()
            };
            scene.cuts[0].breakaway = Some(Breakaway {
                distance: Amount::Percent(distance),
                bevel_deg: 0.0,
                clusters,
                ..Breakaway::default()
            });
            let (open, question) = opened(&scene, [240, 180]);
            let gone = gone(&scene, &question.exact.layers);
            areas.push(gone.iter().filter(|g| **g).count());
            // Those so large that they meet are one.
            let count = if distance > 8.0 { 1 } else { count };
            assert_eq!(open.cuts.len(), count, "{distance} %, {clusters:?}");
            assert_eq!(groups(gone, 240), count, "{distance} %, {clusters:?}");
        }
        assert!(areas[0] <= areas[1], "one opening is no smaller: {areas:?}");
        assert!(areas[0] < last, "{} after {last}", areas[0]);
        last = areas[0];
    }
}
