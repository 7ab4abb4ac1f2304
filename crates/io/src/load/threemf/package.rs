//! The package of a 3MF file, a ZIP archive whose relationships name the model part.
//!
//! Content types are ignored, because the relationship or path that leads to a part defines its type. Part names match regardless of the
//! case of ASCII letters, as in the Open Packaging Conventions.
//!
//! Sizes stated by the archive are not trusted. All parts together may unpack to the size that is allowed for a gzipped file of the
//! archive's length ([`input_file`]). Memory cost: the bytes of one part at a time, plus the images.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Error, Result};
use cutaway::scene::{MOST_TEXELS_ALONG, Texture, TextureKind};
use image::ImageFormat;
use percent_encoding::percent_decode_str;
use zip::ZipArchive;

use super::super::images::texture::texture_of;
use super::super::{input_file, without_mark};
use super::xml::{DAMAGED, Xml, shortened};

const MODEL: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

const RELATIONSHIPS: &str = "_rels/.rels";

/// Maximum number of texels in all images together. It is enough for four images of the largest size.
const MOST_TEXELS: u64 = 4 * (MOST_TEXELS_ALONG as u64).pow(2);

/// An archive from which parts are read.
pub(super) struct Package<'a> {
    path: &'a Path,
    archive: ZipArchive<Cursor<&'a [u8]>>,
    /// Maximum number of bytes in all parts together.
    most: u64,
    /// Number of bytes to which further parts may unpack.
    left: u64,
    /// Images read so far, by part name. If an image could not be read, its error is stored instead.
    textures: BTreeMap<String, Result<Arc<Texture>, String>>,
    /// Number of texels that further images may have.
    texels_left: u64,
}

/// A part as text.
pub(super) struct Text {
    /// Path of the file followed by the part name.
    pub(super) path: PathBuf,
    pub(super) text: String,
}

impl<'a> Package<'a> {
    pub(super) fn open(path: &'a Path, bytes: &'a [u8]) -> Result<Self> {
        let archive = ZipArchive::new(Cursor::new(bytes))
            .map_err(|e| Error::file(path, format!("ZIP: {e}"), DAMAGED))?;
        let most = input_file::most_unpacked(bytes.len() as u64);
        Ok(Self {
            path,
            archive,
            most,
            left: most,
            textures: BTreeMap::new(),
            texels_left: MOST_TEXELS,
        })
    }

    /// The name of the root model part.
    pub(super) fn model(&mut self) -> Result<String> {
        let relationships = self.read(RELATIONSHIPS)?;
        let mut xml = Xml::new(&relationships.path, &relationships.text);
        xml.root("Relationships")?;
        let mut models: Vec<String> = Vec::new();
        while let Some(element) = xml.child()? {
            let [kind, target] = element.values(["Type", "Target"])?;
            if element.is_named("Relationship") && kind.as_deref() == Some(MODEL) {
                let target = element.needed(target, "Target")?;
                if !models
                    .iter()
                    .any(|known| known.eq_ignore_ascii_case(&target))
                {
                    models.push(target.into_owned());
                }
            }
            xml.skip()?;
        }
        xml.end()?;
        let count = models.len();
        match (models.pop(), count) {
            (Some(model), 1) => Ok(model),
            (None, _) => {
                let what = "no relationship leads to a 3D model";
                Err(Error::file(&relationships.path, what, DAMAGED))
            }
            (_, count) => {
                let what =
                    format!("relationships lead to {count} 3D models, but only one is allowed");
                Err(Error::file(&relationships.path, what, DAMAGED))
            }
        }
    }

    /// Returns a part as text, if it exists.
    pub(super) fn read_if_there(&mut self, part: &str) -> Result<Option<Text>> {
        self.find(part).map(|_| self.read(part)).transpose()
    }

    /// Returns a part as text.
    pub(super) fn read(&mut self, part: &str) -> Result<Text> {
        let (path, bytes) = self.bytes(part)?;
        let text = text_of(&path, bytes)?;
        Ok(Text { path, text })
    }

