//! Buffers and textures of a plan.

use std::ops::Range;
use std::sync::Arc;

use super::Clock;
use crate::scene::Wrap;

/// Handle of a resource in its plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub usize);

/// Texel formats in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// Two words: the surface's identity and its normal.
    Rg32Uint,
    /// A height, filtered by a sampler; not supported by every device ([`Limits::filters_f32`](super::Limits)).
    R32Float,
    /// Depth.
    Depth32Float,
    /// Depth and an 8-bit stencil; not supported by every device ([`Limits::depth32_stencil8`](super::Limits)).
    Depth32FloatStencil8,
}

impl Format {
    /// Bytes per texel.
    pub fn texel_bytes(self) -> u64 {
        match self {
            Self::Rg32Uint => 8,
            Self::R32Float | Self::Depth32Float => 4,
            Self::Depth32FloatStencil8 => 5,
        }
    }
}

/// How a buffer is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BufferRole {
    /// `var<storage>`.
    Storage,
    /// `var<uniform>`.
    Uniform,
    /// Vertices.
    Vertex,
    /// 32-bit indices.
    Index,
    /// Arguments of draws and dispatches.
    Arguments,
}

/// Size and kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A buffer.
    Buffer {
        /// Size in bytes.
        bytes: u64,
        /// Its use.
        role: BufferRole,
    },
    /// A 2D texture, with layers.
    Texture {
        /// Width and height in texels.
        size: [u32; 2],
        /// Number of layers, at least 1.
        layers: u32,
        /// Format of a texel.
        format: Format,
    },
    /// Samples textures with bilinear filtering.
    Sampler {
        /// Wrap mode outside the texture, along both axes.
        wrap: Wrap,
    },
}

impl Shape {
    /// Bytes of memory, excluding padding by the driver.
    pub fn bytes(&self) -> u64 {
        match *self {
            Self::Buffer { bytes, .. } => bytes,
            Self::Texture {
                size,
                layers,
                format,
            } => u64::from(size[0]) * u64::from(size[1]) * u64::from(layers) * format.texel_bytes(),
            Self::Sampler { .. } => 0,
        }
    }
}

/// Bytes of an upload, and their offset.
#[derive(Clone)]
pub struct Piece {
    /// Offset of the first byte.
    pub offset: u64,
    /// The bytes, a whole number of words.
    pub bytes: Arc<[u8]>,
}

impl Piece {
    /// The bytes of plain values.
    pub fn from_values<T: bytemuck::NoUninit>(offset: u64, values: &[T]) -> Self {
        Self {
            offset,
            bytes: bytemuck::cast_slice(values).into(),
        }
    }

    /// The byte range that the piece covers.
    pub fn range(&self) -> Range<u64> {
        self.offset..self.offset + self.bytes.len() as u64
    }
}

impl std::fmt::Debug for Piece {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.range())
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.offset == other.offset
            && (Arc::ptr_eq(&self.bytes, &other.bytes) || self.bytes == other.bytes)
    }
}

/// Bytes to upload, in pieces; unchanged pieces are not uploaded again. Gaps between pieces may be written by passes.
#[derive(Clone)]
pub struct Contents {
    pieces: Arc<[Piece]>,
    len: u64,
    changes: bool,
}

impl Contents {
    /// The bytes of plain values.
    pub fn from_values<T: bytemuck::NoUninit>(values: &[T]) -> Self {
        let piece = Piece::from_values(0, values);
        Self::in_pieces(piece.range().end, vec![piece], false)
    }

    /// A buffer of `len` bytes with these pieces in it, in order. `changes` states that pieces will be exchanged or gaps
    /// between them written: every program then keeps a separate buffer for the contents.
    pub fn in_pieces(len: u64, pieces: Vec<Piece>, changes: bool) -> Self {
        Self {
            pieces: pieces.into(),
            len,
            changes,
        }
    }

    /// Bytes from the start of the first piece to the end of the buffer.
    pub fn len(&self) -> u64 {
        self.len
    }

    /// Returns true if there are no bytes.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The pieces, in order.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Returns true if pieces will be exchanged or gaps between them written.
    pub fn changes(&self) -> bool {
        self.changes
    }

