//! Parts driven by the crank: rods, pistons and their pins.

use glam::{DVec2, DVec3};

use super::super::Mesh;
use super::super::lathe::turned;
use super::super::milled::{Facing, Milled, WallSide};
use super::super::outline::{arc, circle, subdivided};
use super::{CROWN, Engine, PISTON, PISTON_INSIDE, PISTON_PIN, ROD, SKIRT, along, upright};
use crate::Result;

impl Engine {
    /// A rod: two eyes and the shank between them, in the plane perpendicular to the crank.
    pub(super) fn rod(&self, k: usize) -> Result<Mesh> {
        let (pin, small) = (self.pins[k], self.piston_pin(k));
        let [big_at, small_at] = [pin, small].map(|p| DVec2::new(p.y, p.z));
        let up = (small_at - big_at) / ROD;
        let place = |p: DVec2| big_at + up * p.x + up.perp() * p.y;
        let (big, eye) = (0.168, 0.075);
        // Common tangents of both eyes.
        let lean = ((big - eye) / ROD).acos();
        let step = self.step();
        let full = std::f64::consts::TAU;
        let mut outline = arc(DVec2::X * ROD, eye, [-lean, lean], step);
        outline.extend(arc(DVec2::ZERO, big, [lean, full - lean], step));
        let outline: Vec<DVec2> = subdivided(&outline, 4.0 * step)
            .into_iter()
            .map(place)
            .collect();
        let mut solid = Milled::default();
        let thick = [pin.x - 0.055, pin.x + 0.055];
        let rim = solid.walls(WallSide::Outer, thick.map(|x| (x, outline.clone())));
        let (mut back, mut front) = (vec![rim.0], vec![rim.1]);
        for (at, radius) in [(big_at, 0.1205), (small_at, PISTON_PIN + 0.0005)] {
            let hole = circle(at, radius, self.fine.corners(radius));
            let hole = solid.walls(WallSide::Bore, thick.map(|x| (x, hole.clone())));
            back.push(hole.0);
            front.push(hole.1);
        }
        solid.face(Facing::Back, &back, 4.0 * step);
        solid.face(Facing::Front, &front, 4.0 * step);
        solid.mesh(along)
    }

    /// A piston: a cup with grooves for three rings.
    pub(super) fn piston(&self, k: usize) -> Result<Mesh> {
        let pin = self.piston_pin(k);
        let (bottom, top) = (pin.y - SKIRT, pin.y + CROWN);
        let mut profile = vec![[bottom, PISTON]];
        for groove in [0.085, 0.06, 0.035] {
            let (from, to) = (top - groove, top - groove + 0.012);
            let narrow = PISTON - 0.012;
            profile.extend([[from, PISTON], [from, narrow], [to, narrow], [to, PISTON]]);
        }
        profile.push([top, PISTON]);
        let centre = DVec2::new(0.0, pin.x);
        let corners = self.fine.corners(PISTON);
        let mut solid = Milled::default();
        let outside = turned(
            &mut solid,
            WallSide::Outer,
            centre,
            corners,
            self.fine.profile(&profile),
        );
        let inside = [[bottom, PISTON_INSIDE], [top - 0.1, PISTON_INSIDE]];
        let inside = turned(
            &mut solid,
            WallSide::Bore,
            centre,
            corners,
            self.fine.profile(&inside),
        );
        let spacing = 4.0 * self.step();
        solid.face(Facing::Back, &[outside.0, inside.0], spacing);
        solid.face(Facing::Back, &[inside.1], spacing);
        solid.face(Facing::Front, &[outside.1], spacing);
        solid.mesh(upright)
    }

    pub(super) fn pin(&self, k: usize) -> Result<Mesh> {
        let pin = self.piston_pin(k);
        let at = DVec2::new(pin.y, pin.z);
        self.rod_of([pin.x - 0.165, pin.x + 0.165], at, PISTON_PIN, along)
    }

    /// A plain cylinder between two stations.
    fn rod_of(
        &self,
        [from, to]: [f64; 2],
        at: DVec2,
        radius: f64,
        place: impl Fn(f64, DVec2) -> DVec3,
    ) -> Result<Mesh> {
        let mut solid = Milled::default();
        let profile = self.fine.profile(&[[from, radius], [to, radius]]);
        let rim = turned(
            &mut solid,
            WallSide::Outer,
            at,
            self.fine.corners(radius),
            profile,
        );
        solid.face(Facing::Back, &[rim.0], 4.0 * self.step());
        solid.face(Facing::Front, &[rim.1], 4.0 * self.step());
        solid.mesh(place)
    }
}
