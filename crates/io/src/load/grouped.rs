//! Merges equal notes about many nodes or objects.

use cutaway::error::Diagnostic;

/// Merges messages that have the same code into the first of them, which then states the number of the others. `noun` is what the messages
/// are about, in the singular, such as "node".
pub(super) fn grouped(messages: Vec<Diagnostic>, noun: &str) -> Vec<Diagnostic> {
    let mut groups: Vec<(Diagnostic, usize)> = Vec::new();
    for message in messages {
        match groups
            .iter_mut()
            .find(|(first, _)| first.code == message.code)
        {
            Some((_, others)) => *others += 1,
            None => groups.push((message, 0)),
        }
    }
    let counted = groups.into_iter().map(|(mut first, others)| {
        match others {
            0 => {}
            1 => first
                .text
                .push_str(&format!(" (and another {noun} likewise)")),
            others => (first.text).push_str(&format!(" (and {others} more {noun}s likewise)")),
        }
        first
    });
    counted.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_one_code_are_one() {
        let messages = [
            ("a", "welded", "welded 1,024 corners"),
            ("b", "skin", "no skin"),
            ("c", "welded", "welded 7 corners"),
            ("d", "welded", "welded 9 corners"),
            ("e", "skin", "no skin"),
        ];
        let messages = messages.map(|(node, code, text)| Diagnostic::note(code, text).about(node));
        let groups = grouped(messages.into(), "node");
        let texts: Vec<String> = groups.iter().map(Diagnostic::to_string).collect();
        assert_eq!(
            texts,
            [
                "a: welded 1,024 corners (and 2 more nodes likewise)",
                "b: no skin (and another node likewise)",
            ]
        );
    }
}
