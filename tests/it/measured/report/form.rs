//! What can be read of a page without a browser: how wide its tables must be, how its numbers are written, how methods look, where links
//! lead, and what is said twice. Each is a function of the page that returns what is wrong with it, so that a planted fault proves that it
//! can fail.

use std::collections::{BTreeMap, BTreeSet};

/// Letters that fit on a line of a page of 1280 pixels: a letter is about eight wide.
const LETTERS: usize = 156;

/// What stands between two marks, from each place where the first is.
fn between<'a>(page: &'a str, start: &str, end: &str) -> Vec<&'a str> {
    let pieces = page.split(start).skip(1);
    pieces.filter_map(|p| p.split(end).next()).collect()
}

/// The words of a piece of a page. Where a line may be broken there is a space.
pub(crate) fn words_of(piece: &str) -> String {
    let mut words = String::new();
    let mut is_tag = false;
    for c in piece.replace("<wbr>", " ").chars() {
        match c {
            '<' => is_tag = true,
            '>' => is_tag = false,
            c if !is_tag => words.push(c),
            _ => {}
        }
    }
    for (escaped, plain) in [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&amp;", "&"),
    ] {
        words = words.replace(escaped, plain);
    }
    words
}

/// Tables that need more letters than a line has, or that do not lie in a box of their own.
pub(crate) fn wide_tables(page: &str) -> Vec<String> {
    let mut wide = Vec::new();
    for table in between(page, "<table class=\"grid\">", "</table>") {
        let mut columns: Vec<usize> = Vec::new();
        for row in between(table, "<tr>", "</tr>") {
            let cells = row.split("<th ").flat_map(|p| p.split("<td ")).skip(1);
            for (index, cell) in cells.enumerate() {
                let (attributes, text) = cell.split_once('>').unwrap();
                let text = words_of(text);
                let is_whole = attributes.contains("number") && !attributes.contains("col");
                let letters = match is_whole {
                    true => text.chars().count(),
                    false => text
                        .split(' ')
                        .map(|w| w.chars().count())
                        .max()
                        .unwrap_or(0),
                };
                match columns.get_mut(index) {
                    Some(most) => *most = letters.max(*most),
                    None => columns.push(letters),
                }
            }
        }
        // What is left and right of a cell is as wide as two letters.
        let letters: usize = columns.iter().map(|c| c + 2).sum();
        if letters > LETTERS {
            let start: String = words_of(table).chars().take(80).collect();
            wide.push(format!("{letters} letters: {start}"));
        }
    }
    let boxes = page.matches("<div class=\"scroll\"").count();
    let inside = page.matches("<table ").count();
    if boxes < inside {
        wide.push(format!("{inside} tables in {boxes} boxes"));
    }
    wide
}

/// Numbers of a page with an exponent, but those of scenes and commands, which are as they were written.
pub(crate) fn exponents(page: &str) -> Vec<String> {
    let body = page.split("<main>").nth(1).unwrap();
    let body = body.split("<script>").next().unwrap();
    let mut text = String::new();
    for (index, piece) in body.split("<pre>").enumerate() {
        let own = match index {
            0 => piece,
            _ => piece.split_once("</pre>").map_or("", |(_, rest)| rest),
        };
        text.push_str(&words_of(&own.replace('<', " <")));
    }
    let numbers = text.split(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '.' | '-' | '+'));
    let is_exponent = |word: &&str| {
        let Some((digits, exponent)) = word.split_once(['e', 'E']) else {
            return false;
        };
        let is_number = |t: &str| !t.is_empty() && t.parse::<f64>().is_ok();
        is_number(digits) && is_number(exponent)
    };
    numbers.filter(is_exponent).map(str::to_owned).collect()
}

/// Methods that have more than one colour or marker in charts, rankings and lists.
pub(crate) fn methods_of_two_looks(page: &str) -> Vec<String> {
    let mut looks: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    // Badges are markers in lines of text: the name follows.
    let page = page.replace("<wbr>", "");
    for piece in page.split("<svg class=\"badge ").skip(1) {
        let (color, rest) = piece.split_once('"').unwrap();
        let (marker, rest) = rest.split_once("</svg>").unwrap();
        let marker = marker.rsplit_once("<").unwrap().0;
        let shape = marker.split_once("<").unwrap().1;
        let name = words_of(rest.trim_start_matches("<b>").split('<').next().unwrap());
        looks
            .entry(name)
            .or_default()
            .insert(format!("{color} {shape}"));
    }
    // Names at the ends of lines have the colour of their line.
    let colors = |looks: &BTreeSet<String>| -> BTreeSet<String> {
        looks
            .iter()
            .map(|l| l.split(' ').next().unwrap().to_owned())
            .collect()
    };
    let mut ends: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for group in page.split("<g class=\"c").skip(1) {
        let group = group.split("</g>").next().unwrap();
        if let Some((_, text)) = group.split_once("<text class=\"ending\"") {
            let name = words_of(text.split_once('>').unwrap().1);
            let color = group.split('"').next().unwrap();
            ends.entry(name).or_default().insert(format!("c{color}"));
        }
    }
    let mut wrong: Vec<String> = Vec::new();
    wrong.extend(
        looks
            .iter()
            .filter(|(_, l)| l.len() > 1)
            .map(|(n, l)| format!("{n}: {l:?}")),
    );
    for (name, color) in ends {
        let known = looks.get(&name).map(colors).unwrap_or_default();
        if color.len() > 1 || known.iter().any(|k| !color.contains(k)) {
            wrong.push(format!("{name}: {color:?} and {known:?}"));
        }
    }
    wrong
}

