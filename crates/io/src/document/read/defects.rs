//! `defects` of a part: what is broken in its mesh on purpose, once, when it is opened.

use cutaway::error::{Result, did_you_mean};
use cutaway::generate::defects::{Defect, DefectKind, break_parts};
use cutaway::scene::Part;

use super::reader::{Entry, Table};

/// Puts the defects of an entry `[[part]]` into its solids.
pub(super) fn apply<'a>(
    table: &Table<'_>,
    parts: impl IntoIterator<Item = &'a mut Part>,
    notes: &mut Vec<String>,
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
        return Err(named.fault(format_args!("{name:?} is no defect"), help));
    };
    let keys: Vec<&str> = ["kind"]
        .into_iter()
        .chain(kind.keys().iter().copied())
        .collect();
    let table = entry.table(&keys)?;
    let mut defect = Defect::of(kind);
    for key in kind.keys() {
        let Some(value) = table.get(key) else {
            continue;
        };
        let set = match *key {
            "amount" => defect.set_amount(value.amount()?),
            "axis" => defect.set_axis(value.text()?),
            _ => defect.set_number(key, value.whole::<u64>()?),
        };
        let help = "write for example `{ kind = \"holes\", amount = \"5%\", seed = 1 }`";
        set.map_err(|what| value.fault(what, help))?;
    }
    Ok(defect)
}
