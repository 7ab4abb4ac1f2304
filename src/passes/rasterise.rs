//! A frame by the compute rasteriser: candidates, one pass over the mesh, one decision per pixel, and paint where there is something.
//!
//! Every sample leaves to the inside test what that wants and keeps the nearest kept triangle. With atomics of 64 bits that is
//! one sweep over the triangles. Core WebGPU lacks them: there a first sweep finds the greatest depth-buffer value and a second
//! one the first triangle at it, to the same picture.
//!
//! Cost per frame: that of the screen and the sweeps, and 12 bytes a pixel after what the inside test wants.

use super::Refusal;
use super::recorder::{Recorder, pixels};
use super::sweep::GROUP;
use super::{Crossings, Inside, Screen, ScreenOf, Store, Sweep};
use crate::plan::{Binding, Clock, Pass, Resource, ResourceId, Work};
use crate::shader::Shader;

/// Workgroups that share the list of pixels to be painted, at most.
const PAINTING_GROUPS: u32 = 1024;

impl Recorder<'_> {
    /// Rasterises all parts into what an inside test wants, and into the nearest kept triangle of each pixel; the reason where there
    /// are too many parts.
    pub(super) fn rasterise(
        &mut self,
        store: &Store,
        crossings: &Crossings,
    ) -> Result<(), Refusal> {
        let nearest = self.nearest();
        let screen = self.screen_of_frame()?;
        let marking = Sweep {
            name: "mark",
            reason: "each sample marks the crossings it is behind, and keeps its triangle where it is the nearest kept",
            sample: "lib/sample/fused.wgsl",
            store: Some(store),
            crossings: Some(crossings),
            bindings: vec![Binding::update("nearest", nearest)],
            again: false,
        };
        if self.wide_atomics {
            self.sweep(&screen, &marking);
            return Ok(());
        }
        let marking = Sweep {
            reason: "each sample marks the crossings it is behind, and raises the depth of its pixel where it is kept",
            sample: "lib/sample/ranked.wgsl",
            ..marking
        };
        self.sweep(&screen, &marking);
        let claiming = Sweep {
            name: "claim",
            reason: "the first triangle at the depth of a pixel claims it",
            again: true,
            ..marking
        };
        self.sweep(&screen, &claiming);
        Ok(())
    }

    /// The screen of the frame, with all parts that are drawn.
    fn screen_of_frame(&mut self) -> Result<Screen, Refusal> {
        let order = self.relevance.order.clone();
        let of = ScreenOf {
            name: "",
            view: self.view,
            frame: self.frame(),
            clock: Clock::Frame,
            ranks: &order,
            settles: self.settles(),
            fresh: "lib/fresh/frame.wgsl",
            freshened: vec![
                Binding::write("nearest", self.nearest()),
                Binding::write("painted", self.painted()),
                Binding::write("picture", self.picture()),
            ],
        };
        let screen = self.screen(of)?;
        self.screen_of_frame = Some(screen.clone());
        Ok(screen)
    }

    /// Decides what each pixel shows, and paints what is not background.
    pub(super) fn decide_and_paint(&mut self, inside: Inside, crossings: &Crossings) {
        let mut bindings = vec![
            self.frame(),
            self.cut_table(),
            self.parts(),
            Binding::read("nearest", self.nearest()),
            Binding::update("painted", self.painted()),
            Binding::write("layers", self.layers()),
        ];
        bindings.extend(inside.bindings);
        bindings.extend(crossings.bindings());
        self.compute(
            "decide",
            Clock::Frame,
            "the nearest crossing that is inside a part and enters it is a cap, unless a surface is before it; pixels that show \
             something are listed",
            Shader::from("passes/rasterise/decide.wgsl").with(inside.file),
            bindings,
            self.of_lanes(),
            self.view.size_px,
        );
        self.paint();
    }

    fn paint(&mut self) {
        let groups = pixels(self.view.size_px).div_ceil(u64::from(GROUP));
        let groups = (groups as u32).clamp(1, PAINTING_GROUPS);
        let (vertices, indices) = self.mesh_in_storage(Clock::Frame);
        let mut bindings = vec![
            self.frame(),
            self.cut_table(),
            self.parts(),
            vertices,
            indices,
            self.rank_of_part(),
            Binding::read("painted", self.painted()),
            Binding::update("layers", self.layers()),
            Binding::update("picture", self.picture()),
        ];
        if let Some(screen) = self.screen_of_frame.clone() {
            bindings.extend([self.told(&screen, false), screen.drawn_parts]);
        }
        let cap_normal = self.cap_normal(&mut bindings);
        let overlap = self.overlap(&mut bindings);
        self.plan.add_pass(Pass {
            name: "paint".to_owned(),
            clock: Clock::Frame,
            reason: "the triangle that claimed a pixel gives it part, side and normal, a cap has its own; lit shading colours both"
                .to_owned(),
            shader: Shader::from("passes/rasterise/paint.wgsl")
                .with(cap_normal)
                .with(overlap),
            bindings,
            constants: vec![("stride", f64::from(groups * GROUP))],
            work: Work::Compute {
                groups: [groups, 1, 1],
            },
        });
    }

    /// The nearest kept triangle of each pixel.
    fn nearest(&mut self) -> ResourceId {
        let bytes = pixels(self.view.size_px) * 8;
        self.once("nearest", |_| {
            Resource::storage("nearest", bytes, Clock::Frame)
        })
    }

    /// The list of pixels that show something.
    fn painted(&mut self) -> ResourceId {
        let bytes = pixels(self.view.size_px) * 4 + 4;
        self.once("painted", |_| {
            Resource::storage("painted", bytes, Clock::Frame)
        })
    }
}
