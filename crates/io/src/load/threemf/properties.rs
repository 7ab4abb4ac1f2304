//! Reads colours from base materials, and from the property groups of the materials extension.
//!
//! Colours are sRGB, given per triangle or per corner. Nothing is blended. A composite is shown as its material with the greatest share. Of
//! several properties on a triangle, the first with a texture coordinate or, failing that, the first colour is shown. Images always repeat,
//! whatever their tile style. A triangle with an invalid property has no colour, with a note, because the shape is not affected.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use cutaway::error::{Diagnostic, Result};
use cutaway::scene::weld::thousands;
use cutaway::scene::{Texture, VertexPaint};
use glam::{Vec2, Vec3};

use super::mesh::{Assigned, Geometry, NONE};
use super::xml::{Element, Space, Xml, shortened};
use crate::load::painted::{Paint, PaintedTriangle, vertex_paint};

/// Red, green, blue and opacity.
type Rgba = [u8; 4];

/// A group of properties.
#[derive(Clone, Debug)]
enum PropertyGroup {
    /// Names and colours of materials.
    Materials(Vec<(Option<String>, Option<Rgba>)>),
    Colors(Vec<Option<Rgba>>),
    /// A group of materials, and for each composite the index of its main material in that group.
    Composites(u32, Vec<Option<u32>>),
    /// Several groups, and for each combined property its index in each group.
    Several(Vec<u32>, Vec<Vec<u32>>),
    /// Texture coordinates in the image with this number, where (0, 0) is the upper left corner.
    Places(u32, Vec<Vec2>),
}

/// An image of the package.
#[derive(Clone, Debug)]
struct TextureImage {
    /// Name of its package part.
    path: String,
    /// Decoded texture, if it could be read.
    texture: Option<Arc<Texture>>,
}

/// The properties of a model part, by their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Properties {
    groups: BTreeMap<u32, PropertyGroup>,
    images: BTreeMap<u32, TextureImage>,
    /// Property numbers that occur more than once.
    pub(super) repeated: Vec<u32>,
}

/// A property after its group and index have been looked up.
enum ResolvedProperty<'a> {
    Color(Rgba, Option<&'a str>),
    /// The number of an image, and a texture coordinate in that image.
    Place(u32, Vec2),
    Missing,
}

/// Appearance of an object, computed from its properties.
#[derive(Debug, Default)]
pub(super) struct ObjectAppearance {
    pub(super) vertex_paint: Option<VertexPaint>,
    /// The most common triangle colour.
    pub(super) color: Option<Vec3>,
    pub(super) materials: Vec<String>,
    pub(super) is_transparent: bool,
    pub(super) notes: Vec<Diagnostic>,
}

