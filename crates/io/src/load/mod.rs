//! Loads files: meshes in OBJ, STL, PLY (all three also gzipped), glTF, GLB and 3MF, [`frames`] of meshes, and images as height maps.
//!
//! A reader of a format only converts bytes into a `Draft`, in which positions are shared as in the file. Its errors give file, line and
//! reason. All decisions about the mesh are made in `draft`: what is refused, welded or left out, and which groups of triangles form one
//! solid. Anything that the loader changed or could not use is reported in [`Loaded::notes`].
//!
//! Files are read from disk, or from a host through [`Files`]. On disk, only regular files are read, up to the limits in `files` and
//! `input_file`. A glTF file may only name files in its own folder and below.

mod assets;
mod companions;
mod content;
mod draft;
mod files;
pub mod frames;
mod gltf;
mod grouped;
mod images;
#[doc(hidden)]
pub mod input_file;
mod lines;
mod mtl;
mod obj;
mod painted;
mod pat;
mod place;
mod placed;
mod ply;
mod stl;
mod threemf;
mod welded;

use std::path::{Path, PathBuf};

use cutaway::error::{Diagnostic, Error, Result, did_you_mean};
use cutaway::scene::{Edges, LengthUnit, Part, Up, range};

#[doc(hidden)]
pub use content::mesh_format;
use draft::{Draft, DraftSolid, DraftWelding, Group};
#[doc(hidden)]
pub use files::MOST_BYTES;
use lines::without_mark;
use placed::{Placed, parts_of};

pub use assets::Assets;
pub use companions::companions;
pub use files::{Disk, Files, Memory};
pub use images::image::{read_offset_map, read_offset_map_from};
pub use images::texture::read_texture_from;
pub use pat::read_patterns;
pub use place::place_of;

/// Content of a mesh file.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The solids, with unique names.
    pub parts: Vec<Part>,
    /// Notes on geometry that was welded, left out, missing or left open.
    pub notes: Vec<Diagnostic>,
    /// The mesh file, and the files that were read because it names them, such as material libraries and buffers.
    pub files: Vec<PathBuf>,
    /// Length unit of the parts, if the format states one. In glTF it is the metre, in 3MF the unit given in the file.
    pub unit: Option<LengthUnit>,
}

impl From<Vec<Part>> for Loaded {
    fn from(parts: Vec<Part>) -> Self {
        Self {
            parts,
            ..Self::default()
        }
    }
}

/// Code of the note on open edges.
pub(crate) const OPEN_EDGES: &str = "open-edges";

/// Extensions of the readable mesh formats.
#[doc(hidden)]
pub const MESH_FORMATS: [&str; 6] = ["obj", "stl", "ply", "glb", "gltf", "3mf"];

/// Formats of CAD programs that hold surfaces instead of triangles.
const SURFACE_FORMATS: [&str; 4] = ["step", "stp", "iges", "igs"];

/// How to make triangles of surfaces.
const SURFACE_HELP: &str = "convert it to a mesh: `gmsh part.step -2 -o part.stl`, or FreeCADCmd, or in Python `import cascadio; \
    cascadio.step_to_glb(\"part.step\", \"part.glb\")` (pip install cascadio), which keeps names and colours of STEP files";

/// Formats that are also read if they are gzipped.
const GZIPPED: [&str; 3] = ["obj", "stl", "ply"];

/// Loads a mesh file from disk. Its extension determines the format.
///
/// ```no_run
/// let loaded = cutaway_io::load::load_mesh_file("bracket.stl".as_ref())?;
/// for note in &loaded.notes {
///     eprintln!("{note}");
/// }
/// # Ok::<(), cutaway::Error>(())
/// ```
pub fn load_mesh_file(path: &Path) -> Result<Loaded> {
    load_mesh_file_from(path, &Disk)
}

/// Loads a mesh file, and the files that it names, from a host's store.
///
/// # Errors
///
/// Fails like [`load_mesh_file`] if a file is missing or is not a mesh.
pub fn load_mesh_file_from(path: &Path, store: &dyn Files) -> Result<Loaded> {
    let (format, stem) = format_and_stem(path)?;
    let bytes = input_file::read_unpacked(path, store)?;
    if bytes.is_empty() {
        let help = "export or download it again";
        return Err(Error::file(path, "the file is empty", help));
    }
    let mut notes = Vec::new();
    let mut files = vec![path.to_owned()];
    let (placed, unit) = if format == "glb" || format == "gltf" {
        let placed = gltf::read(path, &bytes, store, (&mut notes, &mut files))?;
        (placed, Some(LengthUnit::M))
    } else if format == "3mf" {
        let (placed, unit) = threemf::read(path, &bytes, &mut notes)?;
        (placed, Some(unit))
    } else {
        let draft = match format.as_str() {
            "obj" => obj::read(path, &bytes, store, &mut notes, &mut files)?,
            "stl" => stl::read(path, &bytes, &mut notes)?,
            _ => ply::read(path, &bytes, &mut notes)?,
        };
        drop(bytes);
        let solids = draft.into_solids(path, &mut notes)?;
        (solids.into_iter().map(Placed::of).collect(), None)
    };
    let is_closed: Vec<bool> = placed.iter().map(|p| p.is_closed).collect();
    let parts = parts_of(placed, &stem);
    check_range(path, &parts)?;
    notes.extend(doubt(&parts, &is_closed));
    let notes = notes.into_iter().map(|note| note.in_file(path)).collect();
    Ok(Loaded {
        parts,
        notes,
        files,
        unit,
    })
}

