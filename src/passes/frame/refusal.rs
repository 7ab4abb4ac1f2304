//! Reason why a frame is not drawn: the kind of obstacle, for programs, and a description of the offending scene element, for readers.

/// Feature of a scene or device that a method does not support.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Unsupported {
    /// A cap surface and an inside test that are not compatible.
    #[error("the cap surface and the inside test are not compatible")]
    Pairing,
    /// The requested rasteriser.
    #[error("that rasteriser cannot draw it")]
    Rasteriser,
    /// The requested interpolation of relief heights.
    #[error("its heights cannot be read through a sampler")]
    HeightFilter,
    /// A part that is filled by the nonzero rule.
    #[error("it supports only the even-odd rule")]
    Nonzero,
    /// The overlaps of several solids in a cap.
    #[error("it does not tell where solids overlap")]
    Overlaps,
    /// A cut by a closed mesh.
    #[error("it cannot cut by a closed mesh")]
    Cutters,
    /// A relief.
    #[error("it cuts only by planes")]
    Reliefs,
    /// More than one clip-surface.
    #[error("it cuts only by a single plane")]
    Surfaces,
    /// More cuts or clip-surfaces than a pixel's words have bits for.
    #[error("it supports at most 32 clip-surfaces and 32 cuts")]
    Cuts,
    /// The near plane inside a cut part.
    #[error("it makes no cap where the near plane meets a part")]
    NearPlane,
    /// A number or size beyond what frames support.
    #[error("it exceeds what a frame supports")]
    Amount,
    /// A limit of the device.
    #[error("it exceeds a limit of the device")]
    Limit,
}

/// Why a method does not draw a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct Refusal {
    /// Kind of obstacle.
    pub unsupported: Unsupported,
    /// Description in words.
    pub reason: String,
}

impl Refusal {
    /// A refusal of the given kind, with its description.
    pub fn new(unsupported: Unsupported, reason: impl Into<String>) -> Self {
        Self {
            unsupported,
            reason: reason.into(),
        }
    }

    /// A count or size that exceeds the limits of frames.
    pub(crate) fn amount(reason: impl Into<String>) -> Self {
        Self::new(Unsupported::Amount, reason)
    }
}
