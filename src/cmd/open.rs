//! The positional inputs: meshes, built-in shapes, one scene file.

use std::collections::BTreeSet;
use std::path::Path;

use glam::Vec3;

use super::args::{SceneArgs, bytes_of};
use super::console::Console;
use super::sections::warn_of_misses;
use crate::scene::shapes::shape;
use crate::scene::{
    Camera, Fill, Material, OpenedMesh, Part, Prepared, Scene, Topology, View, load_mesh_file,
    load_scene_file,
};
use crate::strategies::FrameOptions;
use crate::{Error, Result};

/// What is used where neither the options nor the scene say a size.
const USUAL_SIZE_PX: [u32; 2] = [1024, 768];

/// A scene as the command line asks for it.
pub(super) struct Opened {
    /// What is drawn.
    pub(super) scene: Scene,
    /// Name of the strategy that the scene file asks for.
    pub(super) strategy: Option<String>,
    /// Size of the picture.
    pub(super) size_px: [u32; 2],
    /// Colour behind everything that the scene file asks for, sRGB.
    pub(super) background: Option<Vec3>,
    /// Colour of caps that several solids share, where they are to be shown.
    pub(super) interference: Option<[u8; 3]>,
    zoom: f64,
}

impl Opened {
    /// Options of frames with what the scene adds to them.
    pub(super) fn options(&self, options: FrameOptions) -> FrameOptions {
        FrameOptions {
            interference: self.interference,
            ..options
        }
    }

    /// The view of the scene.
    pub(super) fn view(&self, prepared: &Prepared) -> View {
        let mut view = prepared.view(self.size_px);
        view.half_height /= self.zoom;
        view
    }
}

/// Opens the inputs and applies what the options say about them.
pub(super) fn open(args: &SceneArgs, console: &Console) -> Result<Opened> {
    let mut opened = match args.inputs.as_slice() {
        [one] if is_scene(one) => open_scene(one, console)?,
        inputs => {
            if let Some(scene) = inputs.iter().find(|i| is_scene(i)) {
                return Err(Error::input(
                    scene.as_str(),
                    "a scene file stands alone",
                    "name the meshes in the scene file, as [[part]] entries",
                ));
            }
            plain(open_parts(inputs, console)?, inputs)
        }
    };
    args.sections.apply(&mut opened.scene)?;
    let bounds = opened.scene.bounds();
    opened.scene.camera = if args.inputs.iter().any(|i| is_scene(i)) {
        args.camera.apply(opened.scene.camera, &bounds)?
    } else {
        args.camera.usual(&opened.scene.cuts, &bounds)?
    };
    opened.size_px = args.resolution.unwrap_or(opened.size_px);
    opened.zoom = args.camera.zoom;
    opened.interference = args.interference.or(opened.interference);
    for part in &mut opened.scene.parts {
        part.fill = args.fill.unwrap_or(part.fill);
        note_what_nonzero_hears(part, console);
    }
    warn_of_misses(&opened.scene, console);
    Ok(opened)
}

/// Under the nonzero rule, faces that do not agree which side is out are as bad as holes.
fn note_what_nonzero_hears(part: &Part, console: &Console) {
    if part.fill == Fill::EvenOdd {
        return;
    }
    let edges = Topology::of(&part.mesh).inconsistent_edges;
    if edges > 0 {
        console.note(format!(
            "{}: fill is nonzero, but at {edges} edges the faces do not agree which side is out: caps can be wrong there, \
             and are marked\n  mend: turn the faces, or use even-odd, which hears of no side",
            part.name
        ));
    }
}

/// The parts of meshes and shapes, with names that tell them apart.
pub(super) fn open_parts(inputs: &[String], console: &Console) -> Result<Vec<Part>> {
    let mut parts: Vec<Part> = Vec::new();
    let mut names = BTreeSet::new();
    for input in inputs {
        let (mut of_input, notes) = open_model(input)?;
        // Notes of loaders begin with the file they are about.
        notes.iter().for_each(|note| console.note(note));
        for part in &mut of_input {
            if part.material == Material::default() {
                part.material = Material::of_index(names.len());
            }
            let wanted = part.name.clone();
            let mut count = 1;
            while !names.insert(part.name.clone()) {
                count += 1;
                part.name = format!("{wanted}_{count}");
            }
        }
        parts.append(&mut of_input);
    }
    Ok(parts)
}

/// Whether an input is a scene file by its name.
pub(super) fn is_scene(input: &str) -> bool {
    !input.starts_with("shape:")
        && Path::new(input)
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// Opens a scene file.
pub(super) fn open_scene(input: &str, console: &Console) -> Result<Opened> {
    let file = load_scene_file(Path::new(input), &open_mesh, &shape)?;
    for note in &file.notes {
        console.note(format!("{input}: {note}"));
    }
    Ok(Opened {
        scene: file.scene,
        strategy: file.strategy,
        size_px: file.resolution.unwrap_or(USUAL_SIZE_PX),
        background: file.background,
        interference: file.interference.map(bytes_of),
        zoom: 1.0,
    })
}

fn open_model(input: &str) -> OpenedMesh {
    if input.starts_with("shape:") {
        return Ok((shape(input)?, Vec::new()));
    }
    let path = Path::new(input);
    if !path.exists() && shape(input).is_ok() {
        let mend = format!("write shape:{input} for the built-in shape");
        return Err(Error::file(path, "there is no such file", mend));
    }
    open_mesh(path)
}

fn open_mesh(path: &Path) -> OpenedMesh {
    let loaded = load_mesh_file(path)?;
    Ok((loaded.parts, loaded.notes))
}

fn plain(parts: Vec<Part>, inputs: &[String]) -> Opened {
    let names: Vec<String> = inputs.iter().map(|i| short_name(i)).collect();
    Opened {
        scene: Scene {
            name: names.join("+"),
            parts,
            cuts: Vec::new(),
            camera: Camera::default(),
            stage: None,
        },
        strategy: None,
        size_px: USUAL_SIZE_PX,
        background: None,
        interference: None,
        zoom: 1.0,
    }
}

fn short_name(input: &str) -> String {
    match input.strip_prefix("shape:") {
        Some(spec) => spec.split('?').next().unwrap_or(spec).to_owned(),
        None => Path::new(input)
            .file_stem()
            .map_or_else(|| input.to_owned(), |s| s.to_string_lossy().into_owned()),
    }
}
