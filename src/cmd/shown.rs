//! A scene as strategies draw it and as exact is asked about it: the one place that makes both.
//!
//! Exact is always asked about meshes posed in f64 on the CPU. What strategies are given is the business of
//! [`drawn_scene`] alone; where that is the same scene, it is prepared once for both.

use std::borrow::Cow;

use crate::passes::Model;
use crate::scene::{Part, Prepared, Scene};

/// A scene at one time, ready to be drawn and judged.
pub(super) struct Shown {
    /// What strategies draw.
    pub(super) model: Model,
    /// What exact is asked about, where it is not the same.
    truth: Option<Prepared>,
}

impl Shown {
    /// Prepares a scene.
    pub(super) fn of(scene: &Scene) -> Self {
        let drawn = drawn_scene(scene);
        let truth = is_posed(&drawn).then(|| Prepared::of(&drawn.posed()));
        Self {
            model: Model::of(&drawn),
            truth,
        }
    }

    /// What exact is asked about.
    pub(super) fn truth(&self) -> &Prepared {
        self.truth.as_ref().unwrap_or(&self.model.prepared)
    }
}

/// What strategies are given of a scene: meshes that are posed beforehand, as long as no pass poses them.
fn drawn_scene(scene: &Scene) -> Cow<'_, Scene> {
    if is_posed(scene) {
        Cow::Owned(scene.posed())
    } else {
        Cow::Borrowed(scene)
    }
}

fn is_posed(scene: &Scene) -> bool {
    let is_moved = |p: &Part| !p.pose.is_rest();
    scene.parts.iter().any(is_moved)
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
