//! The bytes behind a glTF buffer's URI: a data URI or a file beside the model.

use std::path::Path;

use crate::error::{Error, Result};

/// Reads a URI relative to the file `from`.
pub(super) fn read(from: &Path, uri: &str) -> Result<Vec<u8>> {
    if let Some(data) = uri.strip_prefix("data:") {
        let bytes = data
            .split_once(',')
            .filter(|(kind, _)| kind.ends_with(";base64"))
            .and_then(|(_, text)| from_base64(text));
        return bytes.ok_or_else(|| {
            Error::file(
                from,
                "a buffer's data URI is not base64",
                "export the file again",
            )
        });
    }
    if uri.contains("://") {
        let what = format!("a buffer is at {uri}, and nothing is fetched from elsewhere");
        return Err(Error::file(from, what, "download it beside the model"));
    }
    let folder = from.parent().unwrap_or(Path::new(""));
    let path = folder.join(percent_decoded(uri));
    std::fs::read(&path).map_err(|e| {
        let what = format!("its buffer {} cannot be read: {e}", path.display());
        Error::file(from, what, "keep the model and its .bin file together")
    })
}

/// `%20` and the like; anything else stays.
fn percent_decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, more @ ..] = rest {
        let hex = (*first == b'%')
            .then(|| std::str::from_utf8(more.get(..2)?).ok())
            .flatten()
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        bytes.push(hex.unwrap_or(*first));
        rest = if hex.is_some() { &more[2..] } else { more };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn from_base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=');
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    let (mut held, mut bits) = (0_u32, 0);
    for c in text.bytes() {
        let six = match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return None,
        };
        held = (held << 6) | u32::from(six);
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((held >> bits) as u8);
            held &= (1 << bits) - 1;
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_and_percent() {
        assert_eq!(from_base64("TWFu").unwrap(), b"Man");
        assert_eq!(from_base64("TWE=").unwrap(), b"Ma");
        assert_eq!(from_base64("TQ==").unwrap(), b"M");
        assert!(from_base64("T!").is_none());
        assert_eq!(percent_decoded("a%20b%zz%"), "a b%zz%");
    }
}
