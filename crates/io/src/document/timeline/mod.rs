//! A document over time. It moves by clips in its mesh files, by frame sequences, and by its animation keys.
//!
//! [`Timeline::at`] gives the scene at a time. Animated numbers are set in the tree, which is then read like the unanimated scene. No file
//! is opened or parsed again. Clips and looping sequences restart at their own end, while keys stay at their last value. Unchanged data
//! keeps its `Arc` from one time to the next, so that renderers can recognize the data that they have already prepared by its address.
//!
//! An animated scene has one [`stage`](Scene::stage) for all times, so that pictures do not jump and `z=50%` is always the same plane. The
//! stage is computed on first use, from the bounds at many sampled times. Between two samples a part may leave the stage, by the amount by
//! which its motion deviates from a straight line. The outline of the kept geometry, to which the camera may be fitted, and the camera's
//! automatic angles are computed likewise.
//!
//! Evaluating one time costs reading the tree, which is small, and recomputing the reliefs that changed.

mod cutaways;
mod stage;

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use cutaway::error::{Diagnostic, Error, Result, did_you_mean};
use cutaway::scene::{Bounds, Clip, Fit, Outline, Outwards, Part, Scene, Style, View, Viewpoint};

use super::read::reader::Table;
use super::read::{self, Key, Keyed, KeyedTime, PartSource, Resolved, SceneAssets, Seen};
use super::{Document, Node, Settings};
use crate::load::Assets;
use crate::load::frames::Sequence;

/// Times at which visible cuts are collected, as fractions of the duration.
const LOOKED_AT: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// A scene that can be evaluated at any time.
#[derive(Debug)]
pub struct Timeline {
    path: PathBuf,
    name: String,
    /// Root of the document.
    root: Node,
    keys: Vec<Keyed>,
    scene_assets: SceneAssets,
    settings: Settings,
    /// The unanimated scene, with numbers as written and the first frame of each sequence.
    rest: Scene,
    /// Notes about the document.
    notes: Vec<Diagnostic>,
    clips: Vec<Clip>,
    /// The longest clip among the first clips of all parts.
    first_clip: Option<Clip>,
    /// Name of the selected clip. Without a selected clip, every part plays its own first clip.
    chosen: Option<String>,
    /// Reliefs as computed for the last time.
    reliefs: Mutex<Resolved>,
    outwards: Outwards,
    stage: OnceLock<Bounds>,
    /// Outline of the geometry that the cuts keep at any time.
    outline: OnceLock<Arc<Outline>>,
    /// Viewpoint for all times, if the camera is automatic.
    viewpoint: OnceLock<Viewpoint>,
    /// The view at time 0, in world space, if a breakaway opens to that view.
    first_view: OnceLock<View>,
}

