//! The rules of a plan, and the limits of core WebGPU that it must respect.
//!
//! Rules: names are unique; every binding of a shader has a resource and every resource given has a binding; nothing is
//! read before it is written or uploaded; nothing is written that is never read; passes of slower clocks never read what passes of
//! faster clocks make; the indices and arguments that a draw reads lie within their buffers. The values of indices and arguments on
//! the device cannot be checked here: the pass that writes them must be correct.

use std::collections::BTreeMap;

use super::{
    ARGUMENT_BYTES, Access, Arguments, BufferRole, DISPATCH_ARGUMENT_BYTES, Format, INDEX_BYTES,
    Plan, ResourceId, Shape, Vertices, Work,
};
use crate::shader::{self, BindingKind};
use crate::{Error, Result};

/// Limits that a plan is checked against. The default is the minimum that every WebGPU device offers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one storage binding.
    pub storage_binding_bytes: u64,
    /// Bytes of one uniform binding.
    pub uniform_binding_bytes: u64,
    /// Storage buffers visible to one stage.
    pub buffer_bytes: u64,
    /// Storage buffers that one stage sees.
    pub storage_buffers_per_stage: usize,
    /// Workgroups per dimension.
    pub groups_per_dimension: u32,
    /// Width and height of a texture.
    pub texture_size: u32,
    /// Layers of a texture.
    pub texture_layers: u32,
    /// True if 64-bit atomics are supported.
    pub wide_atomics: bool,
    /// True if the 32-bit depth-stencil format is supported.
    pub depth32_stencil8: bool,
    /// True if samplers filter textures of 32-bit floats.
    pub filters_f32: bool,
}

impl Limits {
    /// The minimum limits of every WebGPU implementation.
    pub const CORE: Self = Self {
        storage_binding_bytes: 128 << 20,
        uniform_binding_bytes: 64 << 10,
        buffer_bytes: 256 << 20,
        storage_buffers_per_stage: shader::STORAGE_BUFFERS_PER_STAGE,
        groups_per_dimension: 65_535,
        texture_size: 8192,
        texture_layers: 256,
        wide_atomics: false,
        depth32_stencil8: false,
        filters_f32: false,
    };

    /// The limits by name; features are 1 if present, otherwise 0.
    pub fn by_name(&self) -> BTreeMap<String, u64> {
        let limits = [
            ("storage_binding_bytes", self.storage_binding_bytes),
            ("uniform_binding_bytes", self.uniform_binding_bytes),
            ("buffer_bytes", self.buffer_bytes),
            (
                "storage_buffers_per_stage",
                self.storage_buffers_per_stage as u64,
            ),
            ("groups_per_dimension", u64::from(self.groups_per_dimension)),
            ("texture_size", u64::from(self.texture_size)),
            ("texture_layers", u64::from(self.texture_layers)),
            ("wide_atomics", u64::from(self.wide_atomics)),
            ("depth32_stencil8", u64::from(self.depth32_stencil8)),
        ];
        limits.map(|(name, value)| (name.to_owned(), value)).into()
    }
}

impl Plan {
    /// Checks the plan and returns the first rule or limit that it breaks.
    pub fn check(&self, limits: &Limits) -> Result<()> {
        self.check_names()?;
        self.check_sizes(limits)?;
        self.check_order()?;
        for pass in &self.passes {
            self.check_bindings(pass, limits)?;
            self.check_draws(pass)?;
            if let Work::ComputeIndirect { arguments } = &pass.work {
                self.check_dispatch(pass, arguments)?;
            }
        }
        Ok(())
    }

    fn check_dispatch(&self, pass: &super::Pass, arguments: &Arguments) -> Result<()> {
        self.check_arguments(pass, arguments, DISPATCH_ARGUMENT_BYTES)?;
        // WebGPU: within one dispatch a buffer is either read as arguments or written.
        if pass.writes().contains(&arguments.resource) {
            return Err(Error::Plan(format!(
                "{} writes {}, which holds its own arguments",
                pass.name,
                self.resource(arguments.resource).name
            )));
        }
        Ok(())
    }

