//! Images of a glTF file as textures. Each is read on first use. An error in an image becomes a note, because it affects only colours.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error};
use cutaway::scene::{Texture, TextureKind};
use gltf::image::Source;
use serde_json::Map;

use super::uri;
use crate::load::Files;
use crate::load::images::texture::texture_of;

/// No further image is read once those read have more pixels than this in total. Small files can contain huge plain images.
const MOST_PIXELS: u64 = 1 << 27;

/// The images of a file.
pub(super) struct GltfImages<'a> {
    pub(super) path: &'a Path,
    pub(super) store: &'a dyn Files,
    pub(super) buffers: &'a [Vec<u8>],
    pub(super) read: BTreeMap<usize, Option<Arc<Texture>>>,
    /// Total pixels of all images read.
    pub(super) pixels: u64,
    /// Files that were read.
    pub(super) files: Vec<PathBuf>,
    /// Notes about faulty images.
    pub(super) notes: Vec<Diagnostic>,
}

impl GltfImages<'_> {
    /// The image of a texture, or `None` if the texture has no image or the image cannot be read.
    pub(super) fn of_texture(&mut self, texture: &gltf::Texture<'_>) -> Option<Arc<Texture>> {
        if let Some(image) = texture.source() {
            return self.get(&image);
        }
        let number = texture.index();
        let extensions = texture.extensions().into_iter().flat_map(Map::keys);
        let extensions = extensions.map(String::as_str).collect::<Vec<_>>();
        let why = match extensions.as_slice() {
            [] => "it has no image".to_owned(),
            some => format!(
                "its image requires {}, which is not read",
                some.join(" and ")
            ),
        };
        let note = Diagnostic::note("image-left-out", format!("{why}: shown without it"))
            .about(format!("texture {number}"));
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
        None
    }

    fn get(&mut self, image: &gltf::Image<'_>) -> Option<Arc<Texture>> {
        if let Some(known) = self.read.get(&image.index()) {
            return known.clone();
        }
        let read = match self.pixels > MOST_PIXELS {
            true => Err(format!(
                "the images before it have more than {MOST_PIXELS} pixels"
            )),
            false => self.texture(image),
        };
        let texture = match read {
            Ok(texture) => {
                let [width, height] = texture.size();
                self.pixels += u64::from(width) * u64::from(height);
                Some(Arc::new(texture))
            }
            Err(why) => {
                let note = Diagnostic::note("image-left-out", format!("{why}: shown without it"));
                self.notes
                    .push(note.about(format!("image {}", image.index())));
                None
            }
        };
        self.read.insert(image.index(), texture.clone());
        texture
    }

    fn texture(&mut self, image: &gltf::Image<'_>) -> Result<Texture, String> {
        match image.source() {
            Source::View { view, .. } => {
                let buffer = self.buffers.get(view.buffer().index());
                let bytes = buffer.and_then(|buffer| {
                    let end = view.offset().checked_add(view.length())?;
                    buffer.get(view.offset()..end)
                });
                texture_of(
                    bytes.ok_or("its bytes are not in the file")?,
                    None,
                    TextureKind::Color,
                )
            }
            Source::Uri { uri, .. } => {
                let bytes = uri::read(self.path, ("image", uri), self.store, &mut self.files);
                let bytes = bytes.map_err(Error::into_what)?;
                texture_of(&bytes, None, TextureKind::Color)
            }
        }
    }
}
