//! Cutters and what they cut, in few words.

use cutaway::scene::{Cut, Cutter, Mesh, Part, Scene};
use glam::{DAffine3, DVec3};

use super::common::{meshes, scenes};

/// A cutter of a mesh where it is.
pub(crate) fn cutter(mesh: Mesh) -> Cutter {
    Cutter::of("cutter", mesh).expect("a closed mesh")
}

/// A built-in shape as a cutter, as large as `size` times what it is, at a place.
pub(crate) fn shaped(spec: &str, size: f64, at: DVec3) -> Cutter {
    let parts = meshes::parts(spec);
    let cutter = Cutter::of_parts(spec, &parts).expect("a closed shape");
    cutter.placed(DAffine3::from_translation(at) * DAffine3::from_scale(DVec3::splat(size)))
}

/// A scene of parts and a cut by each cutter, seen from the usual place.
pub(crate) fn bitten(name: &str, parts: Vec<Part>, cutters: Vec<Cutter>) -> Scene {
    let mut scene = scenes::of_parts(name, parts, Vec::new());
    scene.cuts = cutters.into_iter().map(Cut::by).collect();
    scene
}

/// The same of one mesh.
pub(crate) fn solid(name: &str, mesh: Mesh, cutters: Vec<Cutter>) -> Scene {
    bitten(name, vec![Part::new("solid", mesh)], cutters)
}
