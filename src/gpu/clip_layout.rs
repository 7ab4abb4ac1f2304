//! Bindings of the clip shader for hosts.

use std::sync::Arc;

use crate::shader::Composed;

/// The bindings of the clip shader, and their bind group layout; computed once.
pub(super) struct ClipLayout {
    pub(super) composed: Arc<Composed>,
    pub(super) layout: wgpu::BindGroupLayout,
}
