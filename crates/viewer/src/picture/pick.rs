//! Description of a picked pixel, as text and in model coordinates.

use cutaway::layers::{Kind, Layer, NEAR_PLANE};
use cutaway::scene::View;
use glam::{DVec2, DVec3};

use crate::picture::shown::Shown;

/// Result of picking.
#[derive(Clone, Debug, PartialEq)]
pub struct Picked {
    /// Surface, cap or background.
    pub kind: Kind,
    /// The visible part.
    pub part: String,
    /// Name of the cut that made the cap; `None` for a surface.
    pub cut: Option<String>,
    /// Distance from the eye along the viewing direction, in units of the model.
    pub depth: f64,
    /// Position in the world.
    pub point: DVec3,
    /// Unit vector away from the solid.
    pub normal: DVec3,
    /// True if the rendering method marks the pixel as unreliable.
    pub is_unreliable: bool,
}

impl Picked {
    /// Describes the layer of a pixel of a view; `None` for the background.
    pub fn new(layer: &Layer, shown: &Shown, view: &View, at_px: [u32; 2]) -> Option<Self> {
        if layer.kind == Kind::Background {
            return None;
        }
        let prepared = &shown.at.model.prepared;
        let (origin, direction) = view.ray(DVec2::from(at_px.map(f64::from)) + 0.5);
        let in_scene = origin + direction * layer.depth;
        let surface = usize::from(layer.clip_surface);
        let maker = prepared.cuts.iter().find(|c| c.surfaces.contains(&surface));
        let cut = match layer.kind {
            Kind::Cap if layer.clip_surface == NEAR_PLANE => Some("the near plane".to_owned()),
            Kind::Cap => maker.map(|cut| cut.name.clone()),
            _ => None,
        };
        let part = shown.scene.parts.get(usize::from(layer.part));
        Some(Self {
            kind: layer.kind,
            part: part.map(|part| part.name.clone()).unwrap_or_default(),
            cut,
            depth: layer.depth / prepared.scale,
            point: in_scene / prepared.scale + prepared.centre_in_world,
            normal: layer.normal.as_dvec3(),
            is_unreliable: layer.unreliable,
        })
    }

    /// The result as text.
    pub fn sentence(&self) -> String {
        let what = match &self.cut {
            Some(cut) => format!("cap by {cut}"),
            None => "surface".to_owned(),
        };
        let [x, y, z] = self.point.to_array();
        let doubt = if self.is_unreliable {
            ", uncertain"
        } else {
            ""
        };
        let (part, depth) = (&self.part, self.depth);
        format!("{part}: {what} at ({x:.4}, {y:.4}, {z:.4}), {depth:.4} away{doubt}")
    }
}
