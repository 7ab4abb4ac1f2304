//! Needs of bounded buffers: one word per kind, raised by passes and read to size the next frame's plan.

use super::input::Input;
use crate::plan::{Clock, Plan, Resource, ResourceId};

/// Word for crossings per pixel: `shaders/lib/lists/crossing_list.wgsl`.
pub const NEED_OF_CROSSINGS: u32 = 0;
/// Word for the number of relief cells along a ray: `shaders/lib/relief_crossing/`.
pub(crate) const NEED_OF_CELLS: u32 = 1;
/// Word for fragments.
pub const NEED_OF_FRAGMENTS: u32 = 2;
/// Word for fragments of sheets.
pub const NEED_OF_SHEETS: u32 = 3;
/// Word for triangles that a frame makes of clip-surfaces.
pub const NEED_OF_TRIANGLES: u32 = 4;
/// First of the words for sprites, which follow in order of part number.
pub(crate) const NEED_OF_SPRITES: u32 = 5;

/// The buffer of these words, for a pass on `clock`: it takes the slowest clock of all passes that write it.
pub(crate) fn need(plan: &mut Plan, input: &Input<'_>, clock: Clock) -> ResourceId {
    if let Some(id) = plan.need {
        let need = &mut plan.resources[id.0];
        need.clock = need.clock.min(clock);
        return id;
    }
    let words = NEED_OF_SPRITES as usize + input.model.prepared.parts.len();
    let id = plan.add_resource(Resource::storage("need", words as u64 * 4, clock));
    plan.need = Some(id);
    id
}
