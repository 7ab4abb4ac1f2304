//! Pictures of one frame: a grid with a picture per method, and a switch between pictures and heat maps, which needs no script. If scripts
//! can run, a slider compares two of the pictures.

use base64::prelude::{BASE64_STANDARD, Engine as _};
use maud::{Markup, html};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use super::Cell;
use super::marker::badge;
use crate::report::look::Look;

/// Pictures of one frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gallery {
    /// Description of the pictures.
    pub label: String,
    /// One picture for each method, exact first.
    pub shots: Vec<Shot>,
    /// Indices of the left and right picture that the slider shows initially.
    pub opens_at: [usize; 2],
    /// Legend of the heat map colours.
    pub legend: Vec<Swatch>,
    /// Names of pictures that did not fit into the page.
    pub left_out: Vec<String>,
}

/// Legend entry of a heat map colour.
#[derive(Clone, Debug)]
pub(crate) struct Swatch {
    /// The colour as `#rrggbb`.
    pub color: String,
    pub name: String,
    /// Meaning of a pixel of this colour.
    pub meaning: String,
}

/// Picture drawn by a method.
#[derive(Clone, Debug)]
pub(crate) struct Shot {
    /// The method.
    pub name: String,
    /// Look of the method in charts; `None` for the reference, which no chart shows.
    pub look: Option<Look>,
    /// Caption of the picture.
    pub caption: Cell,
    pub picture: GalleryImage,
    /// Heat map of the picture's errors.
    pub errors: Option<GalleryImage>,
}

/// A picture.
#[derive(Clone, Debug)]
pub(crate) struct GalleryImage {
    pub source: PictureLocation,
    /// Path of the file relative to the report.
    pub link: String,
}

/// Location of a picture.
#[derive(Clone, Debug)]
pub(crate) enum PictureLocation {
    /// Embedded in the page: the bytes of the file.
    Inside(Vec<u8>),
    /// Linked as a file outside the page.
    Beside,
}

impl GalleryImage {
    fn url(&self) -> String {
        match &self.source {
            PictureLocation::Inside(png) => {
                format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
            }
            PictureLocation::Beside => encoded(&self.link),
        }
    }
}

/// Bytes that are percent-encoded when a path becomes a link.
const PLAIN: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'/')
    .remove(b'.')
    .remove(b'-')
    .remove(b'_')
    .remove(b'~');

/// Percent-encodes a path as the address of a link.
pub(super) fn encoded(path: &str) -> String {
    utf8_percent_encode(path, PLAIN).to_string()
}

/// The legend of some colours: each with its name and meaning.
pub(super) fn swatches(all: &[Swatch]) -> Markup {
    html! {
        ul.swatches aria-label="colours of heat maps" {
            @for swatch in all {
                li { i style={ "background:" (swatch.color) } {} b { (swatch.name) } ": " (swatch.meaning) }
            }
        }
    }
}

impl Gallery {
    /// The pictures in a grid. The number makes the switch's name unique in the page.
    pub(super) fn html(&self, number: usize) -> Markup {
        let [left, right] = self.opens_at;
        let has_errors = self.shots.iter().any(|s| s.errors.is_some());
        let group = format!("shown-{number}");
        html! {
            div.gallery role="group" data-left=(left) data-right=(right) aria-label=(self.label) {
                @if has_errors {
                    div.switch role="radiogroup" aria-label="what the pictures show" {
                        label { input type="radio" name=(group) value="picture" checked; " pictures" }
                        label { input.errors type="radio" name=(group) value="errors"; " errors" }
                    }
                }
                div.shots {
                    @for shot in &self.shots {
                        figure {
                            img.picture loading="lazy" alt=(shot.name) src=(shot.picture.url());
                            @if let Some(errors) = &shot.errors {
                                img.errors loading="lazy" alt={ (shot.name) ", errors" } src=(errors.url());
                            }
                            figcaption {
                                @if let Some(look) = shot.look { (badge(look)) }
                                b { (shot.name) } " "
                                span class=(shot.caption.tone.name()) { (shot.caption.text) }
                            }
                        }
                        "\n"
                    }
                }
                @if !self.legend.is_empty() { (swatches(&self.legend)) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shot(source: PictureLocation, errors: Option<GalleryImage>) -> Shot {
        Shot {
            name: "<exact>".to_owned(),
            look: None,
            caption: Cell::default(),
            picture: GalleryImage {
                source,
                link: "x/exact.png".to_owned(),
            },
            errors,
        }
    }

    #[test]
    fn paths_are_addresses() {
        assert_eq!(encoded("a b/grid-256+vds.png"), "a%20b/grid-256%2Bvds.png");
        assert_eq!(encoded("\"><script>"), "%22%3E%3Cscript%3E");
    }

    #[test]
    fn pictures_are_in_the_page_or_beside_it() {
        let inside = PictureLocation::Inside(b"foo".to_vec());
        let gallery = Gallery {
            shots: vec![shot(inside, None), shot(PictureLocation::Beside, None)],
            ..Gallery::default()
        };
        let page = gallery.html(0).into_string();
        assert!(page.contains("data:image/png;base64,Zm9v"), "{page}");
        assert!(page.contains("src=\"x/exact.png\""), "{page}");
        assert!(!page.contains("<exact>"), "{page}");
        assert!(!page.contains("radio"), "nothing to switch to");
    }

    #[test]
    fn one_switch_shows_where_all_are_wrong() {
        let errors = || {
            let source = PictureLocation::Beside;
            let link = "x/errors.png".to_owned();
            Some(GalleryImage { source, link })
        };
        let gallery = Gallery {
            shots: (0..3)
                .map(|_| shot(PictureLocation::Beside, errors()))
                .collect(),
            ..Gallery::default()
        };
        let page = gallery.html(7).into_string();
        assert_eq!(page.matches("name=\"shown-7\"").count(), 2, "{page}");
        assert_eq!(page.matches("<figure").count(), 3, "one for each method");
        assert_eq!(page.matches("src=\"x/errors.png\"").count(), 3);
    }
}
