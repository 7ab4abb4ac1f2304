//! Wavefront material libraries: which ones an OBJ names, and their colours; everything else in them is passed over.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::{Files, input_file, without_mark};
use crate::error::Error;

/// The material libraries that an OBJ names, in its order.
pub(super) fn libraries(folder: &Path, bytes: &[u8], store: &dyn Files) -> Vec<PathBuf> {
    let text = String::from_utf8_lossy(without_mark(bytes));
    let words = text
        .lines()
        .filter_map(|l| l.trim().split_once(char::is_whitespace));
    let lines = words.filter(|(word, _)| *word == "mtllib");
    lines
        .flat_map(|(_, rest)| named(folder, rest.trim(), store))
        .collect()
}

/// The files of an `mtllib`, which takes one name with spaces or several without.
fn named(folder: &Path, line: &str, store: &dyn Files) -> Vec<PathBuf> {
    let names: Vec<&str> = if store.is_file(&folder.join(line)) {
        vec![line]
    } else {
        line.split_whitespace().collect()
    };
    // Written on Windows, read anywhere.
    let names = names.iter().map(|name| name.replace('\\', "/"));
    names.map(|name| folder.join(name)).collect()
}

/// Colours by material name.
pub(super) fn read_all(
    obj: &Path,
    lines: &[String],
    store: &dyn Files,
    (notes, files): (&mut Vec<String>, &mut Vec<PathBuf>),
) -> HashMap<String, Vec3> {
    let folder = obj.parent().unwrap_or(Path::new(""));
    let mut colors = HashMap::new();
    for line in lines {
        for path in named(folder, line, store) {
            match input_file::read(&path, store) {
                Ok(bytes) => {
                    files.push(path);
                    let all = colors_of(&String::from_utf8_lossy(without_mark(&bytes)));
                    colors.extend(all.into_iter().filter_map(|(n, c)| Some((n, c?))));
                }
                Err(e) => {
                    let why = match e {
                        Error::File { what, .. } => what,
                        other => other.to_string(),
                    };
                    notes.push({
                        let name = path.strip_prefix(folder).unwrap_or(&path).display();
                        format!("material library {name} {why}: default colours")
                    });
                }
            }
        }
    }
    colors
}

/// Names and `Kd` colours, as sRGB in 0..=1. A colour that does not parse leaves its material without one.
fn colors_of(text: &str) -> Vec<(String, Option<Vec3>)> {
    let mut all: Vec<(String, Option<Vec3>)> = Vec::new();
    for line in text.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("newmtl") {
            all.push((name.trim().to_owned(), None));
        } else if let Some(rest) = line.strip_prefix("Kd ")
            && let Some((_, color)) = all.last_mut()
        {
            let parsed: Vec<f32> = rest
                .split_whitespace()
                .map_while(|w| w.parse().ok())
                .collect();
            // A single number stands for all three channels.
            *color = match parsed.as_slice() {
                [r, g, b, ..] => Some(Vec3::new(*r, *g, *b)),
                [grey] => Some(Vec3::splat(*grey)),
                _ => None,
            }
            .filter(|c| c.is_finite())
            .map(|c| c.clamp(Vec3::ZERO, Vec3::ONE));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_and_odd_ones_survive() {
        let text = "newmtl red steel\n  Kd 1 0.25 0\nnewmtl grey\nKd 0.5\nnewmtl odd\nKd spectral x\nKa 1 1 1\n";
        let all = colors_of(text);
        assert_eq!(
            all[0],
            ("red steel".to_owned(), Some(Vec3::new(1.0, 0.25, 0.0)))
        );
        assert_eq!(all[1].1, Some(Vec3::splat(0.5)));
        assert_eq!(all[2].1, None);
    }
}
