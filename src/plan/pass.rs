//! One step of a plan.

use std::ops::Range;

use super::{Clock, ResourceId};
use crate::shader::Shader;

/// How a pass uses a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Only reads it.
    Read,
    /// Writes all of it that later passes read.
    Write,
    /// Reads what is there and changes it.
    ReadWrite,
}

/// A resource under the name that the shader gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Name of the variable in WGSL.
    pub name: &'static str,
    /// What it is bound to.
    pub resource: ResourceId,
    /// Layer of a texture that the shader sees as a plain 2D texture.
    pub layer: Option<u32>,
    /// How it is used.
    pub access: Access,
    /// Bytes of a buffer that the pass looks at or writes; `None` is all. The shader keeps to them by itself.
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
    /// The same binding of a pass that keeps to some bytes of the buffer.
    #[must_use]
    pub fn within(self, bytes: Range<u64>) -> Self {
        Self {
            bytes: Some(bytes),
            ..self
        }
    }
}

/// A colour attachment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorTarget {
    /// A texture.
    pub resource: ResourceId,
    /// Set to zero before the first draw.
    pub clear: bool,
}

/// Which fragments pass the depth test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DepthCompare {
    /// Nearest first in a reversed buffer, cleared to 0.
    Greater,
    /// Nearest first in a plain buffer, cleared to 1.
    Less,
    /// All, and nothing is written: a pass must have an attachment even where only its side effects count.
    Always,
    /// Strictly behind what is there in a reversed buffer, and nothing is written.
    Behind,
    /// All, and each replaces what is there: of a draw that covers the picture nothing of before is left.
    Replace,
}

impl DepthCompare {
    /// Whether fragments that pass are written.
    pub fn writes(self) -> bool {
        !matches!(self, Self::Always | Self::Behind)
    }
}

/// What the fragments of a draw do to the stencil of their pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum StencilStep {
    /// Each that passes the depth test inverts these bits.
    Flip {
        /// The bits.
        bits: u8,
    },
    /// Each that passes the depth test adds 1 where it shows its inner side and takes 1 where it shows its outer, modulo 256.
    Wind,
    /// Likewise each that is not discarded, hidden or not.
    WindAll,
    /// Only pixels with one of these bits are drawn; all bits of every pixel met end at 0.
    Take {
        /// The bits.
        bits: u8,
    },
}

/// The stencil of a depth attachment that has one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stencil {
    /// Set to 0 before the first draw.
    pub clear: bool,
    /// What fragments do to it.
    pub step: StencilStep,
}

/// The depth attachment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthTarget {
    /// A depth texture.
    pub resource: ResourceId,
    /// Layer to draw into.
    pub layer: u32,
    /// Set to the far value before the first draw.
    pub clear: bool,
    /// The test.
    pub compare: DepthCompare,
    /// What is done to the stencil; none where it is left alone or the texture has none.
    pub stencil: Option<Stencil>,
}

/// Bytes of a vertex of [`Vertices::Mesh`].
pub const VERTEX_BYTES: u64 = 16;
/// Bytes of an index.
pub const INDEX_BYTES: u64 = 4;

/// Which vertex buffer a draw reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vertices {
    /// Position (3 x f32) and octahedral normal (u32), 16 bytes a vertex.
    Mesh(ResourceId),
    /// None: the shader works from the index alone.
    None,
}

/// Bytes of the arguments of a draw.
pub const ARGUMENT_BYTES: u64 = 20;

/// Where a draw finds out on the device how many indices it has: [`ARGUMENT_BYTES`] of a buffer that passes write, as
/// `count, 1, first index, 0, 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arguments {
    /// The buffer.
    pub resource: ResourceId,
    /// Its first byte.
    pub offset: u64,
}

