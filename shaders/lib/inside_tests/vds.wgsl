// The volumetric depth sprite of one part, as the passes that build and ask it see it. Bound as @group(1) @binding(0).

#define_import_path cutaway::vds

#import cutaway::sprite::Sprite

@group(1) @binding(0) var<uniform> sprite: Sprite;
