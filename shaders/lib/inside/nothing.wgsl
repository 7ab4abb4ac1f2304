// No part is cut: nothing is asked.

#define_import_path cutaway::inside

#import cutaway::lanes::Lanes

fn is_blank(pixel: u32) -> bool {
    return true;
}

fn is_inside(lanes: Lanes, place: u32, pixel: u32, crossing: u32) -> bool {
    return false;
}

fn starts_inside(lanes: Lanes, place: u32, pixel: u32) -> bool {
    return false;
}

fn in_doubt(lanes: Lanes, pixel: u32) -> bool {
    return false;
}
