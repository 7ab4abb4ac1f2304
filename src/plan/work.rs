//! Work of a pass: a dispatch of workgroups, or draws into attachments.

use std::ops::Range;

use super::ResourceId;

/// A colour attachment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorTarget {
    /// A texture.
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
    /// All, and nothing is written: a pass must have an attachment even where only its side effects count.
    Always,
    /// Strictly behind what is there in a reversed buffer, and nothing is written.
    Behind,
    /// All, and each replaces what is there: of a draw that covers the picture nothing of before is left.
    Replace,
}

impl DepthCompare {
    /// Returns true if fragments that pass are written.
    pub fn writes(self) -> bool {
        !matches!(self, Self::Always | Self::Behind)
    }
}

/// Effect of a draw's fragments on the stencil of their pixel.
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
    /// Effect of fragments on it.
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
    /// Stencil operation; none where the stencil is unchanged or the texture has none.
    pub stencil: Option<Stencil>,
}

/// Bytes of a vertex of [`Vertices::Mesh`].
pub const VERTEX_BYTES: u64 = 16;
/// Bytes of an index.
pub const INDEX_BYTES: u64 = 4;

/// Vertex buffer that a draw reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vertices {
    /// Position (3 x f32) and octahedral normal (u32), 16 bytes a vertex.
    Mesh(ResourceId),
    /// None: the shader works from the index alone.
    None,
}

/// Bytes of the arguments of a draw.
pub const ARGUMENT_BYTES: u64 = 20;
/// Bytes of the arguments of a dispatch.
pub const DISPATCH_ARGUMENT_BYTES: u64 = 12;

/// Size of a draw or a dispatch on the device: in a buffer that passes write. A draw reads [`ARGUMENT_BYTES`] as
/// `count, 1, first index, 0, 0`, a dispatch [`DISPATCH_ARGUMENT_BYTES`] as workgroups in x, y and z.
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
    /// Instance index in the shader; with arguments it is 0, for core WebGPU has no other first instance there.
    pub instance: u32,
    /// Location of the range on the device; none where the plan contains it.
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

/// Work of a pass.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// A dispatch of workgroups.
    Compute {
        /// Workgroups in x, y, z.
        groups: [u32; 3],
    },
    /// A dispatch of as many workgroups as a pass before it has counted.
    ComputeIndirect {
        /// Workgroups in x, y, z.
        arguments: Arguments,
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

/// Workgroups of 16 x 16 that cover a picture.
pub fn groups_over(size: [u32; 2]) -> [u32; 3] {
    [size[0].div_ceil(16), size[1].div_ceil(16), 1]
}
