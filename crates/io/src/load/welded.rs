//! Motion of welded vertices. Each follows the first of the vertices that were welded together.
//!
//! If a file splits vertices for normals or textures, the copies have the same motion, up to rounding. Where the motions differ, the file
//! would tear the seam open. The seam stays closed, and a note reports that its vertices do not follow the file.

use cutaway::error::Diagnostic;
use cutaway::scene::weld::thousands;
use cutaway::scene::{Mesh, Motion};

/// Weights that differ by less than this are considered equal.
const SAME_WEIGHT: f64 = 1e-4;

/// Displacements that differ by less than this fraction of the mesh's diagonal are considered equal.
const SAME_DISPLACEMENT: f64 = 1e-6;

/// Computes the motion of a welded mesh. `mesh` and `motion` are those before welding.
pub(super) fn motion(
    mesh: &Mesh,
    motion: &Motion,
    new_from_old: &[u32],
    notes: &mut Vec<Diagnostic>,
) -> Motion {
    if *motion == Motion::default() {
        return Motion::default();
    }
    let mut firsts: Vec<u32> = Vec::new();
    for (old, new) in (0..).zip(new_from_old) {
        if *new as usize == firsts.len() {
            firsts.push(old);
        }
    }
    let near = SAME_DISPLACEMENT * mesh.bounds().size().length();
    let goes_astray = |old: usize| {
        let first = firsts[new_from_old[old] as usize] as usize;
        first != old
            && (weights_differ(motion, old, first)
                || (0..motion.targets.len()).any(|target| {
                    let of = |i| motion.displacement(target, i);
                    of(old).distance(of(first)) > near
                }))
    };
    let astray = (0..new_from_old.len())
        .filter(|old| goes_astray(*old))
        .count();
    if astray > 0 {
        notes.push(Diagnostic::note(
            "welded-motion",
            format!(
                "{} vertices move differently from the vertices they were welded to; now they move with them",
                thousands(astray)
            ),
        ));
    }
    motion.of_positions(&firsts)
}

fn weights_differ(motion: &Motion, a: usize, b: usize) -> bool {
    let (a, b) = (motion.pulls_of(a), motion.pulls_of(b));
    let weight = |of: &[cutaway::scene::JointWeight], joint| {
        let pull = of.iter().find(|pull| pull.joint == joint);
        pull.map_or(0.0, |pull| f64::from(pull.weight))
    };
    let mut joints = a.iter().chain(b).map(|pull| pull.joint);
    joints.any(|joint| (weight(a, joint) - weight(b, joint)).abs() > SAME_WEIGHT)
}
