//! Frames in the encoder and the attachments of a host: the pixels of `render`, composed by the host's depth, without a wait.

use crate::common;

mod allocations;
mod clip;
mod depth;
mod g_buffer;
mod guest;
mod host;
mod layers;
