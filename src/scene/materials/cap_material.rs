//! Cap materials: the appearance of cut surfaces (Trapp and Döllner 2013, sections 4.1 and 4.2, Fig. 11).

use std::sync::Arc;

use crate::scene::{Amount, Texture};

/// Solid texture: material throughout the volume of a solid, so that every cut shows it.
#[derive(Clone, Debug)]
pub enum SolidTexture {
    /// Rings around the longest axis of the part.
    Wood,
    /// Veins in pale stone.
    Marble,
    /// Grains of three colours.
    Granite,
    /// Stack of images along the third axis of the part's own box, filling the box: at least one image, all of the same size.
    Stack(Vec<Arc<Texture>>),
}

impl SolidTexture {
    /// Built-in solid textures by name.
    pub const NAMED: [(&'static str, Self); 3] = [
        ("wood", Self::Wood),
        ("marble", Self::Marble),
        ("granite", Self::Granite),
    ];
}

/// Material of caps. Images are mapped to the (u, v) of the clip-surface, scaled by its relief's repeats or `size`, and repeat endlessly;
/// a solid texture is mapped in part space.
#[derive(Clone, Debug, Default)]
pub struct CapMaterial {
    /// Colour; replaces the cap's colour where it is opaque.
    pub diffuse: Option<Arc<Texture>>,
    /// Normal map in the frame (u, image up, n): red to the right, green up, blue outward. It adds to the relief's own normals.
    pub normal: Option<Arc<Texture>>,
    /// Share of light received, in the red channel.
    pub light: Option<Arc<Texture>>,
    /// Material throughout the solid.
    pub solid: Option<SolidTexture>,
    /// Length of one repeat of the images or of the solid texture, in world units or percent of the scene's diagonal. Without it,
    /// images are mapped texel by texel onto the relief; anything else uses 10 %.
    pub size: Option<Amount>,
}

impl CapMaterial {
    /// Its textures, as far as present: colours, normals, light, then the images of a stack.
    pub fn textures(&self) -> impl Iterator<Item = &Arc<Texture>> {
        let stack: &[Arc<Texture>] = match &self.solid {
            Some(SolidTexture::Stack(images)) => images,
            _ => &[],
        };
        [&self.diffuse, &self.normal, &self.light]
            .into_iter()
            .flatten()
            .chain(stack)
    }
}
