//! Where in the pixels strokes are, and how wide: edges of layers that are made here, at known places.

use cutaway::layers::{Layer, Layers};
use cutaway::scene::style::Strokes;

use super::*;

/// Columns beside the borders of the picture that are not looked at: the staircase that leaves the picture ends there.
const MARGIN_PX: u32 = 24;

/// Outlines so many pixels wide, and nothing else.
fn outlines(width_px: f32) -> Style {
    Style {
        strokes: Strokes {
            outline: width_px * 1000.0 / SIZE_PX[1] as f32,
            ..Strokes::default()
        },
        ..Style::default()
    }
}

/// A surface where a function of the middle of a pixel says so.
fn layers_of(is_surface: impl Fn(f64, f64) -> bool) -> Layers {
    let mut layers = Layers::background(SIZE_PX);
    let width = SIZE_PX[0] as usize;
    for (i, pixel) in layers.pixels.iter_mut().enumerate() {
        if is_surface((i % width) as f64 + 0.5, (i / width) as f64 + 0.5) {
            *pixel = Layer {
                kind: Kind::Surface,
                depth: 2.0,
                normal: glam::Vec3::Z,
                ..Layer::default()
            };
        }
    }
    layers
}

fn strokes_on(session: &mut Session, layers: &Layers, width_px: f32) -> Vec<f32> {
    let model = Model::new(&scene_in(outlines(width_px)));
    let view = model.prepared.view(SIZE_PX);
    let channels = session.style_channels(&model, &view, layers);
    channels.expect("channels").stroke
}

/// The greatest distance of the middle of a stroke from the line `y = first + slope x` over the columns of a picture, and the least and
/// the greatest width.
fn off_and_widths(stroke: &[f32], first: f64, slope: f64) -> (f64, [f64; 2]) {
    let [width, height] = SIZE_PX;
    let cos = 1.0 / slope.hypot(1.0);
    let mut off = 0.0_f64;
    let mut widths = [f64::INFINITY, 0.0_f64];
    for x in MARGIN_PX..width - MARGIN_PX {
        let column = (0..height).map(|y| {
            (
                f64::from(y) + 0.5,
                f64::from(stroke[(y * width + x) as usize]),
            )
        });
        let (sum, moment) =
            column.fold((0.0, 0.0), |(s, m), (y, share)| (s + share, m + share * y));
        let line = first + slope * (f64::from(x) + 0.5);
        if line > f64::from(height - MARGIN_PX) {
            break;
        }
        off = off.max((moment / sum - line).abs() * cos);
        widths = [widths[0].min(sum * cos), widths[1].max(sum * cos)];
    }
    (off, widths)
}

#[test]
fn strokes_lie_on_slanting_edges_within_the_pixel() {
    let mut session = session();
    for width_px in [0.6, 1.6, 4.0] {
        for slope in [0.0, 0.03, 0.11, 0.21, 0.37, 0.5, 0.73, 1.0] {
            for shift in [0.0, 0.31, 0.77] {
                let first = 14.0 + shift;
                let below = layers_of(|x, y| y > first + slope * x);
                let stroke = strokes_on(&mut session, &below, width_px);
                let (off, [least, greatest]) = off_and_widths(&stroke, first, slope);
                // An edge along the pixels gives no hint of where in them it is.
                let most = if slope == 0.0 { 0.5 } else { 0.36 };
                let told = format!(
                    "{width_px} px, slope {slope}, {shift}: {off:.3} px off, {least:.3} to {greatest:.3} wide"
                );
                assert!(off <= most, "{told}");
                let width = f64::from(width_px);
                assert!(
                    (least - width).abs() < 0.15 * width && (greatest - width).abs() < 0.2 * width,
                    "{told}"
                );
            }
        }
    }
    // The control: the staircase itself, which a stroke on the borders between samples follows.
    let slope = 0.37;
    let stairs = (0..SIZE_PX[0]).map(|x| {
        let line = 14.0 + slope * (f64::from(x) + 0.5);
        ((line + 0.5).floor() - line).abs() / slope.hypot(1.0)
    });
    assert!(
        stairs.fold(0.0, f64::max) > 0.4,
        "a staircase is farther off"
    );
}

#[test]
fn strokes_keep_to_corners_and_to_edges_along_the_pixels() {
    let [x0, x1, y0, y1] = [30.0, 90.0, 25.0, 85.0];
    let square = layers_of(|x, y| x > x0 && x < x1 && y > y0 && y < y1);
    let stroke = strokes_on(&mut session(), &square, 2.0);
    let at = |x: u32, y: u32| stroke[(y * SIZE_PX[0] + x) as usize];
    // Both pixels beside each edge are alike all along, up to the corner.
    for i in 30..90 {
        for (inside, outside) in [(at(i, 25), at(i, 24)), (at(i, 84), at(i, 85))] {
            assert!(inside >= 0.87 && (30..90).contains(&i), "{i}: {inside}");
            assert!(outside >= 0.87, "{i}: {outside}");
        }
    }
    assert!(at(28, 23) < at(29, 24), "the corner is sharp");
    assert!(at(60, 60) <= 0.0, "nothing in the middle");
}
