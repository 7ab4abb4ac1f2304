// The background: a sky that fades to the ground.

#define_import_path cutaway::background

#import cutaway::frame::frame

// Colour of a row where there is no surface and no cap.
fn background(row: u32) -> u32 {
    let color = mix(vec3<f32>(0.93, 0.94, 0.95), vec3<f32>(0.72, 0.75, 0.79), f32(frame.band.x + row) / f32(frame.band.y));
    return pack4x8unorm(vec4<f32>(color, 1.0));
}
