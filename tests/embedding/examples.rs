//! The examples run, and do what they say.

use cutaway::gpu::wgpu::TextureFormat;

use super::host::Host;

#[allow(dead_code, reason = "its `main` writes a file")]
#[path = "../../examples/embed.rs"]
mod embed;

/// Colours of the picture of the embedding example, as what they are of.
fn is_floor(pixel: &[u8]) -> bool {
    // Linear light of the two squares, as sRGB.
    let [dark, light] = [[108, 149, 137], [160, 149, 137]];
    [dark, light]
        .iter()
        .any(|c| pixel[..3].iter().zip(c).all(|(a, b)| a.abs_diff(*b) <= 1))
}

#[test]
fn a_host_draws_a_floor_through_a_cut_crank() {
    let rgba = embed::draw().expect("a picture");
    let pixels = rgba.chunks_exact(4);
    let floor = pixels.clone().filter(|p| is_floor(p)).count();
    let sky = pixels.clone().filter(|p| p[..3] == [39, 48, 63]).count();
    let crank = pixels.len() - floor - sky;
    assert!(
        floor > 40_000 && crank > 15_000,
        "{floor} floor, {crank} crank, {sky} sky"
    );
    // The control: a host alone has no crank.
    let host = Host::new([64, 64], TextureFormat::Rgba8Unorm);
    assert!(
        !host.read().0.chunks_exact(4).any(is_floor),
        "a floor anywhere"
    );
}