    /// Checks that arguments lie within a buffer made for arguments.
    fn check_arguments(&self, pass: &super::Pass, arguments: &Arguments, bytes: u64) -> Result<()> {
        let of = self.resource(arguments.resource);
        let is_for_arguments = matches!(
            of.shape,
            Shape::Buffer {
                role: BufferRole::Arguments,
                ..
            }
        );
        let wrong = |what: String| Err(Error::Plan(format!("{}: {what}", pass.name)));
        if !is_for_arguments {
            return wrong(format!("{} is not an arguments buffer", of.name));
        }
        if !arguments.offset.is_multiple_of(4) || arguments.offset + bytes > of.shape.bytes() {
            return wrong(format!(
                "there are no arguments at byte {} of {}",
                arguments.offset, of.name
            ));
        }
        Ok(())
    }

    fn check_draws(&self, pass: &super::Pass) -> Result<()> {
        let Work::Draw {
            vertices,
            indices,
            draws,
            ..
        } = &pass.work
        else {
            return Ok(());
        };
        let wrong = |what: String| Err(Error::Plan(format!("{}: {what}", pass.name)));
        let buffer = self.resource(*indices);
        for draw in draws {
            let end = u64::from(draw.indices.end) * INDEX_BYTES;
            if end > buffer.shape.bytes() {
                return wrong(format!(
                    "indices {:?} reach beyond {}",
                    draw.indices, buffer.name
                ));
            }
            let Some(arguments) = draw.arguments else {
                continue;
            };
            self.check_arguments(pass, &arguments, ARGUMENT_BYTES)?;
            if draw.instance != 0 {
                return wrong("a draw with arguments can only use instance 0".to_owned());
            }
            if *vertices != Vertices::None {
                return wrong(
                    "a draw with arguments cannot read a vertex buffer of unknown range".to_owned(),
                );
            }
        }
        Ok(())
    }

    fn check_names(&self) -> Result<()> {
        let mut names: Vec<&str> = self
            .resources
            .iter()
            .map(|r| r.name.as_str())
            .chain(self.passes.iter().map(|p| p.name.as_str()))
            .chain(self.on_cpu.iter().map(|w| w.name.as_str()))
            .collect();
        names.sort_unstable();
        match names.windows(2).find(|w| w[0] == w[1]) {
            Some(w) => Err(Error::Plan(format!("the name `{}` is given twice", w[0]))),
            None => Ok(()),
        }
    }

    /// Checks only the resources against the limits of a device: no shader is composed.
    ///
    /// # Errors
    ///
    /// [`Error::Limit`] with the limit that is exceeded or the feature that is missing.
    pub(crate) fn check_sizes(&self, limits: &Limits) -> Result<()> {
        for r in &self.resources {
            if let Shape::Texture {
                format: Format::Depth32FloatStencil8,
                ..
            } = r.shape
                && !limits.depth32_stencil8
            {
                return Err(Error::Limit(format!(
                    "{} needs a 32-bit depth texture with a stencil, which the device does not have (depth32float-stencil8)",
                    r.name
                )));
            }
            if let Shape::Texture {
                format: Format::R32Float,
                ..
            } = r.shape
                && !limits.filters_f32
            {
                return Err(Error::Limit(format!(
                    "{} needs a sampler that filters 32-bit floats, which the device does not have (float32-filterable)",
                    r.name
                )));
            }
            let (have, most, what) = match r.shape {
                Shape::Buffer {
                    bytes,
                    role: BufferRole::Storage,
                } => (
                    bytes,
                    limits.storage_binding_bytes,
                    "bytes in a storage binding",
                ),
                Shape::Buffer {
                    bytes,
                    role: BufferRole::Uniform,
                } => (
                    bytes,
                    limits.uniform_binding_bytes,
                    "bytes in a uniform binding",
                ),
                Shape::Buffer { bytes, .. } => (bytes, limits.buffer_bytes, "bytes in a buffer"),
                Shape::Texture { size, layers, .. } if layers <= limits.texture_layers => (
                    u64::from(size[0].max(size[1])),
                    u64::from(limits.texture_size),
                    "texels along a texture",
                ),
                Shape::Sampler { .. } => continue,
                Shape::Texture { layers, .. } => (
                    u64::from(layers),
                    u64::from(limits.texture_layers),
                    "layers in a texture",
                ),
            };
            if have > most {
                return Err(Error::Limit(format!(
                    "{} needs {have} {what}; the limit is {most}",
                    r.name
                )));
            }
        }
        for pass in &self.passes {
            if let Work::Compute { groups } = pass.work
                && groups.iter().any(|g| *g > limits.groups_per_dimension)
            {
                let most = limits.groups_per_dimension;
                return Err(Error::Limit(format!(
                    "{} dispatches {groups:?} workgroups; the limit is {most}",
                    pass.name
                )));
            }
        }
        Ok(())
    }

