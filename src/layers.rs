//! Layers: a frame's contents before shading, and the only thing by which strategies are judged.
//!
//! One entry per pixel, rows from the top, sampled at pixel centres. Every strategy and the exact reference end in this type, so
//! that correctness is compared on decisions (which part, which clip-surface, at which depth) and never on colours.

use glam::Vec3;

/// Kind of content of a pixel (design, section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
#[repr(u8)]
pub enum Kind {
    /// No solid along the ray.
    #[default]
    Background = 0,
    /// The ray enters a solid by crossing its mesh.
    Surface = 1,
    /// The ray enters a solid by leaving the removed region inside it.
    Cap = 2,
}

/// Clip-surface number of a cap made by the near plane when the camera stands inside a solid.
pub const NEAR_PLANE: u8 = 0xff;

/// One pixel of [`Layers`].
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Layer {
    /// Kind of content of the pixel.
    pub kind: Kind,
    /// Index of the part in the scene; 0 for background.
    pub part: u16,
    /// Index of the clip-surface that made the cap (numbered over the surfaces of all cuts in order), [`NEAR_PLANE`], or 0 when not a cap.
    pub clip_surface: u8,
    /// True if the visible side is the inner one: the triangle hit faces away from the camera.
    pub back_face: bool,
    /// The strategy marks this pixel as unreliable: an odd crossing count, a winding number near a half, or a buffer that overflowed.
    pub unreliable: bool,
    /// True for a cap where the part shown overlaps other solids that the same cut opens. Strategies report it on
    /// request; the exact reference always does.
    pub overlap: bool,
    /// Distance from the eye along the viewing direction, in scene units; infinite for background.
    pub depth: f64,
    /// Unit normal in scene space, facing the camera; zero for background.
    pub normal: Vec3,
}

/// A frame of [`Layer`]s.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// `width * height` pixels, rows from the top.
    pub pixels: Vec<Layer>,
}

impl Layers {
    /// A frame that is all background.
    pub fn background(size_px: [u32; 2]) -> Self {
        let pixel = Layer {
            depth: f64::INFINITY,
            ..Layer::default()
        };
        Self {
            size_px,
            pixels: vec![pixel; size_px[0] as usize * size_px[1] as usize],
        }
    }

    /// Number of pixels of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.pixels.iter().filter(|p| p.kind == kind).count()
    }

    /// Number of pixels that show a cap shared by several solids.
    pub fn overlap_px(&self) -> usize {
        self.pixels.iter().filter(|p| p.overlap).count()
    }

    /// A range of rows, as a separate frame.
    #[must_use]
    pub fn rows(&self, first: u32, count: u32) -> Self {
        let width = self.size_px[0] as usize;
        let (first, rows) = (first as usize * width, count as usize * width);
        Self {
            size_px: [self.size_px[0], count],
            pixels: self.pixels[first..first + rows].to_vec(),
        }
    }

    /// The pixel in column `x` and row `y`.
    pub fn at(&self, x: u32, y: u32) -> &Layer {
        &self.pixels[(y * self.size_px[0] + x) as usize]
    }
}
