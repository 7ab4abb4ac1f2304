//! Why a frame is not drawn: what stands in the way, for who asks by kind, and what of the scene it is, for who reads.

/// What of a scene, or of a device, a method cannot do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Unsupported {
    /// A cap surface and an inside test that do not go together.
    #[error("the cap surface and the inside test do not go together")]
    Pairing,
    /// The rasteriser that is asked for.
    #[error("it is not drawn by that rasteriser")]
    Rasteriser,
    /// The way in which heights of reliefs are asked to be interpolated.
    #[error("its heights are not read through a sampler")]
    HeightFilter,
    /// A part that is filled by the nonzero rule.
    #[error("it knows parity alone")]
    Nonzero,
    /// Being asked where several solids share a cap.
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
    /// What kind of thing stands in the way.
    pub unsupported: Unsupported,
    /// What it is, in words.
    pub reason: String,
}

impl Refusal {
    /// What stands in the way, and in words.
    pub fn new(unsupported: Unsupported, reason: impl Into<String>) -> Self {
        Self {
            unsupported,
            reason: reason.into(),
        }
    }

    /// What is more, or larger, than frames provide for.
    pub(crate) fn amount(reason: impl Into<String>) -> Self {
        Self::new(Unsupported::Amount, reason)
    }
}
