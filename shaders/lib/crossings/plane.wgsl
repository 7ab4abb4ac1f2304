// The crossings of a pixel where the only clip-surface is a plane: one or none, computed anew by whoever asks. Nothing is stored or read.
//
// Pipelines may round it differently, by what an f32 is worth. Of a part that is cut nothing hangs on that: each of its samples is judged
// once, by the pass that finds it, and with one plane all that are kept lie on one side of it.

#define_import_path cutaway::crossings

#import cutaway::frame::{centre_of, depth_from_buffer, frame, is_behind}
#import cutaway::lone_plane::{LonePlane, lone_plane_at}
#import cutaway::passed::Before

fn plane_at(pixel: u32) -> LonePlane {
    return lone_plane_at(centre_of(vec2<u32>(pixel % frame.size_px.x, pixel / frame.size_px.x)));
}

fn head_of(pixel: u32) -> vec2<u32> {
    let plane = plane_at(pixel);
    return vec2<u32>(select(0u, 1u, plane.z > 0.0), select(0u, 1u, plane.begins_removed));
}

// What is computed is never cut short.
fn is_cut_short(pixel: u32) -> bool {
    return false;
}

fn listed(head: u32) -> u32 {
    return head;
}

fn word_at(index: u32, pixel: u32) -> u32 {
    return 0u;
}

fn surface_at(index: u32, pixel: u32) -> u32 {
    return 0u;
}

fn z_at(index: u32, pixel: u32) -> f32 {
    return plane_at(pixel).z;
}

fn depth_at(index: u32, pixel: u32) -> f32 {
    return depth_from_buffer(z_at(index, pixel));
}

fn crossings_before(z: f32, pixel: u32) -> Before {
    let plane = plane_at(pixel);
    let behind = select(0u, 1u, is_behind(z, plane.z));
    return Before(behind, behind ^ select(0u, 1u, plane.begins_removed));
}
