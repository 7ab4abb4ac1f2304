//! Reason why a frame is not drawn: the kind of obstacle, for programs, and the offending element of the scene in words, for readers.

/// Feature of a scene, or of a device, that a method does not support.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Unsupported {
    /// A cap surface and an inside test that are not compatible.
    #[error("the cap surface and the inside test do not go together")]
    Pairing,
    /// The requested rasteriser.
    #[error("it is not drawn by that rasteriser")]
    Rasteriser,
    /// The requested interpolation of relief heights.
    #[error("its heights are not read through a sampler")]
    HeightFilter,
    /// A part that is filled by the nonzero rule.
    #[error("it knows parity alone")]
    Nonzero,
    /// The overlaps of several solids in a cap.
    #[error("it does not tell where solids overlap")]
    Overlaps,
    /// A cut by a closed mesh.
    #[error("it cuts by no closed mesh")]
    Cutters,
    /// A relief.
    #[error("it cuts by planes alone")]
    Reliefs,
    /// More than one clip-surface.
    #[error("it cuts by one plane")]
    Surfaces,
    /// More cuts or clip-surfaces than the words of a pixel have bits for.
    #[error("it has bits for 32 clip-surfaces and 32 cuts")]
    Cuts,
    /// The near plane in a part that is cut.
    #[error("it makes no cap where the near plane meets a part")]
    NearPlane,
    /// More of something, or larger, than frames provide for.
    #[error("it is more than a frame provides for")]
    Amount,
    /// A limit of the device.
    #[error("a limit of the device")]
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
    /// A refusal of a kind, with its description.
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