impl Properties {
    /// Reads and closes an open resource element. Returns true if it is a property element.
    pub(super) fn read(&mut self, xml: &mut Xml<'_>, element: &Element<'_>) -> Result<bool> {
        let [id, of, indices, groups] = element.values(["id", "matid", "matindices", "pids"])?;
        if element.is(Space::Material, "texture2d") {
            let path = element.value("path")?.map(|path| path.into_owned());
            if let (Some(Ok(id)), Some(path)) = (id.map(|id| element.id(&id)), path) {
                let texture = None;
                self.images
                    .entry(id)
                    .or_insert(TextureImage { path, texture });
            }
            xml.skip()?;
            return Ok(true);
        }
        let group = if element.is(Space::Core, "basematerials") {
            PropertyGroup::Materials(rows(xml, "base", |base| {
                let [name, color] = base.values(["name", "displaycolor"])?;
                Ok((name.map(Into::into), color.and_then(|c| rgba(&c))))
            })?)
        } else if element.is(Space::Material, "colorgroup") {
            PropertyGroup::Colors(rows(xml, "color", |color| {
                Ok(color.value("color")?.and_then(|c| rgba(&c)))
            })?)
        } else if element.is(Space::Material, "compositematerials") {
            let of_group = of.and_then(|of| of.trim().parse().ok()).unwrap_or(NONE);
            let indices: Vec<u32> = numbers(&indices.unwrap_or_default());
            let mains = rows(xml, "composite", |composite| {
                let shares: Vec<f64> = numbers(&composite.value("values")?.unwrap_or_default());
                let of_material = shares.iter().zip(&indices).rev();
                let greatest = of_material.max_by(|a, b| a.0.total_cmp(b.0));
                Ok(greatest.map(|(_, index)| *index))
            })?;
            PropertyGroup::Composites(of_group, mains)
        } else if element.is(Space::Material, "multiproperties") {
            let of_groups = numbers(&groups.unwrap_or_default());
            let indices = rows(xml, "multi", |multi| {
                Ok(numbers(&multi.value("pindices")?.unwrap_or_default()))
            })?;
            PropertyGroup::Several(of_groups, indices)
        } else if element.is(Space::Material, "texture2dgroup") {
            let of = element.value("texid")?;
            let of = of.and_then(|of| of.trim().parse().ok()).unwrap_or(NONE);
            let places = rows(xml, "tex2coord", |place| {
                let number = |key: &str| -> Result<f32> {
                    let text = place.value(key)?.unwrap_or_default();
                    let number = text.trim().parse().ok().filter(|n: &f32| n.is_finite());
                    Ok(number.unwrap_or_default())
                };
                // V points up in the file, but down in rows of texels.
                Ok(Vec2::new(number("u")?, 1.0 - number("v")?))
            })?;
            PropertyGroup::Places(of, places)
        } else {
            return Ok(false);
        };
        if let Some(Ok(id)) = id.map(|id| element.id(&id)) {
            match self.groups.entry(id) {
                Entry::Vacant(free) => _ = free.insert(group),
                Entry::Occupied(_) => self.repeated.push(id),
            }
        }
        Ok(true)
    }

    /// Reads the images that texture coordinates use. `read` returns a package part by its name. Returns notes about unreadable images.
    pub(super) fn read_images(
        &mut self,
        read: &mut dyn FnMut(&str) -> std::result::Result<Arc<Texture>, String>,
    ) -> Vec<Diagnostic> {
        let with_places = self.groups.values().filter_map(|group| match group {
            PropertyGroup::Places(image, _) => Some(*image),
            _ => None,
        });
        let with_places: BTreeSet<u32> = with_places.collect();
        let mut notes = Vec::new();
        for (_, image) in (self.images.iter_mut()).filter(|(id, _)| with_places.contains(id)) {
            match read(&image.path) {
                Ok(texture) => image.texture = Some(texture),
                Err(what) => {
                    let note = Diagnostic::note("image-left-out", what);
                    notes.push(note.about(shortened(&image.path)));
                }
            }
        }
        notes
    }

