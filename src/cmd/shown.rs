//! A scene as strategies draw it and as exact is asked about it: the one place that makes both.
//!
//! Exact is always asked about meshes posed in f64 on the CPU; strategies pose them on the device. Where nothing is posed, a
//! scene is prepared once for both.

use std::sync::OnceLock;

use crate::passes::Model;
use crate::scene::{Prepared, Scene};

/// A scene at one time, ready to be drawn and judged.
pub(super) struct Shown {
    /// What strategies draw.
    pub(super) model: Model,
    scene: Scene,
    /// What exact is asked about, once it is.
    truth: OnceLock<Prepared>,
}

impl Shown {
    /// Prepares a scene.
    pub(super) fn of(scene: &Scene) -> Self {
        Self::with(Model::of(scene), scene)
    }

    /// Prepares a scene that follows this one in time; what has not changed is not prepared again.
    pub(super) fn updated(&self, scene: &Scene) -> Self {
        Self::with(self.model.updated(scene), scene)
    }

    fn with(model: Model, scene: &Scene) -> Self {
        Self {
            model,
            scene: scene.clone(),
            truth: OnceLock::new(),
        }
    }

    /// What exact is asked about.
    pub(super) fn truth(&self) -> &Prepared {
        if self.model.prepared.is_whole() {
            return &self.model.prepared;
        }
        self.truth.get_or_init(|| Prepared::of(&self.scene))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec3;

    use super::*;
    use crate::scene::Motion;
    use crate::scene::shapes::shape;

    /// A cube whose one target takes it along x by 2.
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
            stage: Some(crate::scene::Bounds {
                min: DVec3::splat(-4.0),
                max: DVec3::splat(4.0),
            }),
            ..Scene::default()
        }
    }

    #[test]
    fn strategies_and_exact_are_given_the_same_pose() {
        for (weight, centre) in [(0.0, 0.0), (1.0, 2.0), (0.25, 0.5)] {
            let shown = Shown::of(&cube(weight));
            for prepared in [&shown.model.prepared, shown.truth()] {
                let x = prepared.parts[0].bounds.centre().x / prepared.scale;
                assert!((x - centre).abs() < 1e-6, "{x} at weight {weight}");
            }
        }
    }
}
