//! Output on standard error: notes, warnings and progress.
//!
//! Progress is shown only on a terminal, and only after the work has taken a second. It is always erased at the end.

use std::fmt;
use std::io::IsTerminal;
use std::thread;
use std::time::Duration;

use cutaway::error::{Diagnostic, Severity};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work shorter than this shows no progress.
const PATIENCE: Duration = Duration::from_secs(1);

/// Number of notes about inputs that are shown without `--verbose`.
const MOST_NOTES: usize = 5;

/// Amount of console output.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct ConsoleArgs {
    /// Show the steps, the adapter and the times
    #[arg(long, conflicts_with = "quiet", help_heading = "Output")]
    pub(super) verbose: bool,
    /// Show only warnings and errors, without progress and notes
    #[arg(long, short, help_heading = "Output")]
    pub(super) quiet: bool,
}

/// Standard error.
pub(super) struct Console {
    args: ConsoleArgs,
    bar: ProgressBar,
}

impl Console {
    /// Returns a console with the requested amount of output, for work of `steps` steps.
    pub(super) fn new(args: ConsoleArgs, steps: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::hidden());
        if let Ok(style) =
            ProgressStyle::with_template("{bar:24.cyan/dim} {pos}/{len}  {msg}  {elapsed}")
        {
            bar.set_style(style);
        }
        if !args.quiet {
            let late = bar.clone();
            thread::spawn(move || {
                thread::sleep(PATIENCE);
                if !late.is_finished() {
                    late.set_draw_target(ProgressDrawTarget::stderr());
                    late.enable_steady_tick(Duration::from_millis(200));
                }
            });
        }
        Self { args, bar }
    }

    /// Prints a message; with `--quiet`, notes are not printed.
    pub(super) fn print(&self, message: &Diagnostic) {
        self.print_labelled(message.severity, message);
    }

    /// Prints a message about one of several runs, after the run's name.
    pub(super) fn print_for(&self, run: &str, message: &Diagnostic) {
        self.print_labelled(message.severity, format_args!("{run}: {message}"));
    }

    fn print_labelled(&self, severity: Severity, text: impl fmt::Display) {
        if severity > Severity::Note || !self.args.quiet {
            self.say(&format!("{}: {text}", severity.label()));
        }
    }

    /// Prints a line if there is no progress bar, that is, if standard error is not a terminal.
    pub(super) fn milestone(&self, text: impl AsRef<str>) {
        if !self.args.quiet && !std::io::stderr().is_terminal() {
            self.say(text.as_ref());
        }
    }

    /// Begins a step.
    pub(super) fn step(&self, what: impl Into<String>) {
        let what = what.into();
        self.detail(&what);
        self.bar.set_message(what);
        self.bar.inc(1);
    }

    /// Shows the estimated time of the remaining steps, from their mean time.
    pub(super) fn show_what_is_left(&self) {
        if let Ok(style) = ProgressStyle::with_template(
            "{bar:24.cyan/dim} {pos}/{len}  {elapsed}, {eta} left  {msg}",
        ) {
            self.bar.set_style(style);
        }
    }

    /// Skips steps that need not be done.
    pub(super) fn skip(&self, steps: usize) {
        let left = self.bar.length().unwrap_or(0).saturating_sub(steps as u64);
        self.bar.set_length(left);
    }

    /// From here on, steps are frames.
    pub(super) fn expect_frames(&self, count: u32) {
        if let Ok(style) = ProgressStyle::with_template(
            "{bar:24.cyan/dim} {pos}/{len} frames  {per_sec}  {eta} left  {msg}",
        ) {
            self.bar.set_style(style);
        }
        self.bar.reset();
        self.bar.set_length(u64::from(count));
        self.bar.set_message("");
    }

    pub(super) fn frame_done(&self) {
        self.bar.inc(1);
    }

    /// Reports a step after the last frame.
    pub(super) fn say_step(&self, what: &'static str) {
        self.detail(what);
        self.bar.set_message(what);
    }

    /// Prints a note on this run.
    pub(super) fn note(&self, text: impl AsRef<str>) {
        self.print_labelled(Severity::Note, text.as_ref());
    }

    /// Prints notes of one kind: the first few, and the count of the rest.
    pub(super) fn notes(&self, notes: &[Diagnostic]) {
        let shown = if self.args.verbose {
            notes.len()
        } else {
            shown_of(notes.len())
        };
        notes[..shown].iter().for_each(|note| self.print(note));
        if shown < notes.len() {
            let left = notes.len() - shown;
            self.note(format!(
                "{left} more notes about the inputs; --verbose shows all"
            ));
        }
    }

    /// Prints a warning on this run.
    pub(super) fn warn(&self, text: impl AsRef<str>) {
        self.print_labelled(Severity::Warning, text.as_ref());
    }

    /// Prints a line with `--verbose` only.
    pub(super) fn detail(&self, text: impl AsRef<str>) {
        if self.args.verbose {
            self.say(text.as_ref());
        }
    }

    /// As `detail`, for a text that is costly to compute.
    pub(super) fn detail_by(&self, text: impl FnOnce() -> String) {
        if self.args.verbose {
            self.say(&text());
        }
    }

    /// Prints which stated expectation failed.
    pub(super) fn failed(&self, text: impl AsRef<str>) {
        self.print_labelled(Severity::Failure, text.as_ref());
    }

    /// Prints an error of the program itself.
    pub(super) fn internal_error(&self, text: impl AsRef<str>) {
        self.print_labelled(Severity::InternalError, text.as_ref());
    }

    fn say(&self, text: &str) {
        self.bar.suspend(|| eprintln!("{text}"));
    }
}

/// Number of notes to show. If only one note would be left out, it is shown too: a line with the count would be as long.
fn shown_of(notes: usize) -> usize {
    if notes <= MOST_NOTES + 1 {
        notes
    } else {
        MOST_NOTES
    }
}

impl Drop for Console {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_notes_are_a_few_and_how_many_more() {
        for (notes, shown) in [(0, 0), (6, 6), (7, 5), (32, 5)] {
            assert_eq!(shown_of(notes), shown, "of {notes}");
        }
    }
}
