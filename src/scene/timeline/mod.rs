//! A scene over time: clips of its files, frame sequences, and the keys of a scene file.
//!
//! [`Timeline::at`] gives the scene at a time. Clips and looping sequences begin anew after their end, each after its own;
//! keys stay at their last value. Whatever does not change keeps its `Arc` from time to time, so that those who draw the
//! scene can tell by address what they have prepared already.
//!
//! A scene that moves has one [`stage`](Scene::stage) for all its times, so that pictures do not jump and `z=50%` is the same
//! plane always. It is found when first asked for, from the bounds at many times: between two of them a part may leave it
//! by as little as it moves there off the straight line.

mod stage;

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use super::file::{OpenMesh, Script};
use super::frames::Sequence;
use super::motion::Outwards;
use super::{Bounds, Clip, Cut, Part, Scene, load_scene_file};
use crate::error::{Error, Result, did_you_mean};

/// A scene that can be asked for at any time.
#[derive(Clone, Debug)]
pub struct Timeline {
    source: Source,
    sequences: Vec<Sequence>,
    /// Cuts beside those of the source.
    cuts: Vec<Cut>,
    clips: Vec<Clip>,
    /// The longest of the first clips of parts.
    first_clip: Option<Clip>,
    /// The clip that is played; without one every part plays its own first.
    chosen: Option<String>,
    outwards: Arc<Outwards>,
    stage: OnceLock<Bounds>,
}

/// Where scenes come from, before clips are played.
#[derive(Clone, Debug)]
enum Source {
    Scene(Arc<Scene>),
    File(Arc<Script>),
}

impl Timeline {
    /// A scene in which nothing moves.
    pub fn still(scene: Scene) -> Self {
        Self::of_source(Source::Scene(Arc::new(scene)), &[])
    }

    /// A scene whose parts play the clips of their files. Its cuts are taken as they are: those that are relative to bounds
    /// are to be placed on [`Timeline::stage`] and added by [`Timeline::add_cuts`].
    pub fn of_scene(scene: Scene) -> Self {
        let scene = Arc::new(scene);
        Self::of_source(Source::Scene(Arc::clone(&scene)), &scene.parts)
    }

    /// The timeline of a scene file: [`load_scene_file`] gives it too, and what else the file says.
    pub fn of_file(
        path: &Path,
        open_mesh: &OpenMesh<'_>,
        open_shape: &dyn Fn(&str) -> Result<Vec<Part>>,
    ) -> Result<Self> {
        load_scene_file(path, open_mesh, open_shape).map(|file| file.timeline)
    }

    /// The timeline of a file that was read; its keys are tried.
    pub(super) fn of_script(script: Arc<Script>) -> Result<Self> {
        let parts = script.parts_at(0.0)?;
        let timeline = Self::of_source(Source::File(script), &parts);
        timeline.try_keys()?;
        Ok(timeline)
    }

    /// A timeline on which the clips of some parts are played.
    fn of_source(source: Source, played: &[Part]) -> Self {
        let firsts = played.iter().filter_map(|p| p.clips().first());
        let longest = firsts.max_by(|a, b| a.duration_s.total_cmp(&b.duration_s));
        Self {
            source,
            sequences: Vec::new(),
            cuts: Vec::new(),
            clips: clips_of(played),
            first_clip: longest.cloned(),
            chosen: None,
            outwards: Arc::default(),
            stage: OnceLock::new(),
        }
    }

    /// Adds frames; a name that the scene has already gets a number.
    pub fn add_sequence(&mut self, sequence: Sequence) -> Result<()> {
        let parts = self.unposed_at(0.0)?;
        let taken: BTreeSet<String> = parts.iter().map(|p| p.name.clone()).collect();
        let sequence = sequence.renamed(&taken).coloured(parts.len());
        self.sequences.push(sequence);
        self.stage = OnceLock::new();
        Ok(())
    }

    /// Adds cuts that the scene has at all times.
    pub fn add_cuts(&mut self, cuts: impl IntoIterator<Item = Cut>) {
        self.cuts.extend(cuts);
    }

    /// Whether anything moves.
    pub fn moves(&self) -> bool {
        self.duration_s().is_some()
    }

