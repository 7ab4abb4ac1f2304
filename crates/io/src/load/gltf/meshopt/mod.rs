//! Decompression of buffer views packed by `EXT_meshopt_compression` or `KHR_meshopt_compression`: attributes, triangles and indices, and
//! the filters octahedral, quaternion, exponential and colour. The second extension adds a version of the attribute codec and the colour
//! filter. Both are accepted under either extension name.
//!
//! A stream has no length field. The extension gives the count and the byte size of the elements, which must use up the stream exactly.
//! Each element takes a minimum number of bits in the stream. This is checked before memory is allocated, so that a short stream that
//! states gigabytes is refused.
//!
//! Cost: one pass over the output, at some hundred megabytes per second.

mod attributes;
mod filters;
mod indices;

/// Content of a packed view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Attributes,
    Triangles,
    Indices,
}

impl Mode {
    pub(super) const NAMED: [(&'static str, Self); 3] = [
        ("ATTRIBUTES", Self::Attributes),
        ("TRIANGLES", Self::Triangles),
        ("INDICES", Self::Indices),
    ];
}

/// Filter that converts unpacked bytes to the attributes that accessors read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Colour,
}

impl Filter {
    pub(super) const NAMED: [(&'static str, Self); 5] = [
        ("NONE", Self::None),
        ("OCTAHEDRAL", Self::Octahedral),
        ("QUATERNION", Self::Quaternion),
        ("EXPONENTIAL", Self::Exponential),
        ("COLOR", Self::Colour),
    ];
}

/// How a buffer view is packed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packing {
    pub(super) mode: Mode,
    pub(super) filter: Filter,
    /// Bytes per element.
    pub(super) stride: usize,
    /// Number of elements.
    pub(super) count: usize,
}

impl Packing {
    /// Returns the unpacked bytes of the view.
    pub(super) fn unpack(&self, stream: &[u8]) -> Result<Vec<u8>, String> {
        let (stride, count) = (self.stride, self.count);
        let (is_stride_right, is_filtered) = match (self.mode, self.filter) {
            (Mode::Attributes, Filter::None | Filter::Exponential) => {
                (stride % 4 == 0 && (4..=256).contains(&stride), true)
            }
            (Mode::Attributes, Filter::Octahedral | Filter::Colour) => {
                (stride == 4 || stride == 8, true)
            }
            (Mode::Attributes, Filter::Quaternion) => (stride == 8, true),
            (_, filter) => (stride == 2 || stride == 4, filter == Filter::None),
        };
        if !is_stride_right || !is_filtered {
            let (mode, filter) = (self.mode, self.filter);
            return Err(format!(
                "{mode:?} with the filter {filter:?} cannot have elements of {stride} bytes"
            ));
        }
        match self.mode {
            Mode::Attributes => {
                let mut bytes = attributes::unpack(stream, count, stride)?;
                match self.filter {
                    Filter::None => {}
                    Filter::Octahedral => filters::octahedral(&mut bytes, stride),
                    Filter::Quaternion => filters::quaternion(&mut bytes),
                    Filter::Exponential => filters::exponential(&mut bytes),
                    Filter::Colour => filters::colour(&mut bytes, stride),
                }
                Ok(bytes)
            }
            Mode::Triangles => to_bytes(&indices::triangles(stream, count)?, stride),
            Mode::Indices => to_bytes(&indices::indices(stream, count)?, stride),
        }
    }
}

/// Converts indices to 2 or 4 bytes each.
fn to_bytes(indices: &[u32], stride: usize) -> Result<Vec<u8>, String> {
    if stride == 4 {
        return Ok(indices.iter().flat_map(|i| i.to_le_bytes()).collect());
    }
    let mut bytes = Vec::with_capacity(indices.len() * stride);
    for index in indices {
        let index = u16::try_from(*index)
            .map_err(|_| format!("it contains the index {index}, which needs more than 2 bytes"))?;
        bytes.extend(index.to_le_bytes());
    }
    Ok(bytes)
}

/// Splits a stream into data and a tail of `tail` bytes, after checking that its first byte is `header`.
fn parted(stream: &[u8], header: u8, tail: usize) -> Result<(&[u8], &[u8]), String> {
    match stream.split_first() {
        Some((first, _)) if *first != header => Err(format!(
            "its stream begins with {first:#04x}, not with {header:#04x}"
        )),
        Some((_, rest)) if rest.len() >= tail => Ok(rest.split_at(rest.len() - tail)),
        _ => Err(cut_off()),
    }
}

fn cut_off() -> String {
    "its stream is cut off".to_owned()
}

