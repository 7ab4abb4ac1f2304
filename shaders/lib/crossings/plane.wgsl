// The crossings of a pixel if the only clip-surface is a plane: one or none, recomputed on each use. Nothing is stored or read.
//
// Pipelines may round the crossing differently, within the precision of an f32. No result for a cut part depends on that: each sample is
// classified once, by the pass that finds it, and with one plane all kept samples lie on the same side.

#define_import_path cutaway::crossings

#import cutaway::frame::{centre_of, depth_from_buffer, is_behind}
#import cutaway::lone_plane::{LonePlane, is_in_box, lone_plane_at}
#import cutaway::passed::{Before, Head}
#import cutaway::surfaces::surface_of

fn plane_at(at: vec2<u32>) -> LonePlane {
    return lone_plane_at(centre_of(at));
}

fn head_of(at: vec2<u32>) -> Head {
    let plane = plane_at(at);
    return Head(select(0u, 1u, plane.z > 0.0), select(0u, 1u, plane.begins_removed), 0u);
}

// A computed crossing never overflows.
fn is_cut_short(at: vec2<u32>) -> bool {
    return false;
}

// The crossings that may be caps, from the first to before the second: only those in the box of the cut solids.
fn cappable(at: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(0u, select(0u, 1u, is_in_box(plane_at(at), centre_of(at))));
}

fn word_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return 0u;
}

fn surface_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return surface_of(word_at(head, index, at));
}

fn z_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return plane_at(at).z;
}

fn depth_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return depth_from_buffer(z_at(head, index, at));
}

fn crossings_before(z: f32, at: vec2<u32>) -> Before {
    let plane = plane_at(at);
    let behind = select(0u, 1u, is_behind(z, plane.z));
    return Before(behind, behind ^ select(0u, 1u, plane.begins_removed));
}