impl Timeline {
    /// Builds the timeline of a document, and tests its keys.
    pub(super) fn of(document: &Document, assets: &mut Assets) -> Result<Self> {
        let root = read::root(document.path(), document.root(), None)?;
        let mut scene_assets = read::open(&root, document.folder(), assets)?;
        let settings = read::settings(&root)?;
        let mut notes = scene_assets.notes.clone();
        let outwards = Outwards::default();
        let reliefs = assets.kept::<Resolved>();
        let mut reliefs = reliefs.as_deref().cloned().unwrap_or_default();
        let mut parts = read::parts(&root, &scene_assets, 0.0, &outwards)?;
        if read::finds_roles(&root)? {
            let names = parts.iter().map(|p| p.name.clone());
            scene_assets.sights = Some(names.zip(read::sights_of(&parts, assets)).collect());
            parts = read::parts(&root, &scene_assets, 0.0, &outwards)?;
        }
        notes.extend(read::role_notes(&root, &scene_assets, &parts)?);
        let (mut rest, seen) = read::scene(
            &root,
            &scene_assets,
            (parts, None),
            &mut reliefs,
            &mut notes,
        )?;
        assets.keep(reliefs.clone());
        if seen.is_free() {
            rest.camera.viewpoint = seen.turned(rest.cuts.iter());
        }
        rest.name = document.name();
        let firsts = rest.parts.iter().filter_map(|p| p.clips().first());
        let longest = firsts.max_by(|a, b| a.duration_s.total_cmp(&b.duration_s));
        let mut timeline = Self {
            path: document.path().to_owned(),
            name: rest.name.clone(),
            root: document.root().clone(),
            keys: read::keys(&root)?,
            clips: clips_of(&rest.parts),
            first_clip: longest.cloned(),
            chosen: None,
            scene_assets,
            rest,
            notes,
            reliefs: Mutex::new(reliefs),
            outwards,
            stage: OnceLock::new(),
            outline: OnceLock::new(),
            viewpoint: OnceLock::new(),
            first_view: OnceLock::new(),
            settings: Settings::default(),
        };
        if let (Some(clip), Some(entry)) = (&settings.clip, root.get("clip")) {
            let called = timeline.clip_called(clip).map_err(|e| entry.place(e));
            timeline.chosen = Some(called?);
        }
        timeline.settings = settings;
        let cutouts = read::cutouts(&root)?;
        if !cutouts.is_empty() {
            timeline.place_cutouts(cutouts)?;
        }
        timeline.try_keys()?;
        Ok(timeline)
    }

    /// Returns the timeline with this style as its base, if the document names no style.
    ///
    /// # Errors
    ///
    /// Fails if the document's changes are invalid for this style.
    pub fn with_usual_style(mut self, style: Style) -> Result<Self> {
        self.scene_assets.style.get_or_insert(style);
        self.rest.style = self.read_at(0.0, |root| {
            read::style(root, &self.scene_assets, &self.settings)
        })?;
        Ok(self)
    }

    /// Returns the timeline with this camera fit, if the document gives none.
    #[must_use]
    pub fn with_usual_fit(mut self, fit: Fit) -> Self {
        let camera = self.root.get("camera");
        if camera.and_then(|c| c.get("fit")).is_none() {
            self.scene_assets.fit = fit;
            self.rest.camera.fit = fit;
        }
        self
    }

    /// Returns the scene that is drawn if the user gives no time. It is the scene at the document's own time or, without one, the
    /// unanimated scene with numbers as written and first frames.
    pub fn scene(&self) -> Result<Scene> {
        match self.time_s() {
            Some(time_s) => self.at(time_s),
            None => self.opened(self.rest.clone()),
        }
    }

    /// The time that the document sets, or 0 if the document only selects a clip.
    pub fn time_s(&self) -> Option<f64> {
        let begins = self.chosen.is_some().then_some(0.0);
        self.settings.time_s.or(begins)
    }

    /// The unanimated scene. It has no stage, and its breakaways are not opened.
    pub fn rest(&self) -> &Scene {
        &self.rest
    }

    /// Returns the settings of the document that are not part of the scene itself.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Notes for the user, about repaired meshes and keys without effect.
    pub fn notes(&self) -> &[Diagnostic] {
        &self.notes
    }

