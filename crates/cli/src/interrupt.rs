//! Ctrl-C, and SIGTERM as sent by batch systems and `timeout`: the first signal ends the work after the present step and keeps complete
//! results; a second signal ends the process at once. Neither leaves a half-written file.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use cutaway::{Error, Result};

use super::writing::output::remove_pending;

/// Flag that the work should end.
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Starts listening. `step` is the name of the command's steps, for the message to the user.
    pub(super) fn listen(command: &str, step: &'static str) -> Result<Self> {
        let wanted = Arc::new(AtomicBool::new(false));
        let flag = wanted.clone();
        let listens = on_signal(move || {
            if flag.swap(true, Ordering::SeqCst) {
                remove_pending();
                std::process::exit(i32::from(super::verdict::INTERRUPTED));
            }
            eprintln!("\nending after the present {step}; a second interrupt ends at once");
        });
        listens.map_err(|e| {
            let what = format!("signals cannot be received: {e}");
            Error::input(command, what, "report this")
        })?;
        Ok(Self(wanted))
    }

    /// Returns true after Ctrl-C or SIGTERM.
    pub(super) fn is_wanted(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

/// Handles each signal that should end this process, in a separate thread. SIGHUP is left to `nohup`.
#[cfg(unix)]
fn on_signal(react: impl Fn() + Send + 'static) -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    let listener = std::thread::Builder::new().name("signals".to_owned());
    listener.spawn(move || signals.forever().for_each(|_| react()))?;
    Ok(())
}

/// Handles Ctrl-C, in a separate thread.
#[cfg(not(unix))]
fn on_signal(react: impl Fn() + Send + 'static) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(react)
}
