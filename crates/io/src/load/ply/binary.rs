//! Reads the elements of a binary PLY, in either byte order.
//!
//! If all rows of an element have the length of the first, as in nearly every mesh of triangles, they are read in parallel. Otherwise, and
//! to find what is wrong with a row, they are read one after the other.

use ply_rs_bw::ply::{ElementDef, PropertyType, ScalarType};
use rayon::prelude::*;

use super::PlyError;
use super::elements::{Dropped, Rows};

/// Number of rows that a thread reads at once.
const SHARE: usize = 1 << 14;

/// The payload that has not been read yet.
pub(super) struct Payload<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) is_big_endian: bool,
}

/// Reason why a row cannot be read.
enum Fault {
    CutOff,
    Wrong(String),
}

impl<'a> Payload<'a> {
    /// Reads all rows of an element. `empty` makes the receiver of the rows that follow a number of rows.
    pub(super) fn read<R: Rows>(
        &mut self,
        element: &ElementDef,
        empty: impl Fn(usize) -> R + Sync,
    ) -> Result<R, PlyError> {
        if element.count == 0 {
            return Ok(empty(0));
        }
        if let Some((rows, rest)) = self.uniform_rows(element, &empty) {
            self.bytes = rest;
            return Ok(rows);
        }
        let mut rows = empty(0);
        let mut values = Vec::new();
        for number in 0..element.count {
            let read = self.row(element, &mut rows, &mut values);
            self.bytes = read.map_err(|fault| match fault {
                Fault::CutOff => PlyError::cut_off(None, number, element),
                Fault::Wrong(what) => PlyError { line: None, what },
            })?;
        }
        Ok(rows)
    }

    /// Reads rows in parallel, if all have the same length and nothing is wrong with any, and returns the bytes behind them.
    fn uniform_rows<R: Rows>(
        &self,
        element: &ElementDef,
        empty: &(impl Fn(usize) -> R + Sync),
    ) -> Option<(R, &'a [u8])> {
        let rest = self.row(element, &mut Dropped, &mut Vec::new()).ok()?;
        let length = self.bytes.len() - rest.len();
        let all = self.bytes.get(..length.checked_mul(element.count)?)?;
        let shares = all.par_chunks(SHARE * length).enumerate();
        let shares = shares.map(|(share, bytes)| {
            let (mut rows, mut values) = (empty(share * SHARE), Vec::new());
            for bytes in bytes.chunks_exact(length) {
                let row = Payload { bytes, ..*self };
                let rest = row.row(element, &mut rows, &mut values).ok()?;
                if !rest.is_empty() {
                    return None;
                }
            }
            Some(rows)
        });
        let shares: Vec<R> = shares.collect::<Option<_>>()?;
        Some((R::joined(shares), &self.bytes[all.len()..]))
    }

    /// Reads a row and returns the bytes behind it. `values` is only kept to save its allocation.
    fn row<R: Rows>(
        &self,
        element: &ElementDef,
        rows: &mut R,
        values: &mut Vec<f64>,
    ) -> Result<&'a [u8], Fault> {
        let mut bytes = self.bytes;
        rows.begin();
        for (column, property) in element.properties.values().enumerate() {
            let (count, kind) = match &property.data_type {
                PropertyType::Scalar(kind) => (1, kind),
                PropertyType::List(kind, of) => {
                    let count = self.take(&mut bytes, kind)?;
                    if count < 0.0 || count.fract() != 0.0 {
                        let what = format!("a list of {} has {count} values", element.name);
                        return Err(Fault::Wrong(what));
                    }
                    (count as usize, of)
                }
            };
            if !rows.wants(column) {
                let length = count.checked_mul(size_of(kind));
                bytes = length.and_then(|l| bytes.get(l..)).ok_or(Fault::CutOff)?;
                continue;
            }
            values.clear();
            for _ in 0..count {
                values.push(self.take(&mut bytes, kind)?);
            }
            rows.property(column, kind, values).map_err(Fault::Wrong)?;
        }
        Ok(bytes)
    }

    fn take(&self, bytes: &mut &'a [u8], kind: &ScalarType) -> Result<f64, Fault> {
        use ScalarType as Of;
        let big = self.is_big_endian;
        let number = match kind {
            Of::Char => first(bytes, big).map(|b| i8::from_le_bytes(b).into()),
            Of::UChar => first(bytes, big).map(|b| u8::from_le_bytes(b).into()),
            Of::Short => first(bytes, big).map(|b| i16::from_le_bytes(b).into()),
            Of::UShort => first(bytes, big).map(|b| u16::from_le_bytes(b).into()),
            Of::Int => first(bytes, big).map(|b| i32::from_le_bytes(b).into()),
            Of::UInt => first(bytes, big).map(|b| u32::from_le_bytes(b).into()),
            Of::Float => first(bytes, big).map(|b| f32::from_le_bytes(b).into()),
            Of::Double => first(bytes, big).map(f64::from_le_bytes),
        };
        number.ok_or(Fault::CutOff)
    }
}

/// Size of a number in bytes.
fn size_of(kind: &ScalarType) -> usize {
    use ScalarType as Of;
    match kind {
        Of::Char | Of::UChar => 1,
        Of::Short | Of::UShort => 2,
        Of::Int | Of::UInt | Of::Float => 4,
        Of::Double => 8,
    }
}

/// Takes the first bytes, and returns them in little-endian order.
fn first<const N: usize>(bytes: &mut &[u8], is_big_endian: bool) -> Option<[u8; N]> {
    let (first, rest) = bytes.split_first_chunk::<N>()?;
    *bytes = rest;
    let mut first = *first;
    if is_big_endian {
        first.reverse();
    }
    Some(first)
}
