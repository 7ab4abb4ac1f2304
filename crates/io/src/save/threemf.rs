//! Writes 3MF, core specification 1.3 and materials extension 1.2. Each solid is an object. Faces and caps have base materials, corner
//! colours are in a colour group, and each image has a group of texture coordinates.
//!
//! A triangle has only one property. If it has both corner colours and an image, the image is written.

use std::collections::BTreeSet;
use std::fmt::Write;

use cutaway::scene::{LengthUnit, TexturedTriangle};

use super::images::{Images, bits, upwards};
use super::solid::{Solid, Unwritable, bytes_of};
use super::zip::archive;

const CONTENT_TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/><Default Extension="png" ContentType="image/png"/></Types>
"#;

/// Path of the model in the package.
const MODEL: &str = "3D/3dmodel.model";

/// Writes a relationships part of the package, which names targets of one kind.
fn relationships(targets: impl Iterator<Item = String>, kind: &str) -> String {
    let mut text = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">"#
        .to_owned();
    for (number, target) in targets.enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "<Relationship Target=\"/{target}\" Id=\"rel{number}\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/{kind}\"/>"
        );
    }
    text + "</Relationships>\n"
}

/// Resource number of the base materials.
const MATERIALS: usize = 1;

/// Resource number of the corner colours. Two numbers for each image follow, then those of the objects.
const COLORS: usize = 2;

/// All corner colours of faces without an image. Each colour is stored once.
struct Colors(Vec<[u8; 4]>);

