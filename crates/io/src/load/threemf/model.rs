//! Reads a model part, that is its unit, its objects with their properties, and its build.
//!
//! An error in an object's mesh is only reported if the object is used, because only built objects have to be valid. Errors that affect the
//! set of objects, such as duplicate numbers or a required extension that defines shapes without triangles, are reported at once.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::PathBuf;

use cutaway::error::{Diagnostic, Result};
use cutaway::scene::LengthUnit;
use glam::DAffine3;

use super::mesh::{self, Geometry};
use super::package::Text;
use super::properties::Properties;
use super::slicer::{self, Use};
use super::xml::{Element, Space, Xml, shortened};

/// A model part.
#[derive(Debug)]
pub(super) struct ThreeMfModel {
    pub(super) path: PathBuf,
    pub(super) unit: LengthUnit,
    pub(super) objects: BTreeMap<u32, Object>,
    pub(super) properties: Properties,
    /// Items of the build, or `None` if the model has no `<build>`.
    pub(super) items: Option<Vec<ObjectReference>>,
    pub(super) notes: Vec<Diagnostic>,
}

/// An object.
#[derive(Debug)]
pub(super) struct Object {
    pub(super) name: Option<String>,
    pub(super) part_number: Option<String>,
    /// Type of the object. The type `model` means a solid.
    pub(super) kind: String,
    /// Group and index of the property that triangles without a property have.
    pub(super) default: Option<(u32, u32)>,
    /// What a slicer uses the object for, if it is not a solid.
    pub(super) used_as: Option<Use>,
    pub(super) shape: ObjectGeometry,
}

/// Geometry of an object.
#[derive(Debug)]
pub(super) enum ObjectGeometry {
    Mesh(Result<Geometry>),
    Components(Vec<ObjectReference>),
    /// Name of the element found instead of a mesh or components.
    Other(Option<String>),
}

/// A build item or a component, which places an object by a transform.
#[derive(Debug)]
pub(super) struct ObjectReference {
    pub(super) object: u32,
    /// The package part that contains the object, if it is not the part with the reference.
    pub(super) part: Option<String>,
    pub(super) part_number: Option<String>,
    pub(super) outer_from_object: DAffine3,
    /// Line of the reference in its model part.
    pub(super) line: usize,
}

impl ThreeMfModel {
    pub(super) fn read(text: &Text) -> Result<Self> {
        let mut xml = Xml::new(&text.path, &text.text);
        let root = xml.root("model")?;
        if !root.is(Space::Core, "model") {
            let what = "its <model> is not in the 3MF namespace";
            let help = "write xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" into it, or export it again";
            return Err(root.error_with_help(what.to_owned(), help));
        }
        check_extensions(&xml, &root)?;
        let mut model = Self {
            path: text.path.clone(),
            unit: LengthUnit::Mm,
            objects: BTreeMap::new(),
            properties: Properties::default(),
            items: None,
            notes: Vec::new(),
        };
        if let Some(word) = root.value("unit")? {
            let known = LengthUnit::ALL.iter().find(|u| u.in_3mf() == word.trim());
            model.unit = *known.ok_or_else(|| {
                let names = LengthUnit::ALL.map(LengthUnit::in_3mf).join(", ");
                let what = format!("the unit {:?} is not one of 3MF", shortened(&word));
                root.error_with_help(what, &format!("use one of: {names}"))
            })?;
        }
        let mut passed_over: Vec<String> = Vec::new();
        while let Some(element) = xml.child()? {
            if element.is(Space::Core, "resources") {
                model.resources(&mut xml, &mut passed_over)?;
            } else if element.is(Space::Core, "build") {
                if model.items.is_some() {
                    return Err(element.error("a second <build>"));
                }
                model.items = Some(references(&mut xml, "item")?);
            } else {
                if !element.is(Space::Core, "metadata") && !element.is_named("metadatagroup") {
                    passed_over.push(element.name());
                }
                xml.skip()?;
            }
        }
        xml.end()?;
        if let Some(first) = passed_over.first() {
            let others = passed_over.iter().filter(|name| *name != first).count();
            let more = match others {
                0 => String::new(),
                others => format!(" and {others} more"),
            };
            model.notes.push(Diagnostic::note(
                "3mf-unknown-element",
                format!("ignored <{first}>{more}: not part of a mesh"),
            ));
        }
        for id in &model.properties.repeated {
            let what = format!("properties {id} occur twice: the first are used");
            model
                .notes
                .push(Diagnostic::note("3mf-repeated-properties", what));
        }
        Ok(model)
    }

    fn resources(&mut self, xml: &mut Xml<'_>, passed_over: &mut Vec<String>) -> Result<()> {
        while let Some(element) = xml.child()? {
            if element.is(Space::Core, "object") {
                let (id, object) = object(xml, &element)?;
                match self.objects.entry(id) {
                    Entry::Vacant(free) => _ = free.insert(object),
                    Entry::Occupied(_) => {
                        return Err(element.error(format!("a second object has the number {id}")));
                    }
                }
            } else if !self.properties.read(xml, &element)? {
                if !matches!(element.space(), Space::Core | Space::Material) {
                    passed_over.push(element.name());
                }
                xml.skip()?;
            }
        }
        Ok(())
    }
}

