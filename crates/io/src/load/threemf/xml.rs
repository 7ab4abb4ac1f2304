//! A pull parser for the elements of an XML document in memory. Each element has its namespace and line.
//!
//! Text between elements is ignored, because 3MF keeps all relevant data in attributes. Document types are refused, as the format requires,
//! so XML's five predefined entities are the only ones. Elements may be nested 64 levels deep, of which 3MF itself needs 6.
//!
//! Cost: one pass over the text to parse it, and one to count lines.

use std::borrow::Cow;
use std::path::Path;

use cutaway::error::{Error, Result};
use quick_xml::events::{BytesStart, Event};
use quick_xml::name::{Namespace, QName, ResolveResult};
use quick_xml::{NsReader, XmlVersion};

pub(super) const DAMAGED: &str =
    "the file is cut off, damaged or not a 3MF: export or download it again";

const CORRECT: &str = "correct the line, or export the file again";

/// Maximum nesting depth of elements.
const MOST_DEPTH: usize = 64;

/// The specification that defines an element or attribute name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Space {
    Core,
    Material,
    Production,
    BeamLattice,
    Slice,
    /// The specification of triangle sets, which do not affect geometry.
    TriangleSets,
    Other,
}

impl Space {
    /// Returns the specification that defines a namespace.
    pub(super) fn of(name: &[u8]) -> Self {
        match name {
            b"http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
            | b"http://schemas.microsoft.com/3dmanufacturing/2013/01" => Self::Core,
            b"http://schemas.microsoft.com/3dmanufacturing/material/2015/02" => Self::Material,
            b"http://schemas.microsoft.com/3dmanufacturing/production/2015/06" => Self::Production,
            b"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02" => {
                Self::BeamLattice
            }
            b"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07" => Self::Slice,
            b"http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07" => {
                Self::TriangleSets
            }
            _ => Self::Other,
        }
    }

    fn resolved(result: &ResolveResult<'_>) -> Self {
        match result {
            ResolveResult::Bound(Namespace(name)) => Self::of(name),
            _ => Self::Other,
        }
    }
}

/// Position of an element in the file.
#[derive(Clone, Copy, Debug)]
struct SourcePosition<'a> {
    path: &'a Path,
    line: usize,
}

impl SourcePosition<'_> {
    fn error(&self, what: impl Into<String>, help: &str) -> Error {
        Error::file_line(self.path, self.line, what, help)
    }
}

/// The start tag of an element.
#[derive(Clone, Debug)]
pub(super) struct Element<'a> {
    space: Space,
    start: BytesStart<'a>,
    place: SourcePosition<'a>,
}

impl Element<'_> {
    /// Returns true if the element has this name. The core namespace also matches the materials extension, as some programs mix them.
    pub(super) fn is(&self, space: Space, name: &str) -> bool {
        let is_of_space =
            self.space == space || (self.space, space) == (Space::Core, Space::Material);
        is_of_space && self.start.local_name().as_ref() == name.as_bytes()
    }

    /// Returns true if the element has this name, in any namespace.
    pub(super) fn is_named(&self, name: &str) -> bool {
        self.start.local_name().as_ref() == name.as_bytes()
    }

    pub(super) fn space(&self) -> Space {
        self.space
    }

    /// Line of the element, counted from 1.
    pub(super) fn line(&self) -> usize {
        self.place.line
    }

    /// Name of the element as written in the file.
    pub(super) fn name(&self) -> String {
        let name = self.start.name();
        String::from_utf8_lossy(name.as_ref())
            .chars()
            .take(60)
            .collect()
    }

    pub(super) fn error(&self, what: impl Into<String>) -> Error {
        self.place.error(what, CORRECT)
    }

    pub(super) fn error_with_help(&self, what: impl Into<String>, help: &str) -> Error {
        self.place.error(what, help)
    }

    /// The values of attributes without a prefix, by name.
    pub(super) fn values<const N: usize>(
        &self,
        names: [&str; N],
    ) -> Result<[Option<Cow<'_, str>>; N]> {
        let mut values = [const { None }; N];
        for attribute in self.start.attributes().with_checks(false) {
            let attribute = attribute.map_err(|e| self.error(format!("XML: {e}")))?;
            let is_it = |name: &&str| name.as_bytes() == attribute.key.as_ref();
            let Some(index) = names.iter().position(is_it) else {
                continue;
            };
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value =
                value.map_err(|e| self.error(format!("XML: attribute {}: {e}", names[index])))?;
            values[index] = Some(value);
        }
        Ok(values)
    }

    pub(super) fn value(&self, name: &str) -> Result<Option<Cow<'_, str>>> {
        let [value] = self.values([name])?;
        Ok(value)
    }

    /// Returns a value that is required, or an error that names the missing attribute.
    pub(super) fn needed<T>(&self, value: Option<T>, name: &str) -> Result<T> {
        value.ok_or_else(|| self.error(format!("<{}> lacks `{name}`", self.name())))
    }

    /// Parses the number of a resource.
    pub(super) fn id(&self, value: &str) -> Result<u32> {
        let id = value.trim().parse();
        id.map_err(|_| {
            self.error(format!(
                "{:?} is not the number of a resource",
                shortened(value)
            ))
        })
    }
}

/// The first 60 characters of a text, for error messages.
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}

/// A document that is parsed element by element.
pub(super) struct Xml<'a> {
    path: &'a Path,
    text: &'a str,
    reader: NsReader<&'a [u8]>,
    depth: usize,
    /// Line that contains byte `counted`.
    line: usize,
    counted: usize,
    is_broken: bool,
}

