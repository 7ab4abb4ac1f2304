//! An action that is carried out on a copy of the state, elsewhere, because it reads files that may be large, and what the state takes
//! over of the copy.
//!
//! Where nothing was done meanwhile the copy takes the place of the state. Else the action is carried out once more, which costs what a
//! change of the document costs: the files are read, and the scene of the copy is what the new one has most in common with.
//!
//! Cost of a copy: the tree of the document; meshes and steps of the history are shared.

use cutaway_io::load::Assets;

use super::State;
use crate::action::Action;
use crate::picture::shown::Shown;

/// Data read and prepared elsewhere.
#[derive(Clone, Debug)]
pub(super) struct Ahead {
    assets: Assets,
    pub(super) shown: Option<Shown>,
}

/// Progress of a state when it was copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    acted: u64,
    scene_revision: u64,
}

impl State {
    /// Present progress.
    pub fn moment(&self) -> Moment {
        Moment {
            acted: self.acted,
            scene_revision: self.scene_revision,
        }
    }

    /// A copy to carry an action out on, without the pending notices of this state.
    #[must_use]
    pub fn copy(&self) -> Self {
        let mut copy = self.clone();
        copy.notices.clear();
        copy.opened.clear();
        copy
    }

    /// Takes over what an action has made of the copy of a moment. Whether the copy has taken its place.
    pub fn take_over(&mut self, since: Moment, action: Action, mut copy: Self) -> bool {
        if self.acted == since.acted {
            self.notices.append(&mut copy.notices);
            self.opened.append(&mut copy.opened);
            copy.notices = std::mem::take(&mut self.notices);
            copy.opened = std::mem::take(&mut self.opened);
            *self = copy;
            return true;
        }
        if copy.scene_revision == since.scene_revision {
            // It was refused.
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

    /// Assets that hold nothing from before: those that were read elsewhere, or none.
    pub(super) fn fresh_assets(&self) -> Assets {
        let read = self.ahead.as_ref().map(|ahead| ahead.assets.clone());
        read.unwrap_or_else(|| Assets::from_files(self.store.clone()))
    }
}
