//! Ctrl-C: the first ends the run after the present round, with what is complete kept; the second ends the process.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::{Error, Result};

/// Whether somebody wants the run to end.
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on.
    pub(super) fn listen() -> Result<Self> {
        let wanted = Arc::new(AtomicBool::new(false));
        let heard = wanted.clone();
        let listens = ctrlc::set_handler(move || {
            if heard.swap(true, Ordering::SeqCst) {
                std::process::exit(i32::from(crate::cmd::INTERRUPTED));
            }
            eprintln!("\nending after the present round; again ends at once");
        });
        listens.map_err(|e| {
            let what = format!("Ctrl-C cannot be listened to: {e}");
            Error::input("measure", what, "report this")
        })?;
        Ok(Self(wanted))
    }

    /// Whether it was.
    pub(super) fn is_wanted(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
