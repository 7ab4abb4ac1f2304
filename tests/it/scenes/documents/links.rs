//! Links between documents: files and headings are there, and the book is whole by itself.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

use super::{documents, root};

/// Pages below `docs` that are no page of the book.
const BESIDE_THE_BOOK: [&str; 2] = ["docs/SUMMARY.md", "docs/images/README.md"];

/// Targets of links and pictures.
fn targets(text: &str) -> Vec<String> {
    let events = Parser::new_ext(text, Options::ENABLE_TABLES);
    let target = |event| match event {
        Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
            Some(dest_url.into_string())
        }
        _ => None,
    };
    events.filter_map(target).collect()
}

/// What headings are called in addresses: as code hosts and mdBook make them.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut heading: Option<String> = None;
    for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(text) | Event::Code(text) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&text);
                }
            }
            Event::End(TagEnd::Heading(_)) => {
                let slug = slug(&heading.take().unwrap());
                let again = (1..).map(|n| format!("{slug}-{n}"));
                let free = [slug.clone()].into_iter().chain(again);
                let name = free.into_iter().find(|name| !found.contains(name));
                found.extend(name);
            }
            _ => {}
        }
    }
    found
}

fn slug(heading: &str) -> String {
    let signs = heading.trim().to_lowercase();
    let signs = signs.chars().filter_map(|sign| match sign {
        ' ' => Some('-'),
        sign if sign.is_alphanumeric() || "-_".contains(sign) => Some(sign),
        _ => None,
    });
    signs.collect()
}

/// A path without `.` and `..`, where it does not leave the repository.
fn normal(path: &Path) -> Option<PathBuf> {
    let mut normal = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => normal.pop().then_some(())?,
            Component::CurDir => {}
            other => normal.push(other),
        }
    }
    Some(normal)
}

/// What is wrong with a link from a document.
fn fault(from: &str, target: &str, all: &BTreeMap<String, String>) -> Option<String> {
    if target.starts_with("https://") {
        return None;
    }
    if target.contains(':') {
        return Some(format!("{from}: {target} is no address that is meant"));
    }
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let folder = Path::new(from).parent().unwrap();
    let path = match file {
        "" => Some(PathBuf::from(from)),
        file => normal(&folder.join(file)),
    };
    let Some(path) = path.filter(|p| root().join(p).is_file()) else {
        return Some(format!("{from}: there is no {target}"));
    };
    let name = path.to_str().unwrap().replace('\\', "/");
    let is_of_book = |name: &str| name.starts_with("docs/");
    if is_of_book(from) && !is_of_book(&name) {
        return Some(format!(
            "{from}: {target} is not in the book, where it would lead nowhere"
        ));
    }
    if anchor.is_empty() {
        return None;
    }
    let has_anchor = (all.get(&name)).is_some_and(|text| anchors(text).contains(anchor));
    (!has_anchor).then(|| format!("{from}: {name} has no heading #{anchor}"))
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let all = documents();
    let mut count = 0;
    let mut faults = Vec::new();
    for (from, text) in &all {
        let targets = targets(text);
        count += targets.len();
        faults.extend(targets.iter().filter_map(|t| fault(from, t, &all)));
    }
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(count > 150, "{count} links");
    // The controls: a file, a heading, a way out of the book and of the repository, and one that is right.
    for (target, is_wrong) in [
        ("nowhere.md", true),
        ("algorithm.md#nowhere", true),
        ("../README.md", true),
        ("../../../etc/hostname", true),
        ("file:///etc/hostname", true),
        ("algorithm.md#theorem", false),
    ] {
        let fault = fault("docs/faq.md", target, &all);
        assert_eq!(fault.is_some(), is_wrong, "{target}: {fault:?}");
    }
    assert_eq!(
        targets("[a](b.md) ![](c.png)\n\n|x|\n|-|\n|[d](e.md)|\n"),
        ["b.md", "c.png", "e.md"]
    );
    let twice: Vec<String> = anchors("# The paper's `a|b`\n# Cuts\n# Cuts\n")
        .into_iter()
        .collect();
    assert_eq!(twice, ["cuts", "cuts-1", "the-papers-ab"]);
}

/// Pages that the summary leaves out, or names and are not there.
fn unlisted(summary: &str, pages: &BTreeSet<String>) -> Vec<String> {
    let listed = targets(summary).into_iter();
    let listed: BTreeSet<String> = listed.map(|page| format!("docs/{page}")).collect();
    pages.symmetric_difference(&listed).cloned().collect()
}

#[test]
fn the_summary_lists_every_page_of_the_book() {
    let all = documents();
    let pages = all.keys().filter(|name| name.starts_with("docs/"));
    let pages = pages.filter(|name| !BESIDE_THE_BOOK.contains(&name.as_str()));
    let pages: BTreeSet<String> = pages.cloned().collect();
    let summary = &all["docs/SUMMARY.md"];
    assert_eq!(unlisted(summary, &pages), Vec::<String>::new());
    let planted = summary.replace("tutorial.md", "nowhere.md");
    assert_eq!(
        unlisted(&planted, &pages),
        ["docs/nowhere.md", "docs/tutorial.md"],
        "the control"
    );
}
