//! From what was drawn to layers, and from layers to a picture: the end that every strategy and the exact reference share.

use glam::Vec3;

use super::recorder::{Recorder, or_one, pixels};
use crate::plan::{Binding, Clock, Contents, Resource, ResourceId, Role};
use crate::shader::Shader;

impl Recorder<'_> {
    /// The layers of the frame: three words per pixel.
    pub fn layers(&mut self) -> ResourceId {
        let bytes = pixels(self.view.size_px) * 12;
        let id = self.once("layers", |_| {
            Resource::storage("layers", bytes, Clock::Frame)
        });
        self.plan.layers = Some(id);
        id
    }

    /// Turns what was drawn into layers.
    pub fn gather(&mut self) {
        let targets = self.targets();
        let layers = self.layers();
        let bindings = vec![
            self.frame(),
            Binding::read("surface_words", targets.words),
            Binding::read("surface_depth", targets.depth),
            Binding::write("layers", layers),
        ];
        self.compute(
            "gather",
            Clock::Frame,
            "layers are what the picture and the comparison read",
            "passes/gather.wgsl",
            bindings,
            Vec::new(),
            self.view.size_px,
        );
    }

    /// Layers that come from elsewhere, as words: what the exact reference found.
    pub fn given_layers(&mut self, words: &[u32]) {
        self.once("layers", |_| {
            Resource::upload("layers", Role::Storage, Contents::of(words), Clock::Frame)
        });
    }

    /// Whether anything asks where solids overlap, and two are there that could.
    pub fn shows_overlaps(&self) -> bool {
        self.model.prepared.interference.is_some() && self.relevance.lanes > 1
    }

    /// The picture of the frame: one RGBA8 word per pixel.
    pub(super) fn picture(&mut self) -> ResourceId {
        let bytes = pixels(self.view.size_px) * 4;
        let id = self.once("picture", |_| {
            Resource::storage("picture", bytes, Clock::Frame)
        });
        self.plan.picture = Some(id);
        id
    }

    /// Where each part of the scene is in the part table.
    pub(super) fn rank_of_part(&mut self) -> Binding {
        self.uploaded("rank_of_part", Role::Storage, Clock::Cut, |r| {
            let mut places = vec![0_u32; r.model.prepared.parts.len()];
            for (place, rank) in r.relevance.order.iter().enumerate() {
                places[r.model.prepared.parts[*rank].part] = place as u32;
            }
            Contents::of(&or_one(places))
        })
    }

    /// The file that fills `cutaway::overlap`, and what it binds.
    pub(super) fn overlap(&mut self, bindings: &mut Vec<Binding>) -> &'static str {
        let color = self.model.prepared.interference;
        match color.filter(|_| self.shows_overlaps()) {
            None => "lib/overlap/plain.wgsl",
            Some(color) => {
                let color = linear_from_srgb(color);
                bindings.push(
                    self.uploaded("interference", Role::Uniform, Clock::Cut, |_| {
                        Contents::of(&[color])
                    }),
                );
                "lib/overlap/hatched.wgsl"
            }
        }
    }

    /// Turns layers into a picture, unless what resolved the frame painted it.
    pub fn shade(&mut self) {
        if self.plan.picture.is_some() {
            return;
        }
        let mut bindings = vec![
            self.frame(),
            self.parts(),
            Binding::read("layers", self.layers()),
            self.rank_of_part(),
            Binding::write("picture", self.picture()),
        ];
        let overlap = self.overlap(&mut bindings);
        self.compute(
            "shade",
            Clock::Frame,
            "lit shading turns layers into a picture",
            Shader::from("passes/shade.wgsl").with(overlap),
            bindings,
            Vec::new(),
            self.view.size_px,
        );
    }
}

/// The colour as the shader mixes it.
fn linear_from_srgb(color: Vec3) -> [f32; 4] {
    let [r, g, b] = color.to_array().map(|c| {
        if c <= 0.040_45 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    });
    [r, g, b, 1.0]
}
