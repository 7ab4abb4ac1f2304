// Tests whether a point is inside a part by its volumetric depth sprite: an odd number of layers lies behind it. Texels are loaded,
// not filtered, and hold 1 where a layer is empty. Bound as @group(1) @binding(2).

#define_import_path cutaway::volume

#import cutaway::sprite::{Probe, is_beside, sprite_from_scene, texel_of}
#import cutaway::vds::sprite

@group(1) @binding(2) var depth_layers: texture_depth_2d_array;

// Layers of a texture of core WebGPU.
const MOST_LAYERS: u32 = 256u;

fn probe(place: u32, point: vec3<f32>) -> Probe {
    let at = sprite_from_scene(sprite, point);
    if is_beside(at) {
        return Probe(false, false);
    }
    let texel = texel_of(sprite, at);
    var is_inside = false;
    for (var layer = 0u; layer < min(sprite.layers, MOST_LAYERS); layer++) {
        let depth = textureLoad(depth_layers, texel, layer, 0);
        if depth < 1.0 && at.z < depth {
            is_inside = !is_inside;
        }
    }
    return Probe(is_inside, false);
}