    /// Returns the path of the file followed by the part name, and the part's bytes.
    pub(super) fn bytes(&mut self, part: &str) -> Result<(PathBuf, Vec<u8>)> {
        let Some(index) = self.find(part) else {
            let what = format!("the package has no part {:?}", shortened(part));
            return Err(Error::file(self.path, what, DAMAGED));
        };
        let name = self.archive.name_for_index(index).unwrap_or(part);
        let path = self.path.join(name.trim_start_matches('/'));
        let broken = |e: &dyn std::fmt::Display| Error::file(&path, format!("ZIP: {e}"), DAMAGED);
        let mut bytes = Vec::new();
        let entry = self.archive.by_index(index).map_err(|e| broken(&e))?;
        let read = entry.take(self.left + 1).read_to_end(&mut bytes);
        if bytes.len() as u64 > self.left {
            let what = format!("ZIP: its parts unpack to more than {} bytes", self.most);
            let help = "if intended, pack it again with less compression, or split the model";
            return Err(Error::file(&path, what, help));
        }
        read.map_err(|e| broken(&e))?;
        self.left -= bytes.len() as u64;
        Ok((path, bytes))
    }

    /// Returns a part as an image, or the reason why it cannot be read. Each image is read once.
    pub(super) fn texture(&mut self, part: &str) -> Result<Arc<Texture>, String> {
        let name = part.trim_start_matches('/').to_lowercase();
        if let Some(known) = self.textures.get(&name) {
            return known.clone();
        }
        let read = self.read_texture(part);
        self.textures.insert(name, read.clone());
        read
    }

    fn read_texture(&mut self, part: &str) -> Result<Arc<Texture>, String> {
        let (path, bytes) = self.bytes(part).map_err(Error::into_what)?;
        let by_name = ImageFormat::from_path(&path).ok();
        let texture = texture_of(&bytes, by_name, TextureKind::Color)?;
        let texels = texture.size().map(u64::from).iter().product();
        match self.texels_left.checked_sub(texels) {
            Some(left) => self.texels_left = left,
            None => {
                return Err(format!(
                    "the images of the package have more than {MOST_TEXELS} texels"
                ));
            }
        }
        Ok(Arc::new(texture))
    }

    fn find(&self, part: &str) -> Option<usize> {
        let wanted = part.trim_start_matches('/');
        let decoded = percent_decode_str(wanted).decode_utf8_lossy();
        let names = [wanted, &*decoded];
        let exactly = names
            .iter()
            .find_map(|name| self.archive.index_for_name(name));
        exactly.or_else(|| {
            let is_it = |name: &str| {
                let name = name.trim_start_matches('/').replace('\\', "/");
                names.iter().any(|wanted| name.eq_ignore_ascii_case(wanted))
            };
            let mut indices = 0..self.archive.len();
            indices.find(|index| self.archive.name_for_index(*index).is_some_and(is_it))
        })
    }
}

/// Decodes UTF-8, or UTF-16 with a byte order mark.
fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String> {
    let wrong = |what: &str| {
        Err(Error::file(
            path,
            what,
            "save it in UTF-8 or export it again",
        ))
    };
    if bytes.starts_with(&[0xff, 0xfe, 0, 0]) || bytes.starts_with(&[0, 0, 0xfe, 0xff]) {
        return wrong("it is encoded in UTF-32, but 3MF requires UTF-8 or UTF-16");
    }
    let from_units: Option<fn([u8; 2]) -> u16> = match bytes.first_chunk() {
        Some([0xff, 0xfe]) => Some(u16::from_le_bytes),
        Some([0xfe, 0xff]) => Some(u16::from_be_bytes),
        _ => None,
    };
    if let Some(of_unit) = from_units {
        let pairs = bytes[2..].chunks_exact(2);
        let units = pairs.filter_map(|pair| pair.first_chunk().copied().map(of_unit));
        let text: std::result::Result<String, _> = char::decode_utf16(units).collect();
        return text.or_else(|_| wrong("it begins as UTF-16 but is not valid UTF-16"));
    }
    let length = bytes.len();
    let marked = length - without_mark(&bytes).len();
    match String::from_utf8(bytes) {
        Ok(mut text) => {
            text.drain(..marked);
            Ok(text)
        }
        Err(e) => {
            let good = &e.as_bytes()[..e.utf8_error().valid_up_to()];
            let line = 1 + good.iter().filter(|byte| **byte == b'\n').count();
            let what = "it is not UTF-8";
            Err(Error::file_line(
                path,
                line,
                what,
                "save it in UTF-8 or export it again",
            ))
        }
    }
}