    /// The image of a triangle and the texture coordinates of its corners, if all corners use the same image.
    fn place(&self, found: &[ResolvedProperty<'_>; 3]) -> Option<(u32, [Vec2; 3])> {
        let ResolvedProperty::Place(image, _) = found[0] else {
            return None;
        };
        if !self.is_there(image) {
            return None;
        }
        let mut uv = [Vec2::ZERO; 3];
        for (uv, found) in uv.iter_mut().zip(found) {
            match found {
                ResolvedProperty::Place(of, at) if *of == image => *uv = *at,
                _ => return None,
            }
        }
        Some((image, uv))
    }

    fn is_there(&self, image: u32) -> bool {
        self.images.get(&image).is_some_and(|i| i.texture.is_some())
    }

    fn find(&self, group: u32, index: u32) -> ResolvedProperty<'_> {
        match self.groups.get(&group) {
            Some(PropertyGroup::Composites(of, mains)) => match mains.get(index as usize) {
                Some(Some(main)) => self.plain(*of, *main),
                _ => ResolvedProperty::Missing,
            },
            Some(PropertyGroup::Several(groups, indices)) => {
                let Some(indices) = indices.get(index as usize) else {
                    return ResolvedProperty::Missing;
                };
                let mut found_first = ResolvedProperty::Missing;
                for (at, group) in groups.iter().enumerate() {
                    // A missing index means the first entry.
                    let index = indices.get(at).copied().unwrap_or_default();
                    let found = match self.groups.get(group) {
                        Some(PropertyGroup::Composites(of, mains)) => {
                            let main = mains.get(index as usize).copied().flatten();
                            main.map_or(ResolvedProperty::Missing, |main| self.plain(*of, main))
                        }
                        _ => self.plain(*group, index),
                    };
                    found_first = match (&found_first, &found) {
                        (_, ResolvedProperty::Place(image, _)) if self.is_there(*image) => {
                            return found;
                        }
                        (ResolvedProperty::Missing, _)
                        | (ResolvedProperty::Place(..), ResolvedProperty::Color(..)) => found,
                        _ => found_first,
                    };
                }
                found_first
            }
            _ => self.plain(group, index),
        }
    }

    /// Resolves a property of a group that does not combine other groups.
    fn plain(&self, group: u32, index: u32) -> ResolvedProperty<'_> {
        match self.groups.get(&group) {
            Some(PropertyGroup::Materials(all)) => match all.get(index as usize) {
                Some((name, Some(color))) => ResolvedProperty::Color(*color, name.as_deref()),
                _ => ResolvedProperty::Missing,
            },
            Some(PropertyGroup::Colors(all)) => match all.get(index as usize) {
                Some(Some(color)) => ResolvedProperty::Color(*color, None),
                _ => ResolvedProperty::Missing,
            },
            Some(PropertyGroup::Places(image, all)) => match all.get(index as usize) {
                Some(at) => ResolvedProperty::Place(*image, *at),
                None => ResolvedProperty::Missing,
            },
            _ => ResolvedProperty::Missing,
        }
    }

    /// Computes the appearance of an object's triangles. Triangles without a property have the property `default`.
    pub(super) fn look(
        &self,
        geometry: &Geometry,
        default: Option<(u32, u32)>,
    ) -> ObjectAppearance {
        let mut look = ObjectAppearance::default();
        let mut count_of: BTreeMap<Rgba, usize> = BTreeMap::new();
        let mut painted = Vec::with_capacity(geometry.assigned.len());
        let [mut mixed, mut textured, mut missing, mut opaque] = [0_usize; 4];
        let mut names: BTreeMap<&str, ()> = BTreeMap::new();
        let mut paints = vec![Paint::default()];
        let mut paint_of: BTreeMap<u32, u32> = BTreeMap::new();
        for assigned in &geometry.assigned {
            let (group, corners) = resolved(*assigned, default);
            let mut triangle = PaintedTriangle::default();
            if group != NONE {
                let found = corners.map(|index| self.find(group, index));
                mixed += usize::from(self.is_mixed(group));
                if let Some((image, uv)) = self.place(&found) {
                    triangle.uv = Some(uv);
                    triangle.group = *paint_of.entry(image).or_insert_with(|| {
                        paints.push(Paint {
                            image: self.images[&image].texture.clone(),
                            ..Paint::default()
                        });
                        paints.len() as u32 - 1
                    });
                } else {
                    textured += usize::from(matches!(found[0], ResolvedProperty::Place(..)));
                }
                missing += usize::from(matches!(found[0], ResolvedProperty::Missing));
                if let ResolvedProperty::Color(first, name) = found[0] {
                    let colors = found.map(|found| match found {
                        ResolvedProperty::Color(color, _) => color,
                        _ => first,
                    });
                    if colors == [first; 3] {
                        *count_of.entry(first).or_default() += 1;
                    }
                    names.extend(name.map(|name| (name, ())));
                    opaque += usize::from(colors.iter().any(|[.., opacity]| *opacity == 255));
                    triangle.colors = Some(colors.map(vec3));
                }
            }
            opaque += usize::from(triangle.colors.is_none());
            painted.push(triangle);
        }
        look.vertex_paint = vertex_paint(&paints, true, painted.iter().copied());
        let by_count = count_of.iter().rev().max_by_key(|(_, count)| **count);
        look.color = by_count.map(|(color, _)| vec3(*color));
        look.is_transparent = opaque == 0 && !painted.is_empty();
        look.materials = names.into_keys().map(str::to_owned).collect();
        for (count, code, what) in [
            (
                mixed,
                "3mf-several-properties",
                "several materials or properties, of which one is shown",
            ),
            (
                textured,
                "3mf-texture-left-out",
                "a texture that is missing or cannot be read",
            ),
            (
                missing,
                "3mf-property-missing",
                "a property that is missing or has no colour",
            ),
        ] {
            if count > 0 {
                let text = format!("{} triangles have {what}", thousands(count));
                look.notes.push(Diagnostic::note(code, text));
            }
        }
        look
    }

    fn is_mixed(&self, group: u32) -> bool {
        let of = self.groups.get(&group);
        matches!(
            of,
            Some(PropertyGroup::Composites(..) | PropertyGroup::Several(..))
        )
    }
}