    /// All files that were read, which are the document's own file and the files that it names.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let own = Some(self.path.as_path()).filter(|path| !path.as_os_str().is_empty());
        own.into_iter()
            .chain(self.scene_assets.files.iter().map(PathBuf::as_path))
    }

    /// Names of all parts that entry number `entry` of `part` has at any time. A file gives one part per solid.
    pub fn names_of(&self, entry: usize) -> impl Iterator<Item = &str> {
        let source = self.scene_assets.parts.get(entry).into_iter();
        source.flat_map(PartSource::names).map(String::as_str)
    }

    /// Returns true if the scene is animated.
    pub fn moves(&self) -> bool {
        self.duration_s().is_some()
    }

    /// Duration of the whole timeline, which is that of the longest played clip, key or sequence. Returns `None` if nothing moves.
    pub fn duration_s(&self) -> Option<f64> {
        let longest = match &self.chosen {
            Some(name) => self.clips.iter().find(|c| c.name == *name),
            None => self.first_clip.as_ref(),
        };
        let longest = longest.map_or(0.0, |c| c.duration_s);
        let keys = self
            .keys()
            .filter(|k| k.times_s.len() > 1)
            .filter_map(|k| k.times_s.last().copied());
        let sequences = self.sequences().map(Sequence::duration_s);
        let longest = keys.chain(sequences).fold(longest, f64::max);
        (longest > 0.0).then_some(longest)
    }

    /// The clips of all parts, by name. If several clips share a name, the longest is returned.
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// The animation keys of the document.
    pub fn keys(&self) -> impl Iterator<Item = &Key> {
        self.keys.iter().map(|k| &k.key)
    }

    /// Finds a clip by its name or, if none matches, by its index in [`Timeline::clips`].
    fn clip_called(&self, name_or_number: &str) -> Result<String> {
        let by_name = self.clips.iter().find(|c| c.name == name_or_number);
        let by_number = || self.clips.get(name_or_number.parse::<usize>().ok()?);
        if let Some(clip) = by_name.or_else(by_number) {
            return Ok(clip.name.clone());
        }
        let culprit = format!("clip `{name_or_number}`");
        if self.clips.is_empty() {
            let help = "use a glTF or GLB file with animations, or do not select a clip";
            return Err(Error::input(culprit, "no part has a clip", help));
        }
        let mut help = did_you_mean(name_or_number, self.clips.iter().map(|c| c.name.as_str()));
        help.push_str(&format!("; or a number from 0 to {}", self.clips.len() - 1));
        Err(Error::input(culprit, "there is no such clip", help))
    }

    /// The scene at a time in seconds, which must not be negative. Parts are posed by their clips. Parts without the selected clip keep
    /// their rest pose. The stage is the same for all times.
    pub fn at(&self, time_s: f64) -> Result<Scene> {
        self.opened(self.closed_at(time_s)?)
    }

    /// The scene at a time, before its breakaways are opened.
    fn closed_at(&self, time_s: f64) -> Result<Scene> {
        if !(time_s.is_finite() && time_s >= 0.0) {
            let help = "give seconds from the beginning, 0 or more";
            let what = "it is not a valid time";
            return Err(Error::input(format!("time {time_s}"), what, help));
        }
        let stage = self.stage()?;
        let (mut scene, seen) = self.unposed_scene_at(time_s, stage)?;
        if seen.is_free() {
            scene.camera.viewpoint = self.viewpoint(&seen)?;
        }
        for part in &mut scene.parts {
            self.pose(part, time_s);
        }
        scene.name.clone_from(&self.name);
        if scene.camera.fits_kept() {
            scene.outline = self.outline()?;
        }
        Ok(scene)
    }

    /// The box that contains all parts at all times, in world space. Returns `None` if nothing moves.
    pub fn stage(&self) -> Result<Option<Bounds>> {
        let Some(duration_s) = self.duration_s() else {
            return Ok(None);
        };
        if let Some(stage) = self.stage.get() {
            return Ok(Some(*stage));
        }
        let stage = self.find_stage(duration_s)?;
        Ok(Some(*self.stage.get_or_init(|| stage)))
    }

    /// Outline of the geometry that the cuts keep at any time. Returns `None` if nothing moves.
    fn outline(&self) -> Result<Option<Arc<Outline>>> {
        let Some(duration_s) = self.duration_s() else {
            return Ok(None);
        };
        if let Some(outline) = self.outline.get() {
            return Ok(Some(outline.clone()));
        }
        let outline = Arc::new(self.find_outline(duration_s)?);
        Ok(Some(self.outline.get_or_init(|| outline).clone()))
    }

    /// Viewpoint for all times.
    fn viewpoint(&self, seen: &Seen) -> Result<Viewpoint> {
        if let Some(viewpoint) = self.viewpoint.get() {
            return Ok(*viewpoint);
        }
        let Some(duration_s) = self.duration_s() else {
            return Ok(seen.turned(self.rest.cuts.iter()));
        };
        let stage = self.stage()?;
        let mut cuts = Vec::new();
        for share in LOOKED_AT {
            cuts.extend(self.unposed_scene_at(duration_s * share, stage)?.0.cuts);
        }
        Ok(*self.viewpoint.get_or_init(|| seen.turned(cuts.iter())))
    }

    /// The parts at a time, before clips pose them.
    fn unposed_at(&self, time_s: f64) -> Result<Vec<Part>> {
        self.read_at(time_s, |root| {
            read::parts(root, &self.scene_assets, time_s, &self.outwards)
        })
    }

    /// The scene at a time, before clips pose its parts. Amounts given in percent refer to the stage.
    fn unposed_scene_at(&self, time_s: f64, stage: Option<Bounds>) -> Result<(Scene, Seen)> {
        self.read_at(time_s, |root| {
            let notes = &mut Vec::new();
            let parts = read::parts(root, &self.scene_assets, time_s, &self.outwards)?;
            let mut reliefs = self.reliefs.lock().unwrap_or_else(PoisonError::into_inner);
            read::scene(
                root,
                &self.scene_assets,
                (parts, stage),
                &mut reliefs,
                notes,
            )
        })
    }

    fn read_at<T>(&self, time_s: f64, read: impl FnOnce(&Table<'_>) -> Result<T>) -> Result<T> {
        // The tree is cloned only if keys change it.
        let mut root = Cow::Borrowed(&self.root);
        for keyed in &self.keys {
            keyed.set(root.to_mut(), time_s);
        }
        let keys = self.keys.as_slice();
        let moment = (!keys.is_empty()).then_some(KeyedTime { time_s, keys });
        read(&read::root(&self.path, &root, moment)?)
    }

    /// Poses a part by its clip.
    fn pose(&self, part: &mut Part, time_s: f64) {
        if let Some(index) = self.clip_of(part) {
            let deformers = part.pose.deformers.clone();
            let played_s = looped(time_s, part.clips()[index].duration_s);
            *part = part.at_time(index, played_s);
            part.pose.deformers = deformers;
        }
        self.outwards.complete(part);
    }

    /// Index of the clip played by a part.
    fn clip_of(&self, part: &Part) -> Option<usize> {
        match &self.chosen {
            Some(name) => part.clips().iter().position(|c| c.name == *name),
            None => (!part.clips().is_empty()).then_some(0),
        }
    }

    fn sequences(&self) -> impl Iterator<Item = &Sequence> {
        self.scene_assets
            .parts
            .iter()
            .filter_map(PartSource::sequence)
    }
}

