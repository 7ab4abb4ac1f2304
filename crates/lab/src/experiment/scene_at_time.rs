//! The only place that prepares scenes for the strategies and for the exact reference.
//!
//! The exact reference always uses meshes posed in f64 on the CPU; strategies pose them on the device. If nothing is posed, the
//! scene is prepared once for both.

use std::sync::OnceLock;

use cutaway::layers::NEAR_PLANE;
use cutaway::passes::Model;
use cutaway::scene::{Prepared, Scene};
use cutaway::strategies::DrawOptions;
use cutaway::{Error, Result};
use cutaway_io::document::Settings;

/// A scene at one point in time, ready to be drawn and evaluated.
#[derive(Debug)]
pub struct SceneAtTime {
    /// Model that strategies draw.
    pub model: Model,
    scene: Scene,
    /// Model for the exact reference, created on first use.
    truth: OnceLock<Prepared>,
}

impl SceneAtTime {
    /// Prepares a scene.
    pub fn new(scene: &Scene) -> Self {
        Self::with(Model::new(scene), scene)
    }

    /// Prepares the next state of this scene in time, reusing what has not changed.
    pub fn updated(&self, scene: &Scene) -> Self {
        Self::with(self.model.updated(scene), scene)
    }

    /// Prepares the next state of this scene without reusing anything ([`Model::anew`]).
    pub fn anew(&self, scene: &Scene) -> Self {
        Self::with(self.model.anew(scene), scene)
    }

    fn with(model: Model, scene: &Scene) -> Self {
        Self {
            model,
            scene: scene.clone(),
            truth: OnceLock::new(),
        }
    }

    /// Model for the exact reference. As with strategies, it is an error if a clip-surface number could exceed what layers can store.
    pub fn truth(&self) -> Result<&Prepared> {
        let truth = if self.model.prepared.is_whole() {
            &self.model.prepared
        } else {
            let of_model = || self.model.truth(&self.scene).into_owned();
            self.truth.get_or_init(of_model)
        };
        must_be_named(truth)?;
        Ok(truth)
    }
}

/// The draw options that a document's settings give.
pub fn draw_options(settings: &Settings) -> Result<DrawOptions> {
    Ok(DrawOptions {
        rasteriser: settings
            .strategy
            .rasteriser
            .as_deref()
            .map(str::parse)
            .transpose()?,
        height_filter: settings.height_filter,
        ..DrawOptions::default()
    })
}

fn must_be_named(truth: &Prepared) -> Result<()> {
    let count = usize::from(NEAR_PLANE);
    let is_beyond = |cut: &&usize| truth.cuts[**cut].surfaces.iter().any(|s| *s >= count);
    match truth.parts.iter().flat_map(|p| &p.cuts).find(is_beyond) {
        Some(cut) => Err(Error::input(
            format!("cut `{}`", truth.cuts[*cut].name),
            format!(
                "exact supports {count} clip-surfaces in all, and the surfaces of this cut exceed that number"
            ),
            "use fewer cuts, or boxes and wedges with fewer faces",
        )),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec3;

    use super::*;
    use cutaway::generate::shapes::shape;
    use cutaway::scene::{ClipSurface, Cut, Motion};

    /// A cube whose one morph target moves it along x by 2.
    fn cube(weight: f64) -> Scene {
        let mut parts = shape("cube").unwrap();
        let count = parts[0].mesh.positions.len();
        parts[0].motion = Some(Arc::new(Motion {
            targets: vec![vec![DVec3::X * 2.0; count]],
            ..Motion::default()
        }));
        parts[0].pose.weights = vec![weight];
        Scene {
            parts,
            stage: Some(cutaway::scene::Bounds {
                min: DVec3::splat(-4.0),
                max: DVec3::splat(4.0),
            }),
            ..Scene::default()
        }
    }

    #[test]
    fn exact_is_not_asked_for_numbers_that_layers_cannot_hold() {
        let cut = |at: f64| {
            let plane = ClipSurface::plane(DVec3::Z * at, DVec3::NEG_Z);
            Cut::new(format!("at {at}"), vec![plane])
        };
        for (count, is_refused) in [(255, false), (256, true)] {
            let mut scene = cube(0.0);
            scene.cuts = (0..count).map(|i| cut(f64::from(i) + 0.5)).collect();
            let shown = SceneAtTime::new(&scene);
            match shown.truth() {
                Ok(_) => assert!(!is_refused, "{count}"),
                Err(error) => {
                    assert!(error.to_string().contains("at 255.5"), "{error}")
                }
            }
        }
    }

    #[test]
    fn strategies_and_exact_are_given_the_same_pose() {
        for (weight, centre) in [(0.0, 0.0), (1.0, 2.0), (0.25, 0.5)] {
            let shown = SceneAtTime::new(&cube(weight));
            for prepared in [&shown.model.prepared, shown.truth().unwrap()] {
                let x = prepared.parts[0].bounds.centre().x / prepared.scale;
                assert!((x - centre).abs() < 1e-6, "{x} at weight {weight}");
            }
        }
    }
}