fn too_long(bytes: usize) -> String {
    format!("its stream has {bytes} bytes that belong to no element")
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    use super::*;

    // Output of meshoptimizer 1.3.0 (npm) for 40 vectors, quaternions and triples from the functions below, and for the triangles of a
    // tetrahedron.
    const OCTAHEDRAL_8: &str = "oB8AXzguncB1F67xtA2n4fc+kqytgWungOgqwHXMAMlmjf//AAAZyFFUsS5EIx8ALIOeVyWq2ZQGrffTJKDK3V2BmYa4SLZ78BHHcKsPzP//AABbcCC7RjmCJQAfAP79/v3+/f79/v3+/f79/v3+/f79/v3+/f79/v3+/f7//wAA/f79/v3+/f4AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAGAB/AA==";
    const OCTAHEDRAL_12: &str = "oB8AB3PqACaEgv++r9eXA1oLxZqxS71ZMZqsI9KkAY0sr///AABkTtvr89AeGx4FQpxRraCf9BIPCBMUBwUWFw4CExgRABQZFn//AAARGhkUBBseHwDOTw1mXcAuoWjrnJ5KBno6FCWCOl+Qx3Lg0E22memS//8AAHTaBmQqnh9RHgJ6Ua2gn9KvEBESBQcWFwwEExgRABQZFgER+/0AABoZFBkcFwAAFRmZmZmZmZmZmZkAAB8A/v3+/f79/v3+/f79/v3+/f79/v3+/f79/v3+/f79/v//AAD9/v3+/f79/gAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAHwBAAD/BwAA";
    const QUATERNIONS: &str = "oB8Ar/RhRWX0ery1vYNxllE+VR+8L2rYKYnSfQrRfrmm6f//AADJabd2UiNdCB8AEQMCFhkQAhMYExoXEBMUBQsYGRQAERIEBw8aEQISFf//AAAQFxgPFBkUER8AsdOL3Blk6DK7tDCVi1shjub56+b+YcDUUm1xWerXHf//AADqY6imkFwMtx4P//2CH13k/xkYGRIQFRgHDxYHDxoAGRgZEg0QBQAO/v8AAAUNDhMWBQ8fAL+UZHin9y7sv8aKFQkYQohAIPTAM4QZKyewMkaaSar//wAAvfuCMsA1pr4qCP6UPxG4v3ETEBj/nD9l7/Mv4xEaDw8SFc3/w/EAAAAAEhUQFgECQDEGBWBUJAUw0wYDBjzwAAAFBgUEAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAMgF3wYAAP0H";
    const EXPONENTIAL: &str = "oBQAA/////////////////8AAP//////////Kg8P//zMz2ZmYBcYGC81ZmZm8kJCQkI7QkJCQgAAAAAABToIAgDKAAgAAB8AqgCpqqyqqaupqQCqqqyqqqyqqqyqqaupqaupqaupqf//AACrqamrqamrqRYPBlXDETwBEBVRTBBBDAQQAAABEAAAAAU6CAIAygAIAAAfABAQBB4kGxogIiZPGBoaHiAiJCYoKssWGBoaHBwcHiD//wAAICIiJCQkKCYQgAAAAAAFOggCAMoACAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAACOAAAAjgAAAI4=";
    const TRIANGLES: &str = "4f4OEgPwBAB2h1ZneKmGZYlomAFpAAA=";
    const INDICES: &str = "0QAIAgIECAYEBAoMAgAAAAA=";

    // Output of the same program's second codec version at its highest level, for elements from a function below. One word is coded by
    // bits, one by halves and two by bytes, in all four packings of a byte position. Colours of 8 bits, and of 12 bits in 16, follow.
    const WORDS: &str = "oZpXqP8aATFxMfExcTEP8TFxMfExcTEfD93dAAA/AwcDAFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWBUqqqqqqqqqqqqqAAAVFVVVVVVVVVVVVQAAFSqqqqqqqqqqqqoAAAQQAAIAnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dnZ2dAPL09PL09PL09PL09PL09PTy9PTy9PTy9PTy9PT08vT08vT08vT08gBubnBucG5wbnBucG5wbnBucG5wbm5wbnBucG5wbnBucG5wbnBucG4Aw8PDw8HDw8PDwcPDw8HDw8PDwcPDw8PBw8PDwcPDw8PBw8PDwcPDAAAAAAAAgD8AAHARBwAAAAAAAAAyAQAA";
    const COLOURS_8: &str = "of8AHhwcHoMeHBwcgRweHB6DHB4cHoUeHhwcgx4cHhyBHBwcHoMeHBweADc5Nzn7Nzk3Ofs3OTc3+zk3Nzn7OTc3Ofs3OTc3+zk5Nzf7OTc5NwApKSkndikpKSl4KycpKXYpKSkndCcpKSl2KSknK3gpKSkpdicrJykAgH79gH79gH79gH79gH79gH79gH79gH79gH79gH79gH79gH79gH79AAAAAAAAAAAAAAAAAAAAAAAAAH8Af4AA";
    const COLOURS_12: &str = "oXdXADMzNTMzMzM1MzM1MzMzNTMzMzM1MzMzMzUzMzM1MzMzNTMzMzUzMxUquq6rBwkHquq6rgkHCauqAAAHAGpoampmampqaGhoampqZmpqamhoaGpqamZqaGxoaGhqampmamhqaioDMz8zM/MzPxISEjMz8zM/MzPzEhISMz8zMQAAAAASAJ2bnZ2bnZ2dm52dnZudnZ2dm5ufm52bnZ2dm52dnZudnZ2bnZ2bnRoBETgTEWEROBMRYRMYExFhd9UAAAMIAxUGGGGGGGGGGGGGAAAqCG2G2G2G2G2G2G2G2G2G2G2G2G0AAAAAAAAAAAAAAAAAAAAAAAD/BwAA/wcACAAA";

    const COUNT: usize = 40;

    fn element(i: usize) -> [u8; 16] {
        let i = i as u32;
        let halves = [300 * i, 70_000 - 257 * i].map(|h| h & 0xffff);
        let words = [
            (1.0 + i as f32 / 1024.0).to_bits(),
            halves[0] | halves[1] << 16,
            if i < 20 { 7 } else { 8 },
            i.wrapping_mul(2_654_435_761),
        ];
        let mut bytes = [0; 16];
        for (into, word) in bytes.chunks_exact_mut(4).zip(words) {
            into.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    fn colour(i: usize) -> [f64; 4] {
        let share = i as f64 / (COUNT - 1) as f64;
        [
            share,
            1.0 - share,
            (i % 5) as f64 / 4.0,
            (i % 3) as f64 / 2.0,
        ]
    }

    fn unit_vector(i: usize) -> [f64; 4] {
        let i = i as f64;
        let z = 1.0 - 2.0 * (i + 0.5) / COUNT as f64;
        let (angle, radius) = (i * 2.39996, (1.0 - z * z).sqrt());
        [radius * angle.cos(), radius * angle.sin(), z, i % 2.0]
    }

    fn quaternion(i: usize) -> [f64; 4] {
        let i = i as f64;
        let q = [
            i.sin(),
            (2.0 * i).cos(),
            (3.0 * i + 1.0).sin(),
            (i * i).cos(),
        ];
        let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        q.map(|c| c / length)
    }

    fn triple(i: usize) -> [f64; 3] {
        let i = i as f64;
        [i * 1.5, -i / 3.0, 1e-3 * i * i]
    }

    fn packing(mode: Mode, filter: Filter, stride: usize, count: usize) -> Packing {
        Packing {
            mode,
            filter,
            stride,
            count,
        }
    }

    fn unpacked(filter: Filter, stride: usize, stream: &str) -> Vec<u8> {
        let stream = STANDARD.decode(stream).unwrap();
        let packing = packing(Mode::Attributes, filter, stride, COUNT);
        packing.unpack(&stream).unwrap()
    }

    fn shares(bytes: &[u8]) -> Vec<f64> {
        let words = bytes.as_chunks::<2>().0.iter();
        words
            .map(|w| f64::from(i16::from_le_bytes(*w)) / 32_767.0)
            .collect()
    }

    #[test]
    fn what_another_program_packs_comes_out() {
        let short = unpacked(Filter::Octahedral, 4, OCTAHEDRAL_8);
        let long = shares(&unpacked(Filter::Octahedral, 8, OCTAHEDRAL_12));
        let quaternions = shares(&unpacked(Filter::Quaternion, 8, QUATERNIONS));
        let floats = unpacked(Filter::Exponential, 12, EXPONENTIAL);
        let floats: Vec<f32> = floats
            .as_chunks::<4>()
            .0
            .iter()
            .map(|w| f32::from_le_bytes(*w))
            .collect();
        for i in 0..COUNT {
            let expected = unit_vector(i);
            for k in 0..4 {
                let c = f64::from(short[4 * i + k] as i8) / 127.0;
                assert!(
                    (c - expected[k]).abs() < 0.02,
                    "vector {i}: {c}, {expected:?}"
                );
                let c = long[4 * i + k];
                assert!(
                    (c - expected[k]).abs() < 2e-3,
                    "vector {i}: {c}, {expected:?}"
                );
            }
            let (found, expected) = (&quaternions[4 * i..4 * i + 4], quaternion(i));
            let cosine: f64 = found.iter().zip(expected).map(|(a, b)| a * b).sum();
            let is_near = |(a, b): (&f64, f64)| (a - b * cosine.signum()).abs() < 1e-3;
            let is_it = found.iter().zip(expected).all(is_near);
            assert!(is_it, "{i}: {found:?}, {expected:?}");
            let (found, expected) = (&floats[3 * i..3 * i + 3], triple(i));
            let is_near =
                |(a, b): (&f32, f64)| (f64::from(*a) - b).abs() < 1e-4 * (1.0 + i as f64 * 1.5);
            assert!(
                found.iter().zip(expected).all(is_near),
                "{i}: {found:?}, {expected:?}"
            );
        }
    }

    #[test]
    fn what_the_second_version_packs_comes_out() {
        let bytes = unpacked(Filter::None, 16, WORDS);
        for (i, found) in bytes.chunks(16).enumerate() {
            assert_eq!(found, element(i), "{i}");
        }
        let short = unpacked(Filter::Colour, 4, COLOURS_8);
        let long = unpacked(Filter::Colour, 8, COLOURS_12);
        let long = long.as_chunks::<2>().0.iter();
        let long: Vec<u16> = long.map(|w| u16::from_le_bytes(*w)).collect();
        for i in 0..COUNT {
            for (k, expected) in colour(i).into_iter().enumerate() {
                let [short, long] = [
                    f64::from(short[4 * i + k]) / 255.0,
                    f64::from(long[4 * i + k]) / 65_535.0,
                ];
                let off = [short - expected, long - expected].map(f64::abs);
                assert!(off[0] < 0.02 && off[1] < 1e-3, "{i}: {off:?}");
            }
        }
    }

    #[test]
    fn triangles_come_out_in_their_order() {
        let words = |bytes: Vec<u8>| -> Vec<u16> {
            bytes
                .as_chunks::<2>()
                .0
                .iter()
                .map(|w| u16::from_le_bytes(*w))
                .collect()
        };
        let sequence = STANDARD.decode(INDICES).unwrap();
        let sequence = packing(Mode::Indices, Filter::None, 2, 12).unpack(&sequence);
        assert_eq!(
            words(sequence.unwrap()),
            [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
        );
        // The decoder may rotate the corners of a triangle.
        let stream = STANDARD.decode(TRIANGLES).unwrap();
        let triangles = packing(Mode::Triangles, Filter::None, 2, 12).unpack(&stream);
        assert_eq!(
            words(triangles.unwrap()),
            [0, 2, 1, 0, 1, 3, 3, 1, 2, 3, 2, 0]
        );
    }

    #[test]
    fn streams_that_are_cut_off_or_changed_are_errors_or_other_numbers() {
        for (mode, filter, stride, count, stream) in [
            (
                Mode::Attributes,
                Filter::Octahedral,
                8,
                COUNT,
                OCTAHEDRAL_12,
            ),
            (Mode::Attributes, Filter::Quaternion, 8, COUNT, QUATERNIONS),
            (
                Mode::Attributes,
                Filter::Exponential,
                12,
                COUNT,
                EXPONENTIAL,
            ),
            (Mode::Attributes, Filter::None, 16, COUNT, WORDS),
            (Mode::Attributes, Filter::Colour, 8, COUNT, COLOURS_12),
            (Mode::Triangles, Filter::None, 4, 12, TRIANGLES),
            (Mode::Indices, Filter::None, 2, 12, INDICES),
        ] {
            let stream = STANDARD.decode(stream).unwrap();
            let packing = packing(mode, filter, stride, count);
            assert!(packing.unpack(&stream).is_ok(), "the control");
            for length in 0..stream.len() {
                assert!(
                    packing.unpack(&stream[..length]).is_err(),
                    "{mode:?}: {length} bytes"
                );
            }
            for at in 0..stream.len() {
                for change in [0x01, 0x80, 0xff] {
                    let mut changed = stream.clone();
                    changed[at] ^= change;
                    // Decoding must not panic: either it fails, or it returns all bytes.
                    let bytes = packing.unpack(&changed);
                    assert!(bytes.is_err() || bytes.is_ok_and(|b| b.len() == stride * count));
                }
            }
            for (stride, count) in [
                (stride, count + 48),
                (stride, usize::MAX / 16 * 3),
                (3, count),
                (0, count),
            ] {
                let other = Packing {
                    stride,
                    count,
                    ..packing
                };
                assert!(other.unpack(&stream).is_err(), "{other:?}");
            }
        }
    }
}
