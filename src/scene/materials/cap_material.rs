//! Cap materials: the look of a cut's surface (Trapp and Döllner 2013, sections 4.1 and 4.2, Fig. 11).

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
    /// Images one behind the other, along the third axis of the part's own box, which they fill; at least one, all of one size.
    Stack(Vec<Arc<Texture>>),
}

impl SolidTexture {
    /// Textures that need no file, by their names.
    pub const NAMED: [(&'static str, Self); 3] = [
        ("wood", Self::Wood),
        ("marble", Self::Marble),
        ("granite", Self::Granite),
    ];
}

/// Material of caps. Images lie in the (u, v) of the clip-surface, its relief's repeats or `size`, and repeat without end; a solid texture
/// lies in the part.
#[derive(Clone, Debug, Default)]
pub struct CapMaterial {
    /// Colour, in the place of the colour of the cap where it is opaque.
    pub diffuse: Option<Arc<Texture>>,
    /// Directions in the frame (u, up in the picture; n): red to the right, green up, blue outward. They add to the relief's own.
    pub normal: Option<Arc<Texture>>,
    /// Share of the light, by its red channel.
    pub light: Option<Arc<Texture>>,
    /// Material throughout the solid.
    pub solid: Option<SolidTexture>,
    /// Length of a repeat of the images, or of the solid texture, in world units or percent of the diagonal of the scene. Without it
    /// images lie on the relief, texel by texel as they are, and other things take 10 %.
    pub size: Option<Amount>,
}

impl CapMaterial {
    /// Its textures: colours, normals, light, then the images of a stack, of those that are there.
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
