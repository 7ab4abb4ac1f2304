//! `roles`: which parts are inside, and which are never cut, by globs or by what is seen from outside.
//!
//! ```toml
//! roles = "auto"                        # or:
//! [roles]
//! auto = true
//! interior = ["*core*"]
//! exterior = ["housing*"]
//! whole = ["bolt*", "shaft*"]
//! ```
//!
//! The `role` of a part counts first, then globs, then what is seen.

use std::collections::BTreeMap;
use std::fmt;

use super::reader::Table;
use crate::document::Keys;
use crate::error::Result;
use crate::scene::{Part, Role, Sight, glob_matches};

static KEYS: Keys = Keys::below("roles");

/// From what share of what one expects a part counts as seen from outside.
type Sights = BTreeMap<String, Sight>;

/// Who said which role a part has.
#[derive(Clone, Debug, PartialEq)]
pub enum RoleBy {
    /// Nobody: it is usual.
    Default,
    /// `role` of the part.
    Part,
    /// A glob of `roles`.
    Glob(String),
    /// What is seen of it from outside.
    Sight(Sight),
}

impl fmt::Display for RoleBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("nobody says it"),
            Self::Part => f.write_str("role of the part"),
            Self::Glob(glob) => write!(f, "roles, {glob}"),
            Self::Sight(sight) => {
                write!(f, "seen {:.2}, level {}", sight.seen, sight.level)
            }
        }
    }
}

/// The rules of a document.
#[derive(Debug, Default)]
pub(super) struct Roles {
    globs: Vec<(String, Role)>,
    pub(super) auto: bool,
}

/// Reads the rules.
pub(super) fn read(root: &Table<'_>) -> Result<Roles> {
    let Some(entry) = root.get("roles") else {
        return Ok(Roles::default());
    };
    if entry.is_text() {
        let auto = entry.choice(&[("auto", true), ("none", false)])?;
        return Ok(Roles {
            auto,
            ..Roles::default()
        });
    }
    let table = entry.table(KEYS.all())?;
    let mut roles = Roles {
        auto: table.get("auto").map_or(Ok(false), |e| e.flag())?,
        ..Roles::default()
    };
    for (key, role) in [
        ("whole", Role::Whole),
        ("interior", Role::Interior),
        ("exterior", Role::Exterior),
    ] {
        if let Some(globs) = table.get(key) {
            roles
                .globs
                .extend(globs.texts()?.into_iter().map(|glob| (glob, role)));
        }
    }
    Ok(roles)
}

impl Roles {
    /// The role of a part, which its own table has `given` or not, and who says so.
    pub(super) fn of(&self, part: &Part, given: bool, sights: Option<&Sights>) -> (Role, RoleBy) {
        if given {
            return (part.role, RoleBy::Part);
        }
        if let Some((glob, role)) = self.globs.iter().find(|(g, _)| glob_matches(g, &part.name)) {
            return (*role, RoleBy::Glob(glob.clone()));
        }
        match sights.and_then(|sights| sights.get(&part.name)) {
            Some(sight) if self.auto => {
                let role = match sight.level {
                    0 => Role::Exterior,
                    _ => Role::Interior,
                };
                (role, RoleBy::Sight(*sight))
            }
            _ => (part.role, RoleBy::Default),
        }
    }
}
