// Deformers in closed form. Definitions and notation are those of `Deformer` in the scene: (x, y, h) is the position of a point across,
// aside and along an axis, (p, q, r) are the components of a normal. Bound as @group(0) @binding(1).

#define_import_path cutaway::deformers

#import cutaway::pose::Standing
#import cutaway::trig::{sin_cos, sinc}

const TWIST: u32 = 0u;
const BEND: u32 = 1u;
const WAVE: u32 = 2u;
const INFLATE: u32 = 3u;

struct Deformer {
    // The axis, in rest space.
    centre: vec4<f32>,
    along: vec4<f32>,
    across: vec4<f32>,
    kind: u32,
    // Turn per unit, amplitude of a wave, or distance, depending on the deformer.
    amount: f32,
    // Radians per unit of a wave.
    turn_per_unit: f32,
    // Phase of a wave in radians.
    phase: f32,
}

const MOST_DEFORMERS: u32 = 16u;

struct Deformers {
    rows: array<Deformer, MOST_DEFORMERS>,
}

@group(0) @binding(1) var<uniform> deformers: Deformers;

struct Place {
    at: vec3<f32>,
    normal: vec3<f32>,
    outward: vec3<f32>,
}

fn twisted(turn: f32, place: Place) -> Place {
    let t = sin_cos(turn * place.at.z);
    let turned = mat3x3<f32>(vec3<f32>(t.y, t.x, 0.0), vec3<f32>(-t.x, t.y, 0.0), vec3<f32>(0.0, 0.0, 1.0));
    let at = turned * place.at;
    var normal = turned * place.normal;
    var outward = turned * place.outward;
    normal.z -= turn * (at.x * normal.y - at.y * normal.x);
    outward.z -= turn * (at.x * outward.y - at.y * outward.x);
    return Place(at, normal, outward);
}

fn bent_normal(t: vec2<f32>, m: f32, n: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(m * n.x * t.y + n.z * t.x, m * n.y, n.z * t.y - m * n.x * t.x);
}

fn bent(turn: f32, place: Place) -> Place {
    let angle = turn * place.at.z;
    let t = sin_cos(angle);
    let rise = place.at.z * sinc(0.5 * angle) * sin_cos(0.5 * angle).x;
    let m = 1.0 - turn * place.at.x;
    let at = vec3<f32>(place.at.x * t.y + rise, place.at.y, place.at.z * sinc(angle) - place.at.x * t.x);
    return Place(at, bent_normal(t, m, place.normal), bent_normal(t, m, place.outward));
}

fn waved(amplitude: f32, turn_per_unit: f32, phase: f32, place: Place) -> Place {
    let t = sin_cos(turn_per_unit * place.at.z - phase);
    let slope = amplitude * turn_per_unit * t.y;
    let lean = vec3<f32>(0.0, 0.0, slope);
    return Place(
        place.at + vec3<f32>(amplitude * t.x, 0.0, 0.0),
        place.normal - lean * place.normal.x,
        place.outward - lean * place.outward.x,
    );
}

fn deformed_by(number: u32, standing: Standing) -> Standing {
    let d = deformers.rows[number];
    if d.kind == INFLATE {
        let square = dot(standing.outward, standing.outward);
        let by = select(0.0, d.amount * inverseSqrt(max(square, 1e-30)), square > 1e-30);
        return Standing(standing.point + by * standing.outward, standing.normal, standing.outward);
    }
    let axes = mat3x3<f32>(d.across.xyz, cross(d.along.xyz, d.across.xyz), d.along.xyz);
    let place = Place((standing.point - d.centre.xyz) * axes, standing.normal * axes, standing.outward * axes);
    var to = place;
    switch d.kind {
        case TWIST: { to = twisted(d.amount, place); }
        case BEND: { to = bent(d.amount, place); }
        case WAVE: { to = waved(d.amount, d.turn_per_unit, d.phase, place); }
        default: {}
    }
    return Standing(d.centre.xyz + axes * to.at, axes * to.normal, axes * to.outward);
}
