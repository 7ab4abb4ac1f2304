//! The positional inputs: meshes, built-in shapes, one scene file.

use std::collections::BTreeSet;
use std::path::Path;

use glam::Vec3;

use super::args::{CameraArgs, SceneArgs};
use super::console::Console;
use super::defects::DefectArgs;
use super::look::bytes_of;
use super::places::InputFiles;
use super::sections::warn_of_misses;
use super::set::SetArgs;
use super::when::TimeArgs;
use crate::scene::document::Document;
use crate::scene::frames::{Pattern, Sequence, USUAL_FPS};
use crate::scene::shapes::shape;
use crate::scene::{
    Bounds, Camera, Cut, Fill, HeightFilter, Material, OpenedMesh, Part, Prepared, Scene,
    SceneSpace, Timeline, Topology, View, load_mesh_file, load_scene,
};
use crate::strategies::FrameOptions;
use crate::{Error, Result};

/// What is used where neither the options nor the scene say a size.
const USUAL_SIZE_PX: [u32; 2] = [1024, 768];

/// A scene as the command line asks for it.
pub(super) struct Opened {
    /// What is drawn: the scene at the time that was asked for, or as it stands.
    pub(super) scene: Scene,
    /// The same over time, without what the options add.
    pub(super) timeline: Timeline,
    /// Name of the strategy that the scene file asks for.
    pub(super) strategy: Option<String>,
    /// Size of the picture.
    pub(super) size_px: [u32; 2],
    /// Colour behind everything that the scene file asks for, sRGB.
    pub(super) background: Option<Vec3>,
    /// Colour of caps that several solids share, where they are to be shown.
    pub(super) interference: Option<[u8; 3]>,
    /// Who interpolates heights, where the scene file says it.
    height_filter: Option<HeightFilter>,
    /// The rule that the options fill all parts by, if they say one.
    fill: Option<Fill>,
    /// What the options break, the same at all times.
    defects: DefectArgs,
    /// Cuts of the command line, the same at all times.
    cuts: Vec<Cut>,
    /// All files that were read.
    pub(super) files: InputFiles,
    /// The camera at all times, where the inputs bring none: turned to where the cuts are seen.
    usual_camera: Option<Camera>,
    camera: CameraArgs,
}

impl Opened {
    /// Options of frames with what the scene adds to them.
    pub(super) fn options(&self, options: FrameOptions) -> FrameOptions {
        FrameOptions {
            interference: self.interference,
            height_filter: options.height_filter.or(self.height_filter),
            ..options
        }
    }

    /// The view of the scene.
    pub(super) fn view(&self, prepared: &Prepared) -> View {
        self.zoomed(prepared.view(self.size_px))
    }

    /// The view of the scene by another camera.
    pub(super) fn view_of(&self, prepared: &Prepared, camera: &Camera) -> View {
        self.zoomed(prepared.view_of(camera, self.size_px))
    }

    fn zoomed(&self, mut view: View) -> View {
        view.half_height /= self.camera.zoom;
        view
    }

    /// The scene at a time in seconds, with everything that the options say.
    pub(super) fn at(&self, time_s: f64) -> Result<Scene> {
        let mut scene = self.timeline.at(time_s)?;
        self.defects.apply(&mut scene)?;
        fill_by(&mut scene, self.fill);
        scene.cuts.extend(self.cuts.iter().cloned());
        scene.camera = match self.usual_camera {
            Some(camera) => camera,
            None => self.camera.apply(scene.camera, &scene.bounds())?,
        };
        check_view(&scene, self.size_px)?;
        Ok(scene)
    }
}

/// Opens the inputs and applies what the options say about them.
pub(super) fn open(args: &SceneArgs, when: &TimeArgs, console: &Console) -> Result<Opened> {
    let opened = open_at(args, when, console)?;
    when.note_of_still(&opened.timeline, console);
    Ok(opened)
}

