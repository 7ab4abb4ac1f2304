//! Work of a pass: a dispatch of workgroups, or draws into attachments.

use std::ops::Range;

use super::ResourceId;

/// A colour attachment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorTarget {
    /// The texture drawn into.
    pub resource: ResourceId,
    /// Set to zero before the first draw.
    pub clear: bool,
}

/// Depth test of fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DepthCompare {
    /// Nearest first in a reversed buffer, cleared to 0.
    Greater,
    /// Nearest first in a plain buffer, cleared to 1.
    Less,
    /// Every fragment passes, and depth is not written: a pass must have an attachment even if only its side effects count.
    Always,
    /// Only fragments strictly behind the stored depth of a reversed buffer pass, and depth is not written.
    Behind,
    /// Every fragment passes and replaces the stored depth: a draw that covers the picture leaves no earlier depth.
    Replace,
}

impl DepthCompare {
    /// Returns true if passing fragments write depth.
    pub fn writes(self) -> bool {
        !matches!(self, Self::Always | Self::Behind)
    }
}

/// Effect of a draw's fragments on the stencil of their pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum StencilStep {
    /// Each fragment that passes the depth test inverts these bits.
    Flip {
        /// The bits.
        bits: u8,
    },
    /// Each fragment that passes the depth test adds 1 on the inner side of the mesh and subtracts 1 on the outer side, modulo 256.
    Wind,
    /// As [`Self::Wind`], for every fragment that is not discarded, whether or not it passes the depth test.
    WindAll,
    /// Only pixels with one of these bits set are drawn; all bits of every such pixel end at 0.
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
    /// How fragments change it.
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
    /// Stencil operation; `None` if the pass leaves the stencil unchanged or the texture has no stencil.
    pub stencil: Option<Stencil>,
}

/// Bytes of a vertex of [`Vertices::Mesh`].
pub const VERTEX_BYTES: u64 = 16;
/// Bytes of an index.
pub const INDEX_BYTES: u64 = 4;

/// Vertex buffer read by a draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vertices {
    /// Position (3 x f32) and octahedral normal (u32), 16 bytes per vertex.
    Mesh(ResourceId),
    /// None: the shader uses only the vertex index.
    None,
}

/// Bytes of a draw's arguments.
pub const ARGUMENT_BYTES: u64 = 20;
/// Bytes of a dispatch's arguments.
pub const DISPATCH_ARGUMENT_BYTES: u64 = 12;

/// Size of a draw or a dispatch, in a device buffer that passes write. A draw reads [`ARGUMENT_BYTES`] as
/// `count, 1, first index, 0, 0`, a dispatch [`DISPATCH_ARGUMENT_BYTES`] as workgroups in x, y and z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arguments {
    /// The buffer.
    pub resource: ResourceId,
    /// Offset of the first byte.
    pub offset: u64,
}

/// One indexed draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Range of the index buffer; with arguments, the range that they must stay within, which only the pass that writes them can ensure.
    pub indices: Range<u32>,
    /// Added to every index.
    pub base_vertex: i32,
    /// Number of vertices, from the base vertex, that the indices reach; 0 without a vertex buffer.
    pub vertex_count: u32,
    /// Instance index in the shader; with arguments it is 0, because core WebGPU allows no other first instance there.
    pub instance: u32,
    /// Where the device buffer holds the range; `None` if the plan itself contains the range.
    pub arguments: Option<Arguments>,
}

impl Draw {
    /// The triangle that covers the picture, with three indices.
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

/// Work of a pass.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// A dispatch of workgroups.
    Compute {
        /// Workgroups in x, y, z.
        groups: [u32; 3],
    },
    /// A dispatch of as many workgroups as an earlier pass has counted.
    ComputeIndirect {
        /// Where the workgroup counts in x, y and z are.
        arguments: Arguments,
    },
    /// Indexed triangles, drawn from both sides.
    Draw {
        /// Colour attachment.
        color: Option<ColorTarget>,
        /// Depth attachment.
        depth: DepthTarget,
        /// Vertex buffer.
        vertices: Vertices,
        /// Index buffer.
        indices: ResourceId,
        /// The draws, in order.
        draws: Vec<Draw>,
    },
}

impl DepthTarget {
    /// A depth target that fragments neither test nor write: a drawing pass must have one. Any depth texture will do, as it is cleared.
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
    /// A dispatch with one invocation per pixel, or texel, of a picture.
    pub fn over(size: [u32; 2]) -> Self {
        Self::Compute {
            groups: groups_over(size),
        }
    }

    /// A dispatch of one workgroup.
    pub fn once() -> Self {
        Self::Compute { groups: [1, 1, 1] }
    }

    pub(super) fn resources_mut(&mut self) -> Vec<&mut ResourceId> {
        let (color, depth, vertices, indices, draws) = match self {
            Self::Compute { .. } => return Vec::new(),
            Self::ComputeIndirect { arguments } => return vec![&mut arguments.resource],
            Self::Draw {
                color,
                depth,
                vertices,
                indices,
                draws,
            } => (color, depth, vertices, indices, draws),
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

/// Workgroups of 16 x 16 invocations that cover a picture.
pub fn groups_over(size: [u32; 2]) -> [u32; 3] {
    [size[0].div_ceil(16), size[1].div_ceil(16), 1]
}
