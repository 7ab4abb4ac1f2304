// Solid textures: colour as a function of the position in the solid, so that all cuts match (Peachey 1985, Perlin 1985). Colours are in
// linear light; the unit of length is the material size. Detail finer than a pixel fades to its mean.

#define_import_path cutaway::solids

#import cutaway::color::linear_from_srgb

// Three numbers from 0 to 1 per cell (PCG of three coordinates: Jarzynski and Olano 2020).
fn hash(cell: vec3<i32>) -> vec3<f32> {
    var v = bitcast<vec3<u32>>(cell) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3<u32>(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3<f32>(v >> vec3<u32>(8u)) / 16777216.0;
}

fn corner_noise(cell: vec3<i32>, at: vec3<f32>) -> f32 {
    return dot(hash(cell) * 2.0 - 1.0, at);
}

// Gradient noise, roughly from -0.7 to 0.7.
fn noise(p: vec3<f32>) -> f32 {
    let floor_p = floor(p);
    let cell = vec3<i32>(floor_p);
    let f = p - floor_p;
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    var sums = vec4<f32>(0.0);
    for (var i = 0; i < 4; i++) {
        let offset = vec3<i32>(0, i & 1, i >> 1);
        let behind = offset + vec3<i32>(1, 0, 0);
        let a = corner_noise(cell + offset, f - vec3<f32>(offset));
        let b = corner_noise(cell + behind, f - vec3<f32>(behind));
        sums[i] = mix(a, b, s.x);
    }
    return mix(mix(sums.x, sums.y, s.y), mix(sums.z, sums.w, s.y), s.z);
}

// Fraction of a pattern with this wavelength that remains at this pixel footprint.
fn kept_at(wavelength: f32, footprint: f32) -> f32 {
    return clamp(2.0 - 4.0 * footprint / wavelength, 0.0, 1.0);
}

// Turbulence of three octaves.
fn turbulence(p: vec3<f32>, footprint: f32) -> f32 {
    var sum = 0.0;
    var scale = 1.0;
    for (var i = 0; i < 3; i++) {
        sum += noise(p * scale) / scale * kept_at(1.0 / scale, footprint);
        scale *= 2.0;
    }
    return sum;
}

// Rings around the third axis, four per material size: a slow rise from early to late wood, and a fast end.
fn wood(p: vec3<f32>, footprint: f32) -> vec3<f32> {
    let early = linear_from_srgb(vec3<f32>(0.86, 0.70, 0.47));
    let late = linear_from_srgb(vec3<f32>(0.55, 0.35, 0.18));
    let bent = p.xy + 0.22 * vec2<f32>(turbulence(p * vec3<f32>(0.5, 0.5, 0.12), footprint), turbulence(p.yxz * vec3<f32>(0.5, 0.5, 0.12) + 7.0, footprint));
    let ring = fract(4.0 * length(bent));
    let dark = ring * ring * (1.0 - smoothstep(0.88, 1.0, ring));
    let fibre = 0.12 * noise(p * vec3<f32>(14.0, 14.0, 0.8)) * kept_at(1.0 / 14.0, footprint);
    return mix(early, late, clamp(mix(0.25, dark, kept_at(0.25, footprint)) + fibre, 0.0, 1.0));
}

// Veins where a warped wave is near zero.
fn marble(p: vec3<f32>, footprint: f32) -> vec3<f32> {
    let pale = linear_from_srgb(vec3<f32>(0.94, 0.92, 0.89));
    let vein = linear_from_srgb(vec3<f32>(0.42, 0.44, 0.49));
    let cloud = turbulence(p * 0.7, footprint);
    let wave = dot(p, vec3<f32>(0.9, 0.5, 0.7)) + 2.6 * turbulence(p * 1.1 + 3.0, footprint);
    let near = 1.0 - abs(fract(wave) * 2.0 - 1.0);
    let line = pow(1.0 - near, 9.0);
    let cover = mix(0.1, line, kept_at(0.6, footprint));
    return mix(pale * (0.92 + 0.22 * cloud), vein, clamp(cover * (0.65 + cloud), 0.0, 0.9));
}

// Grains, fourteen per material size: the nearest of jittered points, one per cell, determines the mineral (Worley 1996).
fn granite(p: vec3<f32>, footprint: f32) -> vec3<f32> {
    let rose = linear_from_srgb(vec3<f32>(0.80, 0.66, 0.60));
    let quartz = linear_from_srgb(vec3<f32>(0.80, 0.79, 0.78));
    let mica = linear_from_srgb(vec3<f32>(0.18, 0.18, 0.20));
    let mean = 0.45 * rose + 0.37 * quartz + 0.18 * mica;
    let scaled = p * 14.0;
    let cell = vec3<i32>(floor(scaled));
    var nearest = 1e9;
    var which = 0.0;
    for (var i = 0; i < 27; i++) {
        let other = cell + vec3<i32>(i % 3, (i / 3) % 3, i / 9) - 1;
        let jitter = hash(other);
        let way = vec3<f32>(other) + jitter - scaled;
        let distance = dot(way, way);
        if distance < nearest {
            nearest = distance;
            which = fract(jitter.x * 57.0 + jitter.y * 31.0);
        }
    }
    let grain = select(select(mica, quartz, which < 0.82), rose, which < 0.45);
    return mix(mean, grain, kept_at(1.0 / 14.0, footprint));
}
