//! The mesh on a screen, as buffers and bindings; [`draw::screen`](crate::passes::draw::screen) records the pass that fills them.

use super::touched::Touched;
use crate::passes::draw::share::Share;
use crate::plan::{Binding, Clock, ResourceId};

/// A mesh on a screen, ready to be swept.
#[derive(Clone, Debug)]
pub(crate) struct ScreenMesh {
    pub(crate) name: String,
    pub(crate) clock: Clock,
    pub(crate) frame: Binding,
    pub(crate) drawn_parts: Binding,
    pub(crate) indices: Binding,
    /// The groups of preclassified triangles, if they have rows of their own.
    pub(crate) preclassified: Option<Binding>,
    /// Parameters of the first sweep.
    pub(crate) sweep: Binding,
    /// Parameters of later sweeps.
    pub(crate) sweep_again: Binding,
    pub(crate) triangle_count: u32,
    pub(crate) vertices: ResourceId,
    pub(crate) queue: ResourceId,
    /// Workgroup count for the queued triangles.
    pub(crate) pieces: ResourceId,
    pub(crate) share: Share,
    /// True if a pass before the first sweep has filled the queue.
    pub(crate) is_queued: bool,
    /// True if there is only one part.
    pub(crate) has_one_row: bool,
    /// True if some part may reach beyond the near plane or the guard band.
    pub(crate) may_clip: bool,
}

/// The mesh on a frame's screen, before the first sweep.
#[derive(Clone, Debug)]
pub(crate) struct OnScreen {
    pub(crate) screen: ScreenMesh,
    pub(crate) nearest: ResourceId,
    pub(crate) layers: ResourceId,
    pub(crate) picture: Option<ResourceId>,
    /// The touched tiles, found by the first sweep, or by an earlier pass that then also fills the queue.
    pub(crate) touched: Touched,
}
