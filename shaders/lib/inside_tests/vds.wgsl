// The volumetric depth sprite of one part, for the passes that build and sample it. Bound as @group(1) @binding(0).

#define_import_path cutaway::vds

#import cutaway::sprite::Sprite

@group(1) @binding(0) var<uniform> sprite: Sprite;
