//! How files are read: regular ones only, and no more of them than a machine can hold.
//!
//! A model comes from anywhere. A device or a pipe in its place would be read for ever, and a few kilobytes of gzip can unpack to any
//! size, so both are looked at before and while they are read.

use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::error::{Error, Result};

/// Most bytes of a file, and of what a packed one holds: some 100 million triangles of binary STL fit, and what is made of them
/// still fits into the memory of a workstation.
const MOST_BYTES: u64 = 8 << 30;

/// Most bytes of a packed file for each of its own. Of the real meshes at hand the best packs 1 to 23, a flat grid perhaps 1 to 100;
/// what gzip can do at most, 1 to 1032, only files do that are made for it.
const MOST_RATIO: u64 = 250;

/// Up to so many bytes the ratio does not count: little harm is in them, and tiny files of one repeated value are common in tests.
const RATIO_COUNTS_FROM: u64 = 64 << 20;

/// The length of a file that can be read; what is no regular file is refused by what it is.
pub(crate) fn check(path: &Path) -> Result<u64> {
    let metadata = std::fs::metadata(path).map_err(|e| unreadable(path, &e))?;
    if !metadata.is_file() {
        let what = match kind(&metadata) {
            "folder" => "cannot be read: it is a folder".to_owned(),
            kind => format!("cannot be read: it is a {kind}, not a regular file"),
        };
        let help = "give the name of a file; save what comes through a pipe to one first";
        return Err(Error::file(path, what, help));
    }
    if metadata.len() > MOST_BYTES {
        let what = format!("it has {} bytes, more than {MOST_BYTES}", metadata.len());
        return Err(Error::file(path, what, "split it into several files"));
    }
    Ok(metadata.len())
}

/// The bytes of a regular file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    let length = check(path)?;
    let file = std::fs::File::open(path).map_err(|e| unreadable(path, &e))?;
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    // A file that grows meanwhile is read no further than its limit.
    file.take(MOST_BYTES)
        .read_to_end(&mut bytes)
        .map_err(|e| unreadable(path, &e))?;
    Ok(bytes)
}

/// The bytes of a regular file, unpacked if they are gzipped, whatever the name says.
pub(crate) fn read_unpacked(path: &Path) -> Result<Vec<u8>> {
    let bytes = read(path)?;
    if bytes.starts_with(&[0x1f, 0x8b]) {
        unpacked(path, &bytes)
    } else {
        Ok(bytes)
    }
}

fn unpacked(path: &Path, packed: &[u8]) -> Result<Vec<u8>> {
    let of_ratio = (packed.len() as u64).saturating_mul(MOST_RATIO);
    let most = of_ratio.clamp(RATIO_COUNTS_FROM, MOST_BYTES);
    let mut bytes = Vec::new();
    MultiGzDecoder::new(packed)
        .take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| {
            let what = format!("gzip: {e} after {} bytes", bytes.len());
            let help = "the archive is cut off or damaged: get it again";
            Error::file(path, what, help)
        })?;
    if bytes.len() as u64 > most {
        let limit = if most < MOST_BYTES {
            format!("{MOST_RATIO} bytes for each of its {}", packed.len())
        } else {
            format!("{MOST_BYTES} bytes")
        };
        let what = format!("gzip: it unpacks to more than {limit}");
        let help = "if that is meant, unpack it with gunzip and give the result";
        return Err(Error::file(path, what, help));
    }
    Ok(bytes)
}

fn unreadable(path: &Path, e: &std::io::Error) -> Error {
    let help = match e.kind() {
        std::io::ErrorKind::NotFound => {
            "check the path; in a scene file it is relative to that file"
        }
        std::io::ErrorKind::PermissionDenied => "make the file readable",
        _ => "check that it is a file that can be read",
    };
    Error::file(path, format!("cannot be read: {e}"), help)
}

#[cfg(unix)]
fn kind(metadata: &std::fs::Metadata) -> &'static str {
    use std::os::unix::fs::FileTypeExt;

    let kind = metadata.file_type();
    if kind.is_dir() {
        "folder"
    } else if kind.is_fifo() {
        "pipe"
    } else if kind.is_socket() {
        "socket"
    } else {
        "device"
    }
}

#[cfg(not(unix))]
fn kind(metadata: &std::fs::Metadata) -> &'static str {
    if metadata.is_dir() {
        "folder"
    } else {
        "device"
    }
}
