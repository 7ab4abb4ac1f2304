//! How the samples of triangles are shared out to invocations, and the pieces of those that are too large for one.
//!
//! **Bounded work.** Drivers end loops: llvmpipe after 65,535 rounds of all loops of an invocation together, cards by a watchdog. A covered
//! sample takes as many rounds as its crossings, its lane and its settled faces say; how many samples an invocation may cover follows from
//! that ([`Share`](super::share::Share)), and nothing else grows with mesh or picture. What is larger is queued, by whichever pass goes over the triangles first;
//! a prefix sum over the queue counts the pieces, and one workgroup is dispatched for each (`shaders/lib/pieces.wgsl`).
//!
//! Cannot: stay below that limit of llvmpipe where one sample alone takes more than 700 rounds, as with lists of that many crossings with
//! several clip-surfaces; a triangle of 64 samples in a line is then cut off, which the parity bit shows.

use super::scan::{Run, Scan, Total};
use super::share::first_piece_at;
use crate::passes::frame::dispatch::groups_along;
use crate::passes::frame::on_screen::Screen;
use crate::plan::{Access, Arguments, Pass, Plan, Work};
use crate::shader::Shader;

impl Screen {
    /// A dispatch of one workgroup for each piece.
    pub(crate) fn over_pieces(&self) -> Work {
        let arguments = Arguments {
            resource: self.pieces,
            offset: 0,
        };
        Work::ComputeIndirect { arguments }
    }

    /// Records how the queued triangles are shared out, once they are all there.
    pub(crate) fn count_pieces(&self, plan: &mut Plan) {
        if self.may_clip {
            let mut bindings = self.bindings();
            bindings.push(self.queue(Access::ReadWrite));
            let pass = Pass::new(
                self.named("clipped"),
                "what the near plane and the guard band leave of triangles, in pieces",
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
            run: Run {
                first: first_piece_at(self.triangle_count),
                length: self.triangle_count,
                count_at: Some(0),
            },
            total: Total::Groups(self.pieces),
        }
        .record(plan);
    }
}
