//! Runs of hard cases and of the property search, with their results as records.

use cutaway::Result;
use cutaway::session::Session;
use cutaway_lab::experiment::definition::{AskedCases, AskedSearch};
use cutaway_lab::experiment::{CaseRecord, Expectation, Reached};
use cutaway_lab::hard_cases::random::search as search_for;
use cutaway_lab::hard_cases::{self, found, usual_methods};

/// Default side lengths of the pictures.
const USUAL_SIZES_PX: [u32; 2] = [64, 256];

/// Results of the requested hard cases; `None` if `goes_on` returned false.
pub(super) fn cases(
    session: &mut Session,
    asked: &AskedCases,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<CaseRecord>>> {
    let asked = hard_cases::CaseSelection {
        ids: &asked.cases,
        sizes_px: &sizes_px(asked),
        methods: asked.methods.as_deref(),
    };
    let Some(cases) = found(session, &asked, step, goes_on)? else {
        return Ok(None);
    };
    let record = |case: hard_cases::CaseFound| CaseRecord {
        id: case.id,
        name: case.name,
        held_by: case.held_by,
        expectations: (case.reached.into_iter())
            .map(|r| Reached {
                strategy: r.strategy,
                expected: Expectation {
                    what: r.expected,
                    why: r.why,
                },
                found: r.found,
                holds: r.holds,
            })
            .collect(),
    };
    Ok(Some(cases.into_iter().map(record).collect()))
}

/// Side lengths of a hard-case run's pictures.
pub(super) fn sizes_px(asked: &AskedCases) -> Vec<u32> {
    match asked.sizes_px.as_slice() {
        [] => USUAL_SIZES_PX.to_vec(),
        named => named.to_vec(),
    }
}

/// Result of a search, in the form of one case with an expectation per strategy. `None` if `goes_on` returned false.
pub(super) fn search(
    session: &mut Session,
    asked: &AskedSearch,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<CaseRecord>>> {
    let methods = match &asked.methods {
        Some(named) => named.clone(),
        None => usual_methods(0),
    };
    let scenes = 0..asked.scenes as u64;
    let Some(searched) = search_for(session, scenes, asked.seed, &methods, step, goes_on)? else {
        return Ok(None);
    };
    let reached = methods.iter().zip(&searched.drawn).map(|(method, drawn)| {
        let strategy = method.to_string();
        let of_it: Vec<String> = (searched.findings.iter())
            .filter(|f| f.strategy == strategy)
            .map(|f| format!("scene {}: {}, {:?}", f.scene, f.what, f.recipe))
            .collect();
        let mut found = format!("{drawn} of {} scenes drawn", asked.scenes);
        if !of_it.is_empty() {
            found = format!("{found}; {}", of_it.join("; "));
        }
        Reached {
            holds: of_it.is_empty(),
            expected: Expectation {
                what: "no scene comes out wrong".to_owned(),
                why: None,
            },
            strategy,
            found,
        }
    });
    Ok(Some(vec![CaseRecord {
        id: "random".to_owned(),
        name: format!(
            "{} scenes without a pattern, from seed {}",
            asked.scenes, asked.seed
        ),
        expectations: reached.collect(),
        held_by: Some("agree".to_owned()),
    }]))
}
