//! `--roles`: sets which parts are interior and which are never cut; `inspect` also shows where each role was set.

use cutaway::Result;
use cutaway::scene::{Part, Role};
use cutaway_io::document::{Document, Node, Origin, RoleBy, Value};
use cutaway_lab::report::TextTable;
use serde_json::{Value as Json, json};

/// One value of `--roles`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum RoleWord {
    /// Roles by visibility: parts that are not visible from outside are interior.
    Auto,
    /// A key of `roles`, and a glob for its parts.
    Glob(&'static str, String),
}

const KEYS: [&str; 3] = ["interior", "exterior", "whole"];

/// Parses a value.
pub(crate) fn parse(text: &str) -> Result<RoleWord, String> {
    let word = text.split_once('=').and_then(|(role, glob)| {
        let key = KEYS.into_iter().find(|key| *key == role)?;
        (!glob.is_empty()).then(|| RoleWord::Glob(key, glob.to_owned()))
    });
    match word {
        Some(word) => Ok(word),
        None if text == "auto" => Ok(RoleWord::Auto),
        None => Err("write auto, or for example interior=bearing* or whole=bolt*".to_owned()),
    }
}

/// Writes the roles into a document. If no role sets interior parts and `is_needed` is true, interior parts are detected.
pub(crate) fn amend(document: &mut Document, words: &[RoleWord], is_needed: bool) -> Result<()> {
    let root = document.root();
    let parts = root.get("part").map_or(&[] as &[_], Node::items);
    let is_said = root.get("roles").is_some() || parts.iter().any(|p| p.get("role").is_some());
    let says_what_is_inside =
        |word: &RoleWord| !matches!(word, RoleWord::Glob(key, _) if *key != "interior");
    let finds = is_needed && !is_said && !words.iter().any(says_what_is_inside);
    let found = finds.then_some(&RoleWord::Auto);
    if let (Some(Value::Text(text)), false) =
        (root.get("roles").map(|n| &n.value), words.is_empty())
    {
        // Any other value is rejected when the document is read.
        if let Some(auto) = [("auto", true), ("none", false)]
            .iter()
            .find(|(word, _)| **text == **word)
        {
            document.remove("roles")?;
            document.set("roles.auto", auto.1)?;
        }
    }
    words.iter().chain(found).try_for_each(|word| match word {
        RoleWord::Auto => document.set("roles.auto", true),
        RoleWord::Glob(key, glob) => {
            let held = document
                .root()
                .get("roles")
                .and_then(|roles| roles.get(key));
            let held = held.map_or(&[] as &[_], Node::items).to_vec();
            let origin = Origin::Option(format!("--roles {key}={glob}").into());
            let own = Node::new(glob.as_str()).said(&origin);
            let globs = held.into_iter().chain([own]).collect();
            document.set(&format!("roles.{key}"), Value::List(globs))
        }
    })
}

fn name_of(role: Role) -> &'static str {
    match role {
        Role::Exterior => "exterior",
        Role::Interior => "interior",
        Role::Whole => "whole",
    }
}

/// The roles of parts as a table.
pub(crate) fn to_text(roles: &[(Part, RoleBy)]) -> String {
    let mut table = TextTable::new(["part", "role", "by"]);
    for (part, by) in roles {
        table.row(vec![
            part.name.clone(),
            name_of(part.role).to_owned(),
            by.to_string(),
        ]);
    }
    table.to_text()
}

/// The roles as JSON, which `inspect` reports for each part in addition to its mesh.
pub(crate) fn to_json(part: &Part, by: &RoleBy) -> Json {
    let sight = match by {
        RoleBy::Sight(sight) => Some(sight),
        _ => None,
    };
    json!({
        "role": name_of(part.role),
        "role_by": match by {
            RoleBy::Default => "default",
            RoleBy::Model => "model",
            RoleBy::Transparency => "transparency",
            RoleBy::Part => "part",
            RoleBy::Glob(_) => "glob",
            RoleBy::Sight(_) => "sight",
        },
        "seen": sight.map(|s| s.seen),
        "level": sight.map(|s| s.level),
    })
}
