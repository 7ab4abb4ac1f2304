//! Shadow: what stands on a ground darkens it.

/// The shadow on a level ground below all kept geometry, of light from straight above. Lights of a style shine from the camera; this one
/// shows the ground contact. It is drawn only on request: by `render` and `animate`, and for a [`Model`](crate::Model) that was
/// given one by [`Model::on_ground`](crate::Model::on_ground), which its updates forget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// Share of the light that is missing in full shadow, 0 to 1; 0 draws none.
    pub strength: f32,
    /// Greatest angle of the light from the vertical, in degrees: sets the softness of shadows of geometry far above the ground.
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
