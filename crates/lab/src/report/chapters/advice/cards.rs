//! One answer: a sentence, and a chart of all requested methods.

use super::best::{self, limited};
use super::reasons;
use crate::experiment::Record;
use crate::report::chapters::figures::{counted, percent, times};
use crate::report::derived::{
    Candidate, Situation, Spread, candidates, harms, has_defect, has_other_truth, ranked, variants,
};
use crate::report::document::{Cell, Line, Ranking, ReportBlock, Tone};
use crate::report::look::look;

/// The answer for some points in a sentence or two: what to use, the next choice, and which cheaper methods are wrong.
pub(in crate::report::chapters) fn sentence(records: &[&Record], situation: Situation) -> String {
    if let Some(text) = of_variants(records) {
        return text;
    }
    let (others, sound): (Vec<&Record>, Vec<&Record>) =
        records.iter().partition(|r| has_other_truth(r));
    if sound.is_empty() {
        let broken: Vec<&Record> = others.into_iter().filter(|r| has_defect(r)).collect();
        return of_broken(&broken);
    }
    let ranking = ranked(&sound, situation);
    let Some(first) = ranking.first() else {
        return "No method that `cutaway render` accepts is exact here.".to_owned();
    };
    let mut text = format!(
        "Use `{}`{}: {} of drawing uncut{}.",
        first.usage.words,
        limited(first, sound.len()),
        times(first.ratio.median),
        range(first.ratio, sound.len()),
    );
    if let Some(next) = ranking.get(1) {
        text.push_str(&format!(
            " Next: `{}`{}, {}{}.",
            next.usage.words,
            limited(next, sound.len()),
            times(next.ratio.median),
            if next.is_draw { ", a draw" } else { "" }
        ));
    }
    let cheaper: Vec<String> = candidates(&sound, situation)
        .into_iter()
        .filter(|c| c.totals.drawn > 0 && !c.totals.is_exact())
        .filter_map(|c| Some((c.ratio?.median, c)))
        .filter(|(ratio, _)| *ratio < first.ratio.median)
        .map(|(ratio, c)| {
            let (name, px) = (&c.totals.name, c.totals.worst_px);
            format!("`{name}`, {}, up to {px} wrong px", times(ratio))
        })
        .take(2)
        .collect();
    if !cheaper.is_empty() {
        text.push_str(&format!(" Cheaper and wrong: {}.", cheaper.join("; ")));
    }
    text
}

fn range(spread: Spread, points: usize) -> String {
    match spread.most > spread.least {
        true => format!(
            " ({} to {} over {})",
            times(spread.least),
            times(spread.most),
            counted(points, "point")
        ),
        false => String::new(),
    }
}

fn of_broken(broken: &[&Record]) -> String {
    let [first, _, next] = best::of_broken(&harms(broken));
    match next.text.as_str() {
        "" => format!(
            "No method is exact on broken meshes. Least wrong: {}.",
            first.text
        ),
        next => format!(
            "No method is exact on broken meshes. Least wrong: {}. Next: {next}.",
            first.text
        ),
    }
}

/// Sentence with the costs of a picture's variants; `None` if the points are not variants.
fn of_variants(records: &[&Record]) -> Option<String> {
    let found = variants(records)?;
    let values = found
        .values
        .iter()
        .enumerate()
        .filter_map(|(index, value)| {
            let ratios = found.rows.iter().filter_map(|row| row.ratios[index]);
            let spread = Spread::of(ratios.collect())?;
            Some(match spread.most > spread.least {
                true => format!(
                    "`{value}` {} ({} to {})",
                    times(spread.median),
                    times(spread.least),
                    times(spread.most)
                ),
                false => format!("`{value}` {}", times(spread.median)),
            })
        });
    let values: Vec<String> = values.collect();
    Some(format!(
        "Relative to `{} = {}` in the same picture: {}.",
        found.axis,
        found.base,
        values.join(", ")
    ))
}

/// The chart of all methods requested at some points; `None` if there is only one method.
pub(in crate::report::chapters) fn ranking(
    title: &str,
    records: &[&Record],
    situation: Situation,
    range: [f64; 2],
) -> Option<ReportBlock> {
    let is_broken = records.iter().all(|r| has_other_truth(r));
    let lines: Vec<Line> = match is_broken {
        true => {
            let broken: Vec<&Record> = records.iter().copied().filter(|r| has_defect(r)).collect();
            harms(&broken)
                .into_iter()
                .map(|h| {
                    let share =
                        |s: Option<Spread>| s.map_or_else(|| "-".to_owned(), |s| percent(s.median));
                    let words = format!("{} wrong, {} unmarked", share(h.wrong), share(h.unmarked));
                    line(
                        &h.totals.name,
                        h.totals.ratio,
                        Cell::from(words).toned(Tone::Fair),
                    )
                })
                .collect()
        }
        false => {
            let sound: Vec<&Record> = records
                .iter()
                .copied()
                .filter(|r| !has_other_truth(r))
                .collect();
            candidates(&sound, situation)
                .into_iter()
                .map(|c| line(&c.totals.name, c.ratio, words(&c, sound.len())))
                .collect()
        }
    };
    (lines.len() > 1).then(|| {
        ReportBlock::Ranking(Ranking {
            title: title.to_owned(),
            names: "method",
            axis: "time relative to drawing uncut".to_owned(),
            is_factor: true,
            heading: "wrong px, at most".to_owned(),
            range,
            lines,
        })
    })
}

/// Minimum and maximum ratio over all requested methods, so that several charts can use the same axis.
pub(in crate::report::chapters) fn range_of<'a>(
    all: impl Iterator<Item = (Vec<&'a Record>, Situation)>,
) -> [f64; 2] {
    all.flat_map(|(records, situation)| candidates(&records, situation))
        .filter_map(|c| c.ratio)
        .fold([1.0, 1.0], |[least, most], s| {
            [f64::min(least, s.least), f64::max(most, s.most)]
        })
}

fn line(name: &str, cost: Option<Spread>, words: Cell) -> Line {
    Line {
        name: name.to_owned(),
        look: look(name),
        cost,
        words,
    }
}

/// Cell with the remarks on a method that are shown next to its time.
fn words(candidate: &Candidate, points: usize) -> Cell {
    let totals = &candidate.totals;
    let all: Vec<String> = totals.refusals.keys().cloned().collect();
    if totals.drawn == 0 {
        let reasons = reasons::short(&all);
        let text = format!("refuses: {}", reasons.text);
        return Cell { text, ..reasons }.toned(Tone::Faint);
    }
    let drawn = match totals.refused() {
        0 if totals.asked < points => format!(", at {} of {points} points", totals.asked),
        0 => String::new(),
        refused => format!(", refuses {refused} of {}", totals.asked),
    };
    match totals.is_exact() {
        true => Cell::from(format!("exact{drawn}")).toned(Tone::Good),
        false => {
            let overflowed = if totals.overflowed > 0 {
                ", overflows"
            } else {
                ""
            };
            let text = format!("{} px{overflowed}{drawn}", totals.worst_px);
            Cell::from(text).toned(Tone::Fair)
        }
    }
}
