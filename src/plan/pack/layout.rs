//! Layout of structs that the CPU and the shaders share, and the rows that they are made of.

use bytemuck::Pod;
use glam::{DMat4, DVec3, Mat4};

/// A shared struct's fields, for the layout test: name, offset, size.
pub trait Layout: Pod {
    /// Name of the struct in WGSL.
    const NAME: &'static str;
    /// Name, offset and size in bytes of each field.
    fn fields() -> Vec<(&'static str, usize, usize)>;
}

/// A direction or a place as a row of four, the last of which is 0.
pub(super) fn row(v: DVec3) -> [f32; 4] {
    v.as_vec3().extend(0.0).to_array()
}

/// A matrix column by column.
pub(super) fn matrix(m: DMat4) -> [f32; 16] {
    Mat4::to_cols_array(&m.as_mat4())
}
