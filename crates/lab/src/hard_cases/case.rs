//! A case: scenes with a known answer, and the expected result of each strategy.
//!
//! A case gives the form of its cuts and the expected results of exact strategies and of the paper's strategy; for any other strategy,
//! the expected result follows from the strategy's kind, unless the case gives one for that strategy by name.

use std::sync::Arc;

use cutaway::scene::{Camera, Projection, Scene, Viewpoint, glob_matches};
use cutaway::strategies::{Method, Strategy, Unsupported};
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Node};
use cutaway_io::load::Assets;

use super::Judged;
use super::expected::Expected::{
    self, Band, Doubted, Exact, Fails, FailsWithin, Leaks, Listed, Marked, Overflows, Refuses,
    RefusesSome, Share,
};
use super::files::Embedded;
use super::tolerances::FACTOR;

/// Form of the cuts of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One cut by one plane.
    Plane,
    /// Several planes.
    Planes,
    /// At least one relief.
    Reliefs,
    /// Reliefs, some of them flat, which makes them planes.
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
    /// The case's number in the list of hard cases, or a letter and a number for a case met by users of other projects.
    pub id: String,
    /// Description of the case.
    pub name: String,
    /// Form of its cuts.
    pub form: Form,
    /// Expected result of exact strategies.
    pub exact: Expected,
    /// Expected result of the paper's strategy.
    pub paper: Expected,
    /// Expected results of strategies that differ from what their kind implies, each by a glob over strategy names.
    pub apart: Vec<(String, Expected)>,
    /// Expected results that differ with fewer than 8 sub-pixel bits, each by a glob over strategy names.
    pub coarse: Vec<(String, Expected)>,
    /// For built-in methods that fail: wrong pixels per covered pixel, over all pictures; the minimum and maximum of 64 and 256 px.
    pub found: Vec<(String, [f64; 2])>,
    /// Further bounds that exact strategies must keep to.
    pub keeps: Keeps,
    /// Its scene.
    pub document: Document,
    /// Its pictures, as changes to the scene.
    pub pictures: Vec<CasePicture>,
}

/// A picture, as changes to the scene of its case.
#[derive(Clone, Debug, Default)]
pub struct CasePicture {
    /// Name of the picture.
    pub name: String,
    /// True if the camera is moved so that the middle of the picture is the centre of a pixel.
    pub half_pixel: bool,
    /// The changes: paths in the scene, each with its value.
    pub sets: Vec<(String, Node)>,
}

impl CasePicture {
    /// A picture with the changes of this one and of another.
    pub(super) fn with(&self, other: &Self) -> Self {
        let names = [&self.name, &other.name].map(String::as_str);
        Self {
            name: names.join(if self.name.is_empty() { "" } else { ", " }),
            half_pixel: self.half_pixel || other.half_pixel,
            sets: [&self.sets[..], &other.sets].concat(),
        }
    }
}

/// Bounds on the errors of a picture whose kinds, parts and clip-surfaces are right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keeps {
    /// Largest angle between cap normals and those of exact, in degrees.
    pub normal_deg: f64,
    /// Largest depth error, in edge lengths of a pixel.
    pub depth_px: f64,
}

impl Keeps {
    /// No further bounds.
    pub const NOTHING: Self = Self {
        normal_deg: f64::INFINITY,
        depth_px: f64::INFINITY,
    };

    /// The first bound that a picture exceeds, as text.
    pub fn fault(&self, judged: &Judged) -> Option<String> {
        let found = &judged.comparison;
        let (normal, depth) = (found.normal_error_deg_max, found.depth_error_px_max);
        if normal > self.normal_deg {
            return Some(format!("cap normals are {normal} degrees off"));
        }
        (depth > self.depth_px * judged.precision.coarseness())
            .then(|| format!("depths are {depth} px off"))
    }
}

impl Case {
    /// The scenes of the case's pictures, which are `size_px` pixels wide and high.
    ///
    /// # Errors
    ///
    /// An invalid scene; the error gives its file and line.
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

    /// Expected result of a strategy. Bounds apply to the built-in methods; with other parameters, a method may exceed them.
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

    /// Expected result of a strategy on an adapter that may have fewer than 8 sub-pixel bits.
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
            Marked | Leaks(_) if *strategy == Strategy::STENCIL => {
                Fails("it cannot tell an open mesh, and draws streaks of it unmarked".into())
            }
            Marked | Leaks(_) if *strategy == Strategy::PLANAR => Doubted,
            Marked | Leaks(_) if strategy.resolution().is_some() => {
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

/// An orthographic camera, moved so that the middle of the picture is at the centre of a pixel.
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
        let what = "the camera of a picture with `half_pixel` is not orthographic";
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