/// One indexed draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Range of the index buffer; with arguments, what they keep within, which only the pass that writes them can see to.
    pub indices: Range<u32>,
    /// Added to every index.
    pub base_vertex: i32,
    /// Vertices from the base one on that the indices reach; 0 without a vertex buffer.
    pub vertex_count: u32,
    /// What the shader gets as instance index; with arguments it is 0, for core WebGPU has no other first instance there.
    pub instance: u32,
    /// Where the device finds the range; none where the plan says it.
    pub arguments: Option<Arguments>,
}

impl Draw {
    /// The triangle that covers the picture, of three indices.
    pub fn full_screen(instance: u32) -> Self {
        Self {
            indices: 0..3,
            base_vertex: 0,
            vertex_count: 0,
            instance,
            arguments: None,
        }
    }
}

/// What a pass does.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// A dispatch of workgroups.
    Compute {
        /// Workgroups in x, y, z.
        groups: [u32; 3],
    },
    /// Indexed triangles, both sides drawn.
    Draw {
        /// Colour attachment.
        color: Option<ColorTarget>,
        /// Depth attachment.
        depth: DepthTarget,
        /// Vertex buffer.
        vertices: Vertices,
        /// Index buffer.
        indices: ResourceId,
        /// In order.
        draws: Vec<Draw>,
    },
}

impl DepthTarget {
    /// One that fragments neither ask nor write: a pass that draws must have one. Any depths do, for they are cleared.
    pub fn untouched(resource: ResourceId) -> Self {
        Self {
            resource,
            layer: 0,
            clear: true,
            compare: DepthCompare::Always,
            stencil: None,
        }
    }
}

impl Work {
    /// A dispatch with one invocation for each pixel, or texel, of a picture.
    pub fn over(size: [u32; 2]) -> Self {
        Self::Compute {
            groups: groups_over(size),
        }
    }

    /// A dispatch of one workgroup.
    pub fn once() -> Self {
        Self::Compute { groups: [1, 1, 1] }
    }

    fn resources_mut(&mut self) -> Vec<&mut ResourceId> {
        let Self::Draw {
            color,
            depth,
            vertices,
            indices,
            draws,
        } = self
        else {
            return Vec::new();
        };
        let mut all = vec![&mut depth.resource, indices];
        all.extend(color.as_mut().map(|c| &mut c.resource));
        if let Vertices::Mesh(id) = vertices {
            all.push(id);
        }
        let arguments = draws.iter_mut().filter_map(|d| d.arguments.as_mut());
        all.extend(arguments.map(|a| &mut a.resource));
        all
    }
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Unique name.
    pub name: String,
    /// When it runs.
    pub clock: Clock,
    /// Why it is there, for the reader of `cutaway plan`.
    pub reason: String,
    /// The shader.
    pub shader: Shader,
    /// Resources by the names of the shader.
    pub bindings: Vec<Binding>,
    /// Values of the shader's `override` constants.
    pub constants: Vec<(&'static str, f64)>,
    /// What it does.
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

    /// The same on another clock.
    #[must_use]
    pub fn on(self, clock: Clock) -> Self {
        Self { clock, ..self }
    }

    /// The same with values of the shader's `override` constants.
    #[must_use]
    pub fn with_constants(self, constants: Vec<(&'static str, f64)>) -> Self {
        Self { constants, ..self }
    }

    /// Resources the pass reads, in order of first mention.
    pub fn reads(&self) -> Vec<ResourceId> {
        let bound = self
            .bindings
            .iter()
            .filter(|b| b.access != Access::Write)
            .map(|b| b.resource);
        let mut all: Vec<ResourceId> = bound.collect();
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

    /// All that it mentions, to be numbered anew.
    pub(super) fn resources_mut(&mut self) -> impl Iterator<Item = &mut ResourceId> {
        let bound = self.bindings.iter_mut().map(|b| &mut b.resource);
        bound.chain(self.work.resources_mut())
    }

    /// Resources the pass writes.
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

/// Workgroups of 16 x 16 that cover a picture.
pub fn groups_over(size: [u32; 2]) -> [u32; 3] {
    [size[0].div_ceil(16), size[1].div_ceil(16), 1]
}
