//! Limit on the memory of a comparison.

use cutaway::layers::Layer;
use cutaway::{Error, Result};

/// Maximum total size in bytes of the layers that a comparison keeps: those of exact, and of one frame per renderer.
const MOST_LAYER_BYTES: u64 = 8 << 30;

/// Refuses a comparison at the start that would otherwise run out of memory after minutes.
///
/// # Errors
///
/// Fails if the layers of exact and of `renderers` frames would take more than 8 GiB at this size.
pub fn check_memory(size_px: [u32; 2], renderers: usize) -> Result<()> {
    let [width, height] = size_px.map(u64::from);
    let frames = renderers as u64 + 1;
    let bytes = width * height * size_of::<Layer>() as u64 * frames;
    if bytes <= MOST_LAYER_BYTES {
        return Ok(());
    }
    let gib = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    Err(Error::input(
        format!("--resolution {width},{height}"),
        format!(
            "the layers of {frames} frames, one of exact and one of each strategy, would take {:.1} GiB of memory; the limit is {:.0} GiB",
            gib(bytes),
            gib(MOST_LAYER_BYTES)
        ),
        "lower --resolution, or name fewer --strategies",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_memory_would_hold_is_refused_at_once() {
        assert!(check_memory([1024, 768], 40).is_ok(), "a usual comparison");
        assert!(check_memory([8192, 8192], 1).is_ok(), "a large one");
        let refused = check_memory([16_384, 16_384], 12).unwrap_err().to_string();
        for phrase in [
            "--resolution 16384,16384",
            "13 frames",
            "fewer --strategies",
        ] {
            assert!(refused.contains(phrase), "{refused}");
        }
    }
}