/// Refuses required extensions that are not supported.
fn check_extensions(xml: &Xml<'_>, root: &Element<'_>) -> Result<()> {
    let required = root.value("requiredextensions")?.unwrap_or_default();
    for prefix in required.split_whitespace() {
        let prefix = shortened(prefix);
        let Some(name) = xml.namespace(&prefix) else {
            let what = format!("it requires the extension `{prefix}`, which it does not declare");
            return Err(root.error(what));
        };
        let shapes = match Space::of(name.as_bytes()) {
            Space::Core | Space::Material | Space::Production | Space::TriangleSets => continue,
            Space::Slice => "slices",
            Space::BeamLattice => "lattices of beams",
            Space::Other if name.contains("/beamlattice/") => "lattices of beams",
            Space::Other if name.contains("/booleanoperations/") => {
                "differences, unions and intersections of meshes"
            }
            Space::Other if name.contains("/volumetric/") || name.contains("/implicit/") => {
                "volumetric functions"
            }
            Space::Other if name.contains("/displacement/") => "meshes displaced by images",
            Space::Other if name.contains("/securecontent/") => "encrypted parts",
            Space::Other => "an extension that is not known",
        };
        let name = shortened(&name);
        let what = format!("it requires the extension `{prefix}` ({name}): {shapes}");
        let help = "export it as plain triangles: only the core, materials and production parts of 3MF are read";
        return Err(root.error_with_help(what, help));
    }
    Ok(())
}

fn object(xml: &mut Xml<'_>, element: &Element<'_>) -> Result<(u32, Object)> {
    let [id, name, part_number, kind, group, index] =
        element.values(["id", "name", "partnumber", "type", "pid", "pindex"])?;
    let id = element.id(&element.needed(id, "id")?)?;
    let said = |text: Option<std::borrow::Cow<'_, str>>| {
        text.map(|text| text.trim().to_owned())
            .filter(|text| !text.is_empty())
    };
    let number = |text: &str| text.trim().parse::<u32>().ok();
    let group = group.as_deref().and_then(number);
    let index = index.as_deref().and_then(number).unwrap_or_default();
    let mut object = Object {
        name: said(name),
        part_number: said(part_number),
        kind: said(kind).unwrap_or_else(|| "model".to_owned()),
        default: group.map(|group| (group, index)),
        used_as: None,
        shape: ObjectGeometry::Other(None),
    };
    while let Some(child) = xml.child()? {
        if slicer::is_settings(&child) {
            object.used_as = object.used_as.or(slicer::used_as(xml)?);
        } else if child.is(Space::Core, "mesh") {
            let depth = xml.depth();
            let read = match mesh::read(xml) {
                Err(e) if xml.is_broken() => return Err(e),
                read => read,
            };
            if read.is_err() {
                xml.leave(depth)?;
            }
            object.shape = ObjectGeometry::Mesh(read);
        } else if child.is(Space::Core, "components") {
            object.shape = ObjectGeometry::Components(references(xml, "component")?);
        } else {
            if let ObjectGeometry::Other(other) = &mut object.shape {
                other.get_or_insert_with(|| child.name());
            }
            xml.skip()?;
        }
    }
    Ok((id, object))
}

/// Reads the build items, or the components of an object, in the open element.
fn references(xml: &mut Xml<'_>, name: &str) -> Result<Vec<ObjectReference>> {
    let mut references = Vec::new();
    while let Some(element) = xml.child()? {
        if element.is(Space::Core, name) {
            let [id, transform, part_number] =
                element.values(["objectid", "transform", "partnumber"])?;
            let object = element.id(&element.needed(id, "objectid")?)?;
            let transform = transform.map_or(Ok(DAffine3::IDENTITY), |t| affine(&element, &t))?;
            references.push(ObjectReference {
                object,
                part: xml.value_of(&element, Space::Production, "path")?,
                part_number: part_number.map(Into::into),
                outer_from_object: transform,
                line: element.line(),
            });
        }
        xml.skip()?;
    }
    Ok(references)
}

/// Parses a transform of twelve numbers. The file has three axes and a translation, each as a row.
fn affine(element: &Element<'_>, text: &str) -> Result<DAffine3> {
    let mut numbers = [0.0; 12];
    let mut words = text.split_whitespace();
    for (k, number) in numbers.iter_mut().enumerate() {
        let word = words
            .next()
            .ok_or_else(|| element.error(format!("its transform has only {k} of 12 numbers")))?;
        let word = shortened(word);
        *number = word
            .parse()
            .map_err(|_| element.error(format!("`{word}` is not a number of a transform")))?;
    }
    if words.next().is_some() {
        return Err(element.error("its transform has more than 12 numbers"));
    }
    let affine = DAffine3::from_cols_array(&numbers);
    if !affine.is_finite() {
        return Err(element.error("its transform is not finite"));
    }
    if affine.matrix3.determinant().abs() <= 0.0 {
        return Err(element.error("its transform flattens the object"));
    }
    Ok(affine)
}
