// Outside the touched tiles the picture is kept as background too. Bound as @group(1) @binding(7).

#define_import_path cutaway::blank

#import cutaway::background::background
#import cutaway::frame::pixel_index

@group(1) @binding(7) var<storage, read_write> picture: array<u32>;

// A nonzero number that identifies this kind of background.
fn kind_of_blank() -> u32 {
    return 2u;
}

fn blank_picture(at: vec2<u32>) {
    picture[pixel_index(at)] = background(at.y);
}
