//! One WGSL file as a list of declarations: the name of each, and the positions of names in its text.
//!
//! The scanner recognises comments, numbers, names, and the positions in which a name cannot refer to a declaration: after a dot, in an
//! attribute such as `@builtin(position)`, between the angle brackets of `var<storage, read>`, before the colon of a member. That is
//! enough to give every declaration a unique name in the joined text, which naga then parses. Takes microseconds per file.
//!
//! Cannot: read comments of the form `/* */`, which a lint forbids in the tree; or directives other than `#define_import_path` and
//! `#import MODULE::NAME` or `#import MODULE::{NAME, NAME}`, one per line.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A file of the tree, or a text that replaces one.
#[derive(Debug)]
pub(super) struct File<'a> {
    pub(super) path: &'a str,
    /// Name under which other files import this one; whole shaders have none.
    pub(super) module: Option<&'a str>,
    /// The imported names, each with the module from which it comes.
    pub(super) imports: BTreeMap<&'a str, &'a str>,
    pub(super) declarations: Vec<Declaration<'a>>,
}

/// A function, type, constant or variable of a file.
#[derive(Debug)]
pub(super) struct Declaration<'a> {
    /// Name of the declaration; empty for `const_assert`, and for text that is not WGSL.
    pub(super) name: &'a str,
    /// Text of the declaration, with attributes.
    pub(super) text: &'a str,
    /// Text ranges of the names that refer to a declaration of this file, including this one, or to an imported one.
    pub(super) names: Vec<Range<usize>>,
    /// Line of the file on which the declaration begins, from 1.
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

    /// The modules from which the file imports, without duplicates.
    pub(super) fn modules(&self) -> BTreeSet<&'a str> {
        self.imports.values().copied().collect()
    }

    /// Index of the declaration with a given name.
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

    /// The next declaration. It ends with a semicolon, or with the brace that matches its first brace.
    fn declaration(&mut self) -> Option<Declaration<'a>> {
        let first = self.next()?;
        let mut declaration = Declaration {
            name: "",
            text: &self.text[first.start..],
            names: Vec::new(),
            line: self.line,
        };
        let (mut keyword, mut before, mut braces) = ("", "", 0_usize);
        // The token that ends the current brackets, inside which words are not names.
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
        // Unterminated text is passed on unchanged: naga reports the error.
        Some(declaration)
    }

    fn is_before_colon(&self) -> bool {
        self.text[self.at..].trim_start().starts_with(':')
    }
}

fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || !byte.is_ascii()
}
