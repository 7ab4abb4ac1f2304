//! A case: scenes with a known answer, and what each strategy is expected to make of them.
//!
//! A case says what exact strategies and the paper's own make of it, and how its cuts are made; what the others make follows from what
//! they are. Where one does not do as its kind does, the case names it.

use std::sync::Arc;

use cutaway::scene::{Camera, Projection, Scene, Viewpoint, glob_matches};
use cutaway::strategies::{Method, Strategy, Unsupported};
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Node};
use cutaway_io::load::Assets;

use super::Judged;
use super::expected::Expected::{
    self, Band, Doubted, Exact, Fails, FailsWithin, Listed, Marked, Overflows, Refuses,
    RefusesSome, Share,
};
use super::files::Embedded;
use super::tolerances::FACTOR;

/// What makes the cuts of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One plane, of one cut.
    Plane,
    /// Several planes.
    Planes,
    /// At least one relief.
    Reliefs,
    /// Reliefs, some of which are flat and so planes.
    FlatReliefs,
}

impl Form {
    /// Whether there is a relief among the cuts.
    pub fn has_reliefs(self) -> bool {
        matches!(self, Self::Reliefs | Self::FlatReliefs)
    }
}

/// A row of the table, read from its file.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its number in the list of hard cases, or its letter and number where users of other projects met it.
    pub id: String,
    /// What it is.
    pub name: String,
    /// What makes its cuts.
    pub form: Form,
    /// What exact strategies make of it.
    pub exact: Expected,
    /// What the paper's own strategy makes of it.
    pub paper: Expected,
    /// Who makes something else of it than its kind does, by a glob over names.
    pub apart: Vec<(String, Expected)>,
    /// What is expected otherwise where there are fewer than 8 sub-pixel bits, by a glob over names.
    pub coarse: Vec<(String, Expected)>,
    /// Wrong pixels by covered pixels of built-in methods that fail, over all pictures: the least and the most of 64 and 256 px.
    pub found: Vec<(String, [f64; 2])>,
    /// What exact strategies keep to besides.
    pub keeps: Keeps,
    /// Its scene.
    pub document: Document,
    /// What its pictures have otherwise.
    pub pictures: Vec<Picture>,
}

/// What a picture has otherwise than the scene of its case.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// What it is called.
    pub name: String,
    /// Whether the middle of the picture is the centre of a pixel.
    pub half_pixel: bool,
    /// Values by their paths.
    pub sets: Vec<(String, Node)>,
}

impl Picture {
    /// The picture that has what another one has as well.
    pub(super) fn with(&self, other: &Self) -> Self {
        let names = [&self.name, &other.name].map(String::as_str);
        Self {
            name: names.join(if self.name.is_empty() { "" } else { ", " }),
            half_pixel: self.half_pixel || other.half_pixel,
            sets: [&self.sets[..], &other.sets].concat(),
        }
    }
}

/// What an exact picture keeps to besides showing the right things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keeps {
    /// Largest angle between normals of caps and those of exact, in degrees.
    pub normal_deg: f64,
    /// Largest error of depth, in edge lengths of a pixel.
    pub depth_px: f64,
}

impl Keeps {
    /// Nothing in particular.
    pub const NOTHING: Self = Self {
        normal_deg: f64::INFINITY,
        depth_px: f64::INFINITY,
    };

    /// What a picture does not keep to.
    pub fn fault(&self, judged: &Judged) -> Option<String> {
        let found = &judged.comparison;
        let (normal, depth) = (found.normal_error_deg_max, found.depth_error_px_max);
        if normal > self.normal_deg {
            return Some(format!("normals of caps are {normal} degrees off"));
        }
        (depth > self.depth_px * judged.precision.coarseness())
            .then(|| format!("depths are {depth} px off"))
    }
}

impl Case {
    /// The scenes of its pictures, which are so many pixels wide and high.
    ///
    /// # Errors
    ///
    /// A scene that makes no sense, with its file and line.
    pub fn scenes(&self, size_px: u32) -> Result<Vec<Scene>> {
        let mut assets = Assets::from_files(Arc::new(Embedded));
        let scene = |picture: &Picture| {
            let document = self.document.with_changes(&picture.sets)?;
            let mut scene = document.resolve(0.0, &mut assets)?;
            scene.name.clone_from(&picture.name);
            if picture.half_pixel {
                scene.camera = moved_by_half_a_pixel(scene.camera, size_px)?;
            }
            Ok(scene)
        };
        self.pictures.iter().map(scene).collect()
    }

