//! Reads the case files: scenes with a table `[case]`, which gives the expected results.
//!
//! ```toml
//! part = [{ shape = "shells?subdivisions=3" }]
//! cut = [{ surfaces = [{ section = "-z=0.05" }] }]
//!
//! [case]
//! id = "16"                              # its number in the list of hard cases
//! name = "a hollow ball"
//! form = "plane"                         # or "planes", "reliefs", "flat-reliefs": what makes its cuts
//! exact = "exact"                        # of exact strategies
//! paper = "band"                         # of the paper's own
//! apart = { "planar*" = { refuses = "near-plane" } }   # of those that do not do as their kind does
//! coarse = { "*" = "doubted" }           # of all by a rasteriser of fewer than 8 sub-pixel bits
//! keeps = { normal_deg = 0.1, depth_px = 0.01 }        # what exact pictures keep to besides
//! found = { "planar" = [0.01168, 0.01347] }            # wrong by covered pixels of methods that fail: the least, the most
//!
//! [case.pictures]                        # one for each combination of the values; without it the scene as it is
//! inner = [{ is = "turned", "part.0.shape" = "shells?flip_inner=1" }, ...]
//! "cut.0.surfaces.0.section" = ["-z=0.05", "-1,-1,-1@0,0,0.1"]
//! ```
//!
//! `half_pixel = true` next to an `is` moves an orthographic camera so that the middle of a picture of even size is the centre of a pixel.
//! An expectation is a word (`exact`, `marked`, `doubted`, `band`) or a table: `{ share = S }`, `{ listed = S }` or `{ leaks = S }` with the share
//! found (`share` also takes a `why` if the reason is not the usual one), `{ fails = "WHY" }`, `{ refuses = FEATURE }`,
//! `{ refuses_some = FEATURE }` or `{ overflows = "WORDS" }`.
//!
//! The files are embedded in the program. Reading all of them takes some milliseconds and happens once.

use std::borrow::Cow;
use std::io;
use std::path::Path;
use std::sync::Arc;

use cutaway::Result;
use cutaway::strategies::Unsupported;
use cutaway_io::document::reader::{Entry, Table};
use cutaway_io::document::{Document, Node};
use cutaway_io::load::Files;
use include_dir::{Dir, include_dir};

use super::case::{Case, CasePicture, Form, Keeps};
use super::expected::Expected;
use super::tolerances::FACTOR;

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/hard-cases");

/// The files that the scenes of cases refer to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Embedded;

impl Files for Embedded {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        let file = FOLDER.get_file(path).ok_or(io::ErrorKind::NotFound)?;
        Ok(Cow::Borrowed(file.contents()))
    }

    fn is_file(&self, path: &Path) -> bool {
        FOLDER.get_file(path).is_some()
    }
}

/// All cases, in the order of their files.
pub(super) fn read_all() -> Result<Vec<Case>> {
    let mut files: Vec<_> = (FOLDER.files())
        .filter(|f| f.path().extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort_by_key(|f| f.path());
    let read = |f: &&include_dir::File<'_>| {
        let text = f.contents_utf8().unwrap_or_default();
        read(f.path(), text)
    };
    files.iter().map(read).collect()
}

/// Reads a case from the text of its file.
pub fn read(path: &Path, text: &str) -> Result<Case> {
    let document = Document::parse(path, text)?;
    // All other parts of the scene are checked when it is opened.
    let entry = document.need("case", "{ id = \"1\", name = \"cube\" }")?;
    case(&entry, document.clone())
}

fn case(entry: &Entry<'_>, document: Document) -> Result<Case> {
    let table = entry.table(&[
        "id", "name", "form", "exact", "paper", "apart", "coarse", "keeps", "found", "pictures",
    ])?;
    let text = |key: &str, example: &str| table.need(key, example)?.text().map(str::to_owned);
    let form = (table.get("form")).map(|e| {
        e.choice(&[
            ("plane", Form::Plane),
            ("planes", Form::Planes),
            ("reliefs", Form::Reliefs),
            ("flat-reliefs", Form::FlatReliefs),
        ])
    });
    Ok(Case {
        id: text("id", "\"1\"")?,
        name: text("name", "\"cube\"")?,
        form: form.transpose()?.unwrap_or(Form::Plane),
        exact: expected(&table.need("exact", "\"exact\"")?)?,
        paper: expected(&table.need("paper", "\"band\"")?)?,
        apart: by_glob(&table, "apart", expected)?,
        coarse: by_glob(&table, "coarse", expected)?,
        found: by_glob(&table, "found", found)?,
        keeps: keeps(&table)?,
        pictures: pictures(&table)?,
        document,
    })
}

