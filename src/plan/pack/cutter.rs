//! Triangles of cutters: the data of each triangle except its first vertex.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// A triangle of a cutter, without its first corner: `shaders/strategies/surface/cutter/draw.wgsl`.
    CutterFace {
        /// Its second corner.
        second: [f32; 4],
        /// Its third corner.
        third: [f32; 4],
        /// Unit normal of its plane, and 1 if it is shaded with the normals of its corners.
        normal: [f32; 4],
    }
}
