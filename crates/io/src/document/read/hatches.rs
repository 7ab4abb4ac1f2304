//! `material.hatch`: a named pattern, or one from a PAT file: `"steel"`, `"mine.pat#OAK"`.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use cutaway::error::{Result, did_you_mean};
use cutaway::scene::{CapHatch, HatchPattern};

use super::opening::{LoadContext, missing};
use super::reader::Entry;
use crate::load::{Assets, read_patterns};

/// The built-in patterns. A test checks that they parse.
static NAMED: LazyLock<Vec<Arc<HatchPattern>>> = LazyLock::new(|| {
    let bytes = include_bytes!("../styles/patterns.pat");
    let patterns = read_patterns(Path::new("patterns.pat"), bytes).unwrap_or_default();
    let read = patterns.into_iter().filter_map(|(_, pattern)| pattern.ok());
    read.map(Arc::new).collect()
});

/// Named hatches that have no pattern.
const PLAIN: [(&str, CapHatch); 3] = [
    ("general", CapHatch::General),
    ("none", CapHatch::None),
    ("solid", CapHatch::Solid),
];

/// Names of hatches that need no file.
fn names() -> impl Iterator<Item = &'static str> {
    let plain = PLAIN.iter().map(|(name, _)| *name);
    plain.chain(NAMED.iter().map(|p| p.name.as_str()))
}

/// Splits a text into a pattern file and a pattern name. Returns `None` if the text does not name a file.
fn file_of(text: &str) -> Option<(&str, Option<&str>)> {
    let is_file = |text: &str| text.to_lowercase().ends_with(".pat");
    if is_file(text) {
        return Some((text, None));
    }
    let (file, name) = text.rsplit_once('#')?;
    is_file(file).then_some((file, Some(name)))
}

fn named(entry: &Entry<'_>, name: &str) -> Result<CapHatch> {
    if let Some((_, plain)) = PLAIN.iter().find(|(known, _)| *known == name) {
        return Ok(plain.clone());
    }
    match NAMED.iter().find(|p| p.name == name) {
        Some(pattern) => Ok(CapHatch::Pattern(pattern.clone())),
        None => {
            let near = did_you_mean(name, names());
            let help = format!("{near}, or name a pattern from a file as mine.pat#NAME");
            Err(entry.fault(format_args!("{name:?} is not a hatch"), help))
        }
    }
}

/// Checks everything that can be checked without opening a file.
pub(super) fn check(entry: &Entry<'_>, folder: &Path, assets: &Assets) -> Result<()> {
    match file_of(entry.text()?) {
        None => named(entry, entry.text()?).map(|_| ()),
        Some((file, _)) if assets.store().is_file(&folder.join(file)) => Ok(()),
        Some((file, _)) => Err(missing(entry, &folder.join(file))),
    }
}

/// Opens the hatch named by a text.
pub(super) fn open(entry: &Entry<'_>, opening: &mut LoadContext<'_>) -> Result<CapHatch> {
    let Some((file, name)) = file_of(entry.text()?) else {
        return named(entry, entry.text()?);
    };
    let path = opening.folder.join(file);
    let bytes = opening.assets.store().read(&path).map_err(|e| {
        let help = "check the name, which is relative to the scene file";
        entry.fault(format_args!("{} cannot be read: {e}", path.display()), help)
    })?;
    let mut patterns = read_patterns(&path, &bytes)?;
    opening.files.insert(path);
    let found = match name {
        None if patterns.len() == 1 => Some(0),
        None => {
            let what = format!("{file} contains {} patterns", patterns.len());
            let first = &patterns[0].0;
            return Err(entry.fault(
                what,
                format!("name one of them, for example {file}#{first}"),
            ));
        }
        // Upper and lower case are not distinguished, as in drawing programs.
        Some(name) => (patterns.iter()).position(|(p, _)| p.eq_ignore_ascii_case(name)),
    };
    let Some(found) = found else {
        let name = name.unwrap_or_default();
        let what = format!("{file} contains no pattern `{name}`");
        let all = patterns.iter().map(|(name, _)| name.as_str());
        return Err(entry.fault(what, did_you_mean(name, all)));
    };
    Ok(CapHatch::Pattern(Arc::new(patterns.swap_remove(found).1?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_patterns_of_the_program_are_read() {
        let text = include_str!("../styles/patterns.pat");
        let titles = text.lines().filter(|l| l.starts_with('*')).count();
        assert_eq!(NAMED.len(), titles);
        assert!(titles >= 12, "{titles} patterns");
        for pattern in NAMED.iter() {
            let unit = pattern.unit();
            assert!((0.3..4.0).contains(&unit), "{}: unit {unit}", pattern.name);
        }
    }

    #[test]
    fn files_are_told_from_names() {
        assert_eq!(file_of("steel"), None);
        assert_eq!(file_of("a/b.pat"), Some(("a/b.pat", None)));
        assert_eq!(file_of("a#b/c.pat"), Some(("a#b/c.pat", None)));
        assert_eq!(file_of("b.PAT#OAK"), Some(("b.PAT", Some("OAK"))));
    }
}
