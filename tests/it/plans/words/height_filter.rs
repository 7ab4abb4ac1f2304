//! `filtered_height` by both filters against the offset map in f64: how far a sampler is off, in units of what the relief changes in a
//! cell, and that what is uploaded for it is the map.
//!
//! How many bits of the place within a cell an adapter keeps is its own: most say 8 and keep 8; Mesa's software adapter says 8 and
//! interpolates 32-bit floats in f32. The bound holds for either, and the figure of the adapter at hand is printed.

use std::sync::Arc;

use cutaway::Model;
use cutaway::generate::shapes;
use cutaway::gpu::run_words_with;
use cutaway::plan::{Capacities, Plan};
use cutaway::scene::{ClipSurface, Cut, HeightFilter, OffsetMap, Scene, Wrap};
use cutaway::strategies::{self, DrawOptions, Method};
use glam::{DVec2, DVec3};

use crate::plans::words::{GPU, Random, words_of};

const SEED: u64 = 0xf117;
/// What 8 bits of the place may cost along two axes, whether rounded or cut off.
const OF_EIGHT_BITS: f64 = 1.0 / 128.0;

const FILTERED_AT: &str = "
@group(1) @binding(0) var<storage, read> texels: array<vec2<f32>>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&texels) { return; }
    words[id.x] = bitcast<u32>(filtered_height(1u, texels[id.x]));
}";

const SAMPLED: &str = "#import cutaway::height_filter::filtered_height";

/// Two cuts with maps of one size, the second of random heights but for a level corner of 3 x 3 texels.
fn scene(wrap: Wrap, size: [u32; 2]) -> (Scene, Arc<OffsetMap>) {
    let random = &mut Random(SEED);
    let first = OffsetMap::new(size, (0..size[0] * size[1]).map(|i| i as f32).collect());
    let heights = (0..size[0] * size[1]).map(|i| {
        let is_level = i % size[0] < 3 && i / size[0] < 3;
        if is_level { 0.375 } else { random.signed() }
    });
    let second = Arc::new(OffsetMap::new(size, heights.collect()).expect("finite heights"));
    let surface = |map: Arc<OffsetMap>, z: f64| ClipSurface {
        scale: DVec3::new(1.0, 1.0, 0.1),
        relief: Some(map),
        wrap,
        ..ClipSurface::plane(DVec3::Z * z, DVec3::Z)
    };
    let surfaces = vec![
        surface(Arc::new(first.expect("finite heights")), 0.0),
        surface(second.clone(), 0.1),
    ];
    let scene = Scene {
        parts: shapes::shape("cube").unwrap_or_else(|e| panic!("{e}")),
        cuts: vec![Cut::new("c", surfaces)],
        ..Scene::default()
    };
    (scene, second)
}

fn plan(scene: &Scene) -> Plan {
    let model = Model::new(scene);
    let view = model.prepared.view([32, 32]);
    let options = DrawOptions {
        height_filter: Some(HeightFilter::Hardware),
        ..DrawOptions::default()
    };
    let strategy = "grid:8+vds:16".parse().unwrap_or_else(|e| panic!("{e}"));
    strategies::plan(
        &model,
        &view,
        Method::new(strategy, options),
        &Capacities::UNKNOWN,
    )
    .unwrap_or_else(|e| panic!("{e}"))
}

