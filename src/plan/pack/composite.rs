//! Compositing of a frame into the attachments of a host.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Mapping of pixels to those of a host: `shaders/lib/composite.wgsl`.
    Composite {
        /// Upper left corner of the frame in the target, in pixels.
        origin_px: [u32; 2],
        /// Width and height of the frame.
        size_px: [u32; 2],
        /// A point d scene units ahead is at (x d + y) / (z d + w) in the host's depth buffer.
        depth: [f32; 4],
        /// The host's depth of what is infinitely far.
        far: f32,
        /// 1 where the target takes linear light.
        is_linear: u32,
        /// 1 where pixels that show no model are drawn too.
        has_background: u32,
        /// 1 where nothing but caps is drawn.
        caps_only: u32,
    }
}
