//! Actions that may read large files are carried out in the background on a copy of the state. The state then takes over
//! the copy's result.
//!
//! If the state has not changed meanwhile, the copy replaces it. Otherwise the action is repeated on the state, at the cost of
//! a document change: the files are already read, and most prepared data comes from the copy's scene.
//!
//! Cost of a copy: a copy of the document's tree; meshes and history steps are shared.

use cutaway_io::load::Assets;

use super::State;
use crate::action::Action;
use crate::picture::shown::Shown;

/// Data read and prepared in the background.
#[derive(Clone, Debug)]
pub(super) struct Ahead {
    assets: Assets,
    pub(super) shown: Option<Shown>,
}

/// Revision counters of a state when it was copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateRevision {
    acted: u64,
    scene_revision: u64,
}

impl State {
    /// The state's present revision counters.
    pub fn moment(&self) -> StateRevision {
        StateRevision {
            acted: self.acted,
            scene_revision: self.scene_revision,
        }
    }

    /// A copy for carrying out an action, without this state's pending notices.
    #[must_use]
    pub fn copy(&self) -> Self {
        let mut copy = self.clone();
        copy.notices.clear();
        copy.opened.clear();
        copy
    }

    /// Takes over the result of an action on a copy. Returns true if the copy has replaced the state.
    pub fn take_over(&mut self, since: StateRevision, action: Action, mut copy: Self) -> bool {
        if self.acted == since.acted {
            self.notices.append(&mut copy.notices);
            self.opened.append(&mut copy.opened);
            copy.notices = std::mem::take(&mut self.notices);
            copy.opened = std::mem::take(&mut self.opened);
            *self = copy;
            return true;
        }
        if copy.scene_revision == since.scene_revision {
            // The action was refused.
            self.notices.append(&mut copy.notices);
            return false;
        }
        self.assets = copy.assets.clone();
        self.ahead = Some(Ahead {
            assets: copy.assets,
            shown: copy.shown,
        });
        self.apply(action);
        self.ahead = None;
        false
    }

    /// Assets that hold no outdated files: those read in the background, or else empty ones.
    pub(super) fn fresh_assets(&self) -> Assets {
        let read = self.ahead.as_ref().map(|ahead| ahead.assets.clone());
        read.unwrap_or_else(|| Assets::from_files(self.store.clone()))
    }
}
