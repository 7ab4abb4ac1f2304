//! The attribute codec, mode 0, version 0: bytes of the same place in consecutive elements as differences.
//!
//! The elements come in blocks, and each block byte place by byte place, in groups of 16 differences: all zero, in 2 or 4 bits each with
//! longer ones after them, or whole. The first element differs from one that is the tail of the stream.

use super::{cut_off, parted, too_long};

/// The first byte of a stream.
const VERSION_0: u8 = 0xa0;

/// Least length of the tail.
const TAIL_BYTES: usize = 32;

/// Differences of a group.
const GROUP: usize = 16;

/// How many elements a block has at most.
fn block_elements(stride: usize) -> usize {
    ((8192 / stride) & !(GROUP - 1)).min(256)
}

/// Unpacks elements of `stride` bytes, 4 to 256.
pub(super) fn unpack(stream: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, String> {
    let (mut body, tail) = parted(stream, VERSION_0, TAIL_BYTES.max(stride))?;
    // Two bits for every group: no stream is shorter.
    let least = count.div_ceil(4 * GROUP).saturating_mul(stride);
    if body.len() < least {
        return Err(cut_off());
    }
    let mut element = tail[tail.len() - stride..].to_vec();
    let mut bytes = vec![0; count * stride];
    for block in bytes.chunks_mut(block_elements(stride) * stride) {
        let groups = (block.len() / stride).div_ceil(GROUP);
        for (place, last) in element.iter_mut().enumerate() {
            let modes = take(&mut body, groups.div_ceil(4))?;
            for group in 0..groups {
                let mode = modes[group / 4] >> (2 * (group % 4)) & 3;
                let differences = differences(&mut body, mode)?;
                let from = group * GROUP * stride + place;
                let places = block.iter_mut().skip(from).step_by(stride);
                for (byte, difference) in places.zip(differences) {
                    *last = last.wrapping_add(unfolded(difference));
                    *byte = *last;
                }
            }
        }
    }
    match body.len() {
        0 => Ok(bytes),
        more => Err(too_long(more)),
    }
}

/// The differences of a group.
fn differences(body: &mut &[u8], mode: u8) -> Result<[u8; GROUP], String> {
    let mut all = [0; GROUP];
    let bits = match mode {
        0 => return Ok(all),
        1 => 2,
        2 => 4,
        _ => {
            all.copy_from_slice(take(body, GROUP)?);
            return Ok(all);
        }
    };
    let packed = take(body, GROUP * bits / 8)?;
    let per_byte = 8 / bits;
    let most = (1 << bits) - 1;
    for (i, difference) in all.iter_mut().enumerate() {
        // The first is in the highest bits.
        let shift = 8 - bits * (i % per_byte + 1);
        let short = packed[i / per_byte] >> shift & most;
        *difference = match short == most {
            true => take(body, 1)?[0],
            false => short,
        };
    }
    Ok(all)
}

/// A difference whose sign is in its lowest bit.
fn unfolded(folded: u8) -> u8 {
    match folded & 1 {
        0 => folded >> 1,
        _ => !(folded >> 1),
    }
}

fn take<'a>(body: &mut &'a [u8], count: usize) -> Result<&'a [u8], String> {
    let (taken, rest) = body.split_at_checked(count).ok_or_else(cut_off)?;
    *body = rest;
    Ok(taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_example_of_the_specification() {
        let mut body: &[u8] = &[0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5];
        let found = differences(&mut body, 2).unwrap();
        let found = found.map(|d| i16::from(unfolded(d) as i8));
        let expected = [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0];
        assert_eq!((found, body.len()), (expected, 0));
    }

    #[test]
    fn elements_continue_from_the_tail_through_all_blocks() {
        // 300 equal elements in two blocks, then one difference of 1 in the second byte of the last group.
        let count = 300;
        let mut stream = vec![VERSION_0];
        for (groups, is_last) in [(16_usize, false), (3, true)] {
            for place in 0..4 {
                let mut modes = vec![0; groups.div_ceil(4)];
                let differs = is_last && place == 1;
                if differs {
                    modes[0] = 3 << 4;
                }
                stream.extend(modes);
                if differs {
                    stream.extend([2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
                }
            }
        }
        stream.extend([0; 28]);
        stream.extend([9, 8, 7, 6]);
        let bytes = unpack(&stream, count, 4).unwrap();
        let elements: Vec<&[u8]> = bytes.chunks(4).collect();
        assert_eq!(elements.len(), count);
        assert!(elements[..288].iter().all(|e| **e == [9, 8, 7, 6]));
        assert!(elements[288..].iter().all(|e| **e == [9, 9, 7, 6]));
        for wrong in [&stream[..stream.len() - 1], &[&stream[..], &[0]].concat()] {
            assert!(unpack(wrong, count, 4).is_err(), "{} bytes", wrong.len());
        }
        assert!(unpack(&stream, 1 << 40, 4).is_err(), "room for nothing");
    }
}
