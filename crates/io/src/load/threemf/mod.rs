//! Reads 3MF: the core specification, the production extension, and the colours of the materials extension.
//!
//! The package relationships name the root model. A mesh becomes one part for each of its placements in the build, which may be nested in
//! components and other models. Only built objects are used. A note reports objects that are left out: supports, surfaces, `other`, and
//! those that slicers mark as regions or volumes to subtract ([`slicer`]). Coordinates keep the file's unit, which is reported unless it is
//! the millimetre. Other models are scaled to the first model's unit.
//!
//! Some extensions define shapes without triangles: slices, beams, boolean operations, volumetric functions, displacement, encryption. If a
//! file requires such an extension, it is rejected with an error that names the extension. Otherwise the triangles are shown, with a note
//! if there are beams. An unreadable image becomes a note.
//!
//! Memory cost: one model part at a time, as text and as the data built from it. Each image is held once. All placements of an object share
//! one mesh.

mod mesh;
mod model;
mod package;
mod properties;
mod slicer;
mod solid;
mod xml;

use std::collections::BTreeMap;
use std::path::Path;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::LengthUnit;
use glam::{DAffine3, DVec3};

use super::Placed;
use super::grouped::grouped;

use model::{ObjectGeometry, ObjectReference, ThreeMfModel};
use package::Package;
use slicer::Uses;
use solid::{ShownSolid, label, solid};
use xml::shortened;

/// Maximum nesting depth of objects.
const MOST_DEPTH: usize = 64;

/// Maximum number of objects in a build. Nested components can multiply to more than any memory holds.
const MOST_OBJECTS: usize = 1 << 16;

const BUILD: &str =
    "export it with solid objects: supports, surfaces, points and lines are not cut";

/// Identifies an object of a package by its package part's name, which is empty for the first model, and its number.
type ObjectKey = (String, u32);

/// Reads the solids of a package, and the unit of their coordinates.
pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    notes: &mut Vec<Diagnostic>,
) -> Result<(Vec<Placed>, LengthUnit)> {
    let mut package = Package::open(path, bytes)?;
    let first = package.model()?;
    let root = model_of(&mut package, &first)?;
    let unit = root.unit;
    let uses = Uses::read(&mut package, notes);
    let mut reader = Reader {
        path,
        package,
        uses,
        first,
        models: BTreeMap::from([(String::new(), root)]),
        solids: BTreeMap::new(),
        objects: 0,
        placed: Vec::new(),
        of_objects: Vec::new(),
        notes: Vec::new(),
    };
    reader.build()?;
    if unit != LengthUnit::Mm {
        notes.push(Diagnostic::note(
            "unit-of-length",
            format!("its unit of length is the {}", unit.in_3mf()),
        ));
    }
    for model in reader.models.values_mut() {
        notes.append(&mut model.notes);
    }
    notes.extend(reader.notes);
    notes.extend(grouped(reader.of_objects, "object"));
    if reader.placed.is_empty() {
        return Err(Error::file(
            path,
            "its build contains no solid with triangles",
            BUILD,
        ));
    }
    Ok((reader.placed, unit))
}

struct Reader<'a> {
    path: &'a Path,
    package: Package<'a>,
    uses: Uses,
    /// Name of the package part with the first model.
    first: String,
    models: BTreeMap<String, ThreeMfModel>,
    /// Solids built so far, by object. The value is `None` for objects without triangles.
    solids: BTreeMap<ObjectKey, Option<ShownSolid>>,
    /// Number of objects visited, including repeated visits.
    objects: usize,
    placed: Vec<Placed>,
    /// Notes about objects.
    of_objects: Vec<Diagnostic>,
    notes: Vec<Diagnostic>,
}

/// The path by which an object was reached.
#[derive(Clone, Copy)]
struct ObjectPath<'a> {
    /// The enclosing objects, outermost first.
    around: &'a [ObjectKey],
    part_number: Option<&'a str>,
    world_from_outer: DAffine3,
}

