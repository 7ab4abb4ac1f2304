//! Cuts: removed regions, and the parts they apply to.
//!
//! A part can have its own removed region: an [`Offset`] moves all clip-surfaces of a cut for the parts that it names.

use crate::scene::{Breakaway, ClipSurface, Cutter, KeptHulls, Part, Role};

/// Removes the intersection of the removed sides of its clip-surfaces and cutter from the parts it applies to.
#[derive(Clone, Debug)]
pub struct Cut {
    /// Name for reports and keys.
    pub name: String,
    /// At least one clip-surface, unless there is a cutter.
    pub surfaces: Vec<ClipSurface>,
    /// A closed mesh that acts as an additional clip-surface after the others.
    pub volume: Option<Cutter>,
    /// Parameters of an automatically placed cutter: see [`Scene::open_breakaways`](crate::scene::Scene::open_breakaways).
    pub breakaway: Option<Breakaway>,
    /// Index of the breakaway's opening: a breakaway with several openings becomes one cut per opening. Set when breakaways are opened.
    pub opening: usize,
    /// Names of the [whole](crate::scene::Role::Whole) parts that its opening shows and thus keeps. Set when breakaways are opened.
    pub shows: Vec<String>,
    /// Globs of the parts that are cut, with `*` and `?` as wildcards.
    pub applies_to: Vec<String>,
    /// Globs of parts that are not cut, even if `applies_to` matches them.
    pub except: Vec<String>,
    /// Parts from which more or less is removed.
    pub offsets: Vec<Offset>,
    /// False if the cut is switched off and removes nothing; its clip-surfaces keep their numbers.
    pub enabled: bool,
    /// Hulls of the breakaway at other positions of the camera.
    #[doc(hidden)]
    pub kept_hulls: KeptHulls,
}

/// Offset of a cut for some parts: removes less of them, or more.
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
            kept_hulls: KeptHulls::default(),
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

    /// Returns false if the cut is switched off, or if its opening could not be placed.
    pub(crate) fn is_on(&self) -> bool {
        self.enabled && (self.breakaway.is_none() || self.volume.is_some())
    }

    /// Returns true if the globs match a part.
    #[doc(hidden)]
    pub fn names(&self, part: &Part) -> bool {
        let any = |globs: &[String]| globs.iter().any(|g| glob_matches(g, &part.name));
        any(&self.applies_to) && !any(&self.except)
    }

    /// Distance by which the cut's clip-surfaces are moved to keep more of a part, in world units. An entry with the part's exact name
    /// takes precedence over globs; among matching globs the first wins.
    pub fn offset_for(&self, part: &Part) -> f64 {
        let exact = self.offsets.iter().find(|o| o.parts == part.name);
        let first = || {
            let mut all = self.offsets.iter();
            all.find(|o| glob_matches(&o.parts, &part.name))
        };
        exact.or_else(first).map_or(0.0, |o| o.keeps)
    }
}

/// Returns true if a glob matches a name: `*` matches any run of characters, `?` any single character.
pub fn glob_matches(glob: &str, name: &str) -> bool {
    let (glob, name): (Vec<char>, Vec<char>) = (glob.chars().collect(), name.chars().collect());
    // Positions to backtrack to if the characters after the last `*` do not match.
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
