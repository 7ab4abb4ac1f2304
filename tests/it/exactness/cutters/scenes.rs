//! Cutters and what they cut, in few words.

use std::sync::{Mutex, OnceLock, PoisonError};

use cutaway::scene::{Cut, Cutter, Mesh, Part, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{DrawOptions, Method, Rasteriser};
use glam::{DAffine3, DVec3};

use super::common::{Judged, Question, gpu, meshes, scenes, strategy};

/// The answer of a strategy that draws the mesh by the compute rasteriser, in a session of its own.
pub(crate) fn judged_by_compute(question: &Question, name: &str) -> Judged {
    static SESSION: OnceLock<Mutex<Session>> = OnceLock::new();
    let session = SESSION.get_or_init(|| {
        let gpu = gpu();
        Mutex::new(Session::new(gpu))
    });
    let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
    let method = Method::new(strategy(name), DrawOptions::by(Rasteriser::Compute));
    let drawn = session.draw(&question.model, &question.view, method);
    let outcome = drawn.unwrap_or_else(|e| panic!("{name}: {e}")).outcome;
    assert!(
        !matches!(outcome, Outcome::Refused(_)),
        "{name}: {outcome:?}"
    );
    question.judge(&session, method, outcome)
}

/// A cutter of a mesh where it is.
pub(crate) fn cutter(mesh: Mesh) -> Cutter {
    Cutter::new("cutter", mesh).expect("a closed mesh")
}

/// A built-in shape as a cutter, as large as `size` times what it is, at a place.
pub(crate) fn shaped(spec: &str, size: f64, at: DVec3) -> Cutter {
    let parts = meshes::parts(spec);
    let cutter = Cutter::from_parts(spec, &parts).expect("a closed shape");
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
