//! Reading the heights of reliefs: from four texels, or through the sampler of the GPU.
//!
//! By the definition a height is made of four texels in f32, from the one buffer that holds all maps. A sampler takes one fetch and
//! keeps the place within a cell in few bits. What asks for heights at points, the clip test of the paper's rule and the vertices of
//! grids, may read them through it instead; all of a frame that asks at points asks the same way, and normals stay exact.
//!
//! The maps are layers of a texture of 32-bit floats, so that nothing but the weights is off: 16 bits, which every device filters,
//! would add errors of their own that are larger on smooth reliefs. Cannot: maps of several sizes in one texture, or several ways
//! to go on with one sampler; a device that does not filter 32-bit floats.

use super::Recorder;
use crate::plan::{Binding, Clock, Format, Resource, Role};
use crate::scene::{HeightFilter, OffsetMap, Wrap};

impl Recorder<'_> {
    /// The heights of all reliefs.
    pub fn heights(&mut self) -> Binding {
        self.uploaded("heights", Role::Storage, Clock::Cut, |r| {
            r.model.heights.clone()
        })
    }

    /// Why the sampler of the GPU does not read the heights that are asked of it; `None` where it does, and where nothing is.
    pub fn unfiltered(&self) -> Option<String> {
        let (first, wrap) = self.sampled()?;
        for (map, other) in self.maps() {
            if map.size != first.size {
                let [[w, h], [v, g]] = [first.size, map.size];
                return Some(format!(
                    "height_filter = \"hardware\" reads all reliefs from one texture, and there are maps of {w} x {h} and of {v} x {g} texels"
                ));
            }
            if other != wrap {
                return Some(
                    "height_filter = \"hardware\" reads all reliefs through one sampler, and they go on beyond their maps in different ways (wrap)"
                        .to_owned(),
                );
            }
        }
        None
    }

    /// The file that fills `cutaway::height_filter`.
    pub fn height_filter_file(&self) -> &'static str {
        match self.sampled() {
            None => "lib/height_filter/exact.wgsl",
            Some(_) => "lib/height_filter/hardware.wgsl",
        }
    }

    /// What that binds.
    pub fn filtered_heights(&mut self) -> Vec<Binding> {
        let Some((map, wrap)) = self.sampled() else {
            return vec![self.heights()];
        };
        let size = map.size;
        let maps = self.once("relief_maps", |r| {
            let heights = r.model.heights.clone();
            let layer_bytes =
                u64::from(size[0]) * u64::from(size[1]) * Format::R32Float.texel_bytes();
            let layers = (heights.len() / layer_bytes) as u32;
            Resource::uploaded_texture(
                "relief_maps",
                size,
                layers,
                Format::R32Float,
                heights,
                Clock::Cut,
            )
        });
        let sampler = self.once("relief_sampler", |_| {
            Resource::sampler("relief_sampler", wrap, Clock::Cut)
        });
        vec![
            Binding::read("relief_maps", maps),
            Binding::read("relief_sampler", sampler),
        ]
    }

    /// A map and how it goes on, if heights are to be read through a sampler and there are some.
    fn sampled(&self) -> Option<(&OffsetMap, Wrap)> {
        let is_asked = self.height_filter == HeightFilter::Hardware && self.has_reliefs();
        self.maps().next().filter(|_| is_asked)
    }

    /// The maps of true reliefs.
    fn maps(&self) -> impl Iterator<Item = (&OffsetMap, Wrap)> {
        let surfaces = self.model.prepared.surfaces.iter().enumerate();
        surfaces
            .filter(|(number, _)| self.model.is_relief(*number))
            .filter_map(|(_, surface)| Some((&**surface.relief.as_ref()?, surface.wrap)))
    }
}
