//! Console output during a job: its steps, notes on its scene, failed expectations.

use std::cell::Cell;

use cutaway::error::Diagnostic;
use cutaway_lab::experiment::{Reached, Watcher};

use super::jobs::Job;
use crate::console::Console;
use crate::interrupt::Interrupt;

/// Reports a job to the console.
pub(super) struct Watching<'a> {
    place: String,
    console: &'a Console,
    interrupt: &'a Interrupt,
    reported: Cell<usize>,
}

impl<'a> Watching<'a> {
    pub(super) fn of(job: &Job<'_>, console: &'a Console, interrupt: &'a Interrupt) -> Self {
        Self {
            place: job.place(),
            console,
            interrupt,
            reported: Cell::new(0),
        }
    }

    /// The number of rounds lost to an interrupt, as text. The point has `steps` steps, and its rounds are the last of them.
    pub(super) fn lost(&self, steps: usize, rounds: usize) -> String {
        let before = steps - rounds;
        // The last reported round is incomplete.
        let complete = self.reported.get().saturating_sub(before + 1);
        format!("{}: {complete} of {rounds} rounds are lost", self.place)
    }
}

impl Watcher for Watching<'_> {
    fn opened(&self, message: &Diagnostic) {
        self.console.print_for(&self.place, message);
    }

    fn step(&self, what: String) {
        self.reported.set(self.reported.get() + 1);
        self.console.step(format!("{}: {what}", self.place));
    }

    fn reached(&self, reached: &Reached) {
        if reached.holds {
            return;
        }
        let declared = reached.expected.why.as_ref();
        let declared = declared.map_or_else(String::new, |w| format!(" (declared: {w})"));
        self.console.failed(format!(
            "{}: {}: expected {}{declared}, found {}",
            self.place, reached.strategy, reached.expected.what, reached.found
        ));
    }

    fn goes_on(&self) -> bool {
        !self.interrupt.is_wanted()
    }
}
