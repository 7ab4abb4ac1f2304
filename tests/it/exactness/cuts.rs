//! Promise: a cut is the region that its file says, however it is written: boxes, wedges and clip-surfaces in any union and
//! intersection, farther from some parts than from others, on or off, with heights of any dimension; every exact strategy draws
//! it as the reference has it, and what is not asked for costs nothing.

use crate::common;
use crate::common::command;

mod agree;
mod areas;
mod hostile;
mod minimum;
mod moving;
mod reliefs;
mod said;

use command::Scratch;
use cutaway::scene::{Prepared, Scene};
use cutaway_io::document::Timeline;
use cutaway_lab::exact::{Exact, evaluate};

/// The scene at a time at which it is sound.
fn at(timeline: &Timeline, time_s: f64) -> Scene {
    let scene = timeline.at(time_s);
    scene.unwrap_or_else(|e| panic!("at {time_s} s: {e}"))
}

/// What is to be seen of a scene through its own camera.
fn seen(scene: &Scene, size_px: [u32; 2]) -> Exact {
    let prepared = Prepared::new(scene);
    evaluate(&prepared, &prepared.view(size_px))
}

/// A scene file of one shape called `solid`, seen by parallel rays from a direction, and a cut of these lines.
fn of_shape(shape: &str, from: [i32; 3], height: f64, cut: &str) -> String {
    let up = if from[1] == 0 && from[0] == 0 {
        [0, 1, 0]
    } else {
        [0, 0, 1]
    };
    format!(
        "[camera]\nposition = {from:?}\nfocal_point = [0, 0, 0]\nview_up = {up:?}\nprojection = \"orthographic\"\n\
         height = {height:?}\n[[part]]\nname = \"solid\"\nshape = \"{shape}\"\n[[cut]]\nname = \"front\"\n{cut}\n"
    )
}