/// [`open`] without a word where nothing moves.
pub(super) fn open_at(args: &SceneArgs, when: &TimeArgs, console: &Console) -> Result<Opened> {
    let inputs = Inputs::open(&args.inputs, &args.set, when, console)?;
    let (mut scene, timeline) = inputs.at(when)?;
    args.defects.apply_and_say(&mut scene, console)?;
    let of_file = scene.cuts.len();
    fill_by(&mut scene, args.fill);
    note_what_nonzero_hears(&scene.parts, console);
    scene.camera.up = args.camera.up_axis(scene.camera.up);
    args.sections.apply(&mut scene)?;
    args.sections.add_cutters(&mut scene, |input| {
        let (parts, notes) = open_model(input, &inputs.files)?;
        console.notes(&notes);
        Ok(parts)
    })?;
    inputs.files.add(args.sections.images());
    let bounds = scene.bounds();
    let cuts = scene.cuts[of_file..].to_vec();
    let usual_camera = if inputs.has_camera {
        scene.camera = args.camera.apply(scene.camera, &bounds)?;
        None
    } else {
        scene.camera = args.camera.usual(&scene.cuts, &bounds)?;
        Some(scene.camera)
    };
    warn_of_misses(&scene, console);
    let size_px = args.resolution.or(inputs.resolution);
    let size_px = size_px.unwrap_or(USUAL_SIZE_PX);
    check_view(&scene, size_px)?;
    Ok(Opened {
        scene,
        timeline,
        strategy: inputs.strategy,
        size_px,
        background: inputs.background,
        interference: args.interference.or(inputs.interference),
        height_filter: inputs.height_filter,
        fill: args.fill,
        defects: args.defects.clone(),
        cuts,
        files: inputs.files,
        usual_camera,
        camera: args.camera.clone(),
    })
}

/// What the inputs hold, before the options have their say.
pub(super) struct Inputs {
    /// The scene at rest.
    rest: Scene,
    /// Whether they say where it is seen from.
    has_camera: bool,
    /// What is known of how it moves, beyond the clips of its parts.
    timeline: Option<Timeline>,
    strategy: Option<String>,
    resolution: Option<[u32; 2]>,
    background: Option<Vec3>,
    interference: Option<[u8; 3]>,
    height_filter: Option<HeightFilter>,
    /// All files that were read.
    pub(super) files: InputFiles,
}

impl Inputs {
    /// Opens them.
    pub(super) fn open(
        inputs: &[String],
        set: &SetArgs,
        when: &TimeArgs,
        console: &Console,
    ) -> Result<Self> {
        match inputs {
            [one] if is_scene(one) => Self::of_scene_file(one, set, console),
            inputs => {
                if let Some(scene) = inputs.iter().find(|i| is_scene(i)) {
                    return Err(Error::input(
                        scene.as_str(),
                        "a scene file stands alone",
                        "give it by itself, and name the meshes in it as [[part]] entries",
                    ));
                }
                set.need_no_file()?;
                Self::of_meshes(inputs, when.played_fps.unwrap_or(USUAL_FPS), console)
            }
        }
    }

    fn of_scene_file(input: &str, set: &SetArgs, console: &Console) -> Result<Self> {
        let files = InputFiles::default();
        let open_mesh = |path: &Path| open_mesh(path, &files);
        let mut document = Document::read(Path::new(input))?;
        set.apply(&mut document)?;
        let file = load_scene(&document, &open_mesh, &shape)?;
        let notes: Vec<String> = (file.notes.iter())
            .map(|n| format!("{input}: {n}"))
            .collect();
        console.notes(&notes);
        files.add(file.files);
        Ok(Self {
            rest: file.scene,
            has_camera: file.has_camera,
            timeline: Some(file.timeline),
            strategy: file.strategy,
            resolution: file.resolution,
            background: file.background,
            interference: file.interference.map(bytes_of),
            height_filter: file.height_filter,
            files,
        })
    }

    fn of_meshes(inputs: &[String], played_fps: f64, console: &Console) -> Result<Self> {
        let names: Vec<String> = inputs.iter().map(|i| short_name(i)).collect();
        let is_sequence = |input: &&String| Pattern::is_in(input) && !Path::new(input).exists();
        let (numbered, single): (Vec<&String>, Vec<&String>) = inputs.iter().partition(is_sequence);
        let files = InputFiles::default();
        let mut rest = Scene {
            name: names.join("+"),
            parts: open_parts(&single, &files, console)?,
            ..Scene::default()
        };
        let mut timeline = None;
        if !numbered.is_empty() {
            let mut played = Timeline::of_scene(rest);
            for pattern in numbered {
                let open_mesh = |path: &Path| open_mesh(path, &files);
                let sequence = Sequence::open_by(pattern, played_fps, &open_mesh)?;
                console.notes(sequence.notes());
                played.add_sequence(sequence)?;
            }
            rest = played.at(0.0)?;
            rest.stage = None;
            timeline = Some(played);
        }
        Ok(Self {
            rest,
            has_camera: false,
            timeline,
            strategy: None,
            resolution: None,
            background: None,
            interference: None,
            height_filter: None,
            files,
        })
    }

