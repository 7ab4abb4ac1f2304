//! Pieces of triangles that are too large for one invocation ([`Share`](super::share::Share)).

use super::scan::{Scan, ScanRange, Total};
use super::share::first_piece_at;
use crate::passes::frame::dispatch::groups_along;
use crate::passes::frame::on_screen::ScreenMesh;
use crate::plan::{Access, Arguments, Pass, Plan, Work};
use crate::shader::Shader;

impl ScreenMesh {
    /// A dispatch of one workgroup per piece.
    pub(crate) fn over_pieces(&self) -> Work {
        let arguments = Arguments {
            resource: self.pieces,
            offset: 0,
        };
        Work::ComputeIndirect { arguments }
    }

    /// Records the passes that count the pieces of the queued triangles; the passes that queue triangles must be recorded before.
    pub(crate) fn count_pieces(&self, plan: &mut Plan) {
        if self.may_clip {
            let mut bindings = self.bindings();
            bindings.push(self.queue(Access::ReadWrite));
            let pass = Pass::new(
                self.named("clipped"),
                "clips triangles at the near plane and the guard band, and counts their pieces",
                Shader::from("passes/rasterise/clipped.wgsl").with(self.rows()),
                bindings,
                Work::Compute {
                    groups: groups_along(self.triangle_count),
                },
            );
            let [_, piece_px] = self.share.constants();
            plan.add_pass(pass.on(self.clock).with_constants(vec![piece_px]));
        }
        Scan {
            name: &self.named("pieces"),
            what: "pieces of queued triangles",
            clock: self.clock,
            items: self.queue,
            run: ScanRange {
                first: first_piece_at(self.triangle_count),
                length: self.triangle_count,
                count_at: Some(0),
            },
            total: Total::Groups(self.pieces),
        }
        .record(plan);
    }
}
