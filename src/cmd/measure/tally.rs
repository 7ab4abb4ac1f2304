//! What a sitting came to: a line for each experiment, and the verdict.

use super::MeasureArgs;
use super::jobs::Job;
use crate::cmd::Verdict;
use crate::cmd::judge::command_line;
use crate::experiment::Reached;

/// What was done of one experiment.
#[derive(Default)]
struct Line {
    name: String,
    measured: usize,
    kept: usize,
    missing: usize,
    expected: usize,
    reached: usize,
}

/// What was done of all.
#[derive(Default)]
pub(super) struct Tally {
    lines: Vec<Line>,
    /// Whether somebody ended it.
    pub(super) interrupted: bool,
}

impl Tally {
    /// A job is complete.
    pub(super) fn add(&mut self, job: &Job<'_>, is_kept: bool, reached: &[Reached]) {
        let line = self.line(job);
        line.kept += usize::from(is_kept);
        line.measured += usize::from(!is_kept);
        line.expected += reached.len();
        line.reached += reached.iter().filter(|r| r.holds).count();
    }

    /// A job cannot be done by this program.
    pub(super) fn missing(&mut self, job: &Job<'_>) {
        self.line(job).missing += 1;
    }

    fn line(&mut self, job: &Job<'_>) -> &mut Line {
        let name = &job.definition.name;
        let at = self.lines.iter().position(|l| l.name == *name);
        let at = at.unwrap_or_else(|| {
            self.lines.push(Line {
                name: name.clone(),
                ..Line::default()
            });
            self.lines.len() - 1
        });
        &mut self.lines[at]
    }

    fn complete(&self) -> usize {
        self.lines
            .iter()
            .map(|l| l.measured + l.kept + l.missing)
            .sum()
    }

    /// How it came out.
    pub(super) fn verdict(&self, jobs: usize) -> Verdict {
        if self.interrupted && self.complete() < jobs {
            Verdict::Interrupted
        } else if self.lines.iter().any(|l| l.reached < l.expected) {
            Verdict::Failed
        } else {
            Verdict::Done
        }
    }

    /// For standard output.
    pub(super) fn text(&self, jobs: &[Job<'_>], args: &MeasureArgs) -> String {
        let mut text = String::new();
        for line in &self.lines {
            text.push_str(&format!(
                "{}: {} measured, {} kept",
                line.name, line.measured, line.kept
            ));
            if line.missing > 0 {
                text.push_str(&format!(", {} left out", line.missing));
            }
            if line.expected > 0 {
                let (reached, expected) = (line.reached, line.expected);
                text.push_str(&format!("; {reached} of {expected} expectations reached"));
            }
            text.push('\n');
        }
        if self.verdict(jobs.len()) == Verdict::Interrupted {
            text.push_str(&format!(
                "interrupted: {} of {} are complete; go on with\n  {}\n",
                self.complete(),
                jobs.len(),
                command_line()
            ));
        }
        text.push_str(&format!("records are in {}\n", args.out.display()));
        text
    }
}