    /// All bytes, with zeros in the gaps between pieces.
    pub fn bytes(&self) -> Vec<u8> {
        let mut all = vec![0; self.len as usize];
        for piece in &*self.pieces {
            let range = piece.range();
            all[range.start as usize..range.end as usize].copy_from_slice(&piece.bytes);
        }
        all
    }

    /// The pieces that other contents do not have at the same offset.
    pub fn not_in<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = &'a Piece> {
        let same = Arc::ptr_eq(&self.pieces, &other.pieces);
        let all = if same { &[] } else { &*self.pieces };
        all.iter().filter(|piece| {
            let at = other
                .pieces
                .binary_search_by_key(&piece.offset, |p| p.offset);
            at.map_or(true, |i| other.pieces[i] != **piece)
        })
    }

    /// Returns true if both hold the identical pieces, without comparing their bytes.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.pieces, &other.pieces)
    }

    /// Returns true if the pieces also have another owner.
    pub(crate) fn is_held_elsewhere(&self) -> bool {
        Arc::strong_count(&self.pieces) > 1
    }
}

impl PartialEq for Contents {
    fn eq(&self, other: &Self) -> bool {
        self.len == other.len
            && self.changes == other.changes
            && (self.is_same(other) || self.pieces == other.pieces)
    }
}

impl std::fmt::Debug for Contents {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", self.len)
    }
}

/// A buffer or texture of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Resource {
    /// Unique name.
    pub name: String,
    /// Size and kind.
    pub shape: Shape,
    /// Clock of the inputs that the contents depend on.
    pub clock: Clock,
    /// Uploaded before the passes of `clock` run; `None` if passes write all contents.
    pub contents: Option<Contents>,
    /// Belongs to the scene (meshes, heights, tables) and exists for every strategy; not counted as a strategy's cost.
    pub is_scene: bool,
}

impl Resource {
    /// A storage buffer that passes write.
    pub fn storage(name: impl Into<String>, bytes: u64, clock: Clock) -> Self {
        // WebGPU has no empty bindings.
        let shape = Shape::Buffer {
            bytes: bytes.max(4),
            role: BufferRole::Storage,
        };
        Self {
            name: name.into(),
            shape,
            clock,
            contents: None,
            is_scene: false,
        }
    }

    /// A buffer that passes write and from which draws or dispatches read their size.
    pub fn arguments(name: impl Into<String>, bytes: u64, clock: Clock) -> Self {
        Self {
            shape: Shape::Buffer {
                bytes,
                role: BufferRole::Arguments,
            },
            ..Self::storage(name, bytes, clock)
        }
    }

    /// A buffer with scene contents.
    pub fn upload(
        name: impl Into<String>,
        role: BufferRole,
        contents: Contents,
        clock: Clock,
    ) -> Self {
        let shape = Shape::Buffer {
            bytes: contents.len(),
            role,
        };
        Self {
            name: name.into(),
            shape,
            clock,
            contents: Some(contents),
            is_scene: true,
        }
    }

    /// A buffer with contents specific to a strategy: they count as its cost.
    pub fn own_upload(
        name: impl Into<String>,
        role: BufferRole,
        contents: Contents,
        clock: Clock,
    ) -> Self {
        Self {
            is_scene: false,
            ..Self::upload(name, role, contents, clock)
        }
    }

    /// A texture that passes draw into.
    pub fn texture(
        name: impl Into<String>,
        size: [u32; 2],
        layers: u32,
        format: Format,
        clock: Clock,
    ) -> Self {
        let shape = Shape::Texture {
            size,
            layers,
            format,
        };
        Self {
            name: name.into(),
            shape,
            clock,
            contents: None,
            is_scene: false,
        }
    }

    /// A texture with contents specific to a strategy, layer by layer and row by row: they count as its cost.
    pub fn uploaded_texture(
        name: impl Into<String>,
        size: [u32; 2],
        layers: u32,
        format: Format,
        contents: Contents,
        clock: Clock,
    ) -> Self {
        Self {
            contents: Some(contents),
            ..Self::texture(name, size, layers, format, clock)
        }
    }

    /// A bilinear sampler.
    pub fn sampler(name: impl Into<String>, wrap: Wrap, clock: Clock) -> Self {
        Self {
            name: name.into(),
            shape: Shape::Sampler { wrap },
            clock,
            contents: None,
            is_scene: false,
        }
    }
}
