//! Best strategy at some points, in three cells: its name, its cost, and the second-best strategy.

use crate::experiment::Record;
use crate::report::chapters::figures::{percent, ranged, times};
use crate::report::derived::{
    Harm, Ranked, Situation, Spread, TOO_MUCH, harms, has_defect, has_other_truth, ranked, usage,
};
use crate::report::document::{Cell, Tone};

/// Headings of the three cells.
pub(in crate::report::chapters) const COLUMNS: [&str; 3] = ["use", "× draw only", "or"];

/// The cells for some points. If any points are judged by their own exact image, only these count; otherwise broken meshes do.
pub(in crate::report::chapters) fn cells(records: &[&Record], situation: Situation) -> [Cell; 3] {
    let (others, sound): (Vec<&Record>, Vec<&Record>) =
        records.iter().partition(|r| has_other_truth(r));
    match sound.is_empty() {
        false => of_sound(&ranked(&sound, situation), sound.len()),
        true => {
            let broken: Vec<&Record> = others.into_iter().filter(|r| has_defect(r)).collect();
            of_broken(&harms(&broken))
        }
    }
}

/// A name with its remarks in brackets.
fn noted(name: &str, notes: &[String]) -> String {
    match notes.is_empty() {
        true => name.to_owned(),
        false => format!("{name} ({})", notes.join("; ")),
    }
}

/// Remarks in brackets: the limit of a ranked method, and the number of points where it is exact, if not all. Empty without remarks.
pub(in crate::report::chapters) fn limited(ranked: &Ranked, points: usize) -> String {
    let notes = notes(ranked, points);
    match notes.is_empty() {
        true => String::new(),
        false => format!(" ({})", notes.join("; ")),
    }
}

fn notes(ranked: &Ranked, points: usize) -> Vec<String> {
    let limit = ranked.usage.limit.map(str::to_owned);
    let rare = (ranked.exact < points).then(|| format!("at {} of {points} points", ranked.exact));
    limit.into_iter().chain(rare).collect()
}

/// The first method of the ranking, its cost, and the second method.
fn of_sound(ranking: &[Ranked], points: usize) -> [Cell; 3] {
    let name = |s: &Ranked| noted(&s.usage.words, &notes(s, points));
    let Some(first) = ranking.first() else {
        let none = Cell::from("none is exact").toned(Tone::Bad);
        return [none, Cell::default(), Cell::default()];
    };
    let next = ranking.get(1).map_or_else(Cell::default, |s| {
        let draw = if s.is_draw { ", a draw" } else { "" };
        let text = format!("{} {}{draw}", name(s), times(s.ratio.median));
        Cell::from(text)
    });
    [
        Cell::from(name(first)).toned(Tone::Good),
        ranged(Some(first.ratio)),
        next,
    ]
}

/// The least wrong method that `render` supports, its cost, and the runner-up, or instead a less wrong method that only `compare` runs.
pub(in crate::report::chapters) fn of_broken(harms: &[Harm]) -> [Cell; 3] {
    let usable = harms.iter().filter(|h| h.is_usable());
    let (drawn, compared): (Vec<&Harm>, Vec<&Harm>) =
        usable.partition(|h| usage(&h.totals.name).is_some());
    let share = |s: Option<Spread>| s.map_or_else(String::new, |s| percent(s.median));
    let name = |h: &Harm| {
        let usage = usage(&h.totals.name);
        let limit = usage.as_ref().and_then(|u| u.limit).map(str::to_owned);
        let name = usage.map_or_else(|| h.totals.name.clone(), |u| u.words);
        noted(&name, limit.as_slice())
    };
    let found = |h: &Harm| format!("{} wrong, {} unmarked", share(h.wrong), share(h.unmarked));
    let Some(first) = drawn.first() else {
        let none = Cell::from(format!(
            "no method draws all points and loses less than {} of the cap",
            percent(TOO_MUCH)
        ));
        return [
            none.toned(Tone::Bad),
            Cell::default(),
            compared_cell(&compared),
        ];
    };
    let marked = share(first.marked);
    let text = format!("{}: {}, {marked} marked", name(first), found(first));
    let less_wrong = harms.first().filter(|h| usage(&h.totals.name).is_none());
    let next = match (less_wrong.is_some(), drawn.get(1)) {
        (true, _) => compared_cell(&compared),
        (false, Some(next)) => Cell::from(format!("{}: {}", name(next), found(next))),
        (false, None) => Cell::default(),
    };
    [
        Cell::from(text).toned(Tone::Fair),
        ranged(first.totals.ratio),
        next,
    ]
}

/// Cell for the best method that only `compare` runs, with the command.
fn compared_cell(compared: &[&Harm]) -> Cell {
    compared.first().map_or_else(Cell::default, |h| {
        let wrong = h.wrong.map_or_else(String::new, |s| percent(s.median));
        let name = &h.totals.name;
        Cell::from(format!(
            "{name}: {wrong} wrong; draws no picture; run `cutaway compare --strategies {name}`"
        ))
    })
}
