//! Reads the Wavefront material libraries that an OBJ names: each material's colour, image and transparency (`Kd`, `map_Kd`, `d`, `Tr`).
//! Everything else in a library is ignored, including image options.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error};
use cutaway::scene::{Texture, TextureKind};
use glam::Vec3;

use super::gltf::leads_away;
use super::lines::lines;
use super::painted::Paint;
use super::{Files, input_file, read_texture_from, without_mark};

/// The material libraries that an OBJ names, in order, and the images that those libraries name.
pub(super) fn libraries(folder: &Path, bytes: &[u8], store: &dyn Files) -> Vec<PathBuf> {
    let text = String::from_utf8_lossy(without_mark(bytes));
    let words = lines(&text).filter_map(|l| l.trim().split_once(char::is_whitespace));
    let lines = words.filter(|(word, _)| *word == "mtllib");
    let libraries: Vec<PathBuf> = lines
        .flat_map(|(_, rest)| named(folder, rest.trim(), store))
        .collect();
    let images = libraries.iter().flat_map(|library| {
        let bytes = input_file::read(library, store).unwrap_or_default();
        let beside = library.parent().unwrap_or(Path::new("")).to_owned();
        let text = String::from_utf8_lossy(without_mark(&bytes)).into_owned();
        let names: Vec<String> = images_in(&text)
            .filter(|name| leads_away(name).is_none())
            .collect();
        names.into_iter().map(move |name| beside.join(name))
    });
    let images: Vec<PathBuf> = images.collect();
    [libraries, images].concat()
}

/// The files of an `mtllib` line. The line holds either one name that contains spaces, or several names without spaces.
fn named(folder: &Path, line: &str, store: &dyn Files) -> Vec<PathBuf> {
    let names: Vec<&str> = if store.is_file(&folder.join(line)) {
        vec![line]
    } else {
        line.split_whitespace().collect()
    };
    // Libraries written on Windows use backslashes.
    let names = names.iter().map(|name| name.replace('\\', "/"));
    names.map(|name| folder.join(name)).collect()
}

/// Colours and images by material name.
pub(super) fn read_all(
    obj: &Path,
    lines: &[String],
    store: &dyn Files,
    (notes, files): (&mut Vec<Diagnostic>, &mut Vec<PathBuf>),
) -> HashMap<String, Paint> {
    let folder = obj.parent().unwrap_or(Path::new(""));
    let mut paints = HashMap::new();
    let mut images: HashMap<PathBuf, Option<Arc<Texture>>> = HashMap::new();
    for line in lines {
        for path in named(folder, line, store) {
            match input_file::read(&path, store) {
                Ok(bytes) => {
                    let beside = path.parent().unwrap_or(Path::new("")).to_owned();
                    files.push(path);
                    for look in looks_of(&String::from_utf8_lossy(without_mark(&bytes))) {
                        let image = look.image.and_then(|name| {
                            let at = beside.join(&name);
                            let read = || image(&at, &name, store, (notes, files));
                            images.entry(at.clone()).or_insert_with(read).clone()
                        });
                        let paint = Paint {
                            color: look.color,
                            is_transparent: look.is_transparent,
                            image,
                        };
                        paints.insert(look.name, paint);
                    }
                }
                Err(e) => {
                    let why = e.into_what();
                    let name = path.strip_prefix(folder).unwrap_or(&path).display();
                    let text = format!("material library {name} {why}: default colours");
                    notes.push(Diagnostic::note("material-library-left-out", text));
                }
            }
        }
    }
    paints
}

/// Reads an image in the library's folder or below. A fault becomes a note.
fn image(
    path: &Path,
    name: &str,
    store: &dyn Files,
    (notes, files): (&mut Vec<Diagnostic>, &mut Vec<PathBuf>),
) -> Option<Arc<Texture>> {
    let read = match leads_away(name) {
        Some(what) => Err(what.to_owned()),
        None => read_texture_from(path, TextureKind::Color, store).map_err(Error::into_what),
    };
    match read {
        Ok(texture) => {
            files.push(path.to_owned());
            Some(Arc::new(texture))
        }
        Err(why) => {
            notes.push(Diagnostic::note(
                "image-left-out",
                format!("image {name} {why}: shown without it"),
            ));
            None
        }
    }
}