    /// What a strategy is expected to make of it. Bounds are of the built-in methods: another resolution may miss them.
    pub fn expected(&self, method: &Method) -> Expected {
        let expected = self.declared(method);
        let name = method.to_string();
        let found = self.found.iter().find(|(of, _)| *of == name);
        match (expected, found) {
            (Fails(why), Some((_, [least, most]))) => {
                FailsWithin(why, least / FACTOR, most * FACTOR)
            }
            (expected, _) => expected,
        }
    }

    /// The same, of an adapter that may have fewer sub-pixel bits than 8.
    pub fn expected_on(&self, method: &Method, is_coarse: bool) -> Expected {
        let usual = self.expected(method);
        match is_coarse {
            true => self.expected_if_coarse(method, usual),
            false => usual,
        }
    }

    /// What cannot be otherwise for want of bits stays as it is.
    fn expected_if_coarse(&self, method: &Method, usual: Expected) -> Expected {
        if matches!(
            usual,
            Refuses(_) | RefusesSome(_) | Fails(_) | FailsWithin(..) | Overflows(_)
        ) {
            return usual;
        }
        let name = method.to_string();
        let mut rows = self.coarse.iter();
        let row = rows.find(|(glob, _)| glob_matches(glob, &name));
        row.map_or(usual, |(_, expected)| expected.clone())
    }

    fn declared(&self, method: &Method) -> Expected {
        let name = method.to_string();
        let apart = self
            .apart
            .iter()
            .find(|(glob, _)| glob_matches(glob, &name));
        if let Some((_, expected)) = apart {
            return expected.clone();
        }
        let strategy = &method.strategy;
        let can = strategy.can();
        if matches!(self.paper, Refuses(_)) && !can.nonzero {
            return self.paper.clone();
        }
        match self.form {
            Form::Planes if !can.surfaces => return Refuses(Unsupported::Surfaces),
            Form::Reliefs if !can.reliefs => return Refuses(Unsupported::Reliefs),
            Form::FlatReliefs if !can.reliefs => return RefusesSome(Unsupported::Reliefs),
            _ => {}
        }
        if strategy.is_by_the_papers_rule() {
            return self.paper.clone();
        }
        match &self.exact {
            Marked if *strategy == Strategy::STENCIL => {
                Fails("it cannot tell an open mesh, and draws streaks of it unmarked".into())
            }
            Marked if *strategy == Strategy::PLANAR => Doubted,
            Marked if strategy.resolution().is_some() => {
                Fails("depth images cannot tell that a mesh is open".into())
            }
            Exact if strategy.resolution().is_some() => Band,
            exact => match self.paper {
                Share(most) if strategy.is_tessellated() && self.form.has_reliefs() => Listed(most),
                _ => exact.clone(),
            },
        }
    }

    /// What is wrong with one picture of a strategy.
    pub fn fault(
        &self,
        question: &super::Question,
        judged: &Judged,
        method: &Method,
    ) -> Option<String> {
        let expected = self.expected_on(method, judged.precision.is_coarse());
        let fault = expected.fault(question, judged, method);
        fault.or_else(|| match expected {
            Exact => self.keeps.fault(judged),
            _ => None,
        })
    }
}

/// A parallel camera, moved so that what was in the middle of the picture is at the centre of a pixel.
fn moved_by_half_a_pixel(camera: Camera, size_px: u32) -> Result<Camera> {
    let (
        Viewpoint::Explicit {
            position,
            focal_point,
            view_up,
        },
        Projection::Orthographic {
            height: Some(height),
        },
    ) = (camera.viewpoint, camera.projection)
    else {
        let help = "give it a `position`, `projection = \"orthographic\"` and a `height`";
        let what = "the camera of a picture with `half_pixel` is not parallel";
        return Err(Error::input("hard case", what, help));
    };
    let ahead = (focal_point - position).normalize_or_zero();
    let right = (ahead.cross(view_up.unwrap_or(glam::DVec3::Y))).normalize_or_zero();
    let shift = (right - right.cross(ahead)) * (0.5 * height / f64::from(size_px));
    Ok(Camera {
        viewpoint: Viewpoint::Explicit {
            position: position + shift,
            focal_point: focal_point + shift,
            view_up,
        },
        ..camera
    })
}
