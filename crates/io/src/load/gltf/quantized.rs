//! Reads number triples, which are floating-point or, as in `KHR_mesh_quantization`, integers that may be normalized. Rotations are read
//! the same way.

use glam::DQuat;
use gltf::Accessor;
use gltf::accessor::{DataType, Item};

use super::accessor::{ROTATIONS, VEC3, items};

/// The triples of an accessor.
pub(super) fn triples(
    accessor: Accessor<'_>,
    buffers: &[Vec<u8>],
) -> Result<Vec<[f32; 3]>, String> {
    match accessor.data_type() {
        DataType::I8 => whole(accessor, buffers, i8::MAX),
        DataType::U8 => whole(accessor, buffers, u8::MAX),
        DataType::I16 => whole(accessor, buffers, i16::MAX),
        DataType::U16 => whole(accessor, buffers, u16::MAX),
        _ => items(accessor, VEC3, buffers),
    }
}

fn whole<T: Item + Copy + Into<f64>>(
    accessor: Accessor<'_>,
    buffers: &[Vec<u8>],
    most: T,
) -> Result<Vec<[f32; 3]>, String> {
    let are_shares = accessor.normalized();
    let triples: Vec<[T; 3]> = items(accessor, VEC3, buffers)?;
    let number = |c: T| match are_shares {
        true => share(c, most) as f32,
        false => c.into() as f32,
    };
    Ok(triples.into_iter().map(|t| t.map(number)).collect())
}

/// Converts a normalized integer to a fraction of its type's largest value. The smallest value of a signed type also becomes -1.
pub(super) fn share<T: Into<f64>>(number: T, most: T) -> f64 {
    (number.into() / most.into()).max(-1.0)
}

/// Reads the rotations in an accessor. Integers are always normalized.
pub(super) fn rotations(accessor: Accessor<'_>, buffers: &[Vec<u8>]) -> Result<Vec<DQuat>, String> {
    match accessor.data_type() {
        DataType::I8 => shares(accessor, buffers, i8::MAX),
        DataType::U8 => shares(accessor, buffers, u8::MAX),
        DataType::I16 => shares(accessor, buffers, i16::MAX),
        DataType::U16 => shares(accessor, buffers, u16::MAX),
        _ => shares(accessor, buffers, 1.0_f32),
    }
}

fn shares<T: Item + Copy + Into<f64>>(
    accessor: Accessor<'_>,
    buffers: &[Vec<u8>],
    most: T,
) -> Result<Vec<DQuat>, String> {
    let quadruples: Vec<[T; 4]> = items(accessor, ROTATIONS, buffers)?;
    let is_whole = most.into() > 1.0;
    let number = |c: T| match is_whole {
        true => share(c, most),
        false => c.into(),
    };
    let quat = |q: [T; 4]| DQuat::from_array(q.map(number));
    Ok(quadruples.into_iter().map(quat).collect())
}
