//! The examples run, and do what they say.

#[allow(dead_code, reason = "its `main` prints")]
#[path = "../../examples/animate.rs"]
mod animate;
#[allow(dead_code, reason = "its `main` prints")]
#[path = "../../crates/lab/examples/compare.rs"]
mod compare;
#[allow(dead_code, reason = "its `main` writes a file")]
#[path = "../../examples/embed/main.rs"]
mod embed;
#[allow(dead_code, reason = "its `main` prints")]
#[path = "../../examples/slice.rs"]
mod slice;

/// Whether a pixel shows a square of the floor: linear light of the two, as sRGB.
fn is_floor(pixel: &[u8]) -> bool {
    let squares = [[108, 149, 137], [160, 149, 137]];
    let is = |c: &[u8; 3]| pixel.iter().zip(c).all(|(a, b)| a.abs_diff(*b) <= 1);
    squares.iter().any(is)
}

#[test]
fn a_host_draws_a_floor_through_a_cut_crank() {
    let rgba = embed::draw().expect("a picture");
    let pixels = rgba.chunks_exact(4);
    let floor = pixels.clone().filter(|p| is_floor(p)).count();
    let sky = pixels.clone().filter(|p| p[..3] == [39, 48, 63]).count();
    let crank = pixels.len() - floor - sky;
    let all = [floor > 150_000, crank > 15_000, sky > 50_000];
    assert_eq!(all, [true; 3], "{floor} floor, {crank} crank, {sky} sky");
}

#[test]
fn sections_of_a_gear_are_alike_all_through() {
    let slices = slice::slices().expect("sections");
    let first = slices[0];
    assert!(first.1 > 0.1 && first.2 > 1, "{slices:?}");
    for (percent, area, loops) in slices {
        assert!((area - first.1).abs() < 1e-9, "{percent} %: {area}");
        assert_eq!(loops, first.2, "{percent} %");
    }
}

#[test]
fn the_exact_method_errs_nowhere_and_the_paper_somewhere() {
    let errors = compare::errors().expect("two frames");
    assert_eq!((errors[0].1, errors[0].2), (0, 0), "{errors:?}");
    assert!(errors[1].1 > 0, "{errors:?}");
}

#[test]
fn a_turning_crank_stays_cut() {
    let frames = animate::frames().expect("frames");
    assert!(frames.iter().all(|f| f.1 > 300), "{frames:?}");
    assert!(frames[0].1 != frames[1].1, "it turns: {frames:?}");
}
