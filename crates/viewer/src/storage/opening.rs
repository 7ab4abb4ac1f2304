//! Opens files in the background, on a copy of the state. The state [takes over](State::take_over) the result. One
//! action is carried out at a time; further actions wait.
//!
//! Cost for the window: a copy of the state, plus a document change at the end if the state has changed meanwhile.
//!
//! Cannot: stop reading a file; cancelling only drops the result. Not used in a browser, which has no threads.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use cutaway::Error;

use crate::action::Action;
use crate::beside::beside;
use crate::state::{State, StateRevision};

/// The action in progress, and the actions that wait for it.
#[derive(Debug, Default)]
pub struct Opening {
    waits: VecDeque<Action>,
    under_way: Option<UnderWay>,
}

#[derive(Debug)]
struct UnderWay {
    action: Action,
    since: StateRevision,
    done: Receiver<Box<State>>,
}

impl Opening {
    /// Returns true if an action has to be carried out in the background.
    pub fn is_for(action: &Action) -> bool {
        cfg!(not(target_arch = "wasm32")) && matches!(action, Action::Take(_) | Action::Reload)
    }

    /// Queues an action, which starts at the next [`Opening::go_on`].
    pub fn ask(&mut self, action: Action) {
        // One queued reload is enough to bring all files up to date.
        if action != Action::Reload || !self.waits.contains(&action) {
            self.waits.push_back(action);
        }
    }

    /// Returns true if an action is in progress or waits.
    pub fn is_busy(&self) -> bool {
        self.under_way.is_some() || !self.waits.is_empty()
    }

    /// Description of the action in progress, for the menu bar.
    pub fn what(&self) -> Option<String> {
        let name = |path: &PathBuf| {
            let name = path.file_name().unwrap_or(path.as_os_str());
            name.display().to_string()
        };
        match &self.under_way.as_ref()?.action {
            Action::Take(paths) => {
                let names: Vec<String> = paths.iter().map(name).collect();
                Some(format!("opening {}", names.join(", ")))
            }
            _ => Some("reading all files again".to_owned()),
        }
    }

    /// Drops the action in progress; the next one can then start.
    pub fn cancel(&mut self) {
        self.under_way = None;
    }

    /// Takes over finished actions, and begins waiting ones; `wake` is called when a result is ready. Returns true if the state was
    /// replaced by the copy on which an action was carried out.
    pub fn go_on(&mut self, state: &mut State, wake: impl FnOnce() + Send + 'static) -> bool {
        let is_another = self.take_over(state);
        if self.under_way.is_none()
            && let Some(action) = self.waits.pop_front()
        {
            let (tell, done) = channel();
            let (mut copy, own) = (Box::new(state.copy()), action.clone());
            beside(move || {
                copy.apply(own);
                copy.classify();
                // Sending fails if the action was cancelled, and is then ignored.
                let _ = tell.send(copy);
                wake();
            });
            self.under_way = Some(UnderWay {
                action,
                since: state.moment(),
                done,
            });
        }
        is_another
    }

    fn take_over(&mut self, state: &mut State) -> bool {
        let Some(under_way) = self.under_way.take() else {
            return false;
        };
        match under_way.done.try_recv() {
            Ok(copy) => state.take_over(under_way.since, under_way.action, *copy),
            Err(TryRecvError::Empty) => {
                self.under_way = Some(under_way);
                false
            }
            Err(TryRecvError::Disconnected) => {
                let help = "it is a fault of this program: please report it with the file";
                state.tell(Error::input("the file", "it could not be opened", help));
                false
            }
        }
    }
}
