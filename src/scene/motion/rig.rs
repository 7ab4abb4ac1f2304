//! Rigs: the nodes of a file, the skins attached to them, and the clips that move them.
//!
//! A rig computes a node's transform at a moment; all parts of a file share it. Evaluating a node visits its ancestors; evaluating a skin
//! visits all nodes of the file. Nodes that a clip does not move keep their transforms from the file.

use std::collections::BTreeMap;

use glam::{DAffine3, DQuat, DVec3};

use super::track::Track;

/// One animation of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name in the file, made unique; `clip_N` if it has none.
    pub name: String,
    /// Time of its last key.
    pub duration_s: f64,
}

/// A time in a clip.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    pub clip: usize,
    pub time_s: f64,
}

/// Transform of a node relative to its parent.
#[derive(Clone, Copy, Debug)]
pub struct NodeTransform {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl NodeTransform {
    pub fn affine(self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

/// A node of the file.
#[derive(Clone, Debug)]
pub struct RigNode {
    /// Index into [`Rig::nodes`], less than that of the node itself.
    pub parent: Option<usize>,
    /// Transform in the rest pose.
    pub rest: DAffine3,
    /// The rest transform, decomposed; `None` for a matrix that cannot be decomposed.
    pub stand: Option<NodeTransform>,
}

/// Joints that influence a mesh's vertices.
#[derive(Clone, Debug, Default)]
pub struct RigSkin {
    /// Nodes and their inverse bind matrices.
    pub joints: Vec<(usize, DAffine3)>,
}

/// Tracks of a clip for one node.
#[derive(Clone, Debug, Default)]
pub struct NodeTracks {
    pub translation: Option<Track<DVec3>>,
    pub rotation: Option<Track<DQuat>>,
    pub scale: Option<Track<DVec3>>,
    pub weights: Option<Track<Vec<f64>>>,
}

impl NodeTracks {
    fn moves(&self) -> bool {
        self.translation.is_some() || self.rotation.is_some() || self.scale.is_some()
    }
}

/// Nodes that a clip moves.
#[derive(Clone, Debug, Default)]
struct MovedNodes {
    of_node: BTreeMap<usize, NodeTracks>,
    /// Per node, whether it or one of its ancestors moves.
    is_moved: Vec<bool>,
}

/// Nodes, skins and clips that move the parts of a file.
#[derive(Clone, Debug, Default)]
pub struct Rig {
    /// Nodes, parents before children.
    pub nodes: Vec<RigNode>,
    pub skins: Vec<RigSkin>,
    clips: Vec<Clip>,
    moves: Vec<MovedNodes>,
}

impl Rig {
    /// Nodes and skins without clips.
    pub fn new(nodes: Vec<RigNode>, skins: Vec<RigSkin>) -> Self {
        Self {
            nodes,
            skins,
            ..Self::default()
        }
    }

    /// The clips of the file.
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// Adds a clip with its tracks per node. A node may have tracks only if its transform is decomposed.
    pub fn add(&mut self, clip: Clip, of_node: BTreeMap<usize, NodeTracks>) {
        let mut is_moved: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for (index, node) in self.nodes.iter().enumerate() {
            let above = node.parent.is_some_and(|p| is_moved[p]);
            is_moved.push(above || of_node.get(&index).is_some_and(NodeTracks::moves));
        }
        self.clips.push(clip);
        self.moves.push(MovedNodes { of_node, is_moved });
    }

    /// Removes the clip that was added last.
    pub fn take_back(&mut self) {
        self.clips.pop();
        self.moves.pop();
    }

    /// Returns true if a clip moves a node, directly or through an ancestor.
    pub(crate) fn moves(&self, clip: usize, node: usize) -> bool {
        let moves = self.moves.get(clip);
        moves.is_some_and(|m| m.is_moved.get(node) == Some(&true))
    }

    /// Weights of a node's morph targets, if the clip changes them.
    pub(crate) fn weights(&self, node: usize, moment: Moment) -> Option<Vec<f64>> {
        let tracks = self.tracks(node, moment.clip)?.weights.as_ref()?;
        Some(tracks.at(moment.time_s))
    }

    fn tracks(&self, node: usize, clip: usize) -> Option<&NodeTracks> {
        self.moves.get(clip)?.of_node.get(&node)
    }

    fn local(&self, node: usize, moment: Option<Moment>) -> DAffine3 {
        let node_at_rest = &self.nodes[node];
        let moved = moment.and_then(|m| Some((self.tracks(node, m.clip)?, m.time_s)));
        let (Some((tracks, time_s)), Some(mut stand)) = (moved, node_at_rest.stand) else {
            return node_at_rest.rest;
        };
        if !tracks.moves() {
            return node_at_rest.rest;
        }
        if let Some(track) = &tracks.translation {
            stand.translation = track.at(time_s);
        }
        if let Some(track) = &tracks.rotation {
            stand.rotation = track.at(time_s);
        }
        if let Some(track) = &tracks.scale {
            stand.scale = track.at(time_s);
        }
        stand.affine()
    }

    /// World transform of a node; in the rest pose if there is no moment.
    pub(crate) fn world(&self, node: usize, moment: Option<Moment>) -> DAffine3 {
        // Multiplied from the root down, as in `worlds`, so that rounding does not give one node two different transforms.
        let above = |n: &usize| self.nodes[*n].parent;
        let mut chain: Vec<usize> = std::iter::successors(Some(node), above).collect();
        let root = chain.pop().unwrap_or(node);
        let root_world = self.local(root, moment);
        chain
            .iter()
            .rev()
            .fold(root_world, |world, n| world * self.local(*n, moment))
    }

    /// World transforms of all nodes.
    pub fn worlds(&self, moment: Option<Moment>) -> Vec<DAffine3> {
        let mut worlds: Vec<DAffine3> = Vec::with_capacity(self.nodes.len());
        for (index, node) in self.nodes.iter().enumerate() {
            let local = self.local(index, moment);
            worlds.push(node.parent.map_or(local, |p| worlds[p] * local));
        }
        worlds
    }

    /// Vertex transforms for the joints of a skin, from bind space to the file's world.
    pub fn palette(&self, skin: usize, moment: Option<Moment>) -> Vec<DAffine3> {
        let worlds = self.worlds(moment);
        let joints = self.skins[skin].joints.iter();
        joints
            .map(|(node, inverse)| worlds[*node] * *inverse)
            .collect()
    }

    /// Vertex transform for one joint of a skin.
    pub(crate) fn joint(&self, skin: usize, joint: usize, moment: Option<Moment>) -> DAffine3 {
        let (node, inverse) = self.skins[skin].joints[joint];
        self.world(node, moment) * inverse
    }

    /// Returns true if a clip moves any joint of a skin.
    pub(crate) fn moves_skin(&self, clip: usize, skin: usize) -> bool {
        let joints = &self.skins[skin].joints;
        joints.iter().any(|(node, _)| self.moves(clip, *node))
    }
}