/// The clips of parts by name, in order of first occurrence. If several clips share a name, the longest is returned.
fn clips_of(parts: &[Part]) -> Vec<Clip> {
    let mut all: Vec<Clip> = Vec::new();
    for clip in parts.iter().flat_map(Part::clips) {
        match all.iter_mut().find(|c| c.name == clip.name) {
            Some(known) => known.duration_s = known.duration_s.max(clip.duration_s),
            None => all.push(clip.clone()),
        }
    }
    all
}

/// Time within a clip that restarts after its end. The end of a repetition maps to the clip's end, not to its start.
fn looped(time_s: f64, duration_s: f64) -> f64 {
    if time_s <= duration_s || duration_s <= 0.0 {
        time_s.min(duration_s)
    } else {
        time_s.rem_euclid(duration_s)
    }
}

#[cfg(test)]
mod tests {
    use super::looped;

    #[test]
    fn clips_begin_anew_after_their_end() {
        for (time_s, expected) in [(0.0, 0.0), (1.5, 1.5), (2.0, 2.0), (2.5, 0.5), (9.0, 1.0)] {
            assert_eq!(looped(time_s, 2.0), expected, "at {time_s} s");
        }
        assert_eq!(looped(3.0, 0.0), 0.0, "a clip that is a pose");
    }
}
