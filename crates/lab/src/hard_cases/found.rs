//! Runs the table of hard cases in a session.

use cutaway::layers::Kind;
use cutaway::scene::glob_matches;
use cutaway::session::Session;
use cutaway::strategies::Method;
use cutaway::{Error, Result};

use super::methods::{usual_methods, usual_sizes_px};
use super::{Case, Question, Tally, cases, list};

/// A case, and its results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseFound {
    /// The case's number in the list, or a letter and a number.
    pub id: String,
    /// Description of the case.
    pub name: String,
    /// Arguments after `cargo test -p cutaway-tests` for the tests of what the case's pictures cannot show.
    pub held_by: Option<String>,
    /// Expected result of each strategy, and the result found; empty if the case has no pictures.
    pub reached: Vec<CaseOutcome>,
}

/// Expected result of a strategy, and the result found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseOutcome {
    /// Name of the strategy.
    pub strategy: String,
    /// Expected result.
    pub expected: String,
    /// Why the result cannot be better, if a failure or a bound is declared.
    pub why: Option<String>,
    /// Found result.
    pub found: String,
    /// True if the result found is as expected. If a declared failure passes, this is false.
    pub holds: bool,
}

/// Selection of cases, sizes and methods to run in a session.
#[derive(Clone, Copy, Debug)]
pub struct CaseSelection<'a> {
    /// Globs over the ids of cases.
    pub ids: &'a [String],
    /// Side lengths of the pictures.
    pub sizes_px: &'a [u32],
    /// Methods to run, or none for [the usual methods](super::usual_methods), for which the table's bounds were found.
    pub methods: Option<&'a [Method]>,
}

/// Rejects globs that match no case.
pub fn check_ids(ids: &[String]) -> Result<()> {
    let fits_none = |glob: &&String| !list().any(|l| glob_matches(glob, &l.id));
    match ids.iter().find(fits_none) {
        None => Ok(()),
        Some(glob) => {
            // Ids are in order: numbers first, then ids that begin with a letter.
            let last = |begins: fn(char) -> bool| {
                let of_them = list().filter(|l| l.id.starts_with(begins));
                of_them.last().map_or("", |l| l.id.as_str())
            };
            let help = format!(
                "write a number from 1 to {}, B1 to {}, U1 to {}, or a glob such as B*",
                last(|c| c.is_ascii_digit()),
                last(|c| c == 'B'),
                last(|c| c == 'U'),
            );
            let what = "no case has this number";
            Err(Error::input(format!("hard case `{glob}`"), what, help))
        }
    }
}

/// Runs the cases whose ids match one of the globs, at each size, and calls `step` before each. Ends early, without a result, as soon as
/// `goes_on` returns false; `goes_on` is called before each method.
pub fn found(
    session: &mut Session,
    asked: &CaseSelection<'_>,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<CaseFound>>> {
    check_ids(asked.ids)?;
    let is_asked = |id: &str| asked.ids.iter().any(|glob| glob_matches(glob, id));
    let mut all = Vec::new();
    for listed in list().filter(|l| is_asked(&l.id)) {
        let mut of_it = cases().filter(|c| c.id == listed.id).peekable();
        if of_it.peek().is_none() {
            all.push(CaseFound {
                id: listed.id.clone(),
                name: listed.name.clone(),
                held_by: listed.held_by(),
                reached: Vec::new(),
            });
        }
        for case in of_it {
            let Some(reached) = reached(session, case, asked, step, goes_on)? else {
                return Ok(None);
            };
            all.push(CaseFound {
                id: case.id.clone(),
                name: case.name.clone(),
                held_by: listed.held_by(),
                reached,
            });
        }
    }
    Ok(Some(all))
}

/// The pictures of a case, each with the name of its scene.
///
/// # Errors
///
/// As for [`Case::scenes`].
pub fn pictures(case: &Case, size_px: u32) -> Result<Vec<(String, Question)>> {
    let scenes = case.scenes(size_px)?;
    let of = |s: &cutaway::scene::Scene| (s.name.clone(), Question::new(s, [size_px; 2]));
    Ok(scenes.iter().map(of).collect())
}

/// Results of a method for the pictures of a case.
pub fn tallied(
    session: &mut Session,
    case: &Case,
    method: &Method,
    pictures: &[(String, Question)],
) -> Result<Tally> {
    let is_unasked = |px: &u32| pictures.iter().all(|(_, q)| q.view.size_px[0] != *px);
    let mut tally = Tally {
        unasked_px: (usual_sizes_px(method).iter().copied())
            .filter(is_unasked)
            .collect(),
        ..Tally::default()
    };
    for (name, question) in pictures {
        let judged = question.answer(session, method)?;
        let fault = case.fault(question, &judged, method);
        tally.add(&judged, name, fault);
    }
    Ok(tally)
}

/// Number of cap pixels in the pictures of a case: a case without cap pixels proves nothing about caps.
pub fn caps_px(pictures: &[(String, Question)]) -> usize {
    let caps = pictures
        .iter()
        .map(|(_, q)| q.exact.layers.count(Kind::Cap));
    caps.sum()
}

fn reached(
    session: &mut Session,
    case: &Case,
    asked: &CaseSelection<'_>,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<CaseOutcome>>> {
    let mut tallies: Vec<(Method, Tally)> = Vec::new();
    for size_px in asked.sizes_px {
        step(format!("case {} at {size_px} px", case.id));
        let pictures = pictures(case, *size_px)?;
        let methods = match asked.methods {
            Some(named) => named.to_vec(),
            None => usual_methods(*size_px),
        };
        for method in methods {
            if !goes_on() {
                session.forget();
                return Ok(None);
            }
            let tally = tallied(session, case, &method, &pictures)?;
            match tallies.iter_mut().find(|(e, _)| *e == method) {
                Some((_, so_far)) => so_far.join(tally),
                None => tallies.push((method, tally)),
            }
        }
        // No later case uses these scenes.
        session.forget();
    }
    let describe = |(method, tally): (Method, Tally)| {
        let expected = case.expected_on(&method, tally.is_coarse);
        CaseOutcome {
            strategy: method.to_string(),
            expected: expected.to_string(),
            why: expected.why().filter(|_| tally.is_short_of_exact()),
            found: tally.describe(&expected),
            holds: tally.faults_of(&expected).is_empty(),
        }
    };
    Ok(Some(tallies.into_iter().map(describe).collect()))
}
