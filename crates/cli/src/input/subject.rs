//! Input of a command: the document that results from its arguments, and its scene.

use std::path::{Path, PathBuf};

use cutaway::generate::shapes::shape;
use cutaway::scene::{Bounds, LengthUnit, Prepared, Scene, SceneSpace, Up, View, doubts};
use cutaway::strategies::DrawOptions;
use cutaway::{Error, Result};
use cutaway_io::document::{Document, GuessedUp, Timeline, UpReason, part};
use cutaway_io::load::frames::Pattern;
use cutaway_io::load::{Assets, place_of};
use cutaway_lab::experiment::{SceneAtTime, draw_options};

use super::edits::EditArgs;
use super::look::Defaults;
use super::sections::SectionArgs;
use super::stdin::{self, StdinArgs};
use crate::console::Console;
use crate::renderer_request::RendererRequest;
use crate::writing::output::write_file;
use crate::writing::places::InputFiles;

/// Default supersampling factor of pictures.
const USUAL_SUPERSAMPLE: u32 = 2;

/// A document and its scene.
pub(crate) struct SceneInput {
    /// The scene at the requested time.
    pub(crate) scene: Scene,
    /// The scene over time.
    pub(crate) timeline: Timeline,
    /// All files read.
    pub(crate) files: InputFiles,
    document: Document,
    assets: Assets,
    /// Path for the saved document.
    saved: Option<PathBuf>,
}

impl SceneInput {
    /// Opens a document amended by options, at a given time or at the document's own time. `defaults` apply to settings that the
    /// document omits.
    pub(crate) fn open(
        mut document: Document,
        at_s: Option<f64>,
        usual: Defaults,
        edits: &EditArgs,
        console: &Console,
    ) -> Result<Self> {
        edits.amend(&mut document)?;
        let mut assets = stdin::assets();
        let is_file = !document.path().as_os_str().is_empty();
        let likely_up = match (usual.guesses_up, is_file) {
            (true, false) => document.guess_up(&mut assets)?,
            (true, true) => document.likely_up(&mut assets)?,
            (false, _) => None,
        };
        let saved = edits.place(&document)?;
        let timeline = document.timeline(&mut assets)?;
        let timeline = usual.of(timeline)?;
        let notes = timeline.notes().iter().cloned();
        let notes = notes.map(|note| match is_file {
            true => note.in_file(document.path()),
            false => note,
        });
        console.notes(&notes.collect::<Vec<_>>());
        if let Some(said) = likely_up.and_then(|likely| said_of(&likely, !is_file)) {
            console.note(said);
        }
        let scene = match at_s {
            Some(time_s) => timeline.at(time_s)?,
            None => timeline.scene()?,
        };
        let files = InputFiles::default();
        files.add(timeline.files().map(Path::to_owned));
        let subject = Self {
            scene,
            timeline,
            files,
            document,
            assets,
            saved,
        };
        if subject.timeline.settings().time_s.is_some() && !subject.timeline.moves() {
            console.note("nothing moves in this scene: it is the same at all times");
        }
        Ok(subject)
    }

    /// The scene as drawn in pictures. Hatches are laid out at time 0, so that a picture equals the animation's frame at the same time,
    /// however the frames are divided into shares.
    pub(crate) fn shown(&self) -> Result<SceneAtTime> {
        match self.timeline.moves() && self.scene.style.hatch.is_drawn() {
            true => Ok(SceneAtTime::new(&self.timeline.at(0.0)?).updated(&self.scene)),
            false => Ok(SceneAtTime::new(&self.scene)),
        }
    }

    /// Rejects cuts of the command line that remove nothing.
    pub(crate) fn must_be_cut_by(&self, sections: &SectionArgs) -> Result<()> {
        sections.must_be_of_use(&self.document, &self.scene)
    }

    /// Notes probable mistakes, and rejects a camera whose rays would not be finite.
    pub(crate) fn doubt(&self, console: &Console) -> Result<()> {
        doubts(&self.scene).iter().for_each(|d| console.print(d));
        check_view(&self.scene, self.size_px())
    }

    /// Rejects outputs that would replace an input or one another; then saves the document, if requested. Each output is given by its
    /// option and its file.
    pub(crate) fn save_beside<'a>(
        &self,
        outputs: impl IntoIterator<Item = (&'a str, PathBuf)>,
        edits: &EditArgs,
    ) -> Result<()> {
        // Only the input scene may be replaced, if requested.
        let is_own = |path: &Path| place_of(path) == place_of(self.document.path());
        let is_checked = |path: &PathBuf| !(edits.is_forced() && is_own(path));
        let save = self.saved.clone().filter(is_checked);
        let save = save.map(|path| ("--save", path));
        self.files.keep_from(outputs.into_iter().chain(save))?;
        match &self.saved {
            Some(path) => write_file(path, self.document.moved_to(path)?.to_string().as_bytes()),
            None => Ok(()),
        }
    }

