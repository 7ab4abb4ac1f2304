//! `--shard`: the share of the work for this process, given in numbers or by the scheduler that started it.
//!
//! Shards neither communicate nor wait: each computes the same division from the same files, and all write into one folder.

use std::fmt;
use std::str::FromStr;

/// One share out of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    /// Index of the share, from 0.
    pub(crate) index: u32,
    /// Number of shares; never 0.
    pub(crate) count: u32,
}

/// Maximum number of shares; a larger number is probably a typing error.
const MOST: u32 = 1_000_000;

/// A scheduler's variables: number of the task, number of the first task, step between numbers, and the task count or the last number.
struct Scheduler {
    name: &'static str,
    task: &'static str,
    first: Option<&'static str>,
    step: Option<&'static str>,
    count: Option<&'static str>,
    last: Option<&'static str>,
    /// Number of the first task if the variable is not set.
    usual_first: u32,
}

const SCHEDULERS: [Scheduler; 6] = [
    Scheduler {
        name: "Slurm",
        task: "SLURM_ARRAY_TASK_ID",
        first: Some("SLURM_ARRAY_TASK_MIN"),
        step: Some("SLURM_ARRAY_TASK_STEP"),
        count: Some("SLURM_ARRAY_TASK_COUNT"),
        last: None,
        usual_first: 0,
    },
    Scheduler {
        name: "Grid Engine",
        task: "SGE_TASK_ID",
        first: Some("SGE_TASK_FIRST"),
        step: Some("SGE_TASK_STEPSIZE"),
        count: None,
        last: Some("SGE_TASK_LAST"),
        usual_first: 1,
    },
    Scheduler {
        name: "LSF",
        task: "LSB_JOBINDEX",
        first: None,
        step: Some("LSB_JOBINDEX_STEP"),
        count: None,
        last: Some("LSB_JOBINDEX_END"),
        usual_first: 1,
    },
    Scheduler {
        name: "AWS Batch",
        task: "AWS_BATCH_JOB_ARRAY_INDEX",
        first: None,
        step: None,
        count: Some("AWS_BATCH_JOB_ARRAY_SIZE"),
        last: None,
        usual_first: 0,
    },
    Scheduler {
        name: "GitLab CI",
        task: "CI_NODE_INDEX",
        first: None,
        step: None,
        count: Some("CI_NODE_TOTAL"),
        last: None,
        usual_first: 1,
    },
    // Kubernetes and HyperQueue set the number of the task, but not the number of tasks.
    Scheduler {
        name: "HyperQueue",
        task: "HQ_TASK_ID",
        first: None,
        step: None,
        count: None,
        last: None,
        usual_first: 0,
    },
];

impl Shard {
    /// The whole work as one share.
    pub(crate) const WHOLE: Self = Self { index: 0, count: 1 };

    /// This share's contiguous range of `things` items.
    pub(crate) fn of_row(self, things: u32) -> std::ops::Range<u32> {
        let at = |k: u32| (u64::from(things) * u64::from(k) / u64::from(self.count)) as u32;
        at(self.index)..at(self.index + 1)
    }

