//! Promise: a camera that is fitted to what the cuts keep shows it in the middle of the picture, as large as a margin of 6 % lets it be,
//! whatever is cut of whatever shape; what moves does not make it breathe; and whoever says where the camera is finds it there.

use crate::common;

mod command;
mod fitted;
mod moving;
mod sweep;
mod upright;
mod views;

use cutaway::layers::{Kind, Layers};

/// Pixels between the borders of a picture and what it shows: left, right, above, below. `None` where it shows nothing.
fn margins(size_px: [u32; 2], is_shown: impl Fn(u32, u32) -> bool) -> Option<[f64; 4]> {
    let [width, height] = size_px;
    let shown = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let shown: Vec<[u32; 2]> = shown.filter(|[x, y]| is_shown(*x, *y)).collect();
    let least = |axis: usize| shown.iter().map(|p| p[axis]).min();
    let most = |axis: usize| shown.iter().map(|p| p[axis]).max();
    let all = [
        least(0)?,
        width - 1 - most(0)?,
        least(1)?,
        height - 1 - most(1)?,
    ];
    Some(all.map(f64::from))
}

fn margins_of(layers: &Layers) -> Option<[f64; 4]> {
    let is_shown = |x, y| layers.at(x, y).kind != Kind::Background;
    margins(layers.size_px, is_shown)
}

/// Why margins are not those of a fitted picture, if they are not to so many pixels.
fn misfit(margins: [f64; 4], size_px: [u32; 2], within_px: f64) -> Option<String> {
    let wanted = 0.06 * f64::from(size_px[0].min(size_px[1]));
    let [left, right, above, below] = margins;
    let tight = (left + right).min(above + below) / 2.0;
    let is_off = |what: f64| what.abs() > within_px;
    if is_off(left - right) || is_off(above - below) {
        return Some(format!("{margins:?} is off the middle"));
    }
    is_off(tight - wanted).then(|| format!("{margins:?} instead of {wanted}"))
}