    /// Length unit of the model, if all its files state the same one.
    pub(crate) fn unit(&self) -> Option<LengthUnit> {
        self.assets.unit()
    }

    /// The document that results from all options.
    pub(crate) fn document(&self) -> &Document {
        &self.document
    }

    /// The document, and the assets read for it.
    pub(crate) fn into_document(self) -> (Document, Assets) {
        (self.document, self.assets)
    }

    /// Size of the picture.
    pub(crate) fn size_px(&self) -> [u32; 2] {
        self.timeline.settings().size_px()
    }

    /// Supersampling factor of pictures along each side.
    pub(crate) fn supersample(&self) -> u32 {
        let asked = self.timeline.settings().supersample;
        asked.unwrap_or(USUAL_SUPERSAMPLE)
    }

    /// The options by which frames are drawn.
    pub(crate) fn options(&self) -> Result<DrawOptions> {
        draw_options(self.timeline.settings())
    }

    /// Requested renderer, with the document's drawing options unless the renderer's name sets others.
    pub(crate) fn renderer_request(&self) -> Result<RendererRequest> {
        let name = self.timeline.settings().strategy.name.as_deref();
        RendererRequest::named(name, self.options()?)
    }

    /// The view of the scene.
    pub(crate) fn view(&self, prepared: &Prepared) -> View {
        prepared.view(self.size_px())
    }
}

/// Note on a probable up axis. `is_set` is true if the guess is applied to the document; a scene file keeps its own axis.
fn said_of(likely: &GuessedUp, is_set: bool) -> Option<String> {
    let why = match likely.reason {
        UpReason::Specification if is_set => return None,
        UpReason::Specification => "the specification of the format",
        UpReason::Habit => "the usual axis of the format",
        UpReason::Base => "it stands on a flat base that way",
    };
    let [own, other] = [likely.up, likely.up.other()].map(Up::name);
    if is_set {
        return Some(format!(
            "up is guessed: {own} ({why}); --up {other} changes it"
        ));
    }
    (likely.up != Up::default()).then(|| format!(
        "up is {other}: the scene file does not set it; its meshes look like {own} ({why}): set `up = \"{own}\"` under [camera], or --up {own}"
    ))
}

/// The document given by the positional arguments: one scene file, or models.
pub(crate) fn document(
    inputs: &[String],
    stdin: StdinArgs,
    played_fps: Option<f64>,
) -> Result<Document> {
    let inputs = stdin.classify(inputs)?;
    if let [one] = inputs.as_slice()
        && is_scene(one)
    {
        return Document::read(Path::new(one));
    }
    if let Some(scene) = inputs.iter().find(|i| is_scene(i)) {
        return Err(Error::input(
            scene.as_str(),
            "a scene file stands alone",
            "give it by itself, and name the meshes in it as [[part]] entries",
        ));
    }
    let mut document = Document::new();
    for input in &inputs {
        check_model(input)?;
        let mut draft = part(input);
        if let (true, Some(fps)) = (
            Pattern::is_in(input) && !Path::new(input).exists(),
            played_fps,
        ) {
            draft = draft.with("fps", fps);
        }
        document.add_part(draft)?;
    }
    Ok(document)
}

/// Rejects a missing file; often the prefix of a built-in shape was forgotten.
pub(crate) fn check_model(input: &str) -> Result<()> {
    let path = Path::new(input);
    if input.starts_with("shape:") || stdin::is_it(input) || Pattern::is_in(input) || path.exists()
    {
        return Ok(());
    }
    let help = match shape(input) {
        Ok(_) => format!("write shape:{input} for the built-in shape"),
        // For example after `--cutout 90`.
        Err(_) if input.parse::<f64>().is_ok() => format!(
            "check the path; if this is the value of an option that can stand alone, write it with `=`: --cutout={input}"
        ),
        Err(_) => "check the path; built-in shapes are written shape:NAME".to_owned(),
    };
    Err(Error::file(path, "there is no such file", help).missing())
}

/// Returns true if an input has the name of a scene file.
fn is_scene(input: &str) -> bool {
    let extension = Path::new(input).extension();
    !input.starts_with("shape:") && extension.is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// Rejects a camera whose rays would not be finite.
fn check_view(scene: &Scene, size_px: [u32; 2]) -> Result<()> {
    let bounds = scene.bounds();
    let space = SceneSpace::new(&bounds);
    let in_scene = Bounds::from_points([bounds.min, bounds.max].map(|p| space.point(p)));
    let view = (scene.camera).view(|p| space.point(p), space.scale, in_scene, size_px);
    match view.defect() {
        Some(what) => {
            let help = "move it nearer to the model, and let it look at a point other than its own position";
            Err(Error::input("camera", what, help))
        }
        None => Ok(()),
    }
}
