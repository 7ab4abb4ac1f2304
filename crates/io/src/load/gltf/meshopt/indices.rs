//! The index codecs. Mode 1 codes triangles by recent edges and vertices, and mode 2 codes indices as differences.

use super::{cut_off, parted, too_long};

/// The first byte of a stream of triangles.
const TRIANGLES: u8 = 0xe1;

/// The first byte of a stream of indices.
const INDICES: u8 = 0xd1;

/// Length in bytes of the table at the end of a triangle stream.
const TABLE_BYTES: usize = 16;

/// Length in bytes of the tail of an index stream.
const TAIL_BYTES: usize = 4;

/// Ring buffer of the last 16 items.
struct RingBuffer<T> {
    all: [T; 16],
    next: usize,
}

impl<T: Copy + Default> RingBuffer<T> {
    fn new() -> Self {
        Self {
            all: [T::default(); 16],
            next: 0,
        }
    }

    fn push(&mut self, one: T) {
        self.all[self.next] = one;
        self.next = (self.next + 1) % 16;
    }

    /// Returns the item `back` positions before the last.
    fn get(&self, back: usize) -> T {
        self.all[(self.next + 15 - back % 16) % 16]
    }
}

/// State of the triangle decoder.
struct TriangleDecoder<'a> {
    data: &'a [u8],
    /// Lowest index that no triangle has used so far.
    next: u32,
    /// The last explicitly coded index.
    last: u32,
    edges: RingBuffer<[u32; 2]>,
    vertices: RingBuffer<u32>,
}

impl TriangleDecoder<'_> {
    fn fresh(&mut self) -> u32 {
        let fresh = self.next;
        self.next = fresh.wrapping_add(1);
        fresh
    }

    /// Reads an explicit index, which is coded as its difference from the previous explicit index.
    fn written(&mut self) -> Result<u32, String> {
        let folded = varint(&mut self.data)?;
        self.last = self.last.wrapping_add(unfolded(folded));
        Ok(self.last)
    }

    /// Decodes a half byte to a new index or one of the recent vertices.
    fn by_half_byte(&mut self, half: u8) -> u32 {
        match half {
            0 => self.fresh(),
            back => self.vertices.get(usize::from(back) - 1),
        }
    }

    /// Decodes a triangle that contains a recent edge.
    fn at_edge(&mut self, [a, b]: [u32; 2], half: u8) -> Result<[u32; 3], String> {
        let c = match half {
            0 => self.fresh(),
            13 | 14 => {
                let step = if half == 13 { u32::MAX } else { 1 };
                self.last = self.last.wrapping_add(step);
                self.last
            }
            15 => self.written()?,
            _ => self.vertices.get(usize::from(half)),
        };
        if matches!(half, 0 | 13..) {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Ok([a, b, c])
    }

    /// Decodes a triangle without a recent edge. `is_fresh` means that index 0 is new. In `halves`, 15 may mean an explicit index.
    fn alone(
        &mut self,
        is_fresh: bool,
        halves: u8,
        may_be_written: bool,
    ) -> Result<[u32; 3], String> {
        let (of_b, of_c) = (halves >> 4, halves & 15);
        // New indices are counted before explicit indices are read.
        let a = if is_fresh { Some(self.fresh()) } else { None };
        let mut others = [None; 2];
        for (other, half) in others.iter_mut().zip([of_b, of_c]) {
            if half != 15 || !may_be_written {
                *other = Some(self.by_half_byte(half));
            }
        }
        let mut known = |index: Option<u32>| index.map_or_else(|| self.written(), Ok);
        let (a, b, c) = (known(a)?, known(others[0])?, known(others[1])?);
        self.edges.push([b, a]);
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        self.vertices.push(a);
        for (vertex, half) in [(b, of_b), (c, of_c)] {
            if half == 0 || (half == 15 && may_be_written) {
                self.vertices.push(vertex);
            }
        }
        Ok([a, b, c])
    }
}

