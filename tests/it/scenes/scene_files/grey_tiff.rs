//! Grey TIFF as a relief: floats are heights as they are, whole numbers shares of their greatest.

use std::fs::File;
use std::path::Path;

use cutaway_io::load::read_offset_map;
use tiff::encoder::colortype::{
    ColorType, Gray16, Gray32, Gray32Float, Gray64Float, GrayI16, RGB32Float,
};
use tiff::encoder::{TiffEncoder, TiffValue};

use super::Scratch;

fn write<C: ColorType>(path: &Path, size: [u32; 2], samples: &[C::Inner])
where
    [C::Inner]: TiffValue,
{
    let mut encoder =
        TiffEncoder::new(File::create(path).expect("a temporary file")).expect("a header");
    encoder
        .write_image::<C>(size[0], size[1], samples)
        .expect("an image");
}

#[test]
fn floats_and_whole_numbers_of_all_kinds_are_heights() {
    let folder = Scratch::new("tiff");
    let path = folder.path("heights.tif");
    let floats = [-3.5_f32, 0.0, 1e-3, 1234.5, 2.0, 3.0];
    let read = || {
        let map = read_offset_map(&path).unwrap();
        assert_eq!(map.size(), [3, 2]);
        map.texels().to_vec()
    };
    write::<Gray32Float>(&path, [3, 2], &floats);
    assert_eq!(read(), floats, "32 bits");
    write::<Gray64Float>(&path, [3, 2], &floats.map(f64::from));
    assert_eq!(read(), floats, "64 bits");
    write::<Gray16>(&path, [3, 2], &[0, 1, 255, 256, 40_000, 65_535]);
    let shares = [0_u16, 1, 255, 256, 40_000, 65_535].map(|v| f32::from(v) / 65_535.0);
    assert_eq!(read(), shares, "whole numbers of 16 bits");
    write::<Gray32>(&path, [3, 2], &[0, u32::MAX, 0, 0, 0, 0]);
    assert_eq!(read()[1], 1.0, "whole numbers of 32 bits");
    write::<GrayI16>(&path, [3, 2], &[-32_767, 0, 32_767, 0, 0, 0]);
    assert_eq!(read()[..3], [-1.0, 0.0, 1.0], "signed numbers");
    let grey: Vec<f32> = floats.iter().flat_map(|h| [*h; 3]).collect();
    write::<RGB32Float>(&path, [3, 2], &grey);
    assert_eq!(read(), floats, "grey as colour");
}

#[test]
fn heights_that_are_no_numbers_are_refused_by_their_place() {
    let folder = Scratch::new("tiff-nan");
    let path = folder.path("odd.tiff");
    for (bad, phrase) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf")] {
        write::<Gray32Float>(&path, [2, 2], &[0.0, 1.0, bad, 2.0]);
        let message = read_offset_map(&path).unwrap_err().to_string();
        for word in ["odd.tiff", "texel (0, 1)", phrase] {
            assert!(message.contains(word), "{message}");
        }
    }
    let whole = std::fs::read(&path).unwrap();
    for length in [0, 3, 8, whole.len() - 20] {
        std::fs::write(&path, &whole[..length]).unwrap();
        let message = read_offset_map(&path).unwrap_err().to_string();
        assert!(message.contains("odd.tiff"), "{length} bytes: {message}");
    }
}
