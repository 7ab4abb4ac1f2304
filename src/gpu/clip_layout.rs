//! What the shader that hosts ask binds.

use std::sync::Arc;

use crate::shader::Composed;

/// What the shader binds, and the layout of that; found out once.
pub(super) struct ClipLayout {
    pub(super) composed: Arc<Composed>,
    pub(super) layout: wgpu::BindGroupLayout,
}
