//! Camera arguments of a call. They replace the values of the scene that contradict them.

use cutaway_io::document::{Document, Node, Origin, Value};

use crate::door::Result;

/// The three groups of keys that can define the position of the eye.
const BY_VIEW: [&str; 1] = ["view"];
const BY_PLACE: [&str; 3] = ["position", "focal_point", "view_up"];
const BY_ANGLES: [&str; 2] = ["azimuth_deg", "elevation_deg"];

/// Sets values of the camera; missing angles are computed.
pub(crate) fn aim(document: &mut Document, values: Vec<(String, Value)>) -> Result<()> {
    let is_new = document.root().get("camera").is_none();
    let says = |keys: &[&str]| values.iter().any(|(key, _)| keys.contains(&key.as_str()));
    let contradicted: Vec<&str> = if says(&BY_VIEW) {
        [&BY_PLACE[..], &BY_ANGLES].concat()
    } else if says(&BY_PLACE[..1]) {
        [&BY_VIEW[..], &BY_ANGLES].concat()
    } else if says(&BY_ANGLES) {
        [&BY_VIEW[..], &BY_PLACE].concat()
    } else {
        Vec::new()
    };
    for key in contradicted.iter().filter(|key| !says(&[**key])) {
        document.remove(&format!("camera.{key}"))?;
    }
    if says(&["projection"]) {
        document.remove("camera.fov_y_deg")?;
    }
    for (key, value) in values {
        let origin = Origin::Option(format!("camera {key}").into());
        document.set_node(&format!("camera.{key}"), Node::new(value).said(&origin))?;
    }
    if is_new {
        document.find_angles()?;
    }
    Ok(())
}
