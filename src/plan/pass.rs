//! One step of a plan.

use std::ops::Range;

use super::{Clock, ResourceId, Vertices, Work};
use crate::shader::Shader;

/// How a pass accesses a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Only reads the resource.
    Read,
    /// Writes everything that later passes read.
    Write,
    /// Reads existing contents and changes them.
    ReadWrite,
}

/// A resource bound to a shader variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Name of the variable in WGSL.
    pub name: &'static str,
    /// Resource that it is bound to.
    pub resource: ResourceId,
    /// Single layer of a texture, which the shader sees as a plain 2D texture.
    pub layer: Option<u32>,
    /// Access of the pass.
    pub access: Access,
    /// Bytes of a buffer that the pass reads or writes; `None` means all. The shader itself must stay within them.
    pub bytes: Option<Range<u64>>,
}

impl Binding {
    /// A binding that is read.
    pub fn read(name: &'static str, resource: ResourceId) -> Self {
        Self {
            name,
            resource,
            layer: None,
            bytes: None,
            access: Access::Read,
        }
    }

    /// A binding that is written.
    pub fn write(name: &'static str, resource: ResourceId) -> Self {
        Self {
            name,
            resource,
            layer: None,
            bytes: None,
            access: Access::Write,
        }
    }

    /// A binding that is read and written.
    pub fn update(name: &'static str, resource: ResourceId) -> Self {
        Self {
            name,
            resource,
            layer: None,
            bytes: None,
            access: Access::ReadWrite,
        }
    }

    /// One layer of a texture, read.
    pub fn read_layer(name: &'static str, resource: ResourceId, layer: u32) -> Self {
        Self {
            name,
            resource,
            layer: Some(layer),
            bytes: None,
            access: Access::Read,
        }
    }
}

impl Binding {
    /// The same binding, limited to a byte range of the buffer that the pass stays within.
    #[must_use]
    pub fn within(self, bytes: Range<u64>) -> Self {
        Self {
            bytes: Some(bytes),
            ..self
        }
    }
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Name, unique in the plan.
    pub name: String,
    /// Clock on which it runs.
    pub clock: Clock,
    /// Why the pass is needed, for readers of `cutaway plan`.
    pub reason: String,
    /// The shader.
    pub shader: Shader,
    /// Resources by the names of the shader's variables.
    pub bindings: Vec<Binding>,
    /// Values of the shader's `override` constants.
    pub constants: Vec<(&'static str, f64)>,
    /// Dispatch or draws.
    pub work: Work,
}

impl Pass {
    /// A pass of the frame, without constants.
    pub fn new(
        name: impl Into<String>,
        reason: impl Into<String>,
        shader: impl Into<Shader>,
        bindings: Vec<Binding>,
        work: Work,
    ) -> Self {
        Self {
            name: name.into(),
            clock: Clock::Frame,
            reason: reason.into(),
            shader: shader.into(),
            bindings,
            constants: Vec::new(),
            work,
        }
    }

    /// The same pass on another clock.
    #[must_use]
    pub fn on(self, clock: Clock) -> Self {
        Self { clock, ..self }
    }

    /// The same pass with values of the shader's `override` constants.
    #[must_use]
    pub fn with_constants(self, constants: Vec<(&'static str, f64)>) -> Self {
        Self { constants, ..self }
    }

    /// Resources that the pass reads, in order of first mention.
    pub fn reads(&self) -> Vec<ResourceId> {
        let bound = self
            .bindings
            .iter()
            .filter(|b| b.access != Access::Write)
            .map(|b| b.resource);
        let mut all: Vec<ResourceId> = bound.collect();
        if let Work::ComputeIndirect { arguments } = &self.work
            && !all.contains(&arguments.resource)
        {
            all.push(arguments.resource);
        }
        if let Work::Draw {
            color,
            depth,
            vertices,
            indices,
            draws,
        } = &self.work
        {
            if let Vertices::Mesh(id) = vertices {
                all.push(*id);
            }
            all.push(*indices);
            for id in draws.iter().filter_map(|d| d.arguments.map(|a| a.resource)) {
                if !all.contains(&id) {
                    all.push(id);
                }
            }
            all.extend(color.filter(|c| !c.clear).map(|c| c.resource));
            let keeps = !depth.clear || depth.stencil.is_some_and(|s| !s.clear);
            all.extend(keeps.then_some(depth.resource));
        }
        all
    }

    /// All resources that the pass mentions, to be renumbered.
    pub(super) fn resources_mut(&mut self) -> impl Iterator<Item = &mut ResourceId> {
        let bound = self.bindings.iter_mut().map(|b| &mut b.resource);
        bound.chain(self.work.resources_mut())
    }

    /// Resources that the pass writes.
    pub fn writes(&self) -> Vec<ResourceId> {
        let bound = self
            .bindings
            .iter()
            .filter(|b| b.access != Access::Read)
            .map(|b| b.resource);
        let mut all: Vec<ResourceId> = bound.collect();
        if let Work::Draw { color, depth, .. } = &self.work {
            all.extend(color.map(|c| c.resource));
            let writes = depth.compare.writes() || depth.stencil.is_some();
            all.extend(writes.then_some(depth.resource));
        }
        all
    }
}
