// No part is cut, so there are no crossings.

#define_import_path cutaway::crossings

#import cutaway::frame::depth_from_buffer
#import cutaway::passed::{Before, Head}
#import cutaway::surfaces::surface_of

fn head_of(at: vec2<u32>) -> Head {
    return Head(0u, 0u, 0u);
}

fn is_cut_short(at: vec2<u32>) -> bool {
    return false;
}

fn cappable(at: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(0u);
}

fn word_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return 0u;
}

fn surface_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return surface_of(word_at(head, index, at));
}

fn z_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return 0.0;
}

fn depth_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return depth_from_buffer(z_at(head, index, at));
}

fn crossings_before(z: f32, at: vec2<u32>) -> Before {
    return Before(0u, 0u);
}
