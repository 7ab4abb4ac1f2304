//! Ctrl-C: the first ends the work after the present step, with what is complete kept; the second ends the process. Neither leaves a
//! file that is half written.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::output::remove_pending;
use crate::{Error, Result};

/// Whether the work is to end.
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on, on behalf of a command that works in such steps.
    pub(super) fn listen(command: &str, step: &'static str) -> Result<Self> {
        let wanted = Arc::new(AtomicBool::new(false));
        let flag = wanted.clone();
        let listens = ctrlc::set_handler(move || {
            if flag.swap(true, Ordering::SeqCst) {
                remove_pending();
                std::process::exit(i32::from(super::INTERRUPTED));
            }
            eprintln!("\nending after the present {step}; again ends at once");
        });
        listens.map_err(|e| {
            let what = format!("Ctrl-C cannot be listened to: {e}");
            Error::input(command, what, "report this")
        })?;
        Ok(Self(wanted))
    }

    /// Whether Ctrl-C was pressed.
    pub(super) fn is_wanted(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
