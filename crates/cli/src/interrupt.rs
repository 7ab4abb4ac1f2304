//! Ctrl-C, and SIGTERM as batch systems and `timeout` send it: the first ends the work after the present step, with what is complete
//! kept; the second ends the process. Neither leaves a file that is half written.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use cutaway::{Error, Result};

use super::writing::output::remove_pending;

/// Flag that requests the end of the work.
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on, on behalf of a command that works in such steps.
    pub(super) fn listen(command: &str, step: &'static str) -> Result<Self> {
        let wanted = Arc::new(AtomicBool::new(false));
        let flag = wanted.clone();
        let listens = on_signal(move || {
            if flag.swap(true, Ordering::SeqCst) {
                remove_pending();
                std::process::exit(i32::from(super::verdict::INTERRUPTED));
            }
            eprintln!("\nending after the present {step}; again ends at once");
        });
        listens.map_err(|e| {
            let what = format!("signals cannot be listened to: {e}");
            Error::input(command, what, "report this")
        })?;
        Ok(Self(wanted))
    }

    /// Returns true after Ctrl-C or SIGTERM.
    pub(super) fn is_wanted(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

/// Reacts to each signal that is to end this process, in a thread of its own. SIGHUP is left to `nohup`.
#[cfg(unix)]
fn on_signal(react: impl Fn() + Send + 'static) -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    let listener = std::thread::Builder::new().name("signals".to_owned());
    listener.spawn(move || signals.forever().for_each(|_| react()))?;
    Ok(())
}

/// Reacts to Ctrl-C, in a thread of its own.
#[cfg(not(unix))]
fn on_signal(react: impl Fn() + Send + 'static) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(react)
}