/// Unpacks `count` triangle indices.
pub(super) fn triangles(stream: &[u8], count: usize) -> Result<Vec<u32>, String> {
    if !count.is_multiple_of(3) {
        return Err(format!("the index count {count} is not a multiple of 3"));
    }
    let (body, table) = parted(stream, TRIANGLES, TABLE_BYTES)?;
    let (codes, data) = body.split_at_checked(count / 3).ok_or_else(cut_off)?;
    let mut reader = TriangleDecoder {
        data,
        next: 0,
        last: 0,
        edges: RingBuffer::new(),
        vertices: RingBuffer::new(),
    };
    let mut indices = Vec::with_capacity(count);
    for code in codes {
        let triangle = match (code >> 4, code & 15) {
            (15, row @ 0..14) => reader.alone(true, table[usize::from(row)], false)?,
            (15, row) => {
                let (halves, rest) = reader.data.split_first().ok_or_else(cut_off)?;
                reader.data = rest;
                if *halves == 0 {
                    reader.next = 0;
                }
                reader.alone(row == 14, *halves, true)?
            }
            (back, half) => {
                let edge = reader.edges.get(usize::from(back));
                reader.at_edge(edge, half)?
            }
        };
        indices.extend(triangle);
    }
    match reader.data.len() {
        0 => Ok(indices),
        more => Err(too_long(more)),
    }
}

/// Unpacks `count` indices.
pub(super) fn indices(stream: &[u8], count: usize) -> Result<Vec<u32>, String> {
    let (mut data, _) = parted(stream, INDICES, TAIL_BYTES)?;
    if data.len() < count {
        return Err(cut_off());
    }
    // Each index is coded as a difference from the last index of one of two sequences.
    let mut last = [0_u32; 2];
    let mut indices = Vec::with_capacity(count);
    for _ in 0..count {
        let word = varint(&mut data)?;
        let of = &mut last[(word & 1) as usize];
        *of = of.wrapping_add(unfolded(word >> 1));
        indices.push(*of);
    }
    match data.len() {
        0 => Ok(indices),
        more => Err(too_long(more)),
    }
}

/// Reads a number in groups of seven bits, lowest group first.
fn varint(data: &mut &[u8]) -> Result<u32, String> {
    let mut number = 0;
    for shift in (0..35).step_by(7) {
        let (byte, rest) = data.split_first().ok_or_else(cut_off)?;
        *data = rest;
        number |= u64::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            let number = u32::try_from(number);
            return number.map_err(|_| "it contains an index of more than 4 bytes".to_owned());
        }
    }
    Err("it contains an index that does not end".to_owned())
}

/// Decodes a difference whose sign is in its lowest bit.
fn unfolded(folded: u32) -> u32 {
    match folded & 1 {
        0 => folded >> 1,
        _ => !(folded >> 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_the_specification() {
        for (bytes, number) in [
            (&[0x7f][..], 0x7f),
            (&[0x81, 0x04], 0x201),
            (&[0xff, 0xa0, 0x05], 0x1_507f),
            (&[0xff, 0xff, 0xff, 0xff, 0x0f], u32::MAX),
        ] {
            assert_eq!(varint(&mut &*bytes), Ok(number), "{bytes:x?}");
        }
        for bytes in [&[][..], &[0x80], &[0xff; 5], &[0x80; 9]] {
            assert!(varint(&mut &*bytes).is_err(), "{bytes:x?}");
        }
    }

    #[test]
    fn two_sequences_are_spliced() {
        // +10 in the first sequence, +100 in the second, -1 in the first, +1 in the second.
        let words = [20_u32 << 1, (200 << 1) | 1, 1 << 1, (2 << 1) | 1];
        let mut stream = vec![INDICES];
        for word in words {
            match word {
                0..128 => stream.push(word as u8),
                _ => stream.extend([(word & 0x7f) as u8 | 0x80, (word >> 7) as u8]),
            }
        }
        stream.extend([0; 4]);
        assert_eq!(indices(&stream, 4).unwrap(), [10, 100, 9, 101]);
        assert!(indices(&stream, 3).is_err() && indices(&stream, 5).is_err());
    }
}