    /// This shard's items, in order. By decreasing cost, each item is assigned to the shard with the least total cost (Graham 1969).
    pub(crate) fn of_costs(self, costs: &[f64]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..costs.len()).collect();
        order.sort_by(|a, b| costs[*b].total_cmp(&costs[*a]));
        let mut loads = vec![(0.0_f64, 0_usize); self.count as usize];
        let mut own = Vec::new();
        for thing in order {
            let least = (0..loads.len()).min_by(|a, b| {
                let (a, b) = (loads[*a], loads[*b]);
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            });
            let least = least.unwrap_or(0);
            loads[least].0 += costs[thing];
            loads[least].1 += 1;
            if least == self.index as usize {
                own.push(thing);
            }
        }
        own.sort_unstable();
        own
    }

    /// The task's share, from the scheduler's variables. `count` is the number of tasks, if the command line gives it.
    fn auto(count: Option<u32>, variable: &dyn Fn(&str) -> Option<String>) -> Result<Self, String> {
        let number = |name: &str| {
            let text = variable(name)?;
            Some(text.trim().parse::<u32>().map_err(|_| {
                format!("${name} is {text:?}, which is not a number\n  help: write the share, for example --shard 0/8")
            }))
        };
        for scheduler in &SCHEDULERS {
            let Some(task) = number(scheduler.task) else {
                continue;
            };
            let task = task?;
            let set = |name: Option<&str>, usual: u32| name.and_then(number).unwrap_or(Ok(usual));
            let step = set(scheduler.step, 1)?.max(1);
            // With an explicit count, the share depends on the task's number only, whichever tasks were resubmitted.
            let first = match count {
                Some(_) => scheduler.usual_first,
                None => set(scheduler.first, scheduler.usual_first)?,
            };
            let index = task.checked_sub(first).map(|past| match count {
                Some(_) => past,
                None => past / step,
            });
            let count = match (count, scheduler.count, scheduler.last) {
                (Some(count), _, _) => Some(count),
                (None, Some(name), _) => number(name).transpose()?,
                (None, None, Some(name)) => {
                    let last = number(name).transpose()?;
                    last.map(|last| last.saturating_sub(first) / step + 1)
                }
                (None, None, None) => None,
            };
            let name = scheduler.name;
            return match (index, count) {
                (_, Some(count)) if !(1..=MOST).contains(&count) => Err(format!(
                    "{name} gives {count} tasks, but shares must be 1 to {MOST}\n  help: give their number, for example --shard auto/8"
                )),
                (_, None) => Err(format!(
                    "{name} does not say how many tasks there are\n  help: give their number, for example --shard auto/8"
                )),
                (Some(index), Some(count)) if index < count => Ok(Self { index, count }),
                (_, Some(count)) => Err(format!(
                    "${} is {task}, which is none of {count} tasks from {first} on\n  help: submit the tasks {first} to {}",
                    scheduler.task,
                    u64::from(first) + u64::from(count) - 1
                )),
            };
        }
        Err("no scheduler has set the number of a task\n  help: write the share, for example --shard 0/8".to_owned())
    }

    fn parsed(text: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<Self, String> {
        let usage = || {
            format!(
                "{text:?} is no share\n  help: write I/N, I from 0 to N - 1, for example --shard 0/8; or auto, or auto/8, for the task of an array"
            )
        };
        let count_of = |text: &str| {
            let count = text.parse::<u32>().ok();
            count.filter(|n| (1..=MOST).contains(n)).ok_or_else(usage)
        };
        match text.split_once('/') {
            None if text == "auto" => Self::auto(None, variable),
            None => Err(usage()),
            Some(("auto", count)) => Self::auto(Some(count_of(count)?), variable),
            Some((index, count)) => {
                let count = count_of(count)?;
                let index = index.parse::<u32>().ok().filter(|i| *i < count);
                Ok(Self {
                    index: index.ok_or_else(usage)?,
                    count,
                })
            }
        }
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::parsed(text, &|name| std::env::var(name).ok())
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(set: &[(&str, &str)], text: &str) -> Result<Shard, String> {
        let of = |name: &str| {
            let found = set.iter().find(|(n, _)| *n == name);
            found.map(|(_, value)| (*value).to_owned())
        };
        Shard::parsed(text, &of)
    }

    #[test]
    fn the_task_of_an_array_is_a_share() {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "6"),
            ("SLURM_ARRAY_TASK_MIN", "2"),
            ("SLURM_ARRAY_TASK_STEP", "2"),
            ("SLURM_ARRAY_TASK_COUNT", "5"),
        ];
        // Only this task is resubmitted.
        let again = [
            ("SLURM_ARRAY_TASK_ID", "3"),
            ("SLURM_ARRAY_TASK_MIN", "3"),
            ("SLURM_ARRAY_TASK_COUNT", "1"),
        ];
        let engine = [
            ("SGE_TASK_ID", "4"),
            ("SGE_TASK_FIRST", "1"),
            ("SGE_TASK_LAST", "9"),
        ];
        for (set, text, expected) in [
            (&[][..], "2/3", "2/3"),
            (&slurm, "auto", "2/5"),
            (&again, "auto/8", "3/8"),
            (&again, "auto", "0/1"),
            (&engine, "auto", "3/9"),
            (
                &[("LSB_JOBINDEX", "1"), ("LSB_JOBINDEX_END", "4")],
                "auto",
                "0/4",
            ),
            (
                &[("CI_NODE_INDEX", "3"), ("CI_NODE_TOTAL", "3")],
                "auto",
                "2/3",
            ),
            (&[("HQ_TASK_ID", "7")], "auto/8", "7/8"),
        ] {
            let found = parsed(set, text).map(|s| s.to_string());
            assert_eq!(found.as_deref(), Ok(expected), "{text} with {set:?}");
        }
    }

    #[test]
    fn what_is_no_share_is_refused_with_help() {
        for (set, text, said) in [
            (&[][..], "3/3", "no share"),
            (&[], "0/0", "no share"),
            (&[], "-1/3", "no share"),
            (&[], "1", "no share"),
            (&[], "auto", "no scheduler"),
            (&[("HQ_TASK_ID", "7")], "auto", "how many"),
            (
                &[("CI_NODE_INDEX", "1"), ("CI_NODE_TOTAL", "4000000000")],
                "auto",
                "shares must be 1 to",
            ),
            (
                &[("CI_NODE_INDEX", "1"), ("CI_NODE_TOTAL", "0")],
                "auto",
                "shares must be 1 to",
            ),
            (&[("SLURM_ARRAY_TASK_ID", "x")], "auto", "not a number"),
            (&[("SLURM_ARRAY_TASK_ID", "9")], "auto/8", "none of 8 tasks"),
            (
                &[("CI_NODE_INDEX", "0"), ("CI_NODE_TOTAL", "3")],
                "auto",
                "none of 3",
            ),
        ] {
            let message = parsed(set, text).expect_err(text);
            assert!(
                message.contains(said) && message.contains("help:"),
                "{message}"
            );
        }
    }

    #[test]
    fn shares_are_all_of_the_work_and_none_of_it_twice() {
        let costs: Vec<f64> = (0..37).map(|i| f64::from(1 + i * 7919 % 100)).collect();
        for count in [1, 2, 5, 37, 64] {
            let shards = (0..count).map(|index| Shard { index, count });
            let row: Vec<u32> = shards.clone().flat_map(|s| s.of_row(37)).collect();
            assert_eq!(row, (0..37).collect::<Vec<_>>(), "{count}");
            let mut dealt: Vec<usize> = Vec::new();
            let mut loads = Vec::new();
            for shard in shards {
                let own = shard.of_costs(&costs);
                assert!(own.is_sorted(), "in the order of the experiment");
                loads.push(own.iter().map(|i| costs[*i]).sum::<f64>());
                dealt.extend(own);
            }
            dealt.sort_unstable();
            assert_eq!(dealt, (0..37).collect::<Vec<_>>(), "{count}");
            // Graham: at most 4/3 of the best, which is at least the mean and the largest.
            let most = loads.iter().copied().fold(0.0, f64::max);
            let best = (costs.iter().sum::<f64>() / f64::from(count)).max(100.0);
            assert!(most <= best * 4.0 / 3.0 + 1.0, "{count}: {most} of {best}");
        }
    }
}
