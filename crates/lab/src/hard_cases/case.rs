//! A case: scenes with a known answer, and what each strategy is expected to make of them.
//!
//! A case gives the expected results of exact strategies and of the paper's own, and the form of its cuts; the others follow from what
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

/// Form of the cuts of a case.
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
    /// Returns true if there is a relief among the cuts.
    pub fn has_reliefs(self) -> bool {
        matches!(self, Self::Reliefs | Self::FlatReliefs)
    }
}

/// A row of the table, read from its file.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its number in the list of hard cases, or its letter and number where users of other projects met it.
    pub id: String,
    /// Description of the case.
    pub name: String,
    /// Form of its cuts.
    pub form: Form,
    /// Expectation of exact strategies.
    pub exact: Expected,
    /// Expectation of the paper's own strategy.
    pub paper: Expected,
    /// Expectations of strategies that differ from their kind, by a glob over names.
    pub apart: Vec<(String, Expected)>,
    /// Expectations that differ with fewer than 8 sub-pixel bits, by a glob over names.
    pub coarse: Vec<(String, Expected)>,
    /// Wrong pixels by covered pixels of built-in methods that fail, over all pictures: the least and the most of 64 and 256 px.
    pub found: Vec<(String, [f64; 2])>,
    /// Further bounds on exact strategies.
    pub keeps: Keeps,
    /// Its scene.
    pub document: Document,
    /// Changes of its pictures.
    pub pictures: Vec<CasePicture>,
}

/// Changes of a picture to the scene of its case.
#[derive(Clone, Debug, Default)]
pub struct CasePicture {
    /// Name of the picture.
    pub name: String,
    /// True if the middle of the picture is the centre of a pixel.
    pub half_pixel: bool,
    /// Values by their paths.
    pub sets: Vec<(String, Node)>,
}

impl CasePicture {
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

/// Bounds on an exact picture in addition to showing the right things.
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

    /// First bound that a picture exceeds, in words.
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
    /// The scenes of its pictures, which are `size_px` pixels wide and high.
    ///
    /// # Errors
    ///
    /// A scene that makes no sense, with its file and line.
    pub fn scenes(&self, size_px: u32) -> Result<Vec<Scene>> {
        let mut assets = Assets::from_files(Arc::new(Embedded));
        let scene = |picture: &CasePicture| {
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

    /// Expected result of a strategy. Bounds are of the built-in methods: another resolution may miss them.
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

    /// Expectation with fewer sub-pixel bits: refusals, failures and overflows stay as they are.
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

    /// Fault of one picture of a strategy.
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
