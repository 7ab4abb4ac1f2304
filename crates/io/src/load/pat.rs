//! Reads hatch patterns from the PAT files of drawing programs.
//!
//! A pattern begins with `*NAME, description`. Each line after that is a family of lines: angle, x and y of a point, and the offsets along
//! and across to the next line. Dash lengths may follow, positive for dashes, 0 for dots and negative for gaps. A `;` begins a comment.

use std::path::Path;

use cutaway::error::{Error, Result};
use cutaway::scene::{Dash, HatchPattern, LineFamily, MOST_STROKES};

use super::without_mark;

/// Maximum number of line families in a pattern. Each pixel evaluates all of them.
const MOST_FAMILIES: usize = 64;

/// Returns the patterns of a file with their names, in file order. An invalid pattern does not affect the others.
///
/// # Errors
///
/// Fails if the file has no pattern, or has lines before its first pattern.
pub fn read_patterns(path: &Path, bytes: &[u8]) -> Result<Vec<(String, Result<HatchPattern>)>> {
    let text = String::from_utf8_lossy(without_mark(bytes));
    let mut patterns: Vec<(String, Result<HatchPattern>)> = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split(';').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        let fault = |what: String| {
            let help = "write for example `45, 0,0, 0,1` or `0, 0,0, 2,1, 3,-1` below `*NAME`";
            Error::file(path, format!("line {number}: {what}"), help)
        };
        if let Some(title) = line.strip_prefix('*') {
            let name = title.split(',').next().unwrap_or_default().trim();
            let pattern = HatchPattern {
                name: name.to_owned(),
                families: Vec::new(),
            };
            patterns.push((name.to_owned(), Ok(pattern)));
            continue;
        }
        let Some((name, pattern)) = patterns.last_mut() else {
            return Err(fault("lines before the first `*NAME`".into()));
        };
        let Ok(read) = pattern else {
            continue;
        };
        match family(line) {
            Ok(_) if read.families.len() == MOST_FAMILIES => {
                let what = format!("{name} has more than {MOST_FAMILIES} families of lines");
                *pattern = Err(fault(what));
            }
            Ok(family) => read.families.push(family),
            Err(what) => *pattern = Err(fault(what)),
        }
    }
    if patterns.is_empty() {
        let help = "begin each pattern with `*NAME, description`";
        return Err(Error::file(path, "it contains no pattern", help));
    }
    for (name, pattern) in &mut patterns {
        if pattern.as_ref().is_ok_and(|p| p.families.is_empty()) {
            let what = format!("the pattern {name} has no lines");
            let help = "write for example `45, 0,0, 0,1` below its name";
            *pattern = Err(Error::file(path, what, help));
        }
    }
    Ok(patterns)
}

fn family(line: &str) -> Result<LineFamily, String> {
    let fields = line.split(',').map(str::trim);
    // A trailing comma is common.
    let fields = fields.filter(|f| !f.is_empty());
    let numbers: Result<Vec<f64>, String> = fields
        .map(|f| match f.parse::<f64>() {
            Ok(number) if number.is_finite() && number.abs() < 1e9 => Ok(number),
            _ => Err(format!("`{f}` is not a number")),
        })
        .collect();
    let numbers = numbers?;
    let [angle_deg, x, y, shift, spacing, dashes @ ..] = numbers.as_slice() else {
        return Err(format!(
            "it has {} numbers, but needs at least 5",
            numbers.len()
        ));
    };
    if spacing.abs() < 1e-9 {
        return Err("the distance from line to line is 0".into());
    }
    let dashes: Vec<Dash> = dashes
        .iter()
        .map(|length| Dash {
            length: length.abs(),
            is_drawn: *length >= 0.0,
        })
        .collect();
    let family = LineFamily {
        angle_deg: *angle_deg,
        origin: [*x, *y],
        shift: *shift,
        spacing: *spacing,
        dashes,
    };
    if family.dashes.iter().filter(|d| d.is_drawn).count() > MOST_STROKES {
        return Err(format!("it has more than {MOST_STROKES} strokes and dots"));
    }
    if !family.dashes.is_empty() && family.period() < 1e-9 {
        return Err("its dashes have no length".into());
    }
    Ok(family)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<HatchPattern>> {
        let patterns = read_patterns(Path::new("test.pat"), text.as_bytes())?;
        patterns.into_iter().map(|(_, pattern)| pattern).collect()
    }

    #[test]
    fn a_pattern_that_is_too_much_hinders_no_other() {
        let many = "0,0,0,0,1\n".repeat(MOST_FAMILIES + 1);
        let text = format!("*GOOD\n45,0,0,0,1\n*MANY\n{many}*LAST\n45,0,0,0,1\n");
        let patterns = read_patterns(Path::new("test.pat"), text.as_bytes()).unwrap();
        let read: Vec<bool> = patterns.iter().map(|(_, p)| p.is_ok()).collect();
        assert_eq!(read, [true, false, true]);
    }

    #[test]
    fn lines_dashes_dots_and_comments_are_read() {
        let text = "\u{feff};; units\n*BRASS, alternating\n45, 0,0, 0,.25\n45, .1768,0, 0,.25, .125,-.0625, ; dashed\n\n*DOTS\n0,0,0,.5,1,0,-1\n";
        let patterns = read(text).unwrap();
        assert_eq!(patterns.len(), 2);
        let [solid, dashed] = patterns[0].families.as_slice() else {
            panic!("two families");
        };
        assert_eq!((solid.angle_deg, solid.spacing), (45.0, 0.25));
        assert!(solid.dashes.is_empty());
        assert_eq!(dashed.origin, [0.1768, 0.0]);
        assert_eq!(dashed.period(), 0.1875);
        assert_eq!(patterns[1].name, "DOTS");
        let dots = &patterns[1].families[0];
        assert_eq!(
            (dots.shift, dots.dashes[0].is_drawn, dots.dashes[0].length),
            (0.5, true, 0.0)
        );
    }

    #[test]
    fn what_is_no_pattern_is_told_by_its_line() {
        for (text, what) in [
            ("", "no pattern"),
            ("45,0,0,0,1\n", "line 1"),
            ("*A\n", "A has no lines"),
            ("*A\n45,0,0,0\n", "line 2"),
            ("*A\n45,0,0,0,0\n", "line 2"),
            ("*A\n45,0,0,x,1\n", "`x`"),
            ("*A\n45,0,0,0,1,inf\n", "`inf`"),
            ("*A\n45,0,0,0,1,0,0\n", "no length"),
            ("*A\n45,0,0,0,1,1,-1,1,-1,1,-1,1,-1,1\n", "strokes"),
        ] {
            let error = read(text).expect_err(text).to_string();
            assert!(
                error.contains(what) && error.contains("help:"),
                "{text:?}: {error}"
            );
        }
    }
}