impl<'a> Xml<'a> {
    pub(super) fn new(path: &'a Path, text: &'a str) -> Self {
        let mut reader = NsReader::from_str(text);
        reader.config_mut().expand_empty_elements = true;
        Self {
            path,
            text,
            reader,
            depth: 0,
            line: 1,
            counted: 0,
            is_broken: false,
        }
    }

    /// Opens and returns the next child of the open element. If there are no more children, closes the open element and returns `None`.
    pub(super) fn child(&mut self) -> Result<Option<Element<'a>>> {
        loop {
            let mut place = self.place(self.reader.buffer_position());
            let (space, event) = match self.reader.read_resolved_event() {
                Ok((result, event)) => (Space::resolved(&result), event),
                Err(e) => {
                    self.is_broken = true;
                    place = self.place(self.reader.error_position());
                    return Err(place.error(format!("XML: {e}"), DAMAGED));
                }
            };
            let what = match event {
                Event::Start(start) if self.depth < MOST_DEPTH => {
                    self.depth += 1;
                    return Ok(Some(Element {
                        space,
                        start,
                        place,
                    }));
                }
                Event::End(_) => {
                    self.depth = self.depth.saturating_sub(1);
                    return Ok(None);
                }
                Event::Eof if self.depth == 0 => return Ok(None),
                Event::Start(_) => format!("XML: elements are nested more than {MOST_DEPTH} deep"),
                Event::Eof => format!("XML: it ends while {} elements are open", self.depth),
                Event::DocType(_) => "XML: it has a document type, which 3MF forbids".to_owned(),
                Event::Decl(declaration) => match declaration.encoding() {
                    Some(Ok(name)) if !is_unicode(&name) => format!(
                        "XML: it is encoded in {}, but 3MF requires UTF-8 or UTF-16",
                        shortened(&String::from_utf8_lossy(&name))
                    ),
                    _ => continue,
                },
                _ => continue,
            };
            self.is_broken = true;
            return Err(place.error(what, DAMAGED));
        }
    }

    fn place(&mut self, at: u64) -> SourcePosition<'a> {
        let at = usize::try_from(at)
            .unwrap_or(usize::MAX)
            .min(self.text.len());
        let passed = self
            .text
            .as_bytes()
            .get(self.counted..at)
            .unwrap_or_default();
        self.line += passed.iter().filter(|byte| **byte == b'\n').count();
        self.counted = self.counted.max(at);
        SourcePosition {
            path: self.path,
            line: self.line,
        }
    }

    /// Opens the root element.
    pub(super) fn root(&mut self, name: &str) -> Result<Element<'a>> {
        match self.child()? {
            Some(root) if root.is_named(name) => Ok(root),
            Some(other) => {
                let what = format!("its first element is <{}>, not <{name}>", other.name());
                Err(other.error_with_help(what, DAMAGED))
            }
            None => {
                let what = format!("invalid XML: no <{name}> element");
                Err(Error::file(self.path, what, DAMAGED))
            }
        }
    }

    /// Refuses content after the root element.
    pub(super) fn end(&mut self) -> Result<()> {
        match self.child()? {
            Some(second) => {
                let what = format!("XML: a second root element <{}>", second.name());
                Err(second.error_with_help(what, DAMAGED))
            }
            None => Ok(()),
        }
    }

    /// Closes the open element.
    pub(super) fn skip(&mut self) -> Result<()> {
        self.leave(self.depth)
    }

    /// Returns the leading text of the open element as written, and closes the element.
    pub(super) fn text(&mut self) -> Result<&'a str> {
        let begin = usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX);
        self.skip()?;
        let rest = self.text.get(begin..).unwrap_or_default();
        Ok(rest.split('<').next().unwrap_or_default().trim())
    }

    /// Number of open elements.
    pub(super) fn depth(&self) -> usize {
        self.depth
    }

    /// Closes elements until fewer than `depth` elements are open.
    pub(super) fn leave(&mut self, depth: usize) -> Result<()> {
        while self.depth >= depth.max(1) {
            self.child()?;
        }
        Ok(())
    }

    /// Returns true if the text is not valid XML, so that nothing further can be read.
    pub(super) fn is_broken(&self) -> bool {
        self.is_broken
    }

    /// The namespace bound to a prefix at this point.
    pub(super) fn namespace(&self, prefix: &str) -> Option<String> {
        let name = format!("{prefix}:name");
        match self
            .reader
            .resolver()
            .resolve_element(QName(name.as_bytes()))
            .0
        {
            ResolveResult::Bound(Namespace(name)) => {
                Some(String::from_utf8_lossy(name).into_owned())
            }
            _ => None,
        }
    }

    /// Returns the value of an attribute in a given namespace, on the element that was opened last.
    pub(super) fn value_of(
        &self,
        element: &Element<'_>,
        space: Space,
        name: &str,
    ) -> Result<Option<String>> {
        for attribute in element.start.attributes().with_checks(false) {
            let attribute = attribute.map_err(|e| element.error(format!("XML: {e}")))?;
            let (result, local) = self.reader.resolver().resolve_attribute(attribute.key);
            if local.as_ref() == name.as_bytes() && Space::resolved(&result) == space {
                let value = attribute.normalized_value(XmlVersion::Implicit1_0);
                let value =
                    value.map_err(|e| element.error(format!("XML: attribute {name}: {e}")))?;
                return Ok(Some(value.into_owned()));
            }
        }
        Ok(None)
    }
}

fn is_unicode(name: &[u8]) -> bool {
    name.eq_ignore_ascii_case(b"utf-8") || name.eq_ignore_ascii_case(b"utf-16")
}
