//! Promise: what is inside of a closed mesh can be cut away, alone or with planes and reliefs, standing or moving, and every inside
//! test and both rasterisers draw it as exactly as they draw a plane.

use crate::common;
use crate::common::command;

mod agree;
mod exact;
mod files;
mod moving;
mod plans;
mod real;
mod scenes;
