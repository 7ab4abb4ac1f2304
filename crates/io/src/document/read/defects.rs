//! `defects` of a part: deliberate damage to its mesh, which is applied once, when the part is opened.

use cutaway::error::{Diagnostic, Result, did_you_mean};
use cutaway::generate::defects::{Defect, DefectKind, break_parts};
use cutaway::scene::Part;
use cutaway::scene::describe::Described;

use super::described::{self, keys_of};
use super::reader::{Entry, Table};

/// Applies the defects of a `[[part]]` entry to its solids.
pub(super) fn apply<'a>(
    table: &Table<'_>,
    parts: impl IntoIterator<Item = &'a mut Part>,
    notes: &mut Vec<Diagnostic>,
) -> Result<()> {
    let Some(entry) = table.get("defects") else {
        return Ok(());
    };
    let defects = read(&entry)?;
    notes.extend(break_parts(parts, &defects).map_err(|e| entry.place(e))?);
    Ok(())
}

fn read(entry: &Entry<'_>) -> Result<Vec<Defect>> {
    entry.list()?.iter().map(read_one).collect()
}

pub(super) fn read_one(entry: &Entry<'_>) -> Result<Defect> {
    let named = entry.open_table()?.need("kind", "\"holes\"")?;
    let name = named.text()?;
    let Some(kind) = DefectKind::named(name) else {
        let help = did_you_mean(name, DefectKind::NAMES);
        return Err(named.fault(format_args!("{name:?} is not a defect"), help));
    };
    let mut defect = Defect::of(kind);
    let keys = [vec!["kind"], keys_of(defect.fields())].concat();
    let table = entry.table(&keys)?;
    described::amend(&mut defect, &table)?;
    match (defect.defect(), table.get("amount")) {
        (Some(what), Some(amount)) => {
            let help = "write for example `{ kind = \"holes\", amount = \"5%\", seed = 1 }`";
            Err(amount.fault(what, help))
        }
        _ => Ok(defect),
    }
}
