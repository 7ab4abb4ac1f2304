//! The exact reference against closed forms, metamorphic laws and a second, slower evaluation.
//!
//! Everything else is judged by [`cutaway::exact`], so nothing here asks a strategy for help: known areas and depths,
//! scenes that must give one answer in two guises, and points tested one by one with winding numbers.

#[path = "exact/camera.rs"]
mod camera;
#[path = "exact/laws.rs"]
mod laws;
#[path = "exact/membership.rs"]
mod membership;
#[path = "exact/meshes.rs"]
mod meshes;
#[path = "exact/planes.rs"]
mod planes;
#[path = "exact/priorities.rs"]
mod priorities;
#[path = "exact/reliefs.rs"]
mod reliefs;
#[path = "exact/solids.rs"]
mod solids;
#[path = "exact/undecided.rs"]
mod undecided;
#[path = "exact/upright.rs"]
mod upright;
