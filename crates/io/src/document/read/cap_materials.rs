//! `material.cap`: materials of caps.
//!
//! ```toml
//! material.cap = { diffuse = "rust.png", normal = "grain.png", light = "soft.png", size = "10%" }
//! material.cap = { solid = "marble", size = "20%" }
//! material.cap = { images = "slices/%03d.png" }
//! ```
//!
//! Images are read when the document is opened.

use std::path::Path;
use std::sync::Arc;

use cutaway::error::Result;
use cutaway::scene::{CapMaterial, SolidTexture, Texture, TextureKind};

use super::described;
use super::opening::{LoadContext, missing};
use super::reader::{Entry, Table};
use crate::document::Keys;
use crate::document::describe::CapMaterialDesc;
use crate::load::Assets;
use crate::load::frames::Pattern;

static KEYS: Keys = Keys::below("part.*.material.cap");

/// The keys of single images, and the kind of data in each.
const IMAGES: [(&str, TextureKind); 3] = [
    ("diffuse", TextureKind::Color),
    ("normal", TextureKind::Data),
    ("light", TextureKind::Data),
];

/// Checks everything that can be checked without opening a file.
pub(super) fn check(entry: &Entry<'_>, folder: &Path, assets: &Assets) -> Result<()> {
    let table = entry.table(KEYS.all())?;
    for (key, _) in IMAGES {
        if let Some(image) = table.get(key)
            && !assets.has_texture(&folder.join(image.text()?))
        {
            return Err(missing(&image, &folder.join(image.text()?)));
        }
    }
    plain(&table).map(|_| ())
}

/// Reads the keys that do not name files.
fn plain(table: &Table<'_>) -> Result<CapMaterial> {
    let desc: CapMaterialDesc = described::read(table)?;
    let solid = match (table.get("solid"), table.get("images")) {
        (Some(_), Some(images)) => {
            return Err(images.fault("the cap also has a `solid`", "keep one of the two"));
        }
        (Some(solid), None) => {
            let word = solid.text()?;
            let named = SolidTexture::NAMED.iter().find(|(name, _)| *name == word);
            named.map(|(_, solid)| solid.clone())
        }
        (None, _) => None,
    };
    Ok(CapMaterial {
        solid,
        size: desc.size,
        ..CapMaterial::default()
    })
}

/// The image files of a stack.
fn slices(entry: &Entry<'_>, folder: &Path, assets: &Assets) -> Result<Vec<std::path::PathBuf>> {
    let found = Pattern::parse(entry.text()?)
        .and_then(|pattern| pattern.inside(folder).files(None, assets.store()));
    match found.map_err(|e| entry.place(e))? {
        (files, None) => Ok(files),
        (_, Some(gap)) => Err(entry.fault(gap, "add the missing image, or renumber the others")),
    }
}

/// Opens the cap material of a part.
pub(super) fn open(entry: &Entry<'_>, opening: &mut LoadContext<'_>) -> Result<Arc<CapMaterial>> {
    let table = entry.table(KEYS.all())?;
    let mut material = plain(&table)?;
    let mut read = |entry: &Entry<'_>, path: &Path, kind| -> Result<Arc<Texture>> {
        if !opening.assets.has_texture(path) {
            return Err(missing(entry, path));
        }
        let texture = opening.assets.texture(path, kind);
        let texture = texture.map_err(|e| entry.place(e))?;
        opening.files.insert(path.to_owned());
        Ok(texture)
    };
    let folder = opening.folder;
    let mut images = [None, None, None];
    for ((key, kind), image) in IMAGES.iter().zip(&mut images) {
        if let Some(entry) = table.get(key) {
            *image = Some(read(&entry, &folder.join(entry.text()?), *kind)?);
        }
    }
    [material.diffuse, material.normal, material.light] = images;
    if let Some(entry) = table.get("images") {
        let files = slices(&entry, folder, opening.assets)?;
        let stack = files.iter().map(|path| {
            let assets = &mut *opening.assets;
            let texture = assets.texture(path, TextureKind::Color);
            texture.map_err(|e| entry.place(e))
        });
        let stack: Vec<Arc<Texture>> = stack.collect::<Result<_>>()?;
        if let Some(other) = stack.iter().position(|t| t.size() != stack[0].size()) {
            let [width, height] = stack[0].size();
            let what = format!(
                "{} is not {width} x {height} like the first image",
                files[other].display()
            );
            return Err(entry.fault(what, "give all images of a stack the same size"));
        }
        opening.files.extend(files);
        material.solid = Some(SolidTexture::Stack(stack));
    }
    Ok(Arc::new(material))
}
