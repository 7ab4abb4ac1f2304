//! The table of strategies is what the book says, and every row of it can be asked for.

use std::fs;

use cutaway::Strategy;
use cutaway::strategies::table::{self, CAP_SURFACES, INSIDE_TESTS};

use crate::common::root;

#[test]
fn the_book_holds_the_table() {
    let page = root().join("docs/strategies.md");
    let page = fs::read_to_string(page).expect("the page of strategies");
    let table = table::markdown();
    assert!(
        page.contains(&table),
        "docs/strategies.md has other tables of strategies than these:\n\n{table}"
    );
    let planted = page.replacen("| `raycast` |", "| `raycaster` |", 1);
    assert!(!planted.contains(&table), "the control");
}

#[test]
fn every_row_is_asked_for_by_all_and_by_hard_cases() {
    let all = Strategy::all();
    let surfaces = CAP_SURFACES.iter().map(|row| &row.facts);
    let tests = INSIDE_TESTS.iter().map(|row| &row.facts);
    for facts in surfaces.chain(tests) {
        let name = facts.name;
        let is_it = |s: &&Strategy| {
            s.surface.facts().name == name || s.inside.is_some_and(|i| i.facts().name == name)
        };
        assert!(all.iter().any(|s| is_it(&s)), "`all` leaves {name} out");
        assert!(table::names().contains(name), "help leaves {name} out");
        let methods = cutaway_lab::hard_cases::usual_methods(64);
        let strategies: Vec<Strategy> = methods.iter().map(|m| m.strategy).collect();
        assert!(
            strategies.iter().any(|s| is_it(&s)),
            "no hard case is drawn by {name}"
        );
    }
}
