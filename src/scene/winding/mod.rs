//! Generalised winding numbers of open meshes (Jacobson, Kavan, Sorkine-Hornung 2013) from crossings along one ray.
//!
//! The *boundary chain* of a mesh M is the set of directed edges whose faces do not cancel: rims of holes, flipped faces, doubled and
//! non-manifold edges, T-junctions and loose triangles alike. It is a set of closed loops, and any triangles D that fill these loops close
//! the mesh: crossings of M and D together along any one ray count the winding number of a closed mesh, which is a whole number. The
//! number of M itself is that count minus the number of D, and the number of D is its solid angle over 4 pi:
//!
//! ```text
//! w_M(p) = crossings of M and D behind p, by direction - solid angle of D from p / 4 pi
//! ```
//!
//! This is the identity of Martens & Bessmeltsev (*One-shot method for computing generalized winding numbers*, 2025), whose sum over
//! boundary edges of spherical triangles with the ray's direction is here the sum over D of solid angles minus crossings. Here D is
//! rasterised with M, whose vertices it uses, so that both count the same samples, and the remaining term varies smoothly.
//!
//! [`Closing`] finds the chain and D, from indices alone: a mesh that moves keeps them. [`WindingTree`] sums solid angles, in a time that
//! grows with the logarithm of the number of triangles.

mod centred;
mod closing;
mod stray;
mod tree;

pub(crate) use centred::CentredTree;
pub use closing::Closing;
pub use stray::Stray;
pub use tree::{BallNode, WindingTree};
