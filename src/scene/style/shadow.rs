//! Shadow: what stands on a ground darkens it.

/// The shadow on a level ground below all that is kept, of light from straight above. Lights of a style shine from the camera; this one
/// says where the model stands, and is drawn where it is asked for alone: by `render` and `animate`, and of a [`Model`](crate::Model) that was
/// given one by [`Model::on_ground`](crate::Model::on_ground), which its updates forget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// How much of the light is missing where all of it is hidden, 0 to 1; 0 draws none.
    pub strength: f32,
    /// How far from straight above light still comes, in degrees: what is far above the ground has a shadow that is so soft.
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
    /// Whether it is drawn.
    pub fn is_drawn(&self) -> bool {
        self.strength > 0.0
    }
}
