//! A host with a device, an encoder, a camera and attachments of its own, which a cut solid is composed into by depth.
//!
//! The host draws a chequered floor that passes through a crankshaft; cutaway adds the crankshaft, cut open, in the same frame. Nothing
//! is read back and nothing waited for until the host wants a file: `cargo run --example embed` turns it in a window,
//! `cargo run --example embed -- out.png` writes a picture.

mod headless;
mod host;
mod window;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(path) = std::env::args().nth(1) else {
        return window::run();
    };
    let [width, height] = headless::SIZE_PX;
    image::save_buffer(&path, &draw()?, width, height, image::ColorType::Rgba8)?;
    println!("{path}");
    Ok(())
}

/// The picture that the host draws without a window: RGBA8, rows from the top.
pub(crate) fn draw() -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    headless::draw()
}