    /// How long until it has shown all: the longest of the clips that are played, keys and sequences. `None` where nothing
    /// moves.
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
        let sequences = self.all_sequences().map(Sequence::duration_s);
        let longest = keys.chain(sequences).fold(longest, f64::max);
        (longest > 0.0).then_some(longest)
    }

    /// The clips of all parts, by name; of several with one name the longest.
    pub fn clips(&self) -> Vec<Clip> {
        self.clips.clone()
    }

    /// Plays a clip, by its name or else by its number in [`Timeline::clips`], from 0. Parts without it stand at rest. Cuts
    /// that were added stay where they are, though the stage may change.
    pub fn choose_clip(&mut self, name_or_number: &str) -> Result<()> {
        let by_name = self.clips.iter().find(|c| c.name == name_or_number);
        let by_number = || self.clips.get(name_or_number.parse::<usize>().ok()?);
        let Some(clip) = by_name.or_else(by_number) else {
            let culprit = format!("clip `{name_or_number}`");
            if self.clips.is_empty() {
                let mend = "use a glTF or GLB file with animations, or leave the clip out";
                return Err(Error::input(culprit, "no part has a clip", mend));
            }
            let mut mend = did_you_mean(name_or_number, self.clips.iter().map(|c| c.name.as_str()));
            mend.push_str(&format!("; or a number from 0 to {}", self.clips.len() - 1));
            return Err(Error::input(culprit, "there is no such clip", mend));
        };
        self.chosen = Some(clip.name.clone());
        self.stage = OnceLock::new();
        Ok(())
    }

    /// The scene at a time in seconds, not negative. Its parts stand in the poses of their clips; its stage is that of all
    /// times, or what it was where nothing moves.
    pub fn at(&self, time_s: f64) -> Result<Scene> {
        if !(time_s.is_finite() && time_s >= 0.0) {
            let mend = "times are seconds from the beginning, 0 or more";
            let what = "it is not a time of the scene";
            return Err(Error::input(format!("time {time_s}"), what, mend));
        }
        let stage = self.stage()?;
        let mut scene = match &self.source {
            Source::Scene(scene) => Scene::clone(scene),
            Source::File(script) => script.scene_at(time_s, stage)?,
        };
        self.add_frames(&mut scene.parts, time_s);
        for part in &mut scene.parts {
            self.pose(part, time_s);
        }
        scene.cuts.extend(self.cuts.iter().cloned());
        scene.stage = stage.or(scene.stage);
        Ok(scene)
    }

    /// The box that holds all parts at all times, in world space; `None` where nothing moves.
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

    /// The parts at a time, before clips move them.
    fn unposed_at(&self, time_s: f64) -> Result<Vec<Part>> {
        let mut parts = match &self.source {
            Source::Scene(scene) => scene.parts.clone(),
            Source::File(script) => script.parts_at(time_s)?,
        };
        self.add_frames(&mut parts, time_s);
        Ok(parts)
    }

    fn add_frames(&self, parts: &mut Vec<Part>, time_s: f64) {
        for sequence in &self.sequences {
            parts.extend(sequence.parts_at(time_s).iter().cloned());
        }
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

    /// Which of its clips a part plays.
    fn clip_of(&self, part: &Part) -> Option<usize> {
        if self.clips.is_empty() {
            return None;
        }
        match &self.chosen {
            Some(name) => part.clips().iter().position(|c| c.name == *name),
            None => (!part.clips().is_empty()).then_some(0),
        }
    }

    fn keys(&self) -> impl Iterator<Item = &super::Key> {
        let script = match &self.source {
            Source::File(script) => Some(script),
            Source::Scene(_) => None,
        };
        script.into_iter().flat_map(|s| s.keys())
    }

    fn all_sequences(&self) -> impl Iterator<Item = &Sequence> {
        let script = match &self.source {
            Source::File(script) => Some(script),
            Source::Scene(_) => None,
        };
        let of_file = script.into_iter().flat_map(|s| s.sequences());
        of_file.chain(&self.sequences)
    }
}

/// The clips of parts, by name, in the order in which they come; of several with one name the longest.
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

/// The time within a clip that begins anew after its end; its end itself is its end.
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
