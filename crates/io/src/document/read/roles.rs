//! `roles`: interior parts and parts that are never cut, by globs or by visibility from outside.
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
//! The `role` of a part has priority, followed by globs on its name and on its materials' names. Next is the model's own data: a role, or a
//! material that transmits light, which makes the part exterior. Visibility comes last.

use std::collections::BTreeMap;
use std::fmt;

use cutaway::error::{Diagnostic, Result, did_you_mean};
use cutaway::scene::{Part, Role, Sight, glob_matches};

use super::described;
use super::reader::Table;
use crate::document::Keys;
use crate::document::describe::RolesDesc;

static KEYS: Keys = Keys::below("roles");

/// Visibility from outside of each part, by part name.
type Sights = BTreeMap<String, Sight>;

/// Source of the role of a part.
#[derive(Clone, Debug, PartialEq)]
pub enum RoleBy {
    /// The default, because no source gives a role.
    Default,
    /// Data in the model itself, such as a built-in shape.
    Model,
    /// The `role` key of the part.
    Part,
    /// A glob in `roles`.
    Glob(String),
    /// A material in the part's file that transmits light.
    Transparency,
    /// The part's visibility from outside.
    Sight(Sight),
}

impl fmt::Display for RoleBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("not given"),
            Self::Model => f.write_str("the model"),
            Self::Transparency => f.write_str("a transparent material"),
            Self::Part => f.write_str("role of the part"),
            Self::Glob(glob) => write!(f, "roles, {glob}"),
            Self::Sight(Sight { level: None, .. }) => f.write_str("too small to tell"),
            Self::Sight(Sight {
                seen,
                level: Some(level),
            }) => {
                write!(f, "seen {seen:.2}, level {level}")
            }
        }
    }
}

/// The role rules of a document.
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
    let desc: RolesDesc = described::read(&table)?;
    let of = |globs: Vec<String>, role| globs.into_iter().map(move |glob| (glob, role));
    let globs = of(desc.whole, Role::Whole)
        .chain(of(desc.interior, Role::Interior))
        .chain(of(desc.exterior, Role::Exterior));
    Ok(Roles {
        globs: globs.collect(),
        auto: desc.auto,
    })
}

/// Returns true if a glob matches a part's name or the name of one of its materials.
fn fits(glob: &str, part: &Part) -> bool {
    let materials = part.materials.iter().map(String::as_str);
    materials
        .chain([part.name.as_str()])
        .any(|name| glob_matches(glob, name))
}

impl Roles {
    /// Refuses names that no part has. A glob, in contrast, may match nothing at some times.
    pub(super) fn must_name(&self, root: &Table<'_>, names: &[&str]) -> Result<()> {
        let is_name = |glob: &&String| !glob.contains(['*', '?']);
        let mut said = self.globs.iter().map(|(glob, _)| glob).filter(is_name);
        match said.find(|name| !names.contains(&name.as_str())) {
            None => Ok(()),
            Some(name) => {
                let entry = root.need("roles", "\"auto\"")?;
                let what = format!("there is no part `{name}`");
                Err(entry.fault(what, did_you_mean(name, names.iter().copied())))
            }
        }
    }

    /// Notes about globs that match no part.
    pub(super) fn notes(&self, parts: &[Part]) -> Vec<Diagnostic> {
        let has = |glob: &str| parts.iter().any(|part| fits(glob, part));
        let idle = self.globs.iter().filter(|(glob, _)| !has(glob));
        let note = |glob: &String| {
            let text = format!("no part or material has a name that matches `{glob}`");
            Diagnostic::note("no-such-part", text).about("roles")
        };
        idle.map(|(glob, _)| note(glob)).collect()
    }

    /// Returns the role of a part and its source. `given` is true if the table of the part sets the role.
    pub(super) fn of(&self, part: &Part, given: bool, sights: Option<&Sights>) -> (Role, RoleBy) {
        if given {
            return (part.role, RoleBy::Part);
        }
        if let Some((glob, role)) = self.globs.iter().find(|(glob, _)| fits(glob, part)) {
            return (*role, RoleBy::Glob(glob.clone()));
        }
        if part.role_is_said || part.role != Role::default() {
            return (part.role, RoleBy::Model);
        }
        if part.is_transparent {
            return (Role::Exterior, RoleBy::Transparency);
        }
        match sights.and_then(|sights| sights.get(&part.name)) {
            Some(sight) if self.auto => {
                let role = match sight.level {
                    Some(0) | None => Role::Exterior,
                    Some(_) => Role::Interior,
                };
                (role, RoleBy::Sight(*sight))
            }
            _ => (part.role, RoleBy::Default),
        }
    }
}
