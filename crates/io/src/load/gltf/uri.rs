//! Reads the URI of a glTF buffer or image, which may be a data URI or a file in the model's folder or below.

use std::path::{Path, PathBuf};

use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig, PAD_INDIFFERENT};
use base64::{Engine as _, alphabet};
use cutaway::error::{Error, Result};
use percent_encoding::percent_decode_str;

use crate::load::{Files, input_file};

const BESIDE: &str =
    "keep the file in the folder of the model or below, and name it relative to the model";

/// Reads a URI relative to the file `from`. If it is a file, it is added to `files`.
pub(super) fn read(
    from: &Path,
    (what, uri): (&str, &str),
    store: &dyn Files,
    files: &mut Vec<PathBuf>,
) -> Result<Vec<u8>> {
    if let Some(data) = uri.strip_prefix("data:") {
        let bytes = data
            .split_once(',')
            .filter(|(kind, _)| kind.ends_with(";base64"))
            .and_then(|(_, text)| from_base64(text));
        return bytes.ok_or_else(|| {
            Error::file(
                from,
                format!("the data URI of its {what} is not base64"),
                "export the file again",
            )
        });
    }
    let name = percent_decoded(uri);
    if let Some(why) = leads_away(&name) {
        let what = format!("its {what} {name:?} {why}");
        return Err(Error::file(from, what, BESIDE));
    }
    let folder = from.parent().unwrap_or(Path::new(""));
    let path = folder.join(&name);
    if store.leads_out(&path, from) {
        let what = format!("its {what} {name:?} is a link that leads out of the folder");
        return Err(Error::file(from, what, BESIDE));
    }
    let bytes = input_file::read(&path, store).map_err(|e| {
        let why = e.into_what();
        Error::file(from, format!("its {what} {name:?} {why}"), BESIDE)
    })?;
    files.push(path);
    Ok(bytes.into_owned())
}

/// Returns why a name is not allowed, unless it stays in the folder or below. A model must not read files from elsewhere.
pub(in crate::load) fn leads_away(name: &str) -> Option<&'static str> {
    let scheme = name.split_once(':').map(|(scheme, _)| scheme);
    let is_scheme = |s: &str| {
        let rest = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
        s.starts_with(|c: char| c.is_ascii_alphabetic()) && s.chars().all(rest)
    };
    if scheme.is_some_and(is_scheme) {
        return Some(
            "has a scheme or a drive, but nothing is fetched from outside the model's folder",
        );
    }
    if name.starts_with(['/', '\\']) {
        return Some("is an absolute path");
    }
    let mut depth = 0_i32;
    for step in name.split(['/', '\\']) {
        depth += match step {
            ".." => -1,
            "" | "." => 0,
            _ => 1,
        };
        if depth < 0 {
            return Some("leads out of the folder");
        }
    }
    None
}

/// Decodes `%20` and similar escapes; invalid escapes are kept.
pub(super) fn percent_decoded(text: &str) -> String {
    percent_decode_str(text).decode_utf8_lossy().into_owned()
}

/// Decodes base64 in either alphabet, with or without padding.
fn from_base64(text: &str) -> Option<Vec<u8>> {
    const LENIENT: GeneralPurposeConfig = PAD_INDIFFERENT.with_decode_allow_trailing_bits(true);
    let alphabet = match text.contains(['-', '_']) {
        true => &alphabet::URL_SAFE,
        false => &alphabet::STANDARD,
    };
    GeneralPurpose::new(alphabet, LENIENT).decode(text).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_away_are_told_apart() {
        for name in [
            "a.bin",
            "deep/er/a.bin",
            "deep/../a.bin",
            "./a.bin",
            "a..b",
            "1:a",
        ] {
            assert_eq!(leads_away(name), None, "{name}");
        }
        for name in [
            "/etc/passwd",
            "\\\\host\\a",
            "../a.bin",
            "a/../../b",
            "a\\..\\..\\b",
            "file:a.bin",
            "https://a/b",
            "C:\\a.bin",
        ] {
            assert!(leads_away(name).is_some(), "{name}");
        }
    }

    #[test]
    fn base64_and_percent() {
        assert_eq!(from_base64("TWFu").unwrap(), b"Man");
        assert_eq!(from_base64("TWE=").unwrap(), b"Ma");
        assert_eq!(from_base64("TQ==").unwrap(), b"M");
        assert_eq!(from_base64("TQ").unwrap(), b"M");
        assert_eq!(from_base64("-_8=").unwrap(), from_base64("+/8").unwrap());
        assert!(from_base64("T!").is_none());
        assert_eq!(percent_decoded("a%20b%zz%"), "a b%zz%");
    }
}
