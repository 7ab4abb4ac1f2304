//! The attribute codec (mode 0), versions 0 and 1. It codes each byte of an element as a difference from the previous element.
//!
//! Elements are stored in blocks. A block is stored by byte position, in groups of 16 differences. The differences of a group are all zero,
//! have 1, 2 or 4 bits each with longer ones appended, or are whole bytes. In version 1 each byte position of a block selects one of two
//! sets of these bit counts, all zeros, or whole bytes. Each word of an element selects differences of bytes, 16-bit halves or single bits.
//! The first element is relative to one in the stream's tail.

use super::{cut_off, parted, too_long};

/// The first byte of a stream of `EXT_meshopt_compression`.
const VERSION_0: u8 = 0xa0;

/// The first byte of a stream that is only valid in `KHR_meshopt_compression`.
const VERSION_1: u8 = 0xa1;

/// Number of differences in a group.
const GROUP: usize = 16;

/// Number of bits per difference, by the group's mode.
const BITS_0: [u8; 4] = [0, 2, 4, 8];

/// Number of bits per difference in version 1, by the packing of the byte position and the group's mode.
const BITS_1: [[u8; 4]; 2] = [[0, 1, 2, 4], [1, 2, 4, 8]];

/// How a word of an element is coded relative to the previous element.
#[derive(Clone, Copy, Debug)]
enum Change {
    /// One difference for each byte.
    Bytes,
    /// One difference for each 16-bit half.
    Halves,
    /// XOR of the two words, rotated to the left by this number of bits.
    Bits(u32),
}

impl Change {
    fn of_channel(channel: u8) -> Result<Self, String> {
        match channel & 3 {
            0 => Ok(Self::Bytes),
            1 => Ok(Self::Halves),
            2 => Ok(Self::Bits(u32::from(channel >> 4))),
            _ => Err(format!("its stream has the unknown channel {channel:#04x}")),
        }
    }

    /// Returns the word that follows `last`.
    fn next(self, last: [u8; 4], packed: [u8; 4]) -> [u8; 4] {
        match self {
            Self::Bytes => std::array::from_fn(|i| last[i].wrapping_add(unfolded(packed[i]))),
            Self::Halves => {
                let half = |of: [u8; 4], i: usize| u16::from_le_bytes([of[2 * i], of[2 * i + 1]]);
                let next = [0, 1].map(|i| {
                    let folded = half(packed, i);
                    let difference = (folded >> 1) ^ (folded & 1).wrapping_neg();
                    half(last, i).wrapping_add(difference).to_le_bytes()
                });
                [next[0][0], next[0][1], next[1][0], next[1][1]]
            }
            Self::Bits(turned) => {
                let flipped = u32::from_le_bytes(packed).rotate_right(turned);
                (u32::from_le_bytes(last) ^ flipped).to_le_bytes()
            }
        }
    }
}

/// Maximum number of elements in a block.
fn block_elements(stride: usize) -> usize {
    ((8192 / stride) & !(GROUP - 1)).min(256)
}

/// Unpacks elements of `stride` bytes. The stride is a multiple of 4 from 4 to 256.
pub(super) fn unpack(stream: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, String> {
    let is_second = stream.first() == Some(&VERSION_1);
    let words = stride / 4;
    let of_block = block_elements(stride);
    // Every stream has at least two bits for each group, or one byte for each word of each block.
    let (header, tail_bytes, least_tail, least) = match is_second {
        false => (
            VERSION_0,
            stride,
            32,
            count.div_ceil(4 * GROUP).saturating_mul(stride),
        ),
        true => (
            VERSION_1,
            stride + words,
            24,
            count.div_ceil(of_block).saturating_mul(words),
        ),
    };
    let (mut body, tail) = parted(stream, header, tail_bytes.max(least_tail))?;
    if body.len() < least {
        return Err(cut_off());
    }
    let (first, channels) = tail[tail.len() - tail_bytes..].split_at(stride);
    let mut element = first.to_vec();
    let changes = match is_second {
        false => vec![Change::Bytes; words],
        true => (channels.iter().map(|c| Change::of_channel(*c))).collect::<Result<_, _>>()?,
    };
    let mut bytes = vec![0; count * stride];
    let mut packed = vec![0; of_block * stride];
    for block in bytes.chunks_mut(of_block * stride) {
        let elements = block.len() / stride;
        let controls = match is_second {
            false => None,
            true => Some(take(&mut body, words)?),
        };
        for (place, packed) in packed.chunks_mut(of_block).enumerate() {
            let packed = &mut packed[..elements];
            let control = controls.map(|all| all[place / 4] >> (2 * (place % 4)) & 3);
            match control {
                None => grouped(&mut body, BITS_0, packed)?,
                Some(2) => packed.fill(0),
                Some(3) => packed.copy_from_slice(take(&mut body, elements)?),
                Some(wider) => grouped(&mut body, BITS_1[usize::from(wider)], packed)?,
            }
        }
        for (number, into) in block.chunks_mut(stride).enumerate() {
            let pairs = element.as_chunks_mut::<4>().0.iter_mut().zip(&changes);
            for (word, (last, change)) in pairs.enumerate() {
                let packed = std::array::from_fn(|i| packed[(4 * word + i) * of_block + number]);
                *last = change.next(*last, packed);
            }
            into.copy_from_slice(&element);
        }
    }
    match body.len() {
        0 => Ok(bytes),
        more => Err(too_long(more)),
    }
}

/// Decodes one byte position of a block. The mode of each group selects one of the bit counts in `bits`.
fn grouped(body: &mut &[u8], bits: [u8; 4], into: &mut [u8]) -> Result<(), String> {
    let modes = take(body, into.len().div_ceil(4 * GROUP))?;
    for (group, into) in into.chunks_mut(GROUP).enumerate() {
        let mode = modes[group / 4] >> (2 * (group % 4)) & 3;
        let differences = differences(body, bits[usize::from(mode)])?;
        into.copy_from_slice(&differences[..into.len()]);
    }
    Ok(())
}

/// Decodes the differences of a group. Each has `bits` bits.
fn differences(body: &mut &[u8], bits: u8) -> Result<[u8; GROUP], String> {
    let mut all = [0; GROUP];
    if bits == 0 {
        return Ok(all);
    }
    if bits == 8 {
        all.copy_from_slice(take(body, GROUP)?);
        return Ok(all);
    }
    let packed = take(body, GROUP * usize::from(bits) / 8)?;
    let per_byte = usize::from(8 / bits);
    let most = (1 << bits) - 1;
    for (i, difference) in all.iter_mut().enumerate() {
        // The first difference is in the highest bits of a byte. Only 1-bit differences begin in the lowest bit.
        let shift = match bits {
            1 => i % per_byte,
            _ => 8 - usize::from(bits) * (i % per_byte + 1),
        };
        let short = packed[i / per_byte] >> shift & most;
        *difference = match short == most {
            true => take(body, 1)?[0],
            false => short,
        };
    }
    Ok(all)
}

/// Decodes a difference whose sign is in its lowest bit.
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
        let found = differences(&mut body, 4).unwrap();
        let found = found.map(|d| i16::from(unfolded(d) as i8));
        let expected = [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0];
        assert_eq!((found, body.len()), (expected, 0));
    }

    #[test]
    fn elements_continue_from_the_tail_through_all_blocks() {
        // 300 equal elements in two blocks, then a difference of 1 in the second byte of the last group.
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
