//! Cases 23, 30, 31, 32 and 48: what reliefs ask beyond their outcome.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, OffsetMap, Wrap};
use cutaway::strategies::Strategy;
use glam::DVec3;

use crate::common::{Question, class_of, meshes, scenes, strategy, tolerances};

#[test]
fn case_23_a_ramp_is_a_tilted_plane() {
    // Height rises by 0.4 between texel centres half a period apart: a slope of 1/2 along U.
    let map = scenes::map([2, 1], |x, _| x as f32 - 0.5);
    let normal = DVec3::new(-0.3, -0.5, -1.0).normalize();
    let surface = scenes::mapped(DVec3::ZERO, normal, map, (4.0, 1.0), Wrap::Clamp);
    let frame = surface.frame();
    // F = d.N + f Sz with f = (d.U) / 2 between the texel centres, which lie beyond the solid.
    let plane = ClipSurface::plane(DVec3::ZERO, frame.normal + frame.u_hat * 0.5);
    let ball = || meshes::shape("sphere?subdivisions=3");
    let ramp = Question::new(&scenes::scene("ramp", ball(), vec![surface]), [256; 2]);
    let flat = Question::new(&scenes::scene("plane", ball(), vec![plane]), [256; 2]);
    let (ramp, flat) = [ramp, flat]
        .map(|q| q.answer(Strategy::RAYCAST_MASK))
        .into();
    let mut caps = 0;
    for (i, (a, b)) in ramp
        .layers
        .pixels
        .iter()
        .zip(&flat.layers.pixels)
        .enumerate()
    {
        if ramp.exact.undecided[i] || flat.exact.undecided[i] {
            continue;
        }
        assert_eq!(class_of(a), class_of(b), "{}", ramp.describe(i));
        if a.kind == Kind::Cap {
            caps += 1;
            assert!(
                (a.depth - b.depth).abs() < tolerances::SAME_DEPTH,
                "{} and {} at pixel {i}",
                a.depth,
                b.depth
            );
        }
    }
    assert!(caps > 5000, "only {caps} cap pixels");
}

#[test]
fn case_30_heights_that_are_no_numbers_are_refused() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let refused = OffsetMap::new([2, 2], vec![0.0, 1.0, bad, 0.5]);
        let reason = refused.expect_err("a height that is no number");
        assert!(reason.contains("(0, 1)"), "which texel: {reason}");
    }
    let tiny = f32::MIN_POSITIVE / 4.0;
    let map = OffsetMap::new([2, 1], vec![tiny, -tiny]).expect("denormals are numbers");
    assert_eq!(
        map.texels(),
        [0.0, 0.0],
        "adapters may flush them, so they are flushed before"
    );
}

#[test]
fn case_31_a_map_of_4096_texels_a_side() {
    let map = scenes::map([4096; 2], |x, y| {
        ((x / 512 + y / 512) % 2) as f32 + (x as f32 * 1e-3).sin()
    });
    let normal = DVec3::new(-0.3, -0.5, -1.0);
    let surface = scenes::mapped(DVec3::ZERO, normal, map, (1.2, 0.1), Wrap::Repeat);
    let scene = scenes::scene(
        "large",
        meshes::shape("sphere?subdivisions=3"),
        vec![surface],
    );
    let judged = Question::new(&scene, [64; 2]).answer(Strategy::RAYCAST_MASK);
    assert_eq!(judged.fault_of_exact(), None, "16 million texels");
    assert!(
        judged.layers.count(Kind::Cap) > 500,
        "the cap is in the picture"
    );
}

#[test]
fn case_32_the_gap_of_the_grid_grows_as_the_cut_becomes_tangent() {
    // A coarse grid against the same relief, steeper and steeper to the face: its chord error stays, its gap must not.
    let paper = strategy("grid:12+vds:1024");
    let gaps: Vec<usize> = [40.0_f64, 10.0, 2.5]
        .iter()
        .map(|angle_deg| {
            let slope = angle_deg.to_radians().tan();
            let normal = DVec3::new(slope, -1.0, 0.5 * slope);
            let waves = scenes::map([16, 16], |x, y| ((x + y) % 2) as f32 * 0.01);
            let surface = scenes::mapped(
                DVec3::new(0.0, 0.24, 0.0),
                normal,
                waves,
                (1.3, 1.0),
                Wrap::Repeat,
            );
            let slab = meshes::block(DVec3::new(-0.5, -0.25, -0.5), DVec3::new(0.5, 0.25, 0.5));
            let mut scene = scenes::scene("slab", slab, vec![surface]);
            scene.camera = scenes::orbit(35.0, 50.0, false);
            let question = Question::new(&scene, [256; 2]);
            let exact = question.answer(Strategy::RAYCAST_MASK);
            assert_eq!(exact.fault_of_exact(), None, "at {angle_deg} degrees");
            question.answer(paper).comparison.decided_wrong_px
        })
        .collect();
    println!("decided wrong pixels of {paper} at 40, 10 and 2.5 degrees: {gaps:?}");
    for pair in gaps.windows(2).filter(|_| tolerances::holds_lower_bounds()) {
        assert!(
            pair[1] as f64 > 1.5 * pair[0] as f64,
            "the gap does not grow: {gaps:?}"
        );
    }
}

#[test]
fn case_48_the_length_of_v_counts_and_its_angle_must_be_right() {
    let scene = &scenes::of_case("48-anisotropic", 256)[1];
    let as_meant = Question::new(scene, [256; 2]).answer(Strategy::RAYCAST_MASK);
    assert_eq!(
        as_meant.fault_of_exact(),
        None,
        "U and V of different lengths"
    );
    // The paper's listing divides both coordinates by |U|: as if V were as long as U.
    let mut as_printed = scene.clone();
    let surface = &mut as_printed.cuts[0].surfaces[0];
    surface.v = surface.v.normalize() * surface.u.length();
    let printed = Question::new(&as_printed, [256; 2]).answer(Strategy::RAYCAST_MASK);
    let differing = (0..printed.layers.pixels.len())
        .filter(|i| printed.layers.pixels[*i] != as_meant.layers.pixels[*i])
        .count();
    assert!(
        differing > 2000,
        "the listing as printed differs in {differing} pixels only"
    );

    let mut skewed = scene.cuts[0].surfaces[0].clone();
    skewed.v += skewed.u * 0.1;
    let defect = skewed.defect().expect("a skewed frame");
    assert!(defect.contains("orthogonal"), "{defect}");
}
