//! Promise: the section of a solid by a plane is the region that geometry says, however the plane meets vertices, edges and
//! faces, and never a panic.

#[path = "slice/closed_forms.rs"]
mod closed_forms;
mod common;
