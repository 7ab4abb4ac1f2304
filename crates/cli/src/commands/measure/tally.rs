//! Summary of one call of `measure`: a line per experiment, and the verdict.

use std::collections::BTreeMap;

use cutaway_lab::experiment::Reached;

use super::MeasureArgs;
use super::jobs::Job;
use crate::judge::command_line;
use crate::verdict::Verdict;

/// Jobs done for one experiment.
#[derive(Default)]
struct ExperimentTally {
    name: String,
    measured: usize,
    kept: usize,
    missing: usize,
    expected: usize,
    reached: usize,
}

fn key(job: &Job<'_>) -> [String; 2] {
    [job.definition.name.clone(), job.run.name.clone()]
}

/// Jobs done for all experiments.
#[derive(Default)]
pub(super) struct JobTally {
    lines: Vec<ExperimentTally>,
    /// Per experiment and run: the number of complete jobs, and the number of all jobs.
    runs: BTreeMap<[String; 2], [usize; 2]>,
    /// An interrupted job, which must be restarted.
    pub(super) lost: Option<String>,
    /// True if an interrupt ended the work.
    pub(super) interrupted: bool,
}

impl JobTally {
    /// A tally of these jobs, with none done yet.
    pub(super) fn of(jobs: &[Job<'_>]) -> Self {
        let mut tally = Self::default();
        for job in jobs {
            tally.runs.entry(key(job)).or_default()[1] += 1;
        }
        tally
    }

    /// Number of complete jobs and number of requested jobs in this job's run.
    pub(super) fn of_run(&self, job: &Job<'_>) -> [usize; 2] {
        self.runs.get(&key(job)).copied().unwrap_or_default()
    }

    /// Counts a complete job.
    pub(super) fn add(&mut self, job: &Job<'_>, is_kept: bool, reached: &[Reached]) {
        self.runs.entry(key(job)).or_default()[0] += 1;
        let line = self.line(job);
        line.kept += usize::from(is_kept);
        line.measured += usize::from(!is_kept);
        line.expected += reached.len();
        line.reached += reached.iter().filter(|r| r.holds).count();
    }

    /// Counts a job that this program cannot do.
    pub(super) fn missing(&mut self, job: &Job<'_>) {
        self.line(job).missing += 1;
    }

    fn line(&mut self, job: &Job<'_>) -> &mut ExperimentTally {
        let name = &job.definition.name;
        let at = self.lines.iter().position(|l| l.name == *name);
        let at = at.unwrap_or_else(|| {
            self.lines.push(ExperimentTally {
                name: name.clone(),
                ..ExperimentTally::default()
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

    /// Verdict of the invocation.
    pub(super) fn verdict(&self, jobs: usize) -> Verdict {
        if self.interrupted && self.complete() < jobs {
            Verdict::Interrupted
        } else if self.lines.iter().any(|l| l.reached < l.expected) {
            Verdict::Failed
        } else {
            Verdict::Done
        }
    }

    /// Text for standard output.
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
            let lost = self.lost.iter().map(|l| format!("lost: {l}\n"));
            text.extend(lost);
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
