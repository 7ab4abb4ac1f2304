//! Notes about unexpected properties of a frame.

use cutaway::Model;
use cutaway::gpu::Gpu;
use cutaway::passes::Rasteriser;
use cutaway::scene::{Fill, Scene, Topology, empty_picture, misses};
use cutaway_lab::compare::FrameCounts;
use cutaway_lab::experiment::Renderer;

use super::console::Console;
use super::verdict::Verdict;

/// Description of the adapter, for fault reports.
pub(super) fn adapter_in_words(gpu: &Gpu) -> String {
    let report = gpu.report();
    let bits = match report.sub_pixel_bits {
        Some(bits) => format!("{bits} sub-pixel bits"),
        None => "sub-pixel bits unknown".to_owned(),
    };
    format!("adapter: {}, {}, {bits}", report.name, report.driver)
}

/// Strategies that mark no pixel of a closed mesh. If one does, it is a fault of the program or of the driver.
const MARK_OPEN_MESHES_ALONE: [&str; 4] = [
    "raycast+mask",
    "raycast+winding",
    "raycast+abuffer",
    "raycast+stencil",
];

/// Returns true if the mesh cannot cause marked pixels: all parts are closed and filled even-odd.
fn is_own_fault(renderer: Renderer, scene: &Scene) -> bool {
    let Renderer::Method(method) = renderer else {
        return false;
    };
    let strategy = method.strategy.to_string();
    MARK_OPEN_MESHES_ALONE.contains(&strategy.as_str())
        && scene.parts.iter().all(|p| p.fill == Fill::EvenOdd)
        && Topology::from_parts(&scene.parts).closed
}

/// Reports open parts whose inside winding numbers decide.
fn note_open_parts(count_px: usize, open: &str, console: &Console) {
    match count_px {
        0 => console.note(open),
        _ => console.warn(format!(
            "{open}; {count_px} px may be wrong: the number there is near a half\n  help: --close-holes closes planar and small holes \
             (`cutaway inspect` shows where holes are)"
        )),
    }
}

/// Warns of `count` pixels that may be wrong because the mesh is open along their rays. With a closed mesh, such pixels are a fault of the
/// program or of the driver, and the frame has failed.
pub(super) fn warn_of_doubt(
    count: usize,
    renderer: Renderer,
    (scene, model): (&Scene, &Model),
    console: &Console,
) -> Verdict {
    if let Some(open) = renderer.open_parts_in_words(model) {
        note_open_parts(count, &open, console);
        return Verdict::Done;
    }
    if count == 0 {
        return Verdict::Done;
    }
    if is_own_fault(renderer, scene) {
        let other = match renderer {
            Renderer::Method(m) if m.options.rasteriser == Some(Rasteriser::Compute) => "hardware",
            _ => "compute",
        };
        console.internal_error(format!(
            "{count} px have an odd number of crossings, though every part is closed: a fault of cutaway or of the \
             graphics driver, not of the mesh\n  help: please report it, with the command and what --verbose prints; try --rasteriser \
             {other}"
        ));
        return Verdict::Failed;
    }
    let other = match renderer {
        Renderer::Cpu(_) => "",
        Renderer::Method(_) => ", or see whether --strategy exact shows what you expect",
    };
    console.warn(format!(
        "{count} px may be wrong: the mesh is open along their rays, so that a cap may be missing there or shown where there is \
         none\n  help: --close-holes closes planar and small holes (`cutaway inspect` shows where holes are){other}"
    ));
    Verdict::Done
}

/// Warns of a picture that is empty or has no caps: nearly always the camera or the kept side is wrong.
pub(super) fn note_what_is_not_seen(counts: &FrameCounts, scene: &Scene, console: &Console) {
    let mut enabled = scene.cuts.iter().filter(|c| c.enabled);
    if misses(scene).next().is_some() {
        // A cut that misses the model is already reported.
    } else if counts.background == counts.total() {
        console.print(&empty_picture(scene));
    } else if enabled.next().is_some() && counts.cap == 0 {
        console.note(
            "no cap is seen in this picture: the cut misses the solid, or is seen from behind (see \
             --camera-azimuth-angle and --flip)",
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::generate::shapes::shape;

    #[test]
    fn marks_on_closed_meshes_are_no_fault_of_the_mesh() {
        let scene = Scene {
            parts: shape("cube").unwrap_or_else(|e| panic!("{e}")),
            ..Scene::default()
        };
        let by = |name: &str| -> Renderer { name.parse().unwrap_or_else(|e| panic!("{e}")) };
        assert!(is_own_fault(by("raycast+mask@compute"), &scene));
        // Approximating strategies mark pixels for other reasons, and winding counts may overflow.
        assert!(!is_own_fault(by("raycast+vds:64"), &scene));
        assert!(!is_own_fault(by("exact"), &scene));
        let mut nonzero = scene.clone();
        nonzero.parts[0].fill = Fill::Nonzero;
        assert!(!is_own_fault(by("raycast+mask"), &nonzero));
        let mut open = scene;
        std::sync::Arc::make_mut(&mut open.parts[0].mesh)
            .triangles
            .pop();
        assert!(!is_own_fault(by("raycast+mask"), &open));
    }
}
