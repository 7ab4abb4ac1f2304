//! Joins a shader and the files that it imports into one WGSL text, with all declarations of the shader and only the used ones of the
//! other files.
//!
//! Library declarations get the name of their module as a suffix, so that two files may use the same name for different declarations, and
//! a file cannot use a name that it has not imported. The shader's own names stay unchanged, because its entry points and overrides are
//! looked up by name. Takes tens of microseconds; naga then parses only what is needed.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::file::{Declaration, File};

/// Separator between a name and the name of its module; no name in the tree contains it.
const OF_MODULE: &str = "__";

/// A shader as one text.
pub(super) struct Joined<'a> {
    pub(super) text: String,
    /// For each declaration, in order: the line of the text on which it begins, from 1, its file, and its line in the file.
    begins: Vec<(usize, &'a str, usize)>,
    /// Name suffixes of the files, longest first.
    endings: Vec<String>,
}

/// Joins a shader with the files that it imports; `library` contains every file that any of them imports.
pub(super) fn join<'a>(shader: &File<'a>, library: &[&File<'a>]) -> Result<Joined<'a>, String> {
    let files: Vec<&File<'a>> = library.iter().copied().chain([shader]).collect();
    let modules: BTreeMap<&str, usize> = (files.iter().enumerate())
        .filter_map(|(i, file)| Some((file.module?, i)))
        .collect();
    // The declaration to which a name in a file refers.
    let declared = |at: usize, name: &str| -> Option<[usize; 2]> {
        if let Some(own) = files[at].declaration(name) {
            return Some([at, own]);
        }
        let module = modules.get(files[at].imports.get(name)?)?;
        Some([*module, files[*module].declaration(name)?])
    };
    for (at, file) in files.iter().enumerate() {
        for (name, module) in &file.imports {
            if file.declaration(name).is_some() {
                return Err(format!("{} imports {name} and declares it", file.path));
            }
            declared(at, name).ok_or_else(|| {
                format!(
                    "{} imports {name}, which {module} does not declare",
                    file.path
                )
            })?;
        }
    }

    let last = files.len() - 1;
    let mut needed: Vec<Vec<bool>> = files
        .iter()
        .map(|f| vec![false; f.declarations.len()])
        .collect();
    needed[last].fill(true);
    let mut open: Vec<[usize; 2]> = (0..needed[last].len()).map(|i| [last, i]).collect();
    while let Some([at, which]) = open.pop() {
        let declaration = &files[at].declarations[which];
        for place in &declaration.names {
            if let Some([file, d]) = declared(at, &declaration.text[place.clone()])
                && !std::mem::replace(&mut needed[file][d], true)
            {
                open.push([file, d]);
            }
        }
    }

    let endings: Vec<String> = (files.iter())
        .map(|file| match file.module {
            Some(module) => format!("{OF_MODULE}{}", module.replace("::", "_")),
            None => String::new(),
        })
        .collect();
    let mut joined = Joined {
        text: String::new(),
        begins: Vec::new(),
        endings: Vec::new(),
    };
    let mut line = 1;
    for (at, file) in files.iter().enumerate() {
        let used = file.declarations.iter().zip(&needed[at]);
        for (declaration, _) in used.filter(|(_, needed)| **needed) {
            joined.begins.push((line, file.path, declaration.line));
            let ending = |name: &str| declared(at, name).map_or("", |[file, _]| &*endings[file]);
            write(declaration, ending, &mut joined.text);
            line += declaration.text.matches('\n').count() + 1;
        }
    }
    joined.endings = endings;
    // One suffix may be a prefix of another.
    joined.endings.sort_by_key(|ending| Reverse(ending.len()));
    Ok(joined)
}

/// Appends a declaration and a line break; adds the suffixes to names of declarations.
fn write<'e>(declaration: &Declaration<'_>, ending: impl Fn(&str) -> &'e str, out: &mut String) {
    let mut from = 0;
    for place in &declaration.names {
        out.push_str(&declaration.text[from..place.end]);
        out.push_str(ending(&declaration.text[place.clone()]));
        from = place.end;
    }
    out.push_str(&declaration.text[from..]);
    out.push('\n');
}

