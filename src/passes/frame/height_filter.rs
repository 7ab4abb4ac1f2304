//! Reading the heights of reliefs: from four texels, or through the sampler of the GPU.
//!
//! By the definition a height is made of four texels in f32, from the one buffer that holds all maps. A sampler takes one fetch and
//! keeps the place within a cell in few bits. What asks for heights at points, the clip test of the paper's rule and the vertices of
//! grids, may read them through it instead; all of a frame that asks at points asks the same way, and normals stay exact.
//!
//! The maps are layers of a texture of 32-bit floats, so that nothing but the weights is off: 16 bits, which every device filters,
//! would add errors of their own that are larger on smooth reliefs. Cannot: maps of several sizes in one texture, or several ways
//! to go on with one sampler; a device that does not filter 32-bit floats.

use super::input::Input;
use crate::plan::{Binding, Clock, Contents, Format, Plan, Resource};
use crate::scene::{HeightFilter, OffsetMap, Wrap};

/// Maps that a sampler reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampledMaps {
    /// Texels of each.
    size: [u32; 2],
    wrap: Wrap,
}

impl SampledMaps {
    /// The maps as layers of a texture, and the sampler.
    pub(crate) fn upload(self, plan: &mut Plan, heights: Contents) -> Vec<Binding> {
        let Self { size, wrap } = self;
        let format = Format::R32Float;
        let layer_bytes = u64::from(size[0]) * u64::from(size[1]) * format.texel_bytes();
        let layers = (heights.len() / layer_bytes) as u32;
        let clock = Clock::Cut;
        let maps = Resource::uploaded_texture("relief_maps", size, layers, format, heights, clock);
        let sampler = Resource::sampler("relief_sampler", wrap, clock);
        vec![
            Binding::read("relief_maps", plan.add_resource(maps)),
            Binding::read("relief_sampler", plan.add_resource(sampler)),
        ]
    }
}

impl Input<'_> {
    /// Reason why the sampler of the GPU cannot read the requested heights; `None` where it can, and where no heights are requested.
    pub(crate) fn unfiltered(&self) -> Option<String> {
        let first = self.sampled()?;
        for (map, wrap) in self.maps() {
            if map.size() != first.size {
                let [[w, h], [v, g]] = [first.size, map.size()];
                return Some(format!(
                    "height_filter = \"hardware\" reads all reliefs from one texture, and there are maps of {w} x {h} and of {v} x {g} texels"
                ));
            }
            if wrap != first.wrap {
                return Some(
                    "height_filter = \"hardware\" reads all reliefs through one sampler, and they go on beyond their maps in different ways (wrap)"
                        .to_owned(),
                );
            }
        }
        None
    }

    /// The file that fills `cutaway::height_filter`.
    pub(crate) fn height_filter_file(&self) -> &'static str {
        match self.sampled() {
            None => "lib/height_filter/exact.wgsl",
            Some(_) => "lib/height_filter/hardware.wgsl",
        }
    }

    /// The first map and how it goes on, if heights are to be read through a sampler and there are some.
    pub(crate) fn sampled(&self) -> Option<SampledMaps> {
        let is_asked = self.height_filter == HeightFilter::Hardware && self.has_reliefs();
        let (map, wrap) = self.maps().next().filter(|_| is_asked)?;
        Some(SampledMaps {
            size: map.size(),
            wrap,
        })
    }

    /// The maps of true reliefs.
    fn maps(&self) -> impl Iterator<Item = (&OffsetMap, Wrap)> {
        let surfaces = self.model.prepared.surfaces.iter().enumerate();
        surfaces
            .filter(|(number, _)| self.model.is_relief(*number))
            .filter_map(|(_, surface)| Some((&**surface.relief.as_ref()?, surface.wrap)))
    }
}
