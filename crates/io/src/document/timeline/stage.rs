//! Properties of a timeline as a whole: the box that contains the scene at all times, the geometry that the cuts keep at any time, and
//! whether its keys are valid at all times.
//!
//! Cost: at every sampled time, the scene is read, and the bounds of each part that has changed since the previous sample are computed.

use std::sync::Arc;

use cutaway::error::Result;
use cutaway::scene::memo::is_same;
use cutaway::scene::{Bounds, Cut, Outline, Part, Scene};

use super::Timeline;

/// Number of times spread over the duration, including both ends. In a full rotation, a part leaves the stage by at most 0.1%.
const SPREAD: u32 = 65;

/// Maximum number of additional key and frame times. If there are more, this many of them are picked, spread evenly.
const MOST_SINGLED_OUT: usize = 512;

/// Fractions of the interval between two key times at which the keys are tested.
const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

impl Timeline {
    /// Times at which the bounds of a scene are sampled. `clips_s` are the durations of the played clips. They matter because shorter clips
    /// restart, and times spread over the whole duration may hit the same phase of every repetition.
    fn sampled_times_s(&self, duration_s: f64, clips_s: Vec<f64>) -> Vec<f64> {
        let frames = self.sequences().flat_map(|s| s.times_s());
        let mut singled: Vec<f64> = frames.chain(self.key_times_s()).collect();
        singled.retain(|t| (0.0..=duration_s).contains(t));
        let mut times = spread_over(clips_s, duration_s);
        times.extend(few(singled));
        times
    }

    /// The box of all parts at many times. The rest pose of parts with a played clip is excluded. It is not shown, and often has spread
    /// arms, which would only make the picture wider.
    pub(super) fn find_stage(&self, duration_s: f64) -> Result<Bounds> {
        let mut last: Vec<(Part, Bounds)> = Vec::new();
        let mut stage = Bounds::EMPTY;
        let mut look_at = |parts: Vec<Part>| {
            let seen = parts.into_iter().enumerate().map(|(i, part)| {
                let bounds = match last.get(i) {
                    Some((before, bounds)) if stands_alike(before, &part) => *bounds,
                    _ => part.bounds_in_world(),
                };
                (part, bounds)
            });
            last = seen.collect();
            stage = last.iter().fold(stage, |all, (_, b)| all.union(*b));
        };
        for time_s in self.sampled_times_s(duration_s, self.played_s()?) {
            let mut parts = self.unposed_at(time_s)?;
            parts.iter_mut().for_each(|p| self.pose(p, time_s));
            look_at(parts);
        }
        Ok(stage)
    }

    /// Finds the outline of the geometry that the cuts keep at many times.
    pub(super) fn find_outline(&self, duration_s: f64) -> Result<Outline> {
        let (mut outline, mut last) = (Outline::default(), Scene::default());
        let stage = self.stage()?;
        for time_s in self.sampled_times_s(duration_s, self.played_s()?) {
            let (mut scene, _) = self.unposed_scene_at(time_s, stage)?;
            scene.parts.iter_mut().for_each(|p| self.pose(p, time_s));
            let is_cut_alike = cut_alike(&last.cuts, &scene.cuts);
            let stands = |at: usize, part: &Part| {
                let before = last.parts.get(at);
                is_cut_alike && before.is_some_and(|before| stands_alike(before, part))
            };
            let parts = scene.parts.iter().enumerate();
            let moved = parts.filter(|(at, part)| !stands(*at, part));
            outline.add_parts(&scene, moved.map(|(_, part)| part));
            last = scene;
        }
        Ok(outline)
    }

    /// Durations of the played clips.
    fn played_s(&self) -> Result<Vec<f64>> {
        let parts = self.unposed_at(0.0)?;
        let clips = parts.iter();
        let played = clips.filter_map(|p| Some(p.clips()[self.clip_of(p)?].duration_s));
        Ok(played.collect())
    }

