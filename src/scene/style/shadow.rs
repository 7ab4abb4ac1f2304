//! Shadow: the model darkens the ground that it stands on.

use crate::scene::describe::Described;

/// The shadow that light from straight above casts on level ground below all kept geometry. A style's lights shine from the camera; this
/// one shows ground contact. It is drawn only on request: by `render` and `animate`, and for a [`Model`](crate::Model) that was given a
/// shadow by [`Model::on_ground`](crate::Model::on_ground); an update of the model removes the shadow.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Shadow {
    /// Darkness of the ground shadow; 0 for none.
    ///
    /// Share of light missing in full shadow.
    #[value(range = 0.0..=1.0, example = 0.35)]
    pub strength: f32,
    /// Angular radius of the light around the zenith; larger values give softer shadows.
    #[value(range = 0.0..=70.0, unit = "degrees", example = 25)]
    pub spread_deg: f32,
}

impl Default for Shadow {
    fn default() -> Self {
        Self {
            strength: 0.0,
            spread_deg: 25.0,
        }
    }
}

impl Shadow {
    /// Returns true if it is drawn.
    pub fn is_drawn(&self) -> bool {
        self.strength > 0.0
    }
}
