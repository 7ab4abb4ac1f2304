//! Promise: a part that lies wholly on the removed side has no cap, closed or open, in the reference as in every strategy (hard case 61).

use super::*;

/// A pane.
fn sheet() -> Mesh {
    Mesh {
        positions: [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| DVec3::new(x, y, 0.0))
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

#[test]
fn an_open_part_that_is_wholly_removed_has_no_cap() {
    let bowl = meshes::without(&block(DVec3::splat(-0.6), DVec3::new(0.6, 0.6, 1.0)), 3);
    for (name, open) in [("pane", sheet()), ("bowl", bowl)] {
        for normal in [DVec3::Z, DVec3::new(0.3, -0.5, 1.0).normalize()] {
            for relief in [None, Some("fractal:amplitude=4%")] {
                let what = format!("{name}, {normal}, {relief:?}");
                let closed = block(DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 4.0));
                let parts = vec![Part::new(name, open.clone()), Part::new("box", closed)];
                let mut surface = ClipSurface::plane(DVec3::Z * 2.6, normal);
                if let Some(relief) = relief {
                    let whole = of_parts(&what, parts.clone(), Vec::new());
                    surface = common::scenes::relief(&whole, "z=2.6", relief);
                }
                let scene = of_parts(&what, parts, vec![surface]);
                // Through the pane to the cap.
                let camera = looking(DVec3::new(0.3, -0.2, -6.0), DVec3::Z * 2.0, 30.0);
                let question = Question::through(&scene, &camera, [96, 72]);
                let caps = question
                    .exact
                    .layers
                    .pixels
                    .iter()
                    .filter(|p| p.kind == Kind::Cap);
                assert!(caps.clone().count() > 300, "{what}");
                assert!(caps.into_iter().all(|p| p.part == 1), "{what}");
                for method in [
                    "raycast+mask",
                    "raycast+mask@compute",
                    "raycast+abuffer",
                    "winding",
                ] {
                    let Ok(method) = method.parse::<Method>() else {
                        continue;
                    };
                    let judged = question.answer(method);
                    assert_eq!(judged.comparison.decided_wrong_px, 0, "{what}: {method}");
                }
            }
        }
    }
}

#[test]
fn an_open_part_that_is_cut_keeps_its_cap() {
    // The control: what reaches across the plane is cut as ever.
    let bowl = meshes::without(&block(DVec3::splat(-0.6), DVec3::new(0.6, 0.6, 3.0)), 3);
    let scene = of_parts(
        "cut",
        vec![Part::new("bowl", bowl)],
        vec![ClipSurface::plane(DVec3::Z * 2.6, DVec3::Z)],
    );
    let camera = looking(DVec3::new(0.3, -0.2, -6.0), DVec3::Z * 2.0, 30.0);
    let question = Question::through(&scene, &camera, [96, 72]);
    assert!(question.exact.layers.count(Kind::Cap) > 100);
}
