//! Appearance of a part; nothing here changes visibility.

use std::sync::Arc;

use glam::Vec3;

use crate::scene::memo::is_same;
use crate::scene::{CapHatch, CapMaterial};

/// Colours of a part, as sRGB in 0..=1.
#[derive(Clone, Debug)]
pub struct Material {
    /// Colour of the mesh.
    pub color: Vec3,
    /// Colour of the cap; `None` derives a warm, lighter tone from `color`.
    pub cap_color: Option<Vec3>,
    /// Hatch of the cap, used by styles that hatch.
    pub hatch: CapHatch,
    /// True if `color` replaces the mesh's vertex paint, if any ([`Mesh::vertex_paint`](crate::scene::Mesh::vertex_paint)).
    pub is_painted_over: bool,
    /// Material of the cap; replaces the single colour and [`CapHatch::General`].
    pub cap: Option<Arc<CapMaterial>>,
}

impl PartialEq for Material {
    /// Compares cap materials by pointer, since their contents are large.
    fn eq(&self, other: &Self) -> bool {
        (self.color, self.cap_color) == (other.color, other.cap_color)
            && self.hatch == other.hatch
            && self.is_painted_over == other.is_painted_over
            && is_same(self.cap.as_ref(), other.cap.as_ref())
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            color: Vec3::new(0.56, 0.62, 0.70),
            cap_color: None,
            hatch: CapHatch::General,
            is_painted_over: false,
            cap: None,
        }
    }
}

impl Material {
    /// Colour of the cap, given or derived, as sRGB in 0..=1.
    pub fn cap_color(&self) -> Vec3 {
        self.cap_color
            .unwrap_or_else(|| self.color * 0.35 + Vec3::new(0.60, 0.32, 0.20) * 0.75)
    }

    /// The colour of the `index`-th part of a file without materials: steps of the golden angle around the hue circle, so
    /// that neighbouring parts differ, however many there are.
    pub fn of_index(index: usize) -> Self {
        if index == 0 {
            return Self::default();
        }
        let hue = (index as f32 * 0.381_966 + 0.58).fract() * std::f32::consts::TAU;
        let tone = |shift: f32| 0.60 + 0.22 * (hue + shift).cos();
        Self {
            color: Vec3::new(tone(0.0), tone(-2.094), tone(2.094)),
            ..Self::default()
        }
    }
}