/// The greatest error in units of what the relief changes in a cell, and the greatest where it changes nothing.
fn errors(text: &str, with: &[&str], wrap: Wrap, size: [u32; 2]) -> [f64; 2] {
    let random = &mut Random(SEED + 1);
    let mut texels: Vec<[f32; 2]> = (0..4000)
        .map(|_| [random.signed() * 20.0, random.signed() * 20.0])
        .collect();
    texels.extend((0..500).map(|_| [1.0 + random.signed(), 1.0 + random.signed()]));
    let (scene, map) = scene(wrap, size);
    let plan = plan(&scene);
    let resource = |name: &str| plan.resource(plan.resource_named(name).expect(name));
    let uploaded = |name: &str| {
        let contents = resource(name).contents.as_ref().expect("an upload");
        bytemuck::pod_collect_to_vec::<u8, u32>(&contents.bytes())
    };
    let mut inputs = vec![("texels", words_of(&texels))];
    let mut resources = Vec::new();
    inputs.push(("cut_table", uploaded("cut_table")));
    if text.contains("cutaway::relief") || with.contains(&"lib/height_filter/exact.wgsl") {
        inputs.push(("heights", uploaded("heights")));
    } else {
        resources.extend(["relief_maps", "relief_sampler"].map(|name| (name, resource(name))));
    }
    let wgsl = format!("{text}{FILTERED_AT}");
    let given = run_words_with(&GPU, &wgsl, with, &inputs, &resources, texels.len())
        .unwrap_or_else(|e| panic!("{e}\n{wgsl}"));
    let size = DVec2::from(size.map(f64::from));
    let [mut sloped, mut level] = [0.0_f64; 2];
    for (texel, word) in texels.iter().zip(given) {
        let at = DVec2::from(texel.map(f64::from));
        let height = f64::from(f32::from_bits(word));
        let error = (height - map.sample(wrap, (at + 0.5) / size).0).abs();
        let corner = at.floor();
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE]
            .map(|c| map.sample(wrap, (corner + c + 0.5) / size).0);
        let fold = |f: fn(f64, f64) -> f64| corners.into_iter().reduce(f).unwrap_or(0.0);
        let change = fold(f64::max) - fold(f64::min);
        if change > 0.01 {
            sloped = sloped.max(error / change);
        } else if change < 1e-12 {
            level = level.max(error);
        }
    }
    [sloped, level]
}

const CASES: [(Wrap, [u32; 2]); 4] = [
    (Wrap::Repeat, [8, 8]),
    (Wrap::Mirror, [16, 4]),
    (Wrap::Clamp, [8, 16]),
    (Wrap::Repeat, [5, 7]),
];

#[test]
fn a_sampler_is_off_by_no_more_than_its_bits_cost() {
    for (wrap, size) in CASES {
        let [exact, _] = errors(SAMPLED, &["lib/height_filter/exact.wgsl"], wrap, size);
        let [sloped, level] = errors(SAMPLED, &["lib/height_filter/hardware.wgsl"], wrap, size);
        println!(
            "{wrap:?} {size:?}: by four texels off by {exact:.1e} of what a cell changes, by the sampler {sloped:.1e} (2^{:.1})",
            sloped.log2()
        );
        assert!(exact < 2e-4, "{wrap:?} {size:?}: {exact} by four texels");
        assert!(sloped < OF_EIGHT_BITS, "{wrap:?} {size:?}: {sloped}");
        assert!(level < 1e-6, "{wrap:?} {size:?}: {level} where it is level");
    }
}

#[test]
fn eight_bits_of_the_place_and_wrong_samplers_are_noticed() {
    // What a sampler of 8 bits answers, which is seen and allowed.
    let eight = "#import cutaway::relief::{cell_at, height_in}
fn filtered_height(surface: u32, texel: vec2<f32>) -> f32 {
    let corner = floor(texel);
    let weight = round((texel - corner) * 256.0) / 256.0;
    return height_in(cell_at(surface, vec2<i32>(corner)), weight);
}";
    let [sloped, level] = errors(eight, &[], Wrap::Repeat, [8, 8]);
    assert!(
        (OF_EIGHT_BITS / 8.0..OF_EIGHT_BITS).contains(&sloped),
        "8 bits: {sloped}"
    );
    assert!(level < 1e-6, "8 bits where it is level: {level}");
    for (what, planted) in [
        (
            "7 bits, cut off",
            eight.replace(
                "round((texel - corner) * 256.0) / 256.0",
                "floor((texel - corner) * 128.0) / 128.0",
            ),
        ),
        (
            "half a texel beside",
            eight.replace("floor(texel)", "floor(texel + 0.5)"),
        ),
        ("the nearest texel", eight.replace("* 256.0) / 256.0", ")")),
        (
            "the other map",
            eight.replace("cell_at(surface,", "cell_at(surface - 1u,"),
        ),
    ] {
        assert_ne!(planted, eight, "{what}");
        let [sloped, _] = errors(&planted, &[], Wrap::Repeat, [8, 8]);
        assert!(sloped > OF_EIGHT_BITS, "{what}: {sloped}");
    }
}
