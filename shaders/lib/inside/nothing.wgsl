// No part is cut: no test is made.

#define_import_path cutaway::inside

#import cutaway::lanes::Lanes

fn is_blank(lanes: Lanes, at: vec2<u32>) -> bool {
    return true;
}

fn next_inside(lanes: Lanes, place: u32, at: vec2<u32>, crossing: u32) -> u32 {
    return lanes.count;
}

fn next_starting(lanes: Lanes, place: u32, at: vec2<u32>) -> u32 {
    return lanes.count;
}

fn in_doubt(lanes: Lanes, at: vec2<u32>) -> bool {
    return false;
}
