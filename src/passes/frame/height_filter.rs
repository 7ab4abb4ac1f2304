//! Reading relief heights: from four texels, or through the GPU's sampler.
//!
//! By definition a height is interpolated from four texels in f32, read from the buffer that holds all maps. A sampler takes one fetch, but
//! resolves the position within a cell to few bits. Passes that need heights at points (the clip test of the paper's rule and grid
//! vertices) may use the sampler; all such passes of a frame use the same method, and normals stay exact.
//!
//! The maps are layers of a 32-bit float texture, so that only the filter weights are inexact: 16-bit texels, which every device filters,
//! would add errors of their own that are larger on smooth reliefs. Not supported: maps of several sizes in one texture, several wrap modes
//! in one sampler, or a device that does not filter 32-bit floats.

use super::input::Input;
use crate::plan::{Binding, Clock, Contents, Format, Plan, Resource};
use crate::scene::{HeightFilter, OffsetMap, Wrap};

/// Maps that a sampler reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampledMaps {
    /// Width and height of each map in texels.
    size: [u32; 2],
    wrap: Wrap,
}

impl SampledMaps {
    /// Uploads the maps as layers of a texture, and a sampler.
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
    /// Reason why the GPU's sampler cannot read the requested heights; `None` if it can, or if no heights are requested.
    pub(crate) fn unfiltered(&self) -> Option<String> {
        let first = self.sampled()?;
        for (map, wrap) in self.maps() {
            if map.size() != first.size {
                let [[w, h], [v, g]] = [first.size, map.size()];
                return Some(format!(
                    "height_filter = \"hardware\" reads all reliefs from one texture, but there are maps of {w} x {h} and of {v} x {g} texels"
                ));
            }
            if wrap != first.wrap {
                return Some(
                    "height_filter = \"hardware\" reads all reliefs through one sampler, but they continue beyond their maps in different ways (wrap)"
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

    /// The first map's size and wrap mode, if heights are to be read through a sampler and there are any maps.
    pub(crate) fn sampled(&self) -> Option<SampledMaps> {
        let is_asked = self.height_filter == HeightFilter::Hardware && self.has_reliefs();
        let (map, wrap) = self.maps().next().filter(|_| is_asked)?;
        Some(SampledMaps {
            size: map.size(),
            wrap,
        })
    }

    /// Maps of the clip-surfaces that are true reliefs.
    fn maps(&self) -> impl Iterator<Item = (&OffsetMap, Wrap)> {
        let surfaces = self.model.prepared.surfaces.iter().enumerate();
        surfaces
            .filter(|(number, _)| self.model.is_relief(*number))
            .filter_map(|(_, surface)| Some((&**surface.relief.as_ref()?, surface.wrap)))
    }
}