impl Reader<'_> {
    fn build(&mut self) -> Result<()> {
        let root = self.models.get_mut("");
        let Some(items) = root.and_then(|root| root.items.take()) else {
            let what = "its model has no <build>";
            return Err(Error::file(self.path, what, xml::DAMAGED));
        };
        for item in &items {
            let way = ObjectPath {
                around: &[],
                part_number: item.part_number.as_deref(),
                world_from_outer: DAffine3::IDENTITY,
            };
            self.follow("", item, way)?;
        }
        Ok(())
    }

    /// Follows a reference in the model of package part `from`.
    fn follow(
        &mut self,
        from: &str,
        reference: &ObjectReference,
        way: ObjectPath<'_>,
    ) -> Result<()> {
        let part = match &reference.part {
            Some(part) if is_same(part, &self.first) => String::new(),
            Some(part) => part.trim_start_matches('/').to_lowercase(),
            None => from.to_owned(),
        };
        if let Some(named) = reference
            .part
            .as_ref()
            .filter(|_| !self.models.contains_key(&part))
        {
            let model = model_of(&mut self.package, named)?;
            self.note_unit(&part, &model);
            self.models.insert(part.clone(), model);
        }
        let unit_mm = |part: &str| self.models.get(part).map_or(1.0, |model| model.unit.mm());
        let scale = DAffine3::from_scale(DVec3::splat(unit_mm(&part) / unit_mm(from)));
        let world_from_object = way.world_from_outer * reference.outer_from_object * scale;
        let (id, line) = (reference.object, reference.line);
        let model = self.models.get(from);
        let file = model.map_or(self.path, |model| &model.path).to_owned();
        let wrong = |what: String| Error::file_line(&file, line, what, xml::DAMAGED);
        let key = (part, id);
        self.objects += 1;
        if self.objects > MOST_OBJECTS {
            return Err(wrong(format!(
                "its build has more than {MOST_OBJECTS} objects"
            )));
        }
        if let Some(at) = way.around.iter().position(|outer| *outer == key) {
            let ring = way.around[at..]
                .iter()
                .chain([&key])
                .map(|(_, id)| id.to_string());
            let ring = ring.collect::<Vec<_>>().join(" > ");
            return Err(wrong(format!(
                "object {id} is a component of itself: {ring}"
            )));
        }
        if way.around.len() >= MOST_DEPTH {
            return Err(wrong(format!(
                "objects are nested more than {MOST_DEPTH} deep"
            )));
        }
        if !world_from_object.is_finite() {
            return Err(wrong(format!(
                "the combined transform of object {id} is not finite"
            )));
        }
        let model = self.models.get_mut(&key.0);
        let Some(object) = model.and_then(|model| model.objects.get_mut(&id)) else {
            let what = format!("there is no object {id}");
            return Err(wrong(match &reference.part {
                Some(part) => format!("{what} in {}", shortened(part)),
                None => what,
            }));
        };
        let label = label(id, object);
        if let Some(of) = object.used_as {
            self.of_objects.push(of.note("its mesh").about(label));
            return Ok(());
        }
        match &mut object.shape {
            ObjectGeometry::Components(components) => {
                // The components are put back after the loop. A cycle back to this object is refused before they are needed.
                let components = std::mem::take(components);
                let around = [way.around, std::slice::from_ref(&key)].concat();
                let inner = ObjectPath {
                    around: &around,
                    part_number: way.part_number,
                    world_from_outer: world_from_object,
                };
                for component in &components {
                    let pair = (id, component.object);
                    let of = self
                        .uses
                        .of_components
                        .get(&pair)
                        .filter(|_| key.0.is_empty());
                    if let Some(of) = of {
                        let note = of.note(&format!("component {}", component.object));
                        self.of_objects.push(note.about(&label));
                        continue;
                    }
                    self.follow(&key.0, component, inner)?;
                }
                let model = self.models.get_mut(&key.0);
                if let Some(object) = model.and_then(|model| model.objects.get_mut(&id)) {
                    object.shape = ObjectGeometry::Components(components);
                }
                Ok(())
            }
            ObjectGeometry::Mesh(_) => self.place(key, way, world_from_object),
            ObjectGeometry::Other(other) => {
                let other = other.as_ref().map(|name| format!(", but <{name}>"));
                let what = format!(
                    "object {id} has neither a mesh nor components{}",
                    other.unwrap_or_default()
                );
                Err(wrong(what))
            }
        }
    }

    fn note_unit(&mut self, part: &str, model: &ThreeMfModel) {
        let unit = self.models.get("").map_or(model.unit, |root| root.unit);
        if unit != model.unit {
            let (own, of_root) = (model.unit.in_3mf(), unit.in_3mf());
            let note = format!(
                "its unit is the {own}, and lengths are converted to the {of_root} of the first model"
            );
            self.notes
                .push(Diagnostic::note("3mf-units-differ", note).about(part));
        }
    }

    /// Shows the mesh of an object at a placement.
    fn place(
        &mut self,
        key: ObjectKey,
        way: ObjectPath<'_>,
        world_from_part: DAffine3,
    ) -> Result<()> {
        let Some(model) = self.models.get_mut(&key.0) else {
            return Ok(());
        };
        let Some(object) = model.objects.get_mut(&key.1) else {
            return Ok(());
        };
        let label = label(key.1, object);
        let code = match object.kind.as_str() {
            "model" => None,
            "support" => Some("3mf-support"),
            "solidsupport" => Some("3mf-solidsupport"),
            "surface" => Some("3mf-surface"),
            "other" => Some("3mf-other"),
            unknown => {
                let what = format!("{label} is of the type {:?}", shortened(unknown));
                let help = "types are model, support, solidsupport, surface and other";
                return Err(Error::file(&model.path, what, help));
            }
        };
        if let Some(code) = code {
            let what = format!("left out: its type is `{}`, not a solid", object.kind);
            self.of_objects
                .push(Diagnostic::note(code, what).about(label));
            return Ok(());
        }
        let named = object.name.as_deref().or(object.part_number.as_deref());
        let name = match named.or(way.part_number) {
            Some(name) => name.to_owned(),
            None => format!("object_{}", key.1),
        };
        let solid = match self.solids.get(&key) {
            Some(known) => known.clone(),
            None => {
                let mut said = Vec::new();
                let of_triangles = (self.uses.of_triangles.get(&key.1))
                    .filter(|_| key.0.is_empty())
                    .map_or(&[][..], Vec::as_slice);
                let solid = solid(model, key.1, (&label, of_triangles), &mut said)?;
                let said = said.into_iter().map(|note| note.about(&label));
                self.of_objects.extend(said);
                self.solids.insert(key, solid.clone());
                solid
            }
        };
        self.placed.extend(solid.map(|solid| Placed {
            name: Some(name),
            color: solid.color,
            materials: solid.materials,
            is_transparent: solid.is_transparent,
            role: None,
            is_closed: solid.is_closed,
            mesh: solid.mesh,
            world_from_part,
            driver: None,
        }));
        Ok(())
    }
}

/// Reads a model of a package, with its images.
fn model_of(package: &mut Package<'_>, part: &str) -> Result<ThreeMfModel> {
    let mut model = ThreeMfModel::read(&package.read(part)?)?;
    let properties = &mut model.properties;
    let notes = properties.read_images(&mut |image| package.texture(image));
    model.notes.extend(notes);
    Ok(model)
}

/// Returns true if two names refer to the same part of a package.
fn is_same(a: &str, b: &str) -> bool {
    let [a, b] = [a, b].map(|name| name.trim_start_matches('/'));
    a.eq_ignore_ascii_case(b)
}