/// The property group of a triangle, and an index for each corner. The object's default replaces missing values.
fn resolved(assigned: Assigned, default: Option<(u32, u32)>) -> (u32, [u32; 3]) {
    let (group, index) = default.unwrap_or((NONE, NONE));
    match (assigned.group, assigned.corners) {
        (NONE, [NONE, ..]) => (group, [index; 3]),
        (NONE, corners) => (group, corners),
        (own, corners) => (own, corners),
    }
}

/// Reads the children with this name in the open element, and closes it.
fn rows<T>(
    xml: &mut Xml<'_>,
    name: &str,
    read: impl Fn(&Element<'_>) -> Result<T>,
) -> Result<Vec<T>> {
    let mut rows = Vec::new();
    while let Some(child) = xml.child()? {
        if child.is_named(name) {
            rows.push(read(&child)?);
        }
        xml.skip()?;
    }
    Ok(rows)
}

/// Parses numbers separated by blanks, up to the first word that is not a number.
fn numbers<T: std::str::FromStr>(text: &str) -> Vec<T> {
    let words = text.split_ascii_whitespace();
    words.map_while(|word| word.parse().ok()).collect()
}

fn vec3([r, g, b, _]: Rgba) -> Vec3 {
    Vec3::from([r, g, b].map(f32::from)) / 255.0
}

/// Parses `#RRGGBB`, or `#RRGGBBAA` with opacity.
fn rgba(text: &str) -> Option<Rgba> {
    let digits = text.trim().strip_prefix('#')?;
    let is_known = matches!(digits.len(), 6 | 8) && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let number = u32::from_str_radix(digits, 16).ok().filter(|_| is_known)?;
    let number = if digits.len() == 6 {
        (number << 8) | 0xff
    } else {
        number
    };
    Some(number.to_be_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_six_or_eight_digits() {
        assert_eq!(rgba("#FF8000"), Some([255, 128, 0, 255]));
        assert_eq!(rgba(" #ff800040 "), Some([255, 128, 0, 64]));
        for wrong in ["FF8000", "#FF800", "#FF80000", "#+F8000", "#GG0000", ""] {
            assert_eq!(rgba(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_triangle_without_properties_has_those_of_its_object() {
        let of = |group, corners| resolved(Assigned { group, corners }, Some((4, 2)));
        assert_eq!(of(NONE, [NONE; 3]), (4, [2; 3]));
        assert_eq!(of(NONE, [1, 0, 3]), (4, [1, 0, 3]));
        assert_eq!(of(7, [1, 0, 3]), (7, [1, 0, 3]));
    }
}
