//! Cuts: removed regions, and the parts they apply to.

use super::{ClipSurface, Cutter, Part, Role};

/// The intersection of the removed sides of its clip-surfaces and of its cutter, removed from the parts it applies to.
#[derive(Clone, Debug)]
pub struct Cut {
    /// Name for reports and keys.
    pub name: String,
    /// At least one clip-surface, unless there is a cutter.
    pub surfaces: Vec<ClipSurface>,
    /// A closed mesh that acts as one more clip-surface, after the others.
    pub volume: Option<Cutter>,
    /// Globs of the parts that are cut; `*` and `?` are understood.
    pub applies_to: Vec<String>,
    /// Globs of the parts that are spared.
    pub except: Vec<String>,
}

impl Cut {
    /// A cut of all parts by some clip-surfaces.
    pub fn of(name: impl Into<String>, surfaces: Vec<ClipSurface>) -> Self {
        Self {
            name: name.into(),
            surfaces,
            volume: None,
            applies_to: vec!["*".into()],
            except: Vec::new(),
        }
    }

    /// A cut of all parts by a closed mesh.
    pub fn by(cutter: Cutter) -> Self {
        Self {
            volume: Some(cutter.clone()),
            ..Self::of(cutter.name(), Vec::new())
        }
    }

    /// Whether the cut removes anything from a part.
    pub fn applies_to(&self, part: &Part) -> bool {
        let any = |globs: &[String]| globs.iter().any(|g| glob_matches(g, &part.name));
        part.role == Role::Exterior && any(&self.applies_to) && !any(&self.except)
    }
}

/// `*` stands for any run of characters, `?` for one, everything else for itself.
pub(super) fn glob_matches(glob: &str, name: &str) -> bool {
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
