//! The exact reference against closed forms, metamorphic laws and a second, slower evaluation.
//!
//! Everything else is judged by [`cutaway_lab::exact`], so nothing here asks a strategy for help: known areas and depths,
//! scenes that must give one answer in two guises, and points tested one by one with winding numbers.

mod camera;
mod laws;
mod membership;
mod meshes;
mod planes;
mod priorities;
mod reliefs;
mod solids;
mod undecided;
mod upright;
