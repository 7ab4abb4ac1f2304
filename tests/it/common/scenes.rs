//! Scenes, cameras and clip-surfaces in few words: those of the hard cases, and a scene file.

use std::path::Path;

pub(crate) use cutaway_lab::hard_cases::scenes::*;

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
