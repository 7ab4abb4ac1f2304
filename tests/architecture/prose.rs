//! The prose of comments: plain technical English, as a reader from another project expects it.
//!
//! Two counts stand for it. Words that avoid a noun or a standard term ("who", "told", "of it") are few, and doc comments begin with a noun or
//! a verb, not with a question word. Graphics libraries of others have 0 to 1 such words per 1,000 comment lines, and 0 to 5 % such openings.

use super::{all_sources, files};

/// Marker words per 1,000 comment lines. May only fall.
const MOST_MARKERS: f64 = 3.0;

/// Percentage of doc comments that begin with an opener. May only fall.
const MOST_OPENERS: f64 = 1.0;

/// Words and phrases that stand in the place of a noun or a term.
const MARKERS: [&str; 17] = [
    "told",
    "anew",
    "so many",
    "asked",
    "beside",
    "whoever",
    "who",
    "nobody",
    "somebody",
    "amount to",
    "amounts to",
    "of it",
    "hang on",
    "hangs on",
    "go with",
    "goes with",
    "has it",
];

const OPENERS: [&str; 8] = [
    "What", "Whether", "How", "Of", "Where", "Which", "Who", "That",
];

#[derive(Debug, Default, PartialEq)]
struct Prose {
    lines: usize,
    /// Lines with a marker.
    marked: Vec<String>,
    docs: usize,
    /// First lines of doc comments that begin with an opener.
    opened: Vec<String>,
}

impl Prose {
    fn add(&mut self, file: &str, text: &str) {
        let is_doc = |line: &str| line.starts_with("///") || line.starts_with("//!");
        let mut before = "";
        for line in text.lines().map(str::trim) {
            if line.starts_with("//") {
                self.lines += 1;
                if MARKERS.iter().any(|marker| has_phrase(line, marker)) {
                    self.marked.push(format!("{file}: {line}"));
                }
            }
            if is_doc(line) && !is_doc(before) {
                self.docs += 1;
                let first = line[3..].split_whitespace().next().unwrap_or_default();
                if OPENERS.contains(&first) {
                    self.opened.push(format!("{file}: {line}"));
                }
            }
            before = line;
        }
    }

    fn markers_per_1000(&self) -> f64 {
        1e3 * self.marked.len() as f64 / self.lines.max(1) as f64
    }

    fn openers_percent(&self) -> f64 {
        1e2 * self.opened.len() as f64 / self.docs.max(1) as f64
    }
}

/// True if a text has a phrase that no letter touches.
fn has_phrase(text: &str, phrase: &str) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(phrase).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + phrase.len()..].chars().next();
        !is_letter(before) && !is_letter(after)
    })
}

#[test]
fn comments_are_in_plain_words() {
    let mut prose = Prose::default();
    let shaders = files("shaders", "wgsl");
    for (file, text) in all_sources().iter().chain(&shaders) {
        prose.add(file, text);
    }
    assert!(prose.lines > 10_000 && prose.docs > 5_000, "{prose:?}");
    let (markers, openers) = (prose.markers_per_1000(), prose.openers_percent());
    println!(
        "{markers:.1} markers per 1,000 lines, {openers:.1} % of doc comments open with a question word"
    );
    let lines = |found: &[String]| found.join("\n");
    assert!(
        markers <= MOST_MARKERS,
        "{markers:.1} per 1,000:\n{}",
        lines(&prose.marked)
    );
    assert!(
        openers <= MOST_OPENERS,
        "{openers:.1} %:\n{}",
        lines(&prose.opened)
    );
}

#[test]
fn planted_prose_is_counted() {
    let mut prose = Prose::default();
    let text = "//! Whether it is.\n//! What of it.\n/// A whole\nfn who() {}\n    // Nothing beside.\n/// Who draws\n";
    prose.add("planted", text);
    assert_eq!((prose.lines, prose.docs), (5, 2));
    assert_eq!(
        prose.marked,
        ["planted: //! What of it.", "planted: // Nothing beside."]
    );
    assert_eq!(
        prose.opened,
        ["planted: //! Whether it is.", "planted: /// Who draws"]
    );
}
