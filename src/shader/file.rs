//! One WGSL file as its declarations: the name of each, and where its text mentions names.
//!
//! A scanner that recognises comments, numbers and names, and positions where a name cannot refer to a declaration: after a dot, in an
//! attribute such as `@builtin(position)`, between the angle brackets of `var<storage, read>`, before the colon of a member. This is
//! enough to give every declaration a unique name in the joined text; naga parses the result. Takes microseconds per file.
//!
//! Cannot: read comments of the form `/* */`, which the tree does not contain (a lint checks this), or directives other than our two,
//! `#define_import_path` and `#import MODULE::NAME` or `#import MODULE::{NAME, NAME}`, one to a line.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A file of the tree, or a text that takes its place.
#[derive(Debug)]
pub(super) struct File<'a> {
    pub(super) path: &'a str,
    /// Name under which other files import it; whole shaders have none.
    pub(super) module: Option<&'a str>,
    /// Imported names, each with the module that it comes from.
    pub(super) imports: BTreeMap<&'a str, &'a str>,
    pub(super) declarations: Vec<Declaration<'a>>,
}

/// A function, type, constant or variable of a file.
#[derive(Debug)]
pub(super) struct Declaration<'a> {
    /// Empty if it has none: `const_assert`, or text that is not WGSL.
    pub(super) name: &'a str,
    /// Text, with attributes.
    pub(super) text: &'a str,
    /// Text ranges of the names that refer to declarations of this file, its own included, or to imported ones.
    pub(super) names: Vec<Range<usize>>,
    /// Line of the file on which it begins, from 1.
    pub(super) line: usize,
}

impl<'a> File<'a> {
    pub(super) fn read(path: &'a str, text: &'a str) -> Self {
        let mut file = File {
            path,
            module: None,
            imports: BTreeMap::new(),
            declarations: Vec::new(),
        };
        for line in text.lines() {
            if let Some(module) = line.strip_prefix("#define_import_path ") {
                file.module = Some(module.trim());
            } else if let Some(path) = line.strip_prefix("#import ")
                && let Some((module, names)) = path.rsplit_once("::")
            {
                let names = names.trim().trim_matches(['{', '}']).split(',');
                let named = names.map(str::trim).filter(|name| !name.is_empty());
                file.imports.extend(named.map(|name| (name, module.trim())));
            }
        }
        let mut scanner = Scanner::new(text);
        while let Some(declaration) = scanner.declaration() {
            file.declarations.push(declaration);
        }
        let own: Vec<&str> = file.declarations.iter().map(|d| d.name).collect();
        for declaration in &mut file.declarations {
            let text = declaration.text;
            let is_known = |name: &str| own.contains(&name) || file.imports.contains_key(name);
            declaration
                .names
                .retain(|place| is_known(&text[place.clone()]));
        }
        file
    }

    /// The modules from which it imports, each once.
    pub(super) fn modules(&self) -> BTreeSet<&'a str> {
        self.imports.values().copied().collect()
    }

    /// Index of the declaration with this name.
    pub(super) fn declaration(&self, name: &str) -> Option<usize> {
        self.declarations.iter().position(|d| d.name == name)
    }
}

/// Scans a text token by token.
struct Scanner<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl<'a> Scanner<'a> {
    fn new(text: &'a str) -> Self {
        Self {
            text,
            at: 0,
            line: 1,
        }
    }

    /// Range of the next name, number or punctuation mark; blanks, comments and directives are skipped.
    fn next(&mut self) -> Option<Range<usize>> {
        let bytes = self.text.as_bytes();
        loop {
            let from = self.at;
            let first = *bytes.get(from)?;
            match first {
                b'\n' => {
                    self.line += 1;
                    self.at += 1;
                }
                b'#' => self.skip_line(),
                b'/' if bytes.get(from + 1) == Some(&b'/') => self.skip_line(),
                _ if first.is_ascii_whitespace() => self.at += 1,
                _ => {
                    let belongs = |b: &u8| is_of_word(*b) || first.is_ascii_digit() && *b == b'.';
                    let length = bytes[from..].iter().take_while(|b| belongs(b)).count();
                    self.at = from + length.max(1);
                    return Some(from..self.at);
                }
            }
        }
    }

    fn skip_line(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.find('\n').unwrap_or(rest.len());
    }

    /// The next declaration: up to its semicolon, or to the brace that closes its first one.
    fn declaration(&mut self) -> Option<Declaration<'a>> {
        let first = self.next()?;
        let mut declaration = Declaration {
            name: "",
            text: &self.text[first.start..],
            names: Vec::new(),
            line: self.line,
        };
        let (mut keyword, mut before, mut braces) = ("", "", 0_usize);
        // The token that closes the brackets in which words are not names.
        let mut closing = None;
        let mut attribute = "";
        let mut token = Some(first.clone());
        while let Some(place) = token {
            let word = &self.text[place.clone()];
            match word {
                _ if closing.is_some() => {
                    if closing == Some(word) {
                        closing = None;
                    }
                }
                "<" if before == "var" => closing = Some(">"),
                "(" if matches!(attribute, "builtin" | "interpolate") => closing = Some(")"),
                "{" => braces += 1,
                "}" => braces = braces.saturating_sub(1),
                _ if word
                    .as_bytes()
                    .first()
                    .is_none_or(|b| b.is_ascii_digit() || !is_of_word(*b)) => {}
                _ if before == "@" => {}
                "fn" | "struct" | "const" | "override" | "alias" | "var" if braces == 0 => {
                    keyword = word
                }
                _ => {
                    if braces == 0 && declaration.name.is_empty() && !keyword.is_empty() {
                        declaration.name = word;
                    }
                    let is_member = before == "."
                        || keyword == "struct" && braces > 0 && self.is_before_colon();
                    if !is_member {
                        declaration
                            .names
                            .push(place.start - first.start..place.end - first.start);
                    }
                }
            }
            if closing.is_none() && braces == 0 && matches!(word, ";" | "}") {
                declaration.text = &self.text[first.start..self.at];
                break;
            }
            attribute = if before == "@" { word } else { "" };
            before = word;
            token = self.next();
        }
        // Unterminated text is passed on unchanged: naga reports what is wrong with it.
        Some(declaration)
    }

    fn is_before_colon(&self) -> bool {
        self.text[self.at..].trim_start().starts_with(':')
    }
}

fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || !byte.is_ascii()
}
