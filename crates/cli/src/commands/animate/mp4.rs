//! Checks by its boxes whether an MP4 file is complete: an encoder may report success although the disk is full.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// Description of what the file lacks to be playable, if anything: the frame index (`moov`), the frames (`mdat`), or the end of
/// a box.
pub(super) fn missing(path: &Path) -> std::io::Result<Option<String>> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    if length == 0 {
        return Ok(Some("it is empty".to_owned()));
    }
    let mut found = Vec::new();
    let mut at = 0;
    while at < length {
        let mut head = [0; 16];
        file.seek(SeekFrom::Start(at))?;
        let wanted = head.len().min((length - at) as usize);
        file.read_exact(&mut head[..wanted])?;
        let [a, b, c, d, kind @ ..] = head;
        let (kind, long) = kind.split_at(4);
        let size = match u32::from_be_bytes([a, b, c, d]) {
            // Size 0: the box extends to the end of the file.
            0 => length - at,
            1 => long.first_chunk().map_or(0, |b| u64::from_be_bytes(*b)),
            size => u64::from(size),
        };
        if size < 8 || size > length - at {
            return Ok(Some(format!(
                "it ends within its box number {}",
                found.len() + 1
            )));
        }
        found.push(kind.to_owned());
        at += size;
    }
    let lacks = |kind: &&str| !found.iter().any(|f| f == kind.as_bytes());
    let missing = ["ftyp", "moov", "mdat"].into_iter().find(lacks);
    Ok(missing.map(|kind| format!("it has no box {kind:?}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_without_its_end_or_its_index_is_not_whole() {
        let path = std::env::temp_dir().join(format!("cutaway-{}.mp4", std::process::id()));
        let of = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            missing(&path).unwrap()
        };
        let whole = b"\0\0\0\x08ftyp\0\0\0\x0amdat12\0\0\0\x08moov";
        assert_eq!(of(whole), None);
        let large = b"\0\0\0\x08ftyp\0\0\0\x01mdat\0\0\0\0\0\0\0\x1112\0\0\0\0moov";
        assert_eq!(
            of(&large[..]).as_deref(),
            Some("it ends within its box number 3")
        );
        for length in [0, 8, 12, 18, 21, whole.len() - 1] {
            assert!(of(&whole[..length]).is_some(), "{length} bytes are whole");
        }
        std::fs::remove_file(path).unwrap();
    }
}
