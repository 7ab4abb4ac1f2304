//! Buffers and textures of a plan.

use std::sync::Arc;

use super::Clock;

/// Handle of a resource in its plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub usize);

/// Texel formats in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Two words: what a surface is, and its normal.
    Rg32Uint,
    /// Depth.
    Depth32Float,
    /// Depth and a stencil of 8 bits; not on every device ([`Limits::depth32_stencil8`](super::Limits)).
    Depth32FloatStencil8,
}

impl Format {
    /// Bytes of a texel.
    pub fn texel_bytes(self) -> u64 {
        match self {
            Self::Rg32Uint => 8,
            Self::Depth32Float => 4,
            Self::Depth32FloatStencil8 => 5,
        }
    }
}

/// What a buffer is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// `var<storage>`.
    Storage,
    /// `var<uniform>`.
    Uniform,
    /// Vertices.
    Vertex,
    /// 32-bit indices.
    Index,
}

/// Size and kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A buffer.
    Buffer {
        /// Length.
        bytes: u64,
        /// What it is for.
        role: Role,
    },
    /// A 2D texture, with layers.
    Texture {
        /// Width and height in texels.
        size: [u32; 2],
        /// At least 1.
        layers: u32,
        /// Format of a texel.
        format: Format,
    },
}

impl Shape {
    /// Bytes of memory, without padding by the driver.
    pub fn bytes(&self) -> u64 {
        match *self {
            Self::Buffer { bytes, .. } => bytes,
            Self::Texture {
                size,
                layers,
                format,
            } => u64::from(size[0]) * u64::from(size[1]) * u64::from(layers) * format.texel_bytes(),
        }
    }
}

/// Bytes to upload; equal contents are not uploaded again.
#[derive(Clone)]
pub struct Contents(pub Arc<[u8]>);

impl Contents {
    /// The bytes of plain values.
    pub fn of<T: bytemuck::NoUninit>(values: &[T]) -> Self {
        Self(bytemuck::cast_slice(values).into())
    }
}

impl PartialEq for Contents {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl std::fmt::Debug for Contents {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}

/// A buffer or texture of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Resource {
    /// Unique name.
    pub name: String,
    /// Size and kind.
    pub shape: Shape,
    /// What the contents depend on.
    pub clock: Clock,
    /// Uploaded before the passes of `clock` run; `None` for what passes write.
    pub contents: Option<Contents>,
    /// Belongs to the scene (meshes, heights, tables) and is there for every strategy; not counted as a strategy's cost.
    pub is_scene: bool,
}

impl Resource {
    /// A storage buffer that passes write.
    pub fn storage(name: impl Into<String>, bytes: u64, clock: Clock) -> Self {
        // WebGPU has no empty bindings.
        let shape = Shape::Buffer {
            bytes: bytes.max(4),
            role: Role::Storage,
        };
        Self {
            name: name.into(),
            shape,
            clock,
            contents: None,
            is_scene: false,
        }
    }

    /// A buffer with contents of the scene.
    pub fn upload(name: impl Into<String>, role: Role, contents: Contents, clock: Clock) -> Self {
        let shape = Shape::Buffer {
            bytes: contents.0.len() as u64,
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
}