impl Joined<'_> {
    /// An error message about a line of the joined text, with the file and line from which it comes and with the original names.
    pub(super) fn complaint(&self, line: Option<u32>, what: &str) -> String {
        let mut what = what.to_owned();
        for ending in self.endings.iter().filter(|e| !e.is_empty()) {
            what = what.replace(ending.as_str(), "");
        }
        let Some(line) = line.map(|l| l as usize) else {
            return what;
        };
        let behind = self.begins.partition_point(|(begins, ..)| *begins <= line);
        match behind.checked_sub(1).map(|i| self.begins[i]) {
            Some((begins, path, there)) => format!("{path}:{}: {what}", there + line - begins),
            None => what,
        }
    }
}

/// The name as it was written in its file, without the suffix.
pub(super) fn undecorated(name: &str) -> &str {
    name.split(OF_MODULE).next().unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two modules that use the same name for different declarations.
    const AREA: &str = "#define_import_path t::area
// The area.
fn size(a: vec2<f32>) -> f32 { return a.x * a.y; }
fn idle() -> f32 { return 0.0; }";
    const SPAN: &str = "#define_import_path t::span
#import t::area::{size}
struct Span { size: f32, at: vec2<f32> }
var<private> storage: Span;
fn span_of(a: vec2<f32>) -> f32 {
    let size_of_it = Span(size(a), a); // not size of this file
    return size_of_it.size + storage.size;
}";
    const SHADER: &str = "#import t::span::span_of
fn size() -> f32 { return 2.0; }
@vertex fn vertex(@location(0) at: vec2<f32>) -> @builtin(position) vec4<f32> {
    return vec4<f32>(span_of(at) * size());
}
fn position() -> f32 { return 1.0; }";

    fn joined(shader: &str, library: &[(&'static str, &'static str)]) -> Result<String, String> {
        let library: Vec<File<'_>> = library
            .iter()
            .map(|(path, text)| File::read(path, text))
            .collect();
        let shader = File::read("shader", shader);
        let all: Vec<&File<'_>> = library.iter().collect();
        let joined = join(&shader, &all)?;
        match naga::front::wgsl::parse_str(&joined.text) {
            Ok(_) => Ok(joined.text),
            Err(e) => {
                Err(joined.complaint(e.location(&joined.text).map(|l| l.line_number), e.message()))
            }
        }
    }

    #[test]
    fn one_name_means_what_its_file_says() {
        let text = joined(SHADER, &[("area", AREA), ("span", SPAN)]).unwrap();
        assert!(text.contains("fn size__t_area(a"), "{text}");
        assert!(text.contains("Span__t_span(size__t_area(a), a)"), "{text}");
        // Names of members, attributes and address spaces do not refer to declarations.
        assert!(
            text.contains("{ size: f32") && text.contains("of_it.size +"),
            "{text}"
        );
        assert!(text.contains("@builtin(position)"), "{text}");
        assert!(text.contains("fn size() -> f32"), "{text}");
        assert!(!text.contains("idle"), "nothing needs it: {text}");
    }

    #[test]
    fn a_name_is_seen_where_it_is_imported() {
        const BLIND: &str = "#define_import_path t::blind

fn blind() -> f32 {
    return size(vec2(1.0));
}";
        let shader = "#import t::blind::blind\n#import t::area::size\nfn both() -> f32 { return blind() + size(vec2(1.0)); }";
        let what = joined(shader, &[("area", AREA), ("blind", BLIND)]).unwrap_err();
        assert!(
            what.starts_with("blind:4: ") && what.contains("`size`"),
            "{what}"
        );
        let seeing = BLIND.replacen('\n', "\n#import t::area::size\n", 1).leak();
        joined(shader, &[("area", AREA), ("blind", seeing)]).unwrap();
    }

    #[test]
    fn imports_must_be_there() {
        let shader = "#import t::area::{size, width}\nfn f() -> f32 { return 1.0; }";
        let what = joined(shader, &[("area", AREA)]).unwrap_err();
        assert_eq!(what, "shader imports width, which t::area does not declare");
        let shader = "#import t::area::size\nfn size() -> f32 { return 1.0; }";
        let what = joined(shader, &[("area", AREA)]).unwrap_err();
        assert_eq!(what, "shader imports size and declares it");
    }
}
