//! A case: scenes with a known answer, and what each strategy is expected to make of them.
//!
//! A case says what exact strategies and the paper's own make of it, and how its cuts are made; what the others make follows from what
//! they are. Where one does not do as its kind does, the case names it.

use cutaway::scene::{Scene, glob_matches};
use cutaway::strategies::{Method, Obstacle, Strategy};

use super::expected::Expected::{
    self, Band, Doubted, Exact, Fails, Listed, Marked, Refuses, RefusesSome, Share,
};
use super::{Judged, coarse, failures};

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

/// A row of the table.
#[derive(Clone, Copy)]
pub struct Case {
    /// Its number in the list of hard cases, or its letter and number where users of other projects met it.
    pub id: &'static str,
    /// What it is.
    pub name: &'static str,
    /// Its scenes at so many pixels along a side; some put vertices at pixel centres.
    pub scenes: fn(u32) -> Vec<Scene>,
    /// What makes its cuts.
    pub form: Form,
    /// What exact strategies make of it.
    pub exact: Expected,
    /// What the paper's own strategy makes of it.
    pub paper: Expected,
    /// Who makes something else of it than its kind does, by a glob over names.
    pub apart: &'static [(&'static str, Expected)],
    /// What exact strategies keep to besides.
    pub keeps: Keeps,
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
    /// What a strategy is expected to make of it. Bounds are of the built-in methods: another resolution may miss them.
    pub fn expected(&self, method: &Method) -> Expected {
        let expected = self.declared(method);
        match (expected, failures::bounds(self.name, method)) {
            (Fails(why), Some([least, most])) => Expected::FailsWithin(why, least, most),
            _ => expected,
        }
    }

    /// The same, of an adapter that may have fewer sub-pixel bits than 8.
    pub fn expected_on(&self, method: &Method, is_coarse: bool) -> Expected {
        let usual = self.expected(method);
        match is_coarse {
            true => coarse::expected(self.name, method, usual),
            false => usual,
        }
    }

    fn declared(&self, method: &Method) -> Expected {
        let name = method.to_string();
        let apart = self
            .apart
            .iter()
            .find(|(glob, _)| glob_matches(glob, &name));
        if let Some((_, expected)) = apart {
            return *expected;
        }
        let strategy = &method.strategy;
        let can = strategy.can();
        if matches!(self.paper, Refuses(_)) && !can.nonzero {
            return self.paper;
        }
        match self.form {
            Form::Planes if !can.surfaces => return Refuses(Obstacle::Surfaces),
            Form::Reliefs if !can.reliefs => return Refuses(Obstacle::Reliefs),
            Form::FlatReliefs if !can.reliefs => return RefusesSome(Obstacle::Reliefs),
            _ => {}
        }
        if strategy.is_by_the_papers_rule() {
            return self.paper;
        }
        match self.exact {
            Marked if *strategy == Strategy::STENCIL => {
                Fails("it cannot tell an open mesh, and draws streaks of it unmarked")
            }
            Marked if *strategy == Strategy::PLANAR => Doubted,
            Marked if strategy.resolution().is_some() => {
                Fails("depth images cannot tell that a mesh is open")
            }
            Exact if strategy.resolution().is_some() => Band,
            exact => match self.paper {
                Share(most) if strategy.is_tessellated() && self.form.has_reliefs() => Listed(most),
                _ => exact,
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
