//! Typed descriptions: what a scene file can say, in the units of the file. Each value is declared once, at the field that holds it.
//!
//! Readers fill a description from a table by the declarations, which have types, ranges and examples, and make of it what the scene
//! means in world units. The list of paths, the reference and the panels of a window are made from the same declarations
//! ([`paths`](super::paths)). The style is described in the core: [`Style`](cutaway::scene::Style).
//!
//! Cannot: say which values exclude each other. Readers check that.

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
pub(super) use regions::{AXIS_NAMES, BoxDesc, CutoutDesc, WedgeDesc};
pub(super) use relief::ReliefDesc;
pub(super) use roles::RolesDesc;
pub use settings::{Settings, StrategySettings};
pub(super) use surface::{ReliefUse, SurfaceDesc};
