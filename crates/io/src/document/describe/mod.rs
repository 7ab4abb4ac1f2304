//! Typed descriptions of the values of a scene file, in the file's units. Each value is declared once, at the field that holds it.
//!
//! A declaration has a type, a range and an example. Readers use the declarations to fill a description from a table, and then convert it
//! to world units. The list of paths, the reference and the viewer's panels are generated from the same declarations
//! ([`paths`](super::paths)). The style is described in the core, by [`Style`](cutaway::scene::Style).
//!
//! Declarations cannot express that two values exclude each other. Readers check that.

mod by_hand;
mod camera;
mod cut;
mod deform;
mod key;
mod part;
mod placement;
mod regions;
mod relief;
mod roles;
mod settings;
mod surface;

pub(super) use by_hand::ByHand;
pub(super) use camera::{CameraDesc, ProjectionKind};
pub(super) use cut::CutDesc;
pub(super) use deform::{DeformDesc, DeformKind};
pub use key::Interpolation;
pub(super) use key::KeyDesc;
pub(super) use part::{CapMaterialDesc, MaterialDesc, PartDesc};
pub(super) use placement::PlacementDesc;
pub(super) use regions::{AXES, BoxDesc, CutoutDesc, WedgeDesc};
pub(super) use relief::ReliefDesc;
pub(super) use roles::RolesDesc;
pub use settings::{Settings, StrategySettings};
pub(super) use surface::{ReliefUse, SurfaceDesc};
