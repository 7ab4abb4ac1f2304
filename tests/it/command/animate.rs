//! Promise: an animation is the pictures that `render` draws, in the form that was asked for, whole or not there at all.
//!
//! What was written is read back by decoders that share nothing with what wrote it but the format: those of the crate
//! `image`, and a few bytes of headers read here. A stand-in takes the place of ffmpeg, which need not be installed.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

mod encoders;
mod ffmpeg;
mod numbered;
mod options;
mod reading;
mod times;

use crate::common::command;

/// A cube that is cut, seen from a place that is given: what `render` fits by itself it fits to every picture alone.
const CUT_CUBE: &str = "shape:cube --section -z=50% --camera-position 1,1.5,3 --resolution 64,48";
