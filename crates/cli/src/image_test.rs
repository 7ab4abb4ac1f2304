//! The image test: compares a picture with an accepted reference.
//!
//! Every channel of every pixel counts: a mean would hide differences in the thin lines that matter most at caps. A reference
//! that is missing or of another size is a failure; the test never writes a reference.

use std::path::{Path, PathBuf};

use cutaway::{Error, Result};
use cutaway_io::load::input_file;
use image::{Rgba, RgbaImage};

/// Result of an image test.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ImageTestResult {
    /// No channel of any pixel differs by more than the threshold.
    Same,
    /// Some channels differ by more than the threshold.
    Different {
        /// Description of the difference.
        what: String,
        /// Difference image: grey where equal, red where not; none if the sizes differ.
        difference: Option<RgbaImage>,
    },
}

/// Reads the reference, before the work starts.
pub(super) fn open(path: &Path) -> Result<RgbaImage> {
    if path.exists() {
        input_file::check(path)?;
    }
    let reader = image::ImageReader::open(path)
        .and_then(image::ImageReader::with_guessed_format)
        .map_err(|e| {
            let help = "check the path; to make a reference, render one, check it and keep it";
            Error::file(path, format!("cannot be read: {e}"), help)
        })?;
    let image = reader.decode().map_err(|e| {
        Error::file(
            path,
            format!("is not a readable picture: {e}"),
            "give a PNG as `cutaway render` writes it",
        )
    })?;
    Ok(image.to_rgba8())
}

/// Path of the difference image, next to the output.
pub(super) fn difference_path(output: &Path) -> PathBuf {
    output.with_extension("diff.png")
}

/// Compares a picture with the reference. `threshold` is the largest allowed difference of a channel, 0 to 1.
pub(super) fn compare(
    picture: &RgbaImage,
    reference: &RgbaImage,
    threshold: f64,
) -> ImageTestResult {
    if picture.dimensions() != reference.dimensions() {
        let ((w, h), (rw, rh)) = (picture.dimensions(), reference.dimensions());
        return ImageTestResult::Different {
            what: format!("the picture is {w} x {h}, the reference {rw} x {rh}"),
            difference: None,
        };
    }
    let off = |a: &Rgba<u8>, b: &Rgba<u8>| {
        let each = a.0.iter().zip(&b.0).map(|(a, b)| a.abs_diff(*b));
        f64::from(each.max().unwrap_or(0)) / 255.0
    };
    let (mut count, mut worst) = (0_usize, (0.0, [0, 0]));
    for ((x, y, a), b) in picture.enumerate_pixels().zip(reference.pixels()) {
        let off = off(a, b);
        count += usize::from(off > threshold);
        if off > worst.0 {
            worst = (off, [x, y]);
        }
    }
    if count == 0 {
        return ImageTestResult::Same;
    }
    let difference = RgbaImage::from_fn(picture.width(), picture.height(), |x, y| {
        let (a, b) = (picture.get_pixel(x, y), reference.get_pixel(x, y));
        let grey = (u16::from(b[0]) + u16::from(b[1]) + u16::from(b[2])) / 12;
        let grey = grey as u8;
        match off(a, b) {
            off if off > threshold => Rgba([255, grey, grey, 255]),
            _ => Rgba([grey, grey, grey, 255]),
        }
    });
    let (most, [x, y]) = worst;
    ImageTestResult::Different {
        what: format!(
            "{count} pixels differ by more than {threshold}, the worst by {most:.3} at {x},{y}"
        ),
        difference: Some(difference),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_pixel_off_by_more_than_the_threshold_fails() {
        let reference = RgbaImage::from_pixel(20, 10, Rgba([100, 100, 100, 255]));
        let mut picture = reference.clone();
        assert_eq!(compare(&picture, &reference, 0.0), ImageTestResult::Same);
        picture.put_pixel(7, 3, Rgba([100, 151, 100, 255]));
        assert_eq!(
            compare(&picture, &reference, 0.2),
            ImageTestResult::Same,
            "exactly at the threshold"
        );
        let ImageTestResult::Different { what, difference } = compare(&picture, &reference, 0.19)
        else {
            panic!("a difference of 0.2 is more than 0.19");
        };
        assert!(
            what.starts_with("1 pixels") && what.ends_with("0.200 at 7,3"),
            "{what}"
        );
        let difference = difference.unwrap();
        assert_eq!(difference.get_pixel(7, 3).0[0], 255, "marked");
        assert_eq!(difference.get_pixel(8, 3).0[0], 25, "not marked");
    }

    #[test]
    fn another_size_is_a_difference() {
        let found = compare(&RgbaImage::new(2, 3), &RgbaImage::new(3, 2), 1.0);
        assert!(
            matches!(
                found,
                ImageTestResult::Different {
                    difference: None,
                    ..
                }
            ),
            "{found:?}"
        );
    }
}
