//! Layout of structs shared between the CPU and the shaders, and the rows that they consist of.

use bytemuck::Pod;
use glam::{DMat4, DVec3, Mat4};

/// Fields of a shared struct, for the layout test: name, offset, size.
pub trait Layout: Pod {
    /// Name of the struct in WGSL.
    const NAME: &'static str;
    /// Name, offset and size in bytes of each field.
    fn fields() -> Vec<(&'static str, usize, usize)>;
}

/// A direction or position as a row of four, the last of which is 0.
pub(super) fn row(v: DVec3) -> [f32; 4] {
    v.as_vec3().extend(0.0).to_array()
}

/// A matrix in column-major order.
pub(super) fn matrix(m: DMat4) -> [f32; 16] {
    Mat4::to_cols_array(&m.as_mat4())
}