impl Colors {
    fn of(solids: &[Solid<'_>]) -> Self {
        let vertex_paints = solids.iter().filter_map(|s| s.vertex_paint.as_ref());
        let faces = vertex_paints.flat_map(|c| &c.triangles);
        let mut all: Vec<[u8; 4]> = (faces.filter(|t| t.image.is_none()))
            .flat_map(|t| t.colors)
            .collect();
        all.sort_unstable();
        all.dedup();
        Self(all)
    }

    fn number(&self, color: [u8; 4]) -> usize {
        self.0.partition_point(|known| *known < color)
    }

    fn write(&self, text: &mut String) {
        if self.0.is_empty() {
            return;
        }
        let _ = writeln!(text, "<m:colorgroup id=\"{COLORS}\">");
        for [r, g, b, _] in &self.0 {
            let _ = writeln!(text, "<m:color color=\"#{r:02X}{g:02X}{b:02X}\"/>");
        }
        text.push_str("</m:colorgroup>\n");
    }
}

/// The images, and for each image all texture coordinates of corners, without duplicates.
struct Textures {
    images: Images,
    places: Vec<Vec<[u32; 2]>>,
}

impl Textures {
    fn of(solids: &[Solid<'_>]) -> Self {
        let images = Images::of(solids);
        let mut places = vec![BTreeSet::new(); images.count()];
        for (index, solid) in solids.iter().enumerate() {
            for face in solid
                .vertex_paint
                .iter()
                .flat_map(|vertex_paint| &vertex_paint.triangles)
            {
                if let Some(image) = images.number(index, face) {
                    places[image].extend(face.uv.map(bits));
                }
            }
        }
        let places = places.into_iter().map(|all| all.into_iter().collect());
        let places = places.collect();
        Self { images, places }
    }

    /// The resource numbers of an image and of its texture coordinates.
    fn resources(image: usize) -> [usize; 2] {
        [1, 2].map(|i| COLORS + 2 * image + i)
    }

    fn first_object(&self) -> usize {
        COLORS + 2 * self.images.count() + 1
    }

    /// The texture coordinates of a face of a solid, as the number of their group and one index for each corner.
    fn property(&self, solid: usize, face: &TexturedTriangle) -> Option<(usize, [usize; 3])> {
        let image = self.images.number(solid, face)?;
        let places = &self.places[image];
        let number = |at| places.partition_point(|known| *known < bits(at));
        Some((Self::resources(image)[1], face.uv.map(number)))
    }

    fn write(&self, text: &mut String) {
        for (image, places) in self.places.iter().enumerate() {
            let [texture, group] = Self::resources(image);
            let path = path_of(image);
            let _ = writeln!(
                text,
                "<m:texture2d id=\"{texture}\" path=\"/{path}\" contenttype=\"image/png\"/>\n\
                 <m:texture2dgroup id=\"{group}\" texid=\"{texture}\">"
            );
            for place in places {
                let [u, v] = upwards(place.map(f32::from_bits).into());
                let _ = writeln!(text, "<m:tex2coord u=\"{u}\" v=\"{v}\"/>");
            }
            text.push_str("</m:texture2dgroup>\n");
        }
    }

    /// Returns the image files of the package with their names.
    fn files(&self) -> Result<Vec<(String, Vec<u8>)>, Unwritable> {
        if self.images.count() == 0 {
            return Ok(Vec::new());
        }
        let of_model = relationships((0..self.images.count()).map(path_of), "3dtexture");
        let pngs = self.images.pngs()?.into_iter().enumerate();
        let mut files = vec![(
            "3D/_rels/3dmodel.model.rels".to_owned(),
            of_model.into_bytes(),
        )];
        files.extend(pngs.map(|(image, png)| (path_of(image), png)));
        Ok(files)
    }
}

/// Path of an image in the package.
fn path_of(image: usize) -> String {
    format!("3D/Textures/{image}.png")
}

pub(super) fn encoded(solids: &[Solid<'_>], unit: LengthUnit) -> Result<Vec<u8>, Unwritable> {
    let textures = Textures::of(solids);
    let model = model(solids, &textures, unit.in_3mf());
    let of_package = relationships(std::iter::once(MODEL.to_owned()), "3dmodel");
    let beside = textures.files()?;
    let mut files = vec![
        ("[Content_Types].xml", CONTENT_TYPES.as_bytes()),
        ("_rels/.rels", of_package.as_bytes()),
        (MODEL, model.as_bytes()),
    ];
    files.extend(
        beside
            .iter()
            .map(|(name, bytes)| (name.as_str(), &bytes[..])),
    );
    archive(&files).map_err(|e| Unwritable::Archive(e.to_string()))
}

fn model(solids: &[Solid<'_>], textures: &Textures, unit: &str) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{unit}\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" \
         xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n\
         <metadata name=\"Application\">cutaway</metadata>\n<resources>\n<basematerials id=\"{MATERIALS}\">\n"
    );
    // Writing to a string cannot fail.
    for solid in solids {
        let name = escaped(solid.name);
        for (name, color) in [
            (name.clone(), solid.color),
            (format!("{name} cap"), solid.cap_color),
        ] {
            let [r, g, b] = bytes_of(color);
            let _ = writeln!(
                text,
                "<base name=\"{name}\" displaycolor=\"#{r:02X}{g:02X}{b:02X}\"/>"
            );
        }
    }
    text.push_str("</basematerials>\n");
    let colors = Colors::of(solids);
    colors.write(&mut text);
    textures.write(&mut text);
    let object = |index: usize| textures.first_object() + index;
    for (index, solid) in solids.iter().enumerate() {
        let (id, name) = (object(index), escaped(solid.name));
        let [faces, caps] = [2 * index, 2 * index + 1];
        let _ = writeln!(
            text,
            "<object id=\"{id}\" name=\"{name}\" type=\"model\" pid=\"{MATERIALS}\" pindex=\"{faces}\">\n<mesh>\n<vertices>"
        );
        for p in &solid.mesh.positions {
            let _ = writeln!(text, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x, p.y, p.z);
        }
        text.push_str("</vertices>\n<triangles>\n");
        for (triangle, [a, b, c]) in solid.mesh.triangles.iter().enumerate() {
            let _ = write!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"");
            if triangle >= solid.faces {
                let _ = write!(text, " pid=\"{MATERIALS}\" p1=\"{caps}\"");
            } else if let Some(face) = solid.face(triangle) {
                let of_corners = || (COLORS, face.colors.map(|c| colors.number(c)));
                let (group, [p1, p2, p3]) =
                    textures.property(index, face).unwrap_or_else(of_corners);
                let _ = write!(text, " pid=\"{group}\" p1=\"{p1}\" p2=\"{p2}\" p3=\"{p3}\"");
            }
            text.push_str("/>\n");
        }
        text.push_str("</triangles>\n</mesh>\n</object>\n");
    }
    text.push_str("</resources>\n<build>\n");
    for index in 0..solids.len() {
        let _ = writeln!(text, "<item objectid=\"{}\"/>", object(index));
    }
    text.push_str("</build>\n</model>\n");
    text
}

/// Escapes text for an attribute value.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars().filter(|c| !c.is_control()) {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}
