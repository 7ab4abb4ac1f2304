//! Reads what slicers use meshes for, which they store outside the model. Some meshes are modifier regions with separate settings, and not
//! solids. Others are subtracted from the meshes that they overlap.
//!
//! PrusaSlicer and slicers derived from it write all volumes of an object into one mesh, and the triangle range of each volume into a
//! package file. Bambu Studio and OrcaSlicer write objects with components, and the use of each component. Cura writes settings into the
//! object, as metadata or, in older versions, as `settings`.
//!
//! Neither kind is shown, because a region is not a solid, and solids are not subtracted from each other. Each such mesh becomes a note.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use cutaway::error::{Diagnostic, Result};

use super::package::{Package, Text};
use super::xml::{Element, Xml};

/// Package parts in which slicers write mesh uses.
const PARTS: [&str; 2] = [
    "Metadata/Slic3r_PE_model.config",
    "Metadata/model_settings.config",
];

/// What a slicer uses a mesh for that is not a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Modifier,
    Negative,
    Support,
}

impl Use {
    fn of(word: &str) -> Option<Self> {
        let word = word.to_lowercase();
        let named = [
            ("modifier", Self::Modifier),
            ("negative", Self::Negative),
            ("support", Self::Support),
        ];
        let mut named = named.into_iter();
        named
            .find(|(name, _)| word.contains(name))
            .map(|(_, of)| of)
    }

    /// Maps the name of an enabled Cura setting to a use.
    fn of_setting(name: &str) -> Option<Self> {
        match name.rsplit(':').next().unwrap_or_default() {
            "infill_mesh" | "cutting_mesh" => Some(Self::Modifier),
            "support_mesh" | "anti_overhang_mesh" => Some(Self::Support),
            _ => None,
        }
    }

    /// Returns a note that `what` is left out because of its use.
    pub(super) fn note(self, what: &str) -> Diagnostic {
        let (code, text) = match self {
            Self::Modifier => (
                "slicer-modifier",
                "a modifier of the slicer: a region, not a solid",
            ),
            Self::Negative => (
                "slicer-negative",
                "a negative part of the slicer: it is not subtracted from the solids that it overlaps",
            ),
            Self::Support => (
                "slicer-support",
                "a region where the slicer enforces or blocks supports, not a solid",
            ),
        };
        Diagnostic::note(code, format!("left out {what}, {text}"))
    }
}

/// Uses of meshes of the first model, by object number.
#[derive(Debug, Default)]
pub(super) struct Uses {
    /// Uses of triangle ranges, by object.
    pub(super) of_triangles: BTreeMap<u32, Vec<(RangeInclusive<usize>, Use)>>,
    /// Uses of components, by the numbers of the object and the component.
    pub(super) of_components: BTreeMap<(u32, u32), Use>,
}

impl Uses {
    /// Reads the uses stored in a package. An unreadable file becomes a note.
    pub(super) fn read(package: &mut Package<'_>, notes: &mut Vec<Diagnostic>) -> Self {
        let mut uses = Self::default();
        for part in PARTS {
            let read = package.read_if_there(part);
            let read = read.and_then(|text| text.map_or(Ok(()), |text| uses.add(&text)));
            if let Err(e) = read {
                let why = e.into_what();
                notes.push(Diagnostic::note(
                    "slicer-file-unread",
                    format!(
                        "{part} cannot be read, so meshes that are not solids may be shown: {why}"
                    ),
                ));
            }
        }
        uses
    }

    fn add(&mut self, text: &Text) -> Result<()> {
        let mut xml = Xml::new(&text.path, &text.text);
        xml.root("config")?;
        while let Some(object) = xml.child()? {
            let id = object.value("id")?.and_then(|id| id.trim().parse().ok());
            match id.filter(|_| object.is_named("object")) {
                Some(id) => self.object(&mut xml, id)?,
                None => xml.skip()?,
            }
        }
        Ok(())
    }

    fn object(&mut self, xml: &mut Xml<'_>, id: u32) -> Result<()> {
        while let Some(child) = xml.child()? {
            if child.is_named("part") {
                let [component, kind] = child.values(["id", "subtype"])?;
                let component = component.and_then(|id| id.trim().parse().ok());
                let kind = kind.and_then(|kind| Use::of(&kind));
                if let Some((component, kind)) = component.zip(kind) {
                    self.of_components.insert((id, component), kind);
                }
                xml.skip()?;
            } else if child.is_named("volume") {
                let [first, last] = child.values(["firstid", "lastid"])?;
                let number = |text: Option<std::borrow::Cow<'_, str>>| text?.trim().parse().ok();
                let range = number(first).zip(number(last));
                let kind = volume(xml)?;
                if let Some(((first, last), kind)) = range.zip(kind) {
                    let of_object = self.of_triangles.entry(id).or_default();
                    of_object.push((first..=last, kind));
                }
            } else {
                xml.skip()?;
            }
        }
        Ok(())
    }
}

/// Returns true if an element of an object may hold Cura settings.
pub(super) fn is_settings(element: &Element<'_>) -> bool {
    element.is_named("metadatagroup") || element.is_named("settings")
}

/// Returns the use of an object, from its open settings element, and closes that element.
pub(super) fn used_as(xml: &mut Xml<'_>) -> Result<Option<Use>> {
    let mut found = None;
    while let Some(setting) = xml.child()? {
        // A setting that cannot be read is none of those that matter here, so it is skipped.
        let [name, key] = setting.values(["name", "key"]).unwrap_or_default();
        let of = name.or(key).and_then(|name| Use::of_setting(&name));
        let is_on = xml.text()?.eq_ignore_ascii_case("true");
        found = found.or(of.filter(|_| is_on));
    }
    Ok(found)
}

/// The use of a volume, from its `metadata`.
fn volume(xml: &mut Xml<'_>) -> Result<Option<Use>> {
    let mut found = None;
    while let Some(child) = xml.child()? {
        found = found.or(said(&child)?);
        xml.skip()?;
    }
    Ok(found)
}

fn said(metadata: &Element<'_>) -> Result<Option<Use>> {
    let [key, value] = metadata.values(["key", "value"])?;
    let value = value.unwrap_or_default();
    Ok(match key.as_deref() {
        Some("volume_type") => Use::of(&value),
        // Older versions use this form.
        Some("modifier") => (value.trim() == "1").then_some(Use::Modifier),
        _ => None,
    })
}
