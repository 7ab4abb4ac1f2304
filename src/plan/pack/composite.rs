//! Compositing of a frame into the attachments of a host.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Mapping of the frame's pixels to the host's: `shaders/lib/composite.wgsl`.
    Composite {
        /// Upper left corner of the frame in the target, in pixels.
        origin_px: [u32; 2],
        /// Width and height of the frame.
        size_px: [u32; 2],
        /// A point d scene units ahead has depth (x d + y) / (z d + w) in the host's depth buffer.
        depth: [f32; 4],
        /// The host's depth of points infinitely far away.
        far: f32,
        /// 1 if the target expects linear light.
        is_linear: u32,
        /// 1 if pixels that show no model are also drawn.
        has_background: u32,
        /// 1 if only caps are drawn.
        caps_only: u32,
    }
}
