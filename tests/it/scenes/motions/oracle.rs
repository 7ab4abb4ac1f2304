//! A second opinion on where the vertices of a glTF file are at a time: every vertex by 4 x 4 matrices from the crate's own
//! readers, nothing welded, nothing shared with the loader or its rig.

use std::collections::BTreeSet;

use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::animation::Interpolation;
use gltf::animation::util::ReadOutputs;
use gltf::{Document, Gltf, Node};

pub(crate) struct Oracle {
    document: Document,
    buffer: Vec<u8>,
}

/// What a clip makes of a node.
struct Changed {
    translation: DVec3,
    rotation: DQuat,
    scale: DVec3,
    weights: Option<Vec<f64>>,
}

/// What a channel says at a time.
enum Said {
    Triple(DVec3),
    Rotation(DQuat),
    Weights(Vec<f64>),
}

impl Oracle {
    /// Of a GLB.
    pub(crate) fn new(bytes: &[u8]) -> Self {
        let Gltf { document, blob } = Gltf::from_slice(bytes).unwrap();
        Self {
            document,
            buffer: blob.unwrap(),
        }
    }

    pub(crate) fn clips(&self) -> usize {
        self.document.animations().count()
    }

    /// Time of the last key of a clip.
    pub(crate) fn duration_s(&self, clip: usize) -> f64 {
        let animation = self.document.animations().nth(clip).unwrap();
        let mut last = 0.0_f64;
        for channel in animation.channels() {
            let reader = channel.reader(|_| Some(self.buffer.as_slice()));
            let end = reader.read_inputs().unwrap().last().unwrap();
            last = last.max(f64::from(end));
        }
        last
    }

    /// Places of all vertices that triangles use, in the file's world.
    pub(crate) fn points(&self, clip: usize, time_s: f64) -> Vec<DVec3> {
        let worlds = self.worlds(clip, time_s);
        let mut points = Vec::new();
        for node in self.document.nodes() {
            let (Some(mesh), Some(world)) = (node.mesh(), worlds[node.index()]) else {
                continue;
            };
            let changed = self.changed(&node, clip, time_s);
            let rest = node.weights().or(mesh.weights()).unwrap_or(&[]);
            let rest = rest.iter().map(|w| f64::from(*w)).collect();
            let weights = changed.weights.unwrap_or(rest);
            let matrices = node.skin().map(|skin| self.matrices(&skin, &worlds));
            for primitive in mesh.primitives() {
                let reader = primitive.reader(|_| Some(self.buffer.as_slice()));
                let wide = |p: [f32; 3]| DVec3::from(p.map(f64::from));
                let mut vertices: Vec<DVec3> = reader.read_positions().unwrap().map(wide).collect();
                for (target, weight) in reader.read_morph_targets().zip(&weights) {
                    for (vertex, by) in vertices.iter_mut().zip(target.0.into_iter().flatten()) {
                        *vertex += wide(by) * *weight;
                    }
                }
                let used: BTreeSet<u32> = match reader.read_indices() {
                    Some(indices) => indices.into_u32().collect(),
                    None => (0..vertices.len() as u32).collect(),
                };
                let pulls = matrices
                    .as_ref()
                    .zip(reader.read_joints(0))
                    .map(|(m, joints)| {
                        let weights = reader.read_weights(0).unwrap().into_f32();
                        (m, joints.into_u16().zip(weights).collect::<Vec<_>>())
                    });
                for i in used {
                    let vertex = vertices[i as usize].extend(1.0);
                    let place = match &pulls {
                        None => world * vertex,
                        Some((m, pulls)) => skinned(m, pulls[i as usize], vertex),
                    };
                    points.push(place.truncate());
                }
            }
        }
        points
    }

    fn matrices(&self, skin: &gltf::Skin<'_>, worlds: &[Option<DMat4>]) -> Vec<DMat4> {
        let reader = skin.reader(|_| Some(self.buffer.as_slice()));
        let inverse: Vec<_> = reader.read_inverse_bind_matrices().unwrap().collect();
        let of = |(joint, inverse): (Node<'_>, &[[f32; 4]; 4])| {
            let inverse = DMat4::from_cols_array_2d(&inverse.map(|c| c.map(f64::from)));
            worlds[joint.index()].unwrap() * inverse
        };
        skin.joints().zip(&inverse).map(of).collect()
    }

    fn worlds(&self, clip: usize, time_s: f64) -> Vec<Option<DMat4>> {
        let mut worlds = vec![None; self.document.nodes().count()];
        let scene = self
            .document
            .default_scene()
            .or(self.document.scenes().next());
        for root in scene.unwrap().nodes() {
            self.descend(&root, DMat4::IDENTITY, clip, time_s, &mut worlds);
        }
        worlds
    }

    fn descend(
        &self,
        node: &Node<'_>,
        above: DMat4,
        clip: usize,
        time_s: f64,
        worlds: &mut [Option<DMat4>],
    ) {
        let is_moved = |c: gltf::animation::Channel<'_>| c.target().node().index() == node.index();
        let animation = self.document.animations().nth(clip).unwrap();
        let local = if animation.channels().any(is_moved) {
            let changed = self.changed(node, clip, time_s);
            DMat4::from_translation(changed.translation)
                * DMat4::from_quat(changed.rotation)
                * DMat4::from_scale(changed.scale)
        } else {
            match node.transform() {
                gltf::scene::Transform::Matrix { matrix } => {
                    DMat4::from_cols_array_2d(&matrix.map(|c| c.map(f64::from)))
                }
                gltf::scene::Transform::Decomposed { .. } => {
                    let rest = rest(node);
                    DMat4::from_translation(rest.translation)
                        * DMat4::from_quat(rest.rotation)
                        * DMat4::from_scale(rest.scale)
                }
            }
        };
        let world = above * local;
        worlds[node.index()] = Some(world);
        for child in node.children() {
            self.descend(&child, world, clip, time_s, worlds);
        }
    }