    /// What they show at the time that is meant, and over time. Without a time it is what they show at rest, framed by
    /// itself: nobody pays for times that nobody asks for.
    pub(super) fn at(&self, when: &TimeArgs) -> Result<(Scene, Timeline)> {
        let rest = self.rest.clone();
        let Some(time_s) = when.time_s() else {
            return Ok((rest.clone(), Timeline::still(rest)));
        };
        let mut timeline = self.timeline();
        when.clip.choose(&mut timeline)?;
        Ok((timeline.at(time_s)?, timeline))
    }

    /// All that is known of how they move.
    pub(super) fn timeline(&self) -> Timeline {
        let of_parts = || Timeline::of_scene(self.rest.clone());
        self.timeline.clone().unwrap_or_else(of_parts)
    }
}

/// Refuses a camera whose rays would be no numbers.
fn check_view(scene: &Scene, size_px: [u32; 2]) -> Result<()> {
    let bounds = scene.bounds();
    let space = SceneSpace::of(&bounds);
    let in_scene = Bounds::of([bounds.min, bounds.max].map(|p| space.point(p)));
    let view = (scene.camera).view(|p| space.point(p), space.scale, in_scene, size_px);
    match view.defect() {
        Some(what) => {
            let mend = "move it nearer to the model, and let it look at another point than its own";
            Err(Error::input("camera", what, mend))
        }
        None => Ok(()),
    }
}

/// Fills all parts by the rule that the options say.
fn fill_by(scene: &mut Scene, rule: Option<Fill>) {
    for part in &mut scene.parts {
        part.fill = rule.unwrap_or(part.fill);
    }
}

/// Under the nonzero rule, faces that do not agree which side is out are as bad as holes. All such parts are one note.
fn note_what_nonzero_hears(parts: &[Part], console: &Console) {
    let filled = parts.iter().filter(|p| p.fill == Fill::Nonzero);
    let edges = filled.map(|p| (p, Topology::of(&p.mesh).inconsistent_edges));
    let doubtful: Vec<(&Part, usize)> = edges.filter(|(_, edges)| *edges > 0).collect();
    let worst = doubtful.iter().max_by_key(|(_, edges)| *edges);
    let Some((part, edges)) = worst else {
        return;
    };
    let place = match doubtful.len() {
        1 => format!("{}: fill is nonzero, but at {edges} edges", part.name),
        count => format!(
            "{count} parts: fill is nonzero, but at edges (worst: {}, {edges})",
            part.name
        ),
    };
    console.note(format!(
        "{place} the faces do not agree which side is out: caps can be wrong there, and are marked\n  help: turn the faces, or \
         use even-odd, which hears of no side"
    ));
}

/// The parts of meshes and shapes, with names that tell them apart.
fn open_parts(inputs: &[&String], files: &InputFiles, console: &Console) -> Result<Vec<Part>> {
    let mut parts: Vec<Part> = Vec::new();
    let mut names = BTreeSet::new();
    let mut notes = Vec::new();
    for input in inputs {
        let (mut of_input, said) = open_model(input, files)?;
        notes.extend(said);
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
    console.notes(&notes);
    Ok(parts)
}

/// Whether an input is a scene file by its name.
fn is_scene(input: &str) -> bool {
    !input.starts_with("shape:")
        && Path::new(input)
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// The parts of a mesh or a shape, and notes about them; files that are read are added to `files`.
pub(super) fn open_model(input: &str, files: &InputFiles) -> OpenedMesh {
    if input.starts_with("shape:") {
        return Ok((shape(input)?, Vec::new()));
    }
    let path = Path::new(input);
    if !path.exists() && shape(input).is_ok() {
        let mend = format!("write shape:{input} for the built-in shape");
        return Err(Error::file(path, "there is no such file", mend));
    }
    open_mesh(path, files)
}

fn open_mesh(path: &Path, files: &InputFiles) -> OpenedMesh {
    let loaded = load_mesh_file(path)?;
    files.add(loaded.files);
    Ok((loaded.parts, loaded.notes))
}

fn short_name(input: &str) -> String {
    match input.strip_prefix("shape:") {
        Some(spec) => spec.split('?').next().unwrap_or(spec).to_owned(),
        None => Path::new(input)
            .file_stem()
            .map_or_else(|| input.to_owned(), |s| s.to_string_lossy().into_owned()),
    }
}
