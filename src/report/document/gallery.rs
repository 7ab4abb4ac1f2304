//! Pictures of one frame: all in a row, and two of them under a slider where the page can run its script.

use base64::prelude::{BASE64_STANDARD, Engine as _};
use maud::{Markup, html};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

/// Pictures of one frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gallery {
    /// What they show.
    pub label: String,
    /// The pictures, exact first.
    pub shots: Vec<Shot>,
    /// Which two lie under the slider at first, left and right.
    pub opens_at: [usize; 2],
    /// What the colours of heat maps mean: `#rrggbb` and a name.
    pub(crate) legend: Vec<(String, String)>,
    /// Names of pictures that did not fit into the page.
    pub left_out: Vec<String>,
}

/// A picture.
#[derive(Clone, Debug)]
pub(crate) struct Shot {
    /// Who drew it, and whether it is a heat map.
    pub name: String,
    /// What can be seen.
    pub caption: String,
    /// Where it is.
    pub source: Source,
    /// The file, as seen from the report.
    pub link: String,
}

/// Where a picture is.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// In the page.
    Inside(Vec<u8>),
    /// In its file.
    Beside,
}

impl Shot {
    fn url(&self) -> String {
        match &self.source {
            Source::Inside(png) => {
                format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
            }
            Source::Beside => encoded(&self.link),
        }
    }
}

/// Bytes that a path in an address has as they are.
const PLAIN: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'/')
    .remove(b'.')
    .remove(b'-')
    .remove(b'_')
    .remove(b'~');

/// A path as the address of a link.
pub(super) fn encoded(path: &str) -> String {
    utf8_percent_encode(path, PLAIN).to_string()
}

impl Gallery {
    /// The pictures under each other; the script makes a slider of them.
    pub(super) fn html(&self) -> Markup {
        let [left, right] = self.opens_at;
        html! {
            div.gallery role="group" data-left=(left) data-right=(right) aria-label=(self.label) {
                @if !self.legend.is_empty() {
                    ul.legend aria-label="colours of heat maps" {
                        @for (color, name) in &self.legend {
                            li { i style={ "background:" (color) } {} (name) }
                        }
                    }
                }
                div.shots {
                    @for shot in &self.shots {
                        figure {
                            img loading="lazy" alt=(shot.name) src=(shot.url());
                            figcaption { b { (shot.name) } " " (shot.caption) }
                        }
                        "\n"
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_addresses() {
        assert_eq!(encoded("a b/grid-256+vds.png"), "a%20b/grid-256%2Bvds.png");
        assert_eq!(encoded("\"><script>"), "%22%3E%3Cscript%3E");
    }

    #[test]
    fn pictures_are_in_the_page_or_beside_it() {
        let shot = |source| Shot {
            name: "<exact>".to_owned(),
            caption: String::new(),
            source,
            link: "x/exact.png".to_owned(),
        };
        let gallery = Gallery {
            shots: vec![shot(Source::Inside(b"foo".to_vec())), shot(Source::Beside)],
            ..Gallery::default()
        };
        let page = gallery.html().into_string();
        assert!(page.contains("data:image/png;base64,Zm9v"), "{page}");
        assert!(page.contains("src=\"x/exact.png\""), "{page}");
        assert!(!page.contains("<exact>"), "{page}");
    }
}
