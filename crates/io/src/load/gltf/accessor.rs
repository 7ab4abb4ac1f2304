//! Checked reading of glTF accessors.
//!
//! The `gltf` crate trusts offsets, counts and types once the JSON validates, and panics or overflows if they are wrong. Every
//! accessor is checked here before the crate reads it.

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions, Item, Iter};
use gltf::buffer::View;

/// Largest accepted count of a sparse accessor without base values. Its items have no bytes in the file, so nothing else limits the count.
const MOST_IMPLIED_ITEMS: usize = 1 << 26;

/// Expected content of an accessor.
#[derive(Clone, Copy, Debug)]
pub(super) struct AccessorFormat {
    pub(super) what: &'static str,
    pub(super) types: &'static [DataType],
    pub(super) dimensions: Dimensions,
}

/// `POSITION` and `NORMAL` of vertices and morph targets.
pub(super) const VEC3: AccessorFormat = AccessorFormat {
    what: "positions or normals",
    types: SHARES,
    dimensions: Dimensions::Vec3,
};

/// `TEXCOORD_n`.
pub(super) const PLACES: AccessorFormat = AccessorFormat {
    what: "texture coordinates",
    types: &[DataType::F32, DataType::U8, DataType::U16],
    dimensions: Dimensions::Vec2,
};

/// `COLOR_0` with alpha.
pub(super) const COLORS_WITH_ALPHA: AccessorFormat = AccessorFormat {
    dimensions: Dimensions::Vec4,
    ..COLORS
};

/// `COLOR_0`.
pub(super) const COLORS: AccessorFormat = AccessorFormat {
    what: "colours",
    types: &[DataType::F32, DataType::U8, DataType::U16],
    dimensions: Dimensions::Vec3,
};

/// Vertex indices of triangles.
pub(super) const INDICES: AccessorFormat = AccessorFormat {
    what: "indices",
    types: &[DataType::U8, DataType::U16, DataType::U32],
    dimensions: Dimensions::Scalar,
};

/// `JOINTS_n`.
pub(super) const JOINTS: AccessorFormat = AccessorFormat {
    what: "joints",
    types: &[DataType::U8, DataType::U16],
    dimensions: Dimensions::Vec4,
};

/// `WEIGHTS_n`.
pub(super) const WEIGHTS: AccessorFormat = AccessorFormat {
    what: "weights",
    types: &[DataType::F32, DataType::U8, DataType::U16],
    dimensions: Dimensions::Vec4,
};

/// Times of animation samples.
pub(super) const TIMES: AccessorFormat = AccessorFormat {
    what: "times",
    types: &[DataType::F32],
    dimensions: Dimensions::Scalar,
};

/// Animation values of translations and scales.
pub(super) const TRIPLES: AccessorFormat = AccessorFormat {
    what: "translations or scales",
    types: &[DataType::F32],
    dimensions: Dimensions::Vec3,
};

/// Component types for positions, normals, rotations and target weights. They are floating-point, or integers that are usually normalized.
const SHARES: &[DataType] = &[
    DataType::F32,
    DataType::I8,
    DataType::U8,
    DataType::I16,
    DataType::U16,
];

/// Animation values of rotations.
pub(super) const ROTATIONS: AccessorFormat = AccessorFormat {
    what: "rotations",
    types: SHARES,
    dimensions: Dimensions::Vec4,
};

/// Animation values of morph target weights.
pub(super) const TARGET_WEIGHTS: AccessorFormat = AccessorFormat {
    what: "weights of morph targets",
    types: SHARES,
    dimensions: Dimensions::Scalar,
};

/// Inverse bind matrices.
pub(super) const MAT4: AccessorFormat = AccessorFormat {
    what: "inverse bind matrices",
    types: &[DataType::F32],
    dimensions: Dimensions::Mat4,
};

/// Returns an error message if an accessor is invalid. `buffers` are in order of their index.
pub(super) fn check(
    accessor: &Accessor<'_>,
    wanted: AccessorFormat,
    buffers: &[Vec<u8>],
) -> Result<(), String> {
    let (kind, dimensions) = (accessor.data_type(), accessor.dimensions());
    let named = |what: String| format!("accessor {} ({}) {what}", accessor.index(), wanted.what);
    if !wanted.types.contains(&kind) || dimensions != wanted.dimensions {
        return Err(named(format!("is {dimensions:?} of {kind:?}")));
    }
    let (count, size) = (accessor.count(), accessor.size());
    if count == 0 {
        return Err(named("is empty".to_owned()));
    }
    let fits = |view: View<'_>, offset: usize, items: usize, size: usize| {
        let stride = view.stride().unwrap_or(size);
        let in_view = (items - 1)
            .checked_mul(stride)
            .and_then(|n| n.checked_add(size)?.checked_add(offset))
            .is_some_and(|end| end <= view.length());
        let held = buffers.get(view.buffer().index()).map_or(0, Vec::len);
        let in_buffer = view
            .offset()
            .checked_add(view.length())
            .is_some_and(|end| end <= held);
        stride >= size && in_view && in_buffer
    };
    if let Some(view) = accessor.view() {
        if !fits(view, accessor.offset(), count, size) {
            return Err(named(format!(
                "states {count} items, but its buffer ends before the last"
            )));
        }
    } else if accessor.sparse().is_none() {
        return Err(named("has no data".to_owned()));
    } else if count > MOST_IMPLIED_ITEMS {
        return Err(named(format!("states {count} items without data")));
    }
    if let Some(sparse) = accessor.sparse() {
        let (indices, values) = (sparse.indices(), sparse.values());
        let changed = sparse.count();
        if changed == 0
            || changed > count
            || !fits(
                indices.view(),
                indices.offset(),
                changed,
                indices.index_type().size(),
            )
            || !fits(values.view(), values.offset(), changed, size)
        {
            return Err(named("has sparse values outside its buffer".to_owned()));
        }
    }
    Ok(())
}

/// Returns the items of an accessor. Its item type must be `T`.
pub(super) fn items<T: Item>(
    accessor: Accessor<'_>,
    wanted: AccessorFormat,
    buffers: &[Vec<u8>],
) -> Result<Vec<T>, String> {
    check(&accessor, wanted, buffers)?;
    let index = accessor.index();
    Iter::new(accessor, |b| buffers.get(b.index()).map(Vec::as_slice))
        .map(Iterator::collect)
        .ok_or_else(|| format!("accessor {index} ({}) cannot be read", wanted.what))
}
