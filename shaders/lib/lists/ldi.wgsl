// The layered depth images of all parts that have one. Bound as @group(1) @binding(0).
//
// Each texel has a list. The lists of an image are in row order, and follow those of the previous part.

#define_import_path cutaway::ldi

#import cutaway::sprite::Sprite

// Indexed by part-table index; a part without an image has a resolution of 0.
@group(1) @binding(0) var<storage, read> sprites: array<Sprite>;

fn list_of(sprite: Sprite, texel: vec2<u32>) -> u32 {
    return (sprite.slot * sprite.resolution + texel.y) * sprite.resolution + texel.x;
}
