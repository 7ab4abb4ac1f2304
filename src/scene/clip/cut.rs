//! Cuts: removed regions, and the parts they apply to.
//!
//! A part can have a region of its own: an [`Offset`] moves all clip-surfaces of a cut for the parts that it names.

use crate::scene::{Breakaway, ClipSurface, Cutter, Part, Role};

/// The intersection of the removed sides of its clip-surfaces and of its cutter, removed from the parts it applies to.
#[derive(Clone, Debug)]
pub struct Cut {
    /// Name for reports and keys.
    pub name: String,
    /// At least one clip-surface, unless there is a cutter.
    pub surfaces: Vec<ClipSurface>,
    /// A closed mesh that acts as one more clip-surface, after the others.
    pub volume: Option<Cutter>,
    /// Parameters of a cutter that places itself: see [`Scene::open_breakaways`](crate::scene::Scene::open_breakaways).
    pub breakaway: Option<Breakaway>,
    /// The number of its opening, from 0: a breakaway with several is several cuts. Set where breakaways are opened.
    pub opening: usize,
    /// Names of the whole parts among what its opening shows, which it does not hide. Set where breakaways are opened.
    pub shows: Vec<String>,
    /// Globs of the parts that are cut; `*` and `?` are understood.
    pub applies_to: Vec<String>,
    /// Globs of the parts that are spared.
    pub except: Vec<String>,
    /// Parts from which more or less is removed.
    pub offsets: Vec<Offset>,
    /// True if the cut removes anything. The clip-surfaces of a cut that is off keep their numbers.
    pub enabled: bool,
}

/// Offset of a cut for some parts: removes less from them.
#[derive(Clone, Debug, PartialEq)]
pub struct Offset {
    /// Glob of the parts.
    pub parts: String,
    /// World units by which every clip-surface of the cut, plane or relief, is moved along `-N`: a positive number keeps more
    /// of the part, so that it stands out of the cut; a negative one keeps less.
    pub keeps: f64,
}

impl Cut {
    /// A cut of all parts by some clip-surfaces.
    pub fn new(name: impl Into<String>, surfaces: Vec<ClipSurface>) -> Self {
        Self {
            name: name.into(),
            surfaces,
            volume: None,
            breakaway: None,
            opening: 0,
            shows: Vec::new(),
            applies_to: vec!["*".into()],
            except: Vec::new(),
            offsets: Vec::new(),
            enabled: true,
        }
    }

    /// A cut of all parts by a closed mesh.
    pub fn by(cutter: Cutter) -> Self {
        Self {
            volume: Some(cutter.clone()),
            ..Self::new(cutter.name(), Vec::new())
        }
    }

    /// Returns true if the cut removes anything from a part.
    pub fn applies_to(&self, part: &Part) -> bool {
        self.is_on() && part.role == Role::Exterior && self.names(part)
    }

    /// Returns false if the cut is off, or if no place was found for its opening.
    pub(crate) fn is_on(&self) -> bool {
        self.enabled && (self.breakaway.is_none() || self.volume.is_some())
    }

    /// Returns true if the globs match a part.
    #[doc(hidden)]
    pub fn names(&self, part: &Part) -> bool {
        let any = |globs: &[String]| globs.iter().any(|g| glob_matches(g, &part.name));
        any(&self.applies_to) && !any(&self.except)
    }

    /// By how much more of a part is kept than the clip-surfaces say, in world units. The name itself counts before globs that
    /// match it, and of those the first.
    pub fn offset_for(&self, part: &Part) -> f64 {
        let exact = self.offsets.iter().find(|o| o.parts == part.name);
        let first = || {
            let mut all = self.offsets.iter();
            all.find(|o| glob_matches(&o.parts, &part.name))
        };
        exact.or_else(first).map_or(0.0, |o| o.keeps)
    }
}

/// `*` stands for any run of characters, `?` for one, everything else for itself.
pub fn glob_matches(glob: &str, name: &str) -> bool {
    let (glob, name): (Vec<char>, Vec<char>) = (glob.chars().collect(), name.chars().collect());
    // Positions to return to when the characters after the last `*` do not fit.
    let (mut g, mut n, mut star) = (0, 0, None);
    while n < name.len() {
        if g < glob.len() && glob[g] == '*' {
            star = Some((g + 1, n));
            g += 1;
        } else if g < glob.len() && (glob[g] == '?' || glob[g] == name[n]) {
            (g, n) = (g + 1, n + 1);
        } else if let Some((after, from)) = star {
            star = Some((after, from + 1));
            (g, n) = (after, from + 1);
        } else {
            return false;
        }
    }
    glob[g..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::glob_matches;

    #[test]
    fn globs_match_like_a_shell() {
        for (glob, name, expected) in [
            ("*", "", true),
            ("bolt*", "bolt_7", true),
            ("bolt*", "a bolt", false),
            ("*bolt", "a bolt", true),
            ("b?lt", "belt", true),
            ("a*b*c", "a-b-b-c", true),
            ("a*b*c", "a-b-b", false),
            ("", "x", false),
        ] {
            assert_eq!(glob_matches(glob, name), expected, "{glob} against {name}");
        }
    }
}