    fn check_order(&self) -> Result<()> {
        let mut written: Vec<bool> = self
            .resources
            .iter()
            .map(|r| r.contents.is_some() || matches!(r.shape, Shape::Sampler { .. }))
            .collect();
        let mut read = vec![false; self.resources.len()];
        for pass in &self.passes {
            for id in pass.reads() {
                let r = self.resource(id);
                if !written[id.0] {
                    return Err(Error::Plan(format!(
                        "{} reads {} before anything wrote it",
                        pass.name, r.name
                    )));
                }
                if r.clock > pass.clock {
                    let (c, rc) = (pass.clock.name(), r.clock.name());
                    return Err(Error::Plan(format!(
                        "{} runs per {c} but reads {}, made per {rc}",
                        pass.name, r.name
                    )));
                }
                read[id.0] = true;
            }
            for id in pass.writes() {
                written[id.0] = true;
            }
        }
        let outputs = [self.layers, self.picture, self.need];
        let is_output = |id| {
            let id = ResourceId(id);
            outputs.contains(&Some(id)) || self.channels.contains(&id)
        };
        // A pass reads its own depth buffer in the depth test.
        let tests_itself = |id: usize| {
            matches!(
                self.resources[id].shape,
                Shape::Texture {
                    format: Format::Depth32Float | Format::Depth32FloatStencil8,
                    ..
                }
            )
        };
        match (0..self.resources.len())
            .find(|id| !read[*id] && !is_output(*id) && !tests_itself(*id))
        {
            Some(id) => Err(Error::Plan(format!(
                "nothing reads {}",
                self.resources[id].name
            ))),
            None => Ok(()),
        }
    }

    fn check_bindings(&self, pass: &super::Pass, limits: &Limits) -> Result<()> {
        let composed = shader::compose(&pass.shader)?;
        if composed.is_native && !limits.wide_atomics {
            return Err(Error::Limit(format!(
                "{} needs 64-bit atomics, which this adapter does not offer",
                pass.name
            )));
        }
        for b in &pass.bindings {
            let Some(w) = composed.bindings.iter().find(|w| w.name == b.name) else {
                return Err(Error::Plan(format!(
                    "{}: {} binds no `{}`",
                    pass.name, pass.shader, b.name
                )));
            };
            let bytes = self.resource(b.resource).shape.bytes();
            let is_storage = matches!(
                w.kind,
                BindingKind::StorageRead | BindingKind::StorageReadWrite
            );
            // Vertices and indices may be larger in a vertex or index buffer than a shader may bind.
            if is_storage && bytes > limits.storage_binding_bytes {
                return Err(Error::Limit(format!(
                    "{} needs {bytes} bytes in a storage binding of {}; WebGPU offers {}",
                    self.resource(b.resource).name,
                    pass.name,
                    limits.storage_binding_bytes
                )));
            }
            if w.kind != BindingKind::StorageReadWrite && b.access != Access::Read {
                return Err(Error::Plan(format!(
                    "{}: `{}` is only read by {}",
                    pass.name, b.name, pass.shader
                )));
            }
        }
        if let Some(w) = (composed.bindings)
            .iter()
            .find(|w| !pass.bindings.iter().any(|b| b.name == w.name))
        {
            return Err(Error::Plan(format!(
                "{}: `{}` of {} is bound to nothing",
                pass.name, w.name, pass.shader
            )));
        }
        let is_storage = |w: &&shader::ShaderBinding| {
            matches!(
                w.kind,
                BindingKind::StorageRead | BindingKind::StorageReadWrite
            )
        };
        for stage in 0..3 {
            let count = (composed.bindings)
                .iter()
                .filter(is_storage)
                .filter(|w| w.stages[stage])
                .count();
            if count > limits.storage_buffers_per_stage {
                return Err(Error::Plan(format!(
                    "{} binds {count} storage buffers in one stage",
                    pass.shader
                )));
            }
        }
        Ok(())
    }
}
