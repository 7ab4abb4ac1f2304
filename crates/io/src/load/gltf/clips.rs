//! The clips of a glTF file: its animations, checked channel by channel.
//!
//! A clip with any fault is left out as a whole, because half a motion is worse than none and the mesh can be shown without it. A note
//! gives the clip's name and the reason. Channels that move nodes outside the scene are ignored because they affect nothing that is shown.
//! Weights of nodes without morph targets are also ignored.

use std::collections::BTreeMap;

use cutaway::error::Diagnostic;
use cutaway::scene::motion::{Clip, Moment, NodeTracks, Rig, Track, Way};
use glam::DVec3;
use gltf::accessor::DataType;
use gltf::animation::{Interpolation, Property};
use gltf::json::animation::{Animation, Channel, Sampler};
use gltf::json::validation::Checked;
use gltf::{Accessor, Document};

use super::accessor::{TARGET_WEIGHTS, TIMES, TRIPLES, items};
use super::nodes::Nodes;
use super::quantized::{rotations, share};

/// The sources from which the clips of an otherwise complete rig are read.
pub(super) struct ClipReader<'a> {
    pub(super) document: &'a Document,
    pub(super) nodes: &'a Nodes<'a>,
    pub(super) buffers: &'a [Vec<u8>],
}

impl ClipReader<'_> {
    /// Adds all usable clips to the rig.
    pub(super) fn read(
        &self,
        animations: &[Animation],
        rig: &mut Rig,
        notes: &mut Vec<Diagnostic>,
    ) {
        let accessors: Vec<Accessor<'_>> = self.document.accessors().collect();
        let mut flat = Vec::new();
        for (index, animation) in animations.iter().enumerate() {
            let name = self.name(index, animation, rig);
            let tracks = self.tracks(animation, &accessors);
            let added = tracks.and_then(|mut of_node| {
                self.give_weights_to_instances(&mut of_node);
                flat.extend(flattening(&of_node, &name, rig));
                add(rig, &name, of_node)
            });
            if let Err(why) = added {
                notes.push(Diagnostic::note(
                    "clip-left-out",
                    format!("left out clip `{name}`: {why}"),
                ));
            }
        }
        if let Some(first) = flat.first() {
            let more = match flat.len() - 1 {
                0 => String::new(),
                more => format!(" (and {more} more)"),
            };
            notes.push(Diagnostic::note(
                "joint-scaled-to-nothing",
                format!(
                    "{first}{more}: there, geometry that follows only this joint has no volume"
                ),
            ));
        }
    }

    /// Copies the weights of a node's morph targets to all instances of its mesh in the rig.
    fn give_weights_to_instances(&self, of_node: &mut BTreeMap<usize, NodeTracks>) {
        let tracks = of_node.iter();
        let weights: Vec<_> = tracks
            .filter_map(|(place, tracks)| Some((*place, tracks.weights.clone()?)))
            .collect();
        for (place, weights) in weights {
            for at in self.nodes.shown_at(place) {
                of_node.entry(at).or_default().weights = Some(weights.clone());
            }
        }
    }

    fn name(&self, index: usize, animation: &Animation, rig: &Rig) -> String {
        let given = animation.name.clone().filter(|n| !n.trim().is_empty());
        let wanted = given.unwrap_or_else(|| format!("clip_{index}"));
        let is_free = |name: &String| rig.clips().iter().all(|c| c.name != *name);
        let numbered = (2..).map(|k| format!("{wanted}_{k}"));
        std::iter::once(wanted.clone())
            .chain(numbered)
            .find(is_free)
            .unwrap_or(wanted)
    }

    fn tracks(
        &self,
        animation: &Animation,
        accessors: &[Accessor<'_>],
    ) -> Result<BTreeMap<usize, NodeTracks>, String> {
        let mut of_node: BTreeMap<usize, NodeTracks> = BTreeMap::new();
        for (index, channel) in animation.channels.iter().enumerate() {
            let at = |why: String| format!("channel {index}: {why}");
            let sampler = animation.samplers.get(channel.sampler.value());
            let sampler = sampler.ok_or_else(|| {
                let (wanted, there) = (channel.sampler.value(), animation.samplers.len());
                at(format!(
                    "it names sampler {wanted}, but there are only {there}"
                ))
            })?;
            self.track(channel, sampler, accessors, &mut of_node)
                .map_err(at)?;
        }
        Ok(of_node)
    }

    fn track(
        &self,
        channel: &Channel,
        sampler: &Sampler,
        accessors: &[Accessor<'_>],
        of_node: &mut BTreeMap<usize, NodeTracks>,
    ) -> Result<(), String> {
        let node = channel.target.node.value();
        let Some(place) = self.nodes.place_of.get(node) else {
            let there = self.nodes.place_of.len();
            return Err(format!("it moves node {node}, but there are only {there}"));
        };
        let (Checked::Valid(property), Checked::Valid(interpolation)) =
            (channel.target.path, sampler.interpolation)
        else {
            return Err("its target path or interpolation is not in glTF 2.0".to_owned());
        };
        let Some(place) = *place else { return Ok(()) };
        let accessor = |index: usize| {
            let found = accessors.get(index).cloned();
            found.ok_or_else(|| {
                format!(
                    "it names accessor {index}, but there are only {}",
                    accessors.len()
                )
            })
        };
        let times: Vec<f32> = items(accessor(sampler.input.value())?, TIMES, self.buffers)?;
        let times: Vec<f64> = times.into_iter().map(f64::from).collect();
        let output = accessor(sampler.output.value())?;
        let way = match interpolation {
            Interpolation::Step => Way::Step,
            Interpolation::Linear => Way::Straight,
            Interpolation::CubicSpline => Way::Cubic,
        };
        let rig_node = &self.nodes.of_rig[place];
        if property != Property::MorphTargetWeights && rig_node.stand.is_none() {
            return Err(format!(
                "node {node} has a matrix that cannot be decomposed into translation, rotation and scale"
            ));
        }
        let tracks = of_node.entry(place).or_default();
        let is_second = match property {
            Property::Translation => tracks
                .translation
                .replace(Track::new(times, way, self.triples(output)?)?)
                .is_some(),
            Property::Scale => tracks
                .scale
                .replace(Track::new(times, way, self.triples(output)?)?)
                .is_some(),
            Property::Rotation => tracks
                .rotation
                .replace(Track::new(times, way, rotations(output, self.buffers)?)?)
                .is_some(),
            Property::MorphTargetWeights => {
                let width = targets(&self.nodes.nodes[place]);
                if width == 0 {
                    return Ok(());
                }
                let values = self.weights(output)?;
                if values.len() % width != 0 {
                    let count = values.len();
                    return Err(format!("{count} weights for {width} morph targets"));
                }
                let values = values.chunks_exact(width).map(<[f64]>::to_vec).collect();
                tracks
                    .weights
                    .replace(Track::new(times, way, values)?)
                    .is_some()
            }
        };
        if is_second {
            return Err(format!("it moves node {node} a second time"));
        }
        Ok(())
    }

    fn triples(&self, accessor: Accessor<'_>) -> Result<Vec<DVec3>, String> {
        let triples: Vec<[f32; 3]> = items(accessor, TRIPLES, self.buffers)?;
        Ok(triples
            .into_iter()
            .map(|t| DVec3::from(t.map(f64::from)))
            .collect())
    }

    fn weights(&self, accessor: Accessor<'_>) -> Result<Vec<f64>, String> {
        let wanted = TARGET_WEIGHTS;
        Ok(match accessor.data_type() {
            DataType::I8 => items::<i8>(accessor, wanted, self.buffers)?
                .into_iter()
                .map(|c| share(c, i8::MAX))
                .collect(),
            DataType::U8 => items::<u8>(accessor, wanted, self.buffers)?
                .into_iter()
                .map(|c| share(c, u8::MAX))
                .collect(),
            DataType::I16 => items::<i16>(accessor, wanted, self.buffers)?
                .into_iter()
                .map(|c| share(c, i16::MAX))
                .collect(),
            DataType::U16 => items::<u16>(accessor, wanted, self.buffers)?
                .into_iter()
                .map(|c| share(c, u16::MAX))
                .collect(),
            _ => items::<f32>(accessor, wanted, self.buffers)?
                .into_iter()
                .map(f64::from)
                .collect(),
        })
    }
}

/// Number of morph targets of a node's mesh.
pub(super) fn targets(node: &gltf::Node<'_>) -> usize {
    let mesh = node.mesh();
    let primitives = mesh.iter().flat_map(gltf::Mesh::primitives);
    primitives
        .map(|p| p.morph_targets().len())
        .max()
        .unwrap_or(0)
}

/// Number of sampled times at which a clip is checked for positions that are not finite.
const TRIED: usize = 9;

/// Adds a clip, unless it gives positions that are not finite. Products of large scales may overflow.
fn add(rig: &mut Rig, name: &str, of_node: BTreeMap<usize, NodeTracks>) -> Result<(), String> {
    let ends = of_node.values().flat_map(|tracks| {
        [
            tracks.translation.as_ref().map(Track::end_s),
            tracks.rotation.as_ref().map(Track::end_s),
            tracks.scale.as_ref().map(Track::end_s),
            tracks.weights.as_ref().map(Track::end_s),
        ]
    });
    let duration_s = ends.flatten().fold(0.0, f64::max);
    let clip = Clip {
        name: name.to_owned(),
        duration_s,
    };
    rig.add(clip, of_node);
    let clip = rig.clips().len() - 1;
    for k in 0..TRIED {
        let time_s = duration_s * k as f64 / (TRIED - 1) as f64;
        let moment = Some(Moment { clip, time_s });
        let nodes = rig.worlds(moment).iter().all(|w| w.is_finite());
        let joints = |skin| rig.palette(skin, moment).iter().all(|j| j.is_finite());
        if !(nodes && (0..rig.skins.len()).all(joints)) {
            rig.take_back();
            return Err(format!(
                "at {time_s} s it leads to positions that are not finite"
            ));
        }
    }
    Ok(())
}

/// Notes about joints that a clip scales to zero although a skin depends on them. This is often intended, to hide a part.
fn flattening(of_node: &BTreeMap<usize, NodeTracks>, name: &str, rig: &Rig) -> Vec<String> {
    let mut found = Vec::new();
    for (node, tracks) in of_node {
        let zero = (tracks.scale.iter().flat_map(Track::keys))
            .find(|(_, scale)| scale.abs().min_element() <= 0.0);
        let Some((time_s, _)) = zero else { continue };
        let below = |joint: usize| {
            let above = |n: &usize| rig.nodes[*n].parent;
            std::iter::successors(Some(joint), above).any(|n| n == *node)
        };
        for (skin, of_skin) in rig.skins.iter().enumerate() {
            let joint = of_skin.joints.iter().position(|(joint, _)| below(*joint));
            found.extend(joint.map(|joint| {
                format!("clip `{name}` scales joint {joint} of skin {skin} to zero at {time_s} s")
            }));
        }
    }
    found
}
