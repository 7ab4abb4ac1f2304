//! Figures: those of the theorem are there and well formed, and what README takes from the results is what stands there.

use std::fs;

use quick_xml::Reader;
use quick_xml::events::Event;

use super::{documents, root};

/// What is wrong with a drawing.
fn fault(svg: &str) -> Option<String> {
    let mut reader = Reader::from_str(svg);
    let mut shapes = 0;
    let mut has_label = false;
    loop {
        match reader.read_event() {
            Err(e) => return Some(e.to_string()),
            Ok(Event::Eof) => break,
            Ok(Event::Start(tag) | Event::Empty(tag)) => {
                has_label |= tag.try_get_attribute("aria-label").ok().flatten().is_some();
                shapes += usize::from(tag.name().as_ref() != b"g");
            }
            Ok(_) => {}
        }
    }
    (shapes < 10 || !has_label).then(|| format!("{shapes} shapes, labelled: {has_label}"))
}

#[test]
fn the_figures_of_the_theorem_are_there() {
    let page = &documents()["docs/algorithm.md"];
    let folder = root().join("docs/images/algorithm");
    let mut shown = 0;
    for entry in fs::read_dir(&folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let svg = fs::read_to_string(folder.join(&name)).unwrap();
        assert!(
            page.contains(&format!("(images/algorithm/{name})")),
            "{name} is not shown"
        );
        assert_eq!(fault(&svg), None, "{name}");
        assert!(svg.len() < 4000, "{name} is large");
        shown += 1;
    }
    assert_eq!(shown, page.matches("(images/algorithm/").count());
    for name in ["one-list", "proof", "gap", "mask", "tie"] {
        let file = format!("(images/algorithm/{name}.svg)");
        assert!(page.contains(&file), "{name}");
    }
    let sound = fs::read_to_string(folder.join("proof.svg")).unwrap();
    let broken = sound.replace("</text>", "");
    assert!(fault(&broken).is_some(), "the control");
}

/// Rows of the table under a heading of cells, as cells.
fn table(text: &str, first: &str) -> Vec<Vec<String>> {
    let lines = text.lines().skip_while(|l| !l.starts_with(first));
    let rows = lines.take_while(|l| l.starts_with('|'));
    let rows = rows.filter(|l| !l.starts_with("|---"));
    let cells = |row: &str| {
        let cells = row.trim_matches('|').split('|');
        cells.map(|c| c.trim().to_owned()).collect()
    };
    rows.map(cells).collect()
}

/// Cells of README that are not what the table of the results has under the same heading in the row of the same name.
fn strange(readme: &str, results: &str) -> Vec<String> {
    let first = "| what you have | use |";
    let (of_readme, of_results) = (table(readme, first), table(results, first));
    let column = |name: &String| of_results[0].iter().position(|n| n == name);
    let mut strange = Vec::new();
    for row in &of_readme[1..] {
        let found = of_results.iter().find(|r| r[0] == row[0]);
        for (name, cell) in of_readme[0].iter().zip(row) {
            let there = found.zip(column(name)).map(|(row, at)| &row[at]);
            if there != Some(cell) {
                strange.push(format!("{}, {name}: {cell}", row[0]));
            }
        }
    }
    strange
}

#[test]
fn the_table_of_readme_is_that_of_the_results() {
    let all = documents();
    let (readme, results) = (&all["README.md"], &all["docs/results.md"]);
    assert_eq!(table(readme, "| what you have |").len(), 5);
    assert_eq!(strange(readme, results), Vec::<String>::new());
    let planted = readme.replacen("118 to 838 px", "118 to 839 px", 1);
    assert_eq!(strange(&planted, results).len(), 1, "the control");
    let planted = readme.replacen("| one plane |", "| two planes |", 1);
    assert_eq!(strange(&planted, results).len(), 4, "the control");
}

#[test]
fn readme_is_read_in_a_minute() {
    let readme = &documents()["README.md"];
    let lines = readme.lines().count();
    assert!((60..=120).contains(&lines), "{lines} lines");
    let code = super::blocks(readme);
    let library = code.iter().find(|(language, _)| language == "rust");
    let lines = library.unwrap().1.lines().filter(|l| !l.is_empty());
    assert!(lines.count() <= 13, "the library in twelve lines");
}
