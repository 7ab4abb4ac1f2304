//! A frame by the compute rasteriser: the pass over the mesh without the GPU's own rasteriser.
//!
//! Two sweeps over the triangles in the place of one atomic of 64 bits, which core WebGPU lacks: marking leaves fragments to the
//! inside test and finds the greatest depth-buffer value, claiming finds the first triangle at it. Both run the same pipelines.
//! Cost per frame: that of the screen and the sweeps, and 8 bytes a pixel after what the inside test wants.

use super::recorder::{Recorder, pixels};
use super::{Crossings, ScreenOf, Store, Sweep};
use crate::plan::{Binding, Clock, Resource};

/// Planes of one word per pixel: the nearest depth and who claims it.
const NEAREST_PLANES: u64 = 2;

impl Recorder<'_> {
    /// Rasterises all parts into what an inside test wants, and what the nearest kept surfaces are into the layers, where they wait for the
    /// resolve with depth-buffer values for depths; the reason where there are too many parts.
    pub(super) fn rasterise(&mut self, store: &Store, crossings: &Crossings) -> Result<(), String> {
        let bytes = NEAREST_PLANES * pixels(self.view.size_px) * 4;
        let nearest = self.once("nearest", |_| {
            Resource::storage("nearest", bytes, Clock::Frame)
        });
        let order = self.relevance.order.clone();
        let (frame, view) = (self.frame(), self.view);
        let screen = self.screen(ScreenOf {
            name: "",
            view,
            frame: frame.clone(),
            clock: Clock::Frame,
            ranks: &order,
            fresh: "lib/fresh/nearest.wgsl",
            freshened: vec![Binding::write("nearest", nearest)],
        })?;
        let marking = Sweep {
            name: "mark",
            reason: "each sample marks the crossings it is behind, and raises the depth of its pixel where it is kept",
            sample: "lib/sample/ranked.wgsl",
            store: Some(store),
            crossings: Some(crossings),
            bindings: vec![Binding::update("nearest", nearest)],
            again: false,
        };
        self.sweep(&screen, &marking);
        self.sweep(
            &screen,
            &Sweep {
                name: "claim",
                reason: "the first triangle at the depth of a pixel claims it",
                again: true,
                ..marking
            },
        );

        let layers = self.layers();
        let (vertices, _) = self.mesh_in_storage();
        let bindings = vec![
            frame,
            self.sweep_of(&screen, false),
            screen.drawn_parts.clone(),
            screen.indices.clone(),
            vertices,
            screen.vertices(),
            Binding::read("nearest", nearest),
            Binding::write("layers", layers),
        ];
        self.compute(
            "surfaces",
            Clock::Frame,
            "the triangle that claimed a pixel gives it part, side and normal",
            "passes/rasterise/surfaces.wgsl",
            bindings,
            Vec::new(),
            self.view.size_px,
        );
        Ok(())
    }
}