/// Properties of a material in a library.
#[derive(Debug, PartialEq)]
struct MtlMaterial {
    name: String,
    /// `Kd`, as sRGB in 0..=1.
    color: Option<Vec3>,
    /// `map_Kd`.
    image: Option<String>,
    /// `d` below 1, or `Tr` above 0.
    is_transparent: bool,
}

/// The images that a library names.
fn images_in(text: &str) -> impl Iterator<Item = String> {
    looks_of(text).into_iter().filter_map(|look| look.image)
}

/// Parses all materials. If a material's colour cannot be parsed, the material has no colour.
fn looks_of(text: &str) -> Vec<MtlMaterial> {
    let mut all: Vec<MtlMaterial> = Vec::new();
    for line in lines(text).map(str::trim) {
        if let Some(name) = line.strip_prefix("newmtl") {
            all.push(MtlMaterial {
                name: name.trim().to_owned(),
                color: None,
                image: None,
                is_transparent: false,
            });
            continue;
        }
        let Some(look) = all.last_mut() else { continue };
        if let Some(rest) = line.strip_prefix("Kd ") {
            let parsed: Vec<f32> = rest
                .split_whitespace()
                .map_while(|w| w.parse().ok())
                .collect();
            // A single number stands for all three channels.
            look.color = match parsed.as_slice() {
                [r, g, b, ..] => Some(Vec3::new(*r, *g, *b)),
                [grey] => Some(Vec3::splat(*grey)),
                _ => None,
            }
            .filter(|c| c.is_finite())
            .map(|c| c.clamp(Vec3::ZERO, Vec3::ONE));
        } else if let Some(rest) = line.strip_prefix("map_Kd ") {
            let rest = rest.trim();
            // The name follows the options, which begin with `-`; without options the name may contain spaces.
            let name = match rest.starts_with('-') {
                true => rest.split_whitespace().next_back().unwrap_or(rest),
                false => rest,
            };
            look.image = Some(name.replace('\\', "/"));
        } else if let Some((word @ ("d" | "Tr"), rest)) = line.split_once(char::is_whitespace) {
            let share = rest
                .split_whitespace()
                .next_back()
                .and_then(|w| w.parse().ok());
            let opaque = share.map(|share: f32| if word == "d" { share } else { 1.0 - share });
            look.is_transparent = opaque.is_some_and(|opaque| opaque < 1.0);
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
        let all = looks_of(text);
        assert!(!all[0].is_transparent && !all[1].is_transparent);
        let glass = looks_of("newmtl a\nd 0.3\nnewmtl b\nTr 0.2\nnewmtl c\nd -halo 1.0\nTr 0\n");
        let is_glass: Vec<bool> = glass.iter().map(|look| look.is_transparent).collect();
        assert_eq!(is_glass, [true, true, false]);
        assert_eq!(all[0].name, "red steel");
        assert_eq!(all[0].color, Some(Vec3::new(1.0, 0.25, 0.0)));
        assert_eq!(all[1].color, Some(Vec3::splat(0.5)));
        assert_eq!(all[2].color, None);
    }

    #[test]
    fn images_are_named_behind_their_options() {
        let text = "newmtl a\nmap_Kd my wall.png\nnewmtl b\nmap_Kd -s 2 2 1 sub\\b.png\nnewmtl c\n";
        let images: Vec<_> = looks_of(text).into_iter().map(|look| look.image).collect();
        let named = ["my wall.png", "sub/b.png"].map(|name| Some(name.to_owned()));
        assert_eq!(images, [&named[..], &[None]].concat());
    }
}
