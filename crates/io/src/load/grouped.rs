//! Merging of equal notes about many nodes or objects.

/// Merges notes about labelled nodes or objects that differ only in their numbers: each group is reported as its first note, with the
/// count of the others. `noun` is the singular name of the labelled thing, such as "node".
pub(super) fn grouped(said: Vec<(String, String)>, noun: &str) -> Vec<String> {
    let kind = |note: &str| note.replace(|c: char| c.is_ascii_digit() || c == ',' || c == '.', "");
    let mut groups: Vec<(String, String, usize)> = Vec::new();
    for (label, note) in said {
        let of = kind(&note);
        match groups.iter_mut().find(|(known, ..)| *known == of) {
            Some((.., others)) => *others += 1,
            None => groups.push((of, format!("{label}: {note}"), 0)),
        }
    }
    let notes = groups.into_iter().map(|(_, note, others)| match others {
        0 => note,
        1 => format!("{note} (and another {noun} likewise)"),
        others => format!("{note} (and {others} more {noun}s likewise)"),
    });
    notes.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_of_one_kind_are_one() {
        let said = [
            ("a", "welded 1,024 corners"),
            ("b", "no skin"),
            ("c", "welded 7 corners"),
            ("d", "welded 9 corners"),
            ("e", "no skin"),
        ];
        let said = said.map(|(label, note)| (label.to_owned(), note.to_owned()));
        assert_eq!(
            grouped(said.into(), "node"),
            [
                "a: welded 1,024 corners (and 2 more nodes likewise)",
                "b: no skin (and another node likewise)",
            ]
        );
    }
}