    /// Reads the scene at and between all key times, so that invalid values are reported before drawing starts.
    pub(super) fn try_keys(&self) -> Result<()> {
        if self.keys().next().is_none() {
            return Ok(());
        }
        let mut times: Vec<f64> = self.key_times_s().filter(|t| *t >= 0.0).collect();
        times.push(0.0);
        let times = few(times);
        let between = times
            .windows(2)
            .flat_map(|w| BETWEEN.map(|share| w[0] + (w[1] - w[0]) * share));
        let all: Vec<f64> = times.iter().copied().chain(between).collect();
        // The parts are read first, because the stage depends on them.
        for time_s in &all {
            self.unposed_at(*time_s)?;
        }
        let stage = self.stage()?;
        for time_s in &all {
            self.unposed_scene_at(*time_s, stage)?;
        }
        Ok(())
    }

    fn key_times_s(&self) -> impl Iterator<Item = f64> {
        self.keys().flat_map(|k| k.times_s.iter().copied())
    }
}

/// Times spread over the whole duration, and over the first repetition of each shorter clip.
fn spread_over(mut clips_s: Vec<f64>, duration_s: f64) -> Vec<f64> {
    clips_s.push(duration_s);
    clips_s.sort_by(f64::total_cmp);
    clips_s.dedup();
    let spread =
        |whole: f64| (0..SPREAD).map(move |i| whole * f64::from(i) / f64::from(SPREAD - 1));
    clips_s.into_iter().flat_map(spread).collect()
}

/// Sorts times and removes duplicates. If there are too many, keeps only some of them, spread evenly.
fn few(mut times: Vec<f64>) -> Vec<f64> {
    times.sort_by(f64::total_cmp);
    times.dedup();
    if times.len() <= MOST_SINGLED_OUT {
        return times;
    }
    let last = times.len() - 1;
    let spread = (0..MOST_SINGLED_OUT).map(|i| times[i * last / (MOST_SINGLED_OUT - 1)]);
    spread.collect()
}

/// Returns true if two lists of cuts are defined by the same data, and therefore remove the same region.
fn cut_alike(all: &[Cut], others: &[Cut]) -> bool {
    let is_like = |(a, b): (&Cut, &Cut)| {
        let mut surfaces = a.surfaces.iter().zip(&b.surfaces);
        let same_volume = match (&a.volume, &b.volume) {
            (Some(a), Some(b)) => {
                Arc::ptr_eq(a.mesh(), b.mesh()) && a.world_from_cutter == b.world_from_cutter
            }
            (a, b) => a.is_none() && b.is_none(),
        };
        a.enabled == b.enabled
            && a.offsets == b.offsets
            && a.surfaces.len() == b.surfaces.len()
            && same_volume
            && surfaces.all(|(a, b)| {
                (a.origin, a.u, a.v, a.scale) == (b.origin, b.u, b.v, b.scale)
                    && is_same(a.relief.as_ref(), b.relief.as_ref())
            })
    };
    all.len() == others.len() && all.iter().zip(others).all(is_like)
}

/// Returns true if all data that places two parts is equal, so that they occupy the same space.
fn stands_alike(a: &Part, b: &Part) -> bool {
    is_same(a.motion.as_ref(), b.motion.as_ref())
        && Arc::ptr_eq(&a.mesh, &b.mesh)
        && a.world_from_part == b.world_from_part
        && a.pose == b.pose
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_clip_is_looked_at_all_the_way_round() {
        let halfway = |times: &[f64]| times.iter().any(|t| t.rem_euclid(1.0) == 0.5);
        // As a control, times that are only spread over the whole duration all fall on the beginning of a repetition.
        assert!(!halfway(&spread_over(Vec::new(), 64.0)));
        assert!(halfway(&spread_over(vec![1.0, 64.0, 1.0], 64.0)));
        assert_eq!(spread_over(vec![64.0], 64.0).len(), SPREAD as usize);
    }
}