/// Pairs of a value and the name of its method, or a glob over names; sorted by name, so that the first match is the same everywhere.
fn by_glob<T>(
    table: &Table<'_>,
    key: &str,
    read: impl Fn(&Entry<'_>) -> Result<T>,
) -> Result<Vec<(String, T)>> {
    let Some(entry) = table.get(key) else {
        return Ok(Vec::new());
    };
    let all = entry.open_table()?;
    let pair = |(glob, e): (&str, Entry<'_>)| Ok((glob.to_owned(), read(&e)?));
    all.all().map(pair).collect()
}

fn expected(entry: &Entry<'_>) -> Result<Expected> {
    if !entry.is_table() {
        let word = entry.choice(&[
            ("exact", &Expected::Exact),
            ("marked", &Expected::Marked),
            ("doubted", &Expected::Doubted),
            ("band", &Expected::Band),
        ]);
        return word.cloned();
    }
    let table = entry.table(&[
        "share",
        "listed",
        "leaks",
        "why",
        "fails",
        "refuses",
        "refuses_some",
        "overflows",
    ])?;
    let number = |key: &str| table.get(key).map(|e| e.number()).transpose();
    let words = |key: &str| table.get(key).map(|e| e.text().map(Arc::from)).transpose();
    let unsupported = |key: &str| table.get(key).map(|e| unsupported(&e)).transpose();
    let why: Option<Arc<str>> = words("why")?;
    let has_why = why.is_some();
    let all = [
        number("share")?.map(|found| match why {
            Some(why) => Expected::Within(found * FACTOR, why),
            None => Expected::Share(found * FACTOR),
        }),
        number("listed")?.map(|found| Expected::Listed(found * FACTOR)),
        number("leaks")?.map(|found| Expected::Leaks(found * FACTOR)),
        words("fails")?.map(Expected::Fails),
        unsupported("refuses")?.map(Expected::Refuses),
        unsupported("refuses_some")?.map(Expected::RefusesSome),
        words("overflows")?.map(Expected::Overflows),
    ];
    let help = "write one word, such as `exact`, or a table, such as `{ share = 0.02 }`";
    let all: Vec<Expected> = all.into_iter().flatten().collect();
    match &all[..] {
        [] => Err(entry.fault("it expects nothing", help)),
        [one] if !has_why || matches!(one, Expected::Within(..)) => Ok(one.clone()),
        [_] => Err(entry.fault("only a share has a `why` of its own", help)),
        _ => Err(entry.fault("it expects several things", help)),
    }
}

fn unsupported(entry: &Entry<'_>) -> Result<Unsupported> {
    entry.choice(&[
        ("near-plane", Unsupported::NearPlane),
        ("nonzero", Unsupported::Nonzero),
        ("reliefs", Unsupported::Reliefs),
        ("surfaces", Unsupported::Surfaces),
    ])
}

fn found(entry: &Entry<'_>) -> Result<[f64; 2]> {
    let list = entry.list()?;
    match &list[..] {
        [least, most] => Ok([least.number()?, most.number()?]),
        _ => Err(entry.fault("it is not a range", "write minimum and maximum: [0.1, 0.2]")),
    }
}

fn keeps(table: &Table<'_>) -> Result<Keeps> {
    let Some(entry) = table.get("keeps") else {
        return Ok(Keeps::NOTHING);
    };
    let table = entry.table(&["normal_deg", "depth_px"])?;
    let number = |key: &str| match table.get(key) {
        Some(entry) => entry.number(),
        None => Ok(f64::INFINITY),
    };
    Ok(Keeps {
        normal_deg: number("normal_deg")?,
        depth_px: number("depth_px")?,
    })
}

/// Makes one picture for each combination of values. Axes are ordered by name, and the last varies fastest.
fn pictures(table: &Table<'_>) -> Result<Vec<CasePicture>> {
    let mut all = vec![CasePicture::default()];
    let Some(entry) = table.get("pictures") else {
        return Ok(all);
    };
    for (name, axis) in entry.open_table()?.all() {
        let values = axis.list()?;
        let value = |e: &Entry<'_>| picture(name, e);
        let values: Vec<CasePicture> = values.iter().map(value).collect::<Result<_>>()?;
        all = (all.iter())
            .flat_map(|one| values.iter().map(|value| one.with(value)))
            .collect();
    }
    Ok(all)
}

/// Reads a value of an axis: a table of paths and values to set, or a value for the path that is the axis's name.
fn picture(axis: &str, entry: &Entry<'_>) -> Result<CasePicture> {
    if !entry.is_table() {
        return Ok(CasePicture {
            name: (entry.text().map(str::to_owned))
                .or_else(|_| entry.number().map(|n| n.to_string()))?,
            half_pixel: false,
            sets: vec![(axis.to_owned(), Node::clone(entry.node))],
        });
    }
    let table = entry.open_table()?;
    let mut picture = CasePicture {
        name: table.need("is", "\"turned\"")?.text()?.to_owned(),
        half_pixel: table.get("half_pixel").map_or(Ok(false), |e| e.flag())?,
        sets: Vec::new(),
    };
    let others = (table.all()).filter(|(key, _)| !["is", "half_pixel"].contains(key));
    let set = |(path, e): (&str, Entry<'_>)| (path.to_owned(), Node::clone(e.node));
    picture.sets = others.map(set).collect();
    Ok(picture)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::hard_cases::{cases, usual_methods};

    #[test]
    fn every_case_is_another_and_every_file_beside_them_is_used() {
        let all: BTreeSet<_> = cases().map(|c| (&c.id, &c.name)).collect();
        assert!(all.len() >= 54, "{} cases", all.len());
        assert_eq!(all.len(), cases().count(), "two have one name");
        let texts: Vec<String> = cases().map(|c| c.document.to_string()).collect();
        let beside = (FOLDER.dirs()).flat_map(|d| d.files().map(|f| f.path().to_string_lossy()));
        let stray: Vec<_> = beside
            .filter(|name| !texts.iter().any(|t| t.contains(&**name)))
            .collect();
        assert!(stray.is_empty(), "no case names {stray:?}");
    }

    /// Built-in methods that fail a case; each has true if the case states by how much.
    fn failures(case: &Case) -> Vec<(String, bool)> {
        let of = |method: cutaway::strategies::Method| match case.expected(&method) {
            Expected::Fails(_) => Some((method.to_string(), false)),
            Expected::FailsWithin(..) => Some((method.to_string(), true)),
            _ => None,
        };
        usual_methods(0).into_iter().filter_map(of).collect()
    }

    #[test]
    fn every_failure_has_a_line_and_every_line_a_failure() {
        for case in cases() {
            let failures = failures(case);
            let bare: Vec<_> = failures.iter().filter(|(_, has)| !has).collect();
            assert!(bare.is_empty(), "{}: by how much? {bare:?}", case.name);
            for (method, [least, most]) in &case.found {
                let fails = failures.iter().any(|(name, _)| name == method);
                assert!(fails, "{}: {method} does not fail", case.name);
                assert!(0.0 < *least && least <= most, "{}: {method}", case.name);
            }
        }
        let grid = |name: &str| {
            let case = cases().find(|c| c.name == "every face twice");
            case.map(|c| c.expected(&name.parse().expect("a name")))
        };
        let bounded = grid("grid:256+vds:512");
        assert!(matches!(bounded, Some(Expected::FailsWithin(..))));
        let other = grid("grid:16+vds:32");
        assert!(matches!(other, Some(Expected::Fails(_))), "no bounds");
    }

    #[test]
    fn every_difference_of_a_coarse_rasteriser_is_one() {
        for case in cases() {
            for (glob, expected) in &case.coarse {
                let differs = usual_methods(64).iter().any(|m| {
                    cutaway::scene::glob_matches(glob, &m.to_string())
                        && case.expected_on(m, true) == *expected
                        && case.expected(m) != *expected
                });
                assert!(differs, "{}, {glob}: nothing is otherwise", case.name);
            }
        }
    }

    #[test]
    fn a_slip_is_told_with_its_line() {
        let good = "part = [{ shape = \"cube\" }]\n[case]\nid = \"1\"\nname = \"a\"\nexact = \"exact\"\npaper = \"band\"\n";
        let faulty = |from: &str, to: &str| {
            let text = good.replace(from, to);
            let case = read(Path::new("1.toml"), &text);
            let scenes = case.and_then(|c| c.scenes(64));
            scenes.err().map_or_else(String::new, |e| e.to_string())
        };
        assert_eq!(faulty("", ""), "", "as it is");
        for (from, to, told) in [
            ("\"exact\"\n", "\"exat\"\n", "1.toml:5"),
            ("\"band\"", "{ fail = \"so\" }", "did you mean `fails`"),
            ("\"band\"", "{ why = \"so\" }", "it expects nothing"),
            (
                "\"band\"",
                "{ share = 0.1, fails = \"so\" }",
                "several things",
            ),
            ("\"band\"", "{ listed = 0.1, why = \"so\" }", "only a share"),
            ("\"band\"", "{ refuses = \"rain\" }", "1.toml:6"),
            ("name =", "nam =", "1.toml:4"),
            ("[case]", "[cse]", "it has no `case`"),
            (
                "\"band\"\n",
                "\"band\"\nfound = { \"planar\" = [1] }\n",
                "not a range",
            ),
            ("cube", "cub", "did you mean `cube`"),
            (
                "\"band\"\n",
                "\"band\"\n[case.pictures]\na = [{ is = \"b\", \"part.7.shape\" = \"cube\" }]\n",
                "part",
            ),
        ] {
            let found = faulty(from, to);
            assert!(found.contains(told), "{to}: {found}");
        }
    }
}
