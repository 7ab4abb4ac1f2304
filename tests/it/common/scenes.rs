//! Scenes, cameras and clip-surfaces in few words: those of the hard cases, and a scene file.

use std::path::Path;

use cutaway::scene::Scene;
use cutaway_lab::hard_cases::cases;

pub(crate) use cutaway_lab::hard_cases::scenes::*;

/// The scenes of a hard case, by its file, for pictures of so many pixels along a side.
#[track_caller]
pub(crate) fn of_case(file: &str, size_px: u32) -> Vec<Scene> {
    let case = cases().find(|c| c.document.name() == file);
    let case = case.unwrap_or_else(|| panic!("there is no {file}.toml"));
    case.scenes(size_px).expect("scenes")
}

/// A torus cut by a slanted plane.
pub(crate) fn torus_cut() -> Scene {
    sectioned("torus?segments=40&sides=20", &["-0.3,-1,-0.2@50%,50%,50%"])
}

/// A scene file of the gears of an assembly: two are turned against each other in four seconds, by so many degrees.
pub(crate) fn turning_gears(mesh: &Path, section: &str, turn_deg: f64) -> String {
    let gear = |name: &str, solid: &str, turn_deg: f64| {
        format!(
            r#"
[[part]]
name = "{name}"
mesh = '{0}'
only = ["{solid}"]
pivot = "centre"
rotate_deg = [0, 0, 0]
[[key]]
target = "part.{name}.rotate_deg.2"
times_s = [0, 4]
values = [0, {turn_deg:?}]
"#,
            mesh.display()
        )
    };
    format!(
        r#"
[[part]]
name = "still"
mesh = '{0}'
except = ["gear 2", "gear 3"]
{1}{2}
[[cut]]
surfaces = [{{ section = "{section}" }}]
"#,
        mesh.display(),
        gear("left", "gear 2", turn_deg),
        gear("right", "gear 3", -turn_deg)
    )
}