    fn changed(&self, node: &Node<'_>, clip: usize, time_s: f64) -> Changed {
        let mut changed = rest(node);
        let animation = self.document.animations().nth(clip).unwrap();
        for channel in animation.channels() {
            let target = channel.target();
            if target.node().index() != node.index() {
                continue;
            }
            match self.said(&channel, time_s) {
                Said::Rotation(rotation) => changed.rotation = rotation,
                Said::Weights(weights) => changed.weights = Some(weights),
                Said::Triple(to) if target.property() == gltf::animation::Property::Scale => {
                    changed.scale = to;
                }
                Said::Triple(to) => changed.translation = to,
            }
        }
        changed
    }

    fn said(&self, channel: &gltf::animation::Channel<'_>, time_s: f64) -> Said {
        let reader = channel.reader(|_| Some(self.buffer.as_slice()));
        let times: Vec<f64> = reader.read_inputs().unwrap().map(f64::from).collect();
        let way = channel.sampler().interpolation();
        let between = |values: &[DVec4]| between(way, &times, values, time_s, false);
        match reader.read_outputs().unwrap() {
            ReadOutputs::Translations(all) | ReadOutputs::Scales(all) => {
                let wide = |p: [f32; 3]| DVec3::from(p.map(f64::from)).extend(0.0);
                Said::Triple(between(&all.map(wide).collect::<Vec<_>>()).truncate())
            }
            ReadOutputs::Rotations(all) => {
                let wide = |q: [f32; 4]| DVec4::from(q.map(f64::from));
                let all: Vec<DVec4> = all.into_f32().map(wide).collect();
                let q = self::between(way, &times, &all, time_s, true);
                Said::Rotation(DQuat::from_vec4(q.normalize()))
            }
            ReadOutputs::MorphTargetWeights(all) => {
                let all: Vec<f64> = all.into_f32().map(f64::from).collect();
                let per_key = if way == Interpolation::CubicSpline {
                    3
                } else {
                    1
                };
                let width = all.len() / (per_key * times.len());
                let one = |target: usize| {
                    let of_target = all.iter().skip(target).step_by(width);
                    between(&of_target.map(|w| DVec4::splat(*w)).collect::<Vec<_>>()).x
                };
                Said::Weights((0..width).map(one).collect())
            }
        }
    }
}

fn rest(node: &Node<'_>) -> Changed {
    let (translation, rotation, scale) = node.transform().decomposed();
    Changed {
        translation: DVec3::from(translation.map(f64::from)),
        rotation: DQuat::from_array(rotation.map(f64::from)).normalize(),
        scale: DVec3::from(scale.map(f64::from)),
        weights: None,
    }
}

/// Weights count as the loader states that it keeps them: divided by their sum, then rounded to f32.
fn skinned(matrices: &[DMat4], pulls: ([u16; 4], [f32; 4]), vertex: DVec4) -> DVec4 {
    let (joints, weights) = pulls;
    let sum: f64 = weights.iter().map(|w| f64::from(*w)).sum();
    let mut place = DVec4::ZERO;
    for (joint, weight) in joints.iter().zip(weights) {
        let share = (f64::from(weight) / sum) as f32;
        place += matrices[usize::from(*joint)] * vertex * f64::from(share);
    }
    place
}

fn between(
    way: Interpolation,
    times: &[f64],
    values: &[DVec4],
    time_s: f64,
    is_rotation: bool,
) -> DVec4 {
    let cubic = way == Interpolation::CubicSpline;
    let value = |key: usize| {
        if cubic {
            values[3 * key + 1]
        } else {
            values[key]
        }
    };
    if time_s <= times[0] {
        return value(0);
    }
    let Some(next) = times.iter().position(|t| *t > time_s) else {
        return value(times.len() - 1);
    };
    let (a, b) = (value(next - 1), value(next));
    let step = times[next] - times[next - 1];
    let s = (time_s - times[next - 1]) / step;
    match way {
        Interpolation::Step => a,
        Interpolation::Linear if is_rotation => turned_towards(a, b, s),
        Interpolation::Linear => a + (b - a) * s,
        Interpolation::CubicSpline => {
            // As a Bézier curve, by de Casteljau.
            let (leaves, arrives) = (values[3 * (next - 1) + 2], values[3 * next]);
            let mut points = [a, a + leaves * step / 3.0, b - arrives * step / 3.0, b];
            for left in (1..4).rev() {
                for k in 0..left {
                    points[k] = points[k] + (points[k + 1] - points[k]) * s;
                }
            }
            points[0]
        }
    }
}

/// A part of the turn that takes `a` to `b`, done after `a`.
fn turned_towards(a: DVec4, b: DVec4, s: f64) -> DVec4 {
    let (a, b) = (
        DQuat::from_vec4(a).normalize(),
        DQuat::from_vec4(b).normalize(),
    );
    let turn = a.conjugate() * b;
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let (along, half) = (turn.xyz(), turn.xyz().length().atan2(turn.w));
    if half <= 0.0 {
        return a.into();
    }
    let part = along.normalize() * (s * half).sin();
    (a * DQuat::from_xyzw(part.x, part.y, part.z, (s * half).cos())).into()
}