/// Links into the page that lead nowhere, and places that two links could mean.
pub(crate) fn broken_links(page: &str) -> Vec<String> {
    let ids = between(page, " id=\"", "\"");
    let links = between(page, "href=\"#", "\"");
    assert!(links.len() > 3, "{links:?}");
    let lost = links.iter().filter(|l| !l.is_empty() && !ids.contains(l));
    let twice = ids
        .iter()
        .filter(|id| ids.iter().filter(|i| i == id).count() > 1);
    lost.chain(twice).map(|s| (*s).to_owned()).collect()
}

/// Notices that a page has twice in one place: before the sections, or in one point.
pub(crate) fn repeated_notices(page: &str) -> Vec<String> {
    let mut repeated = Vec::new();
    for part in page.split("<summary>") {
        let notices = between(part, "<p class=\"notice", "</p>");
        let remedies = notices.iter().filter_map(|n| n.split_once("To do: "));
        let mut seen: Vec<&str> = Vec::new();
        for (_, remedy) in remedies {
            if seen.contains(&remedy) {
                repeated.push(remedy.to_owned());
            }
            seen.push(remedy);
        }
    }
    repeated
}

/// Everything that is wrong with a page.
pub(crate) fn faults(page: &str) -> Vec<String> {
    let of = |what: &str, found: Vec<String>| -> Vec<String> {
        found.into_iter().map(|f| format!("{what}: {f}")).collect()
    };
    [
        of("wide", wide_tables(page)),
        of("exponent", exponents(page)),
        of("look", methods_of_two_looks(page)),
        of("link", broken_links(page)),
        of("repeated", repeated_notices(page)),
    ]
    .concat()
}

#[test]
fn planted_faults_of_form_are_found() {
    let links = "<a href=\"#a\"></a>".repeat(4);
    let calm = format!(
        "<i id=\"a\"></i>{links}<main><div class=\"scroll\"><table class=\"grid\"><tr><th scope=\"col\">a</th></tr></table></div>\
         <svg class=\"badge c1\"><path d=\"M0\"></path></svg>planar</main><script>1e5</script>"
    );
    assert_eq!(faults(&calm), [""; 0], "the control");
    let cells = "<td class=\"number\">×1.29 ± 0.05</td>".repeat(20);
    let plants = [
        (
            "</main>",
            format!(
                "<div class=\"scroll\"><table class=\"grid\"><tr>{cells}</tr></table></div></main>"
            ),
            "wide",
        ),
        (
            "</main>",
            "<table class=\"grid\"></table></main>".to_owned(),
            "wide",
        ),
        ("</main>", "<td>1.4e0</td></main>".to_owned(), "exponent"),
        ("</main>", "×3.5e1 px</main>".to_owned(), "exponent"),
        (
            "</main>",
            "<svg class=\"badge c2\"><path d=\"M0\"></path></svg>planar</main>".to_owned(),
            "look",
        ),
        (
            "</main>",
            "<svg class=\"badge c1\"><path d=\"M9\"></path></svg>planar</main>".to_owned(),
            "look",
        ),
        (
            "</main>",
            "<g class=\"c3\"><text class=\"ending\" x=\"1\">planar</text></g></main>".to_owned(),
            "look",
        ),
        ("</main>", "<a href=\"#b\"></a></main>".to_owned(), "link"),
        ("</main>", "<i id=\"a\"></i></main>".to_owned(), "link"),
        (
            "</main>",
            "<p class=\"notice\">x. To do: y.</p><p class=\"notice\">z. To do: y.</p></main>"
                .to_owned(),
            "repeated",
        ),
    ];
    for (place, plant, kind) in plants {
        let found = faults(&calm.replace(place, &plant));
        assert!(
            found.iter().any(|f| f.starts_with(kind)),
            "{plant}: {found:?}"
        );
    }
    assert_eq!(
        exponents("<main><pre>1e5</pre> 12e crank.2e3x</main>"),
        [""; 0]
    );
}
