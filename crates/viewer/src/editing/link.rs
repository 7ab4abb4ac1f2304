//! Encodes a scene as a URL fragment: its document, compressed by DEFLATE and written in URL-safe Base64.
//!
//! A fragment is never sent to a server. It contains the document, but not the files that it names. The recipient
//! would need these files as well, so there is no link for a scene with files.
//!
//! A scene with a few cuts takes 200 to 600 characters. Cannot: encode more than a megabyte of scene text.

use std::io::{Read, Write};

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use cutaway::{Error, Result};
use cutaway_io::Document;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;

/// Text before the scene in a fragment; it identifies the encoding.
const KEY: &str = "scene=";

/// Maximum size of the decompressed text: a longer one is not a scene but an attack.
const MOST_BYTES: u64 = 1 << 20;

/// The URL fragment for a document.
///
/// # Errors
///
/// The document names files, or its text is too long.
pub fn fragment(document: &Document) -> Result<String> {
    let files = document.files(&cutaway_io::load::Memory::default());
    if let Some(file) = files.first() {
        return Err(Error::input(
            "the link",
            format!("it contains the scene, but not the file {}", file.display()),
            "save the scene and pass it on together with its files",
        ));
    }
    let text = document.to_string();
    if text.len() as u64 > MOST_BYTES {
        let what = format!("the scene has more than {MOST_BYTES} bytes of text");
        return Err(Error::input("the link", what, "save the scene instead"));
    }
    let packed = || {
        let mut packed = DeflateEncoder::new(Vec::new(), Compression::best());
        packed.write_all(text.as_bytes())?;
        packed.finish()
    };
    let packed = packed().map_err(|e: std::io::Error| unreadable(&e.to_string()))?;
    Ok(format!("{KEY}{}", URL_SAFE_NO_PAD.encode(packed)))
}

/// The document in a fragment; `None` if it contains none.
///
/// # Errors
///
/// The scene is damaged or too long.
pub fn document(fragment: &str) -> Result<Option<Document>> {
    let fragment = fragment.trim_start_matches('#');
    let Some(packed) = fragment.strip_prefix(KEY) else {
        return Ok(None);
    };
    let packed = URL_SAFE_NO_PAD.decode(packed);
    let packed = packed.map_err(|e| unreadable(&e.to_string()))?;
    let mut text = String::new();
    let mut unpacked = DeflateDecoder::new(&*packed).take(MOST_BYTES + 1);
    (unpacked.read_to_string(&mut text)).map_err(|e| unreadable(&e.to_string()))?;
    if text.len() as u64 > MOST_BYTES {
        return Err(unreadable("it is too long"));
    }
    Document::parse("", &text).map(Some)
}

fn unreadable(why: &str) -> Error {
    Error::input(
        "the link",
        format!("its scene cannot be read: {why}"),
        "copy the whole link again",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "# A comment.\n[[part]]\nshape = \"crank\"\n\n[[cut]]\nsurfaces = [{ section = \"x=50%\" }]\n";

    #[test]
    fn a_scene_comes_back_with_its_comments() {
        let scene = Document::parse("", SCENE).expect("a scene");
        let fragment = fragment(&scene).expect("a fragment");
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_=".contains(c);
        assert!(fragment.chars().all(plain), "{fragment}");
        let back = document(&format!("#{fragment}"))
            .expect("a scene")
            .expect("one");
        assert_eq!(back.to_string(), SCENE);
    }

    #[test]
    fn what_is_no_scene_is_refused_or_left_alone() {
        assert!(document("#top").expect("no scene").is_none());
        let scene = Document::parse("", SCENE).expect("a scene");
        let whole = fragment(&scene).expect("a fragment");
        assert!(document(&whole[..whole.len() - 9]).is_err(), "cut short");
        assert!(document("scene=%%%").is_err(), "another alphabet");
        let long = format!("{SCENE}# {}\n", "x".repeat(MOST_BYTES as usize));
        let long = Document::parse("", &long).expect("a scene");
        assert!(fragment(&long).is_err(), "too long");
        let files = "[[part]]\nmesh = \"bracket.stl\"\n";
        let files = Document::parse("", files).expect("a scene");
        let refused = fragment(&files).expect_err("a file").to_string();
        assert!(refused.contains("bracket.stl"), "{refused}");
    }
}