/// Reports open edges, which make the inside a matter of definition. Gives their count and, if only one part is open, the position of one.
/// Edges are not looked at again where a part is known to be closed.
fn doubt(parts: &[Part], is_closed: &[bool]) -> Option<Diagnostic> {
    const DOUBT: &str = "winding numbers decide what is inside; strategies that count crossings mark pixels that may be wrong";
    let unknown = (parts.iter().zip(is_closed)).filter(|(_, is_closed)| !**is_closed);
    let edges = unknown.map(|(part, _)| (part, Edges::of(&part.mesh.triangles)));
    let open: Vec<(&Part, Edges)> = edges.filter(|(_, e)| e.open().next().is_some()).collect();
    let worst = (open.iter())
        .enumerate()
        .max_by_key(|(i, (_, edges))| (edges.count().open, std::cmp::Reverse(*i)));
    let (_, (part, edges)) = worst?;
    let (name, count) = (&part.name, edges.count().open);
    if open.len() > 1 {
        let (all, open) = (parts.len(), open.len());
        let text = format!(
            "{all} parts, {open} open (worst: {name}, {count} open edges); `cutaway inspect` lists them: {DOUBT}"
        );
        return Some(Diagnostic::note(OPEN_EDGES, text));
    }
    let [a, b] = edges
        .open()
        .next()?
        .map(|i| part.mesh.positions[i as usize]);
    let middle = part.world_from_part.transform_point3((a + b) * 0.5);
    let text = format!(
        "part {name} is open at {count} edges, one near ({:.4}, {:.4}, {:.4}): {DOUBT}",
        middle.x, middle.y, middle.z
    );
    Some(Diagnostic::note(OPEN_EDGES, text))
}

/// Refuses parts with coordinates beyond the computable range.
fn check_range(path: &Path, parts: &[Part]) -> Result<()> {
    let mut defects =
        (parts.iter()).filter_map(|p| Some((p, range::defect(&p.bounds_in_world())?)));
    match defects.next() {
        Some((part, what)) => {
            let what = format!("part {} {what}", part.name);
            Err(Error::file(path, what, draft::UNITS))
        }
        None => Ok(()),
    }
}

/// Conventional up axis of a mesh file. It is +Z in STL, which comes from CAD and printing, and +Y in PLY, which mostly comes from scans.
/// In 3MF it is +Z by definition, in glTF +Y, and in OBJ +Y by the convention of its usual readers.
pub(crate) fn up_by_habit(path: &Path) -> Option<Up> {
    match format_and_stem(path).ok()?.0.as_str() {
        "stl" | "3mf" => Some(Up::PlusZ),
        "ply" => Some(Up::PlusY),
        _ => None,
    }
}

/// Returns true if the format of a mesh file defines +Z as up.
pub(crate) fn has_z_up(path: &Path) -> bool {
    format_and_stem(path).is_ok_and(|(format, _)| format == "3mf")
}

/// Returns the format from the extension, in lower case and without `.gz`, and the file name without its extensions.
fn format_and_stem(path: &Path) -> Result<(String, String)> {
    let name = path
        .file_name()
        .map_or(String::new(), |n| n.to_string_lossy().into_owned());
    let lower = name.to_lowercase();
    let unpacked = lower.strip_suffix(".gz").unwrap_or(&lower);
    let format = match unpacked.rsplit_once('.') {
        Some((_, extension)) => extension,
        None => "",
    };
    let gzipped = unpacked.len() < lower.len();
    if !MESH_FORMATS.contains(&format) || (gzipped && !GZIPPED.contains(&format)) {
        let what = if gzipped && MESH_FORMATS.contains(&format) {
            "only .obj, .stl and .ply may be gzipped".to_owned()
        } else if format.is_empty() {
            "the name has no extension to identify the format".to_owned()
        } else {
            format!("`.{format}` is not a supported mesh format")
        };
        let help = match SURFACE_FORMATS.contains(&format) {
            true => SURFACE_HELP.to_owned(),
            false => did_you_mean(format, MESH_FORMATS),
        };
        return Err(Error::file(path, what, help));
    }
    let stem_length = unpacked.len() - format.len() - 1;
    let stem = name.get(..stem_length).unwrap_or(&name).to_owned();
    Ok((format.to_owned(), stem))
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::scene::{Mesh, Motion};

    #[test]
    fn extensions_name_the_format() {
        let of = |name: &str| format_and_stem(Path::new(name));
        assert_eq!(of("a/b.c.STL").unwrap(), ("stl".into(), "b.c".into()));
        assert_eq!(of("x.ply.gz").unwrap(), ("ply".into(), "x".into()));
        for surfaces in ["a.step", "a.STP", "a.igs"] {
            let text = of(surfaces).unwrap_err().to_string();
            assert!(text.contains("help: convert it to a mesh"), "{text}");
            assert!(!text.contains("did you mean"), "{text}");
        }
        for wrong in ["a.dae", "a", "a.glb.gz", "a.gz"] {
            let text = of(wrong).unwrap_err().to_string();
            assert!(text.contains("help:") && text.contains("ply"), "{text}");
        }
    }

    #[test]
    fn names_are_unique() {
        let solid = |name: Option<&str>| {
            Placed::of(DraftSolid {
                name: name.map(str::to_owned),
                color: None,
                materials: Vec::new(),
                is_transparent: false,
                is_closed: false,
                mesh: Mesh::default(),
                motion: Motion::default(),
            })
        };
        let names = |placed| -> Vec<String> {
            parts_of(placed, "file")
                .into_iter()
                .map(|p| p.name)
                .collect()
        };
        assert_eq!(names(vec![solid(Some("bolt"))]), ["file"]);
        let several = ["a", "a_2", "a", ""].map(|n| solid(Some(n)));
        assert_eq!(
            names(several.into_iter().chain([solid(None)]).collect()),
            ["a", "a_2", "a_3", "file", "file_2"]
        );
    }
}
