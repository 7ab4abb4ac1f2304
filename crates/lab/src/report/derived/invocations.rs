//! The commands that measured a run: each record names the command that measured it, and `run.json` names the last command.

use crate::experiment::{Invocation, Record, Run};

/// The invocations of a run, the earliest first, each with the number of points whose records name that invocation.
///
/// No record may name the command of `run.json`, for example if it found all points measured already. The command is then
/// listed last, and is credited with the points whose records name no command, as records of older versions do not.
pub(crate) fn invocations<'a>(
    run: &Run,
    records: impl IntoIterator<Item = &'a Record>,
) -> Vec<(Invocation, usize)> {
    let mut found: Vec<(Invocation, usize)> = Vec::new();
    let mut unnamed = 0;
    for record in records {
        let Some(invocation) = &record.invocation else {
            unnamed += 1;
            continue;
        };
        match found.iter_mut().find(|(s, _)| s == invocation) {
            Some((_, points)) => *points += 1,
            None => found.push((invocation.clone(), 1)),
        }
    }
    found.sort_by(|(a, _), (b, _)| a.began.cmp(&b.began));
    if !found.iter().any(|(s, _)| s.command == run.command) {
        let last = Invocation {
            began: match found.is_empty() {
                true => run.began.clone(),
                false => String::new(),
            },
            load: run.machine.load,
            command: run.command.clone(),
            ..Invocation::default()
        };
        found.push((last, unnamed));
    }
    found
}
