//! The planes of a scene's cuts, and the region of each plane that is a cap: on the removed sides of the other clip-surfaces of the plane's
//! cut, where no other cut removes the solid behind the plane.
//!
//! Tie rule: among coplanar clip-surfaces that keep the same side, the first has the cap; two clip-surfaces that keep opposite sides
//! have no cap.

use cutaway::scene::numbers::round;
use cutaway::scene::{Part, Scene};
use cutaway::slice::{HalfPlane, SlicePlane, Trim};
use cutaway::{Error, Result};
use cutaway_io::save::section::SectionFace;
use glam::{DVec2, DVec3};

/// Tolerance for parallel and for coincident planes, relative to the sizes involved.
const PARALLEL: f64 = 1e-12;

/// A plane, the cut that it belongs to, and its number in the scene.
pub(super) struct CutPlane {
    /// Index of the cut.
    pub(super) cut: usize,
    /// Number of the clip-surface.
    pub(super) number: usize,
    /// Face of the cut.
    pub(super) face: SectionFace,
    /// Position for parts without an offset.
    pub(super) plane: SlicePlane,
}

/// Position of one plane relative to another.
enum RelativeSide {
    /// The plane is entirely on the other's kept side.
    Kept,
    /// The plane is entirely on the other's removed side.
    Removed,
    /// One half-plane of the plane is on the other's removed side.
    Crossed(HalfPlane),
    /// The planes coincide; `is_opposite` is true if they keep opposite sides.
    Same { is_opposite: bool },
}

impl CutPlane {
    /// The plane for a part, with the cut's offset for that part.
    pub(super) fn for_part(&self, scene: &Scene, part: &Part) -> SlicePlane {
        self.plane.keeping(scene.cuts[self.cut].offset_for(part))
    }

    /// Trims a part's section in this plane, which is at `at` for the part; `size` is the part's size. `None` if nothing is left.
    pub(super) fn trim(
        &self,
        (scene, planes): (&Scene, &[Self]),
        part: &Part,
        at: &SlicePlane,
        size: f64,
    ) -> Option<Trim> {
        let mut trim = Trim::default();
        let side = |other: &Self| side(at, &other.for_part(scene, part), size);
        let own = planes.iter().filter(|p| p.cut == self.cut);
        for other in own.filter(|p| p.number != self.number) {
            match side(other) {
                RelativeSide::Removed => {}
                RelativeSide::Crossed(half) => trim.within.push(half),
                RelativeSide::Same { is_opposite: false } if other.number > self.number => {}
                RelativeSide::Kept | RelativeSide::Same { .. } => return None,
            }
        }
        let others = (0..scene.cuts.len()).filter(|c| *c != self.cut);
        for cut in others.filter(|c| scene.cuts[*c].applies_to(part)) {
            let of_cut = planes.iter().filter(|p| p.cut == cut);
            let region: Option<Vec<Option<HalfPlane>>> = of_cut
                .map(|other| match side(other) {
                    RelativeSide::Removed | RelativeSide::Same { is_opposite: true } => Some(None),
                    RelativeSide::Same { is_opposite: false } if cut < self.cut => Some(None),
                    RelativeSide::Crossed(half) => Some(Some(half)),
                    RelativeSide::Kept | RelativeSide::Same { .. } => None,
                })
                .collect();
            let Some(region) = region else {
                continue;
            };
            let region: Vec<HalfPlane> = region.into_iter().flatten().collect();
            if region.is_empty() {
                return None;
            }
            trim.without.push(region);
        }
        Some(trim)
    }
}

/// Position of a plane relative to another, with tolerances for a model of this size.
fn side(plane: &SlicePlane, other: &SlicePlane, size: f64) -> RelativeSide {
    let outward = other.frame.normal;
    let normal = DVec2::new(
        outward.dot(plane.frame.u_hat),
        outward.dot(plane.frame.v_hat),
    );
    let offset = other.height(plane.zero);
    if normal.length() > PARALLEL {
        return RelativeSide::Crossed(HalfPlane { normal, offset });
    }
    let far = |p: DVec3| p.abs().max_element();
    let reach = size + far(plane.zero) + far(other.origin);
    if offset.abs() <= PARALLEL * reach {
        let is_opposite = outward.dot(plane.frame.normal) < 0.0;
        RelativeSide::Same { is_opposite }
    } else if offset < 0.0 {
        RelativeSide::Removed
    } else {
        RelativeSide::Kept
    }
}

/// The planes of all cuts; an error if there is none, or if a clip-surface is not a plane.
pub(super) fn planes(scene: &Scene) -> Result<Vec<CutPlane>> {
    let mut planes = Vec::new();
    // Clip-surfaces of a disabled cut keep their numbers, and a cutter has the number after the other clip-surfaces of its cut.
    let mut next = 0;
    for (index, cut) in scene.cuts.iter().enumerate() {
        let first = next;
        next += cut.surfaces.len() + usize::from(cut.volume.is_some());
        if !cut.enabled {
            continue;
        }
        if let Some(cutter) = &cut.volume {
            return Err(Error::input(
                format!("cut `{}`", cut.name),
                format!(
                    "{} is a mesh that cuts, but a section must be flat",
                    cutter.name()
                ),
                "leave it out, or see the cap with `cutaway render`",
            ));
        }
        for (number, surface) in (first..).zip(&cut.surfaces) {
            let Some(plane) = SlicePlane::of_flat(surface) else {
                return Err(Error::input(
                    format!("cut `{}`", cut.name),
                    format!("clip-surface {number} has a relief, but a section must be flat"),
                    "leave the relief out, or see the ragged cap with `cutaway render`",
                ));
            };
            planes.push(CutPlane {
                cut: index,
                number,
                face: face(scene, index, number - first, &plane),
                plane,
            });
        }
    }
    if planes.is_empty() {
        return Err(Error::input(
            "section",
            "there is no plane to cut by",
            "add --section SPEC, for example --section z=50%",
        ));
    }
    Ok(planes)
}

/// The cut's face that a plane forms. Cuts with the same name form one region: a wedge of more than half a turn has several cuts.
fn face(scene: &Scene, cut: usize, within: usize, plane: &SlicePlane) -> SectionFace {
    let name = &scene.cuts[cut].name;
    let kin = |cuts: &[cutaway::scene::Cut]| -> usize {
        let kin = cuts.iter().filter(|c| c.enabled && c.name == *name);
        kin.map(|c| c.surfaces.len()).sum()
    };
    SectionFace {
        number: kin(&scene.cuts[..cut]) + within + 1,
        of: kin(&scene.cuts),
        plane: spec(plane),
    }
}

/// A plane in the syntax of `--section`.
fn spec(plane: &SlicePlane) -> String {
    let (normal, origin) = (plane.frame.normal, plane.origin);
    let axis = (0..3).find(|i| normal[*i].abs() == 1.0);
    let Some(axis) = axis else {
        let numbers = [normal.x, normal.y, normal.z, origin.dot(normal)];
        return numbers.map(|n| round(n + 0.0)).join(",");
    };
    let sign = if normal[axis] < 0.0 { "-" } else { "" };
    let at = round(origin[axis] + 0.0);
    format!("{sign}{}={at}", ["x", "y", "z"][axis])
}
