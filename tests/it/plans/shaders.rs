//! Every composition is valid under naga's default capabilities, keeps our own rules, and means the same by every shared
//! struct and constant as the Rust that fills it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::sync::Arc;

use cutaway::generate::shapes;
use cutaway::layers::{Kind, NEAR_PLANE};
use cutaway::passes::{
    BLOCK_WORDS, INVOCATIONS_PER_ROW, Model, NEED_OF_SHEETS, NEED_OF_TRIANGLES, NO_LANE,
};
use cutaway::plan::pack::{
    self, Cascade, ClipSurface, Composite, CutTable, Deformer, Domain, DrawnPart, FragmentPool,
    Frame, Layout, MAX_CUTS, MAX_SURFACES, MOST_DEFORMERS, MOST_DRAWN_PARTS,
    MOST_PRECLASSIFIED_GROUPS, NO_RELIEF, Part, PartHatch, Pose, PreclassifiedGroup, Pyramid, Quad,
    RayRow, RaySurface, RayTable, RaysOfFour, Refinement, SheetPool, Sprite, Sweep,
};
use cutaway::plan::{Capacities, Work};
use cutaway::scene::{Camera, ClipSurface as SceneSurface, Cut, Scene, Style, Wrap};
use cutaway::shader::{self, Composed, Finding, Rule, StructLayout, lint};
use cutaway::strategies::{self, Strategy};
use glam::{DAffine3, DVec3};
use naga::{ArraySize, Expression, Literal, Module, TypeInner};

/// Files that no plan puts together, for so many storage buffers a stage does not have; a plan that did would be refused.
const NEVER_TOGETHER: &[(&str, &str, &str)] = &[
    (
        "lib/crossings/list.wgsl",
        "lib/touch/tiles.wgsl",
        "where there is a list, a pass before the sweep has found the tiles",
    ),
    (
        "lib/touch/depths.wgsl",
        "lib/crossings/list.wgsl",
        "sweeps find depths where rays are walked after them",
    ),
    (
        "lib/share/effect_tiles.wgsl",
        "lib/interval/tiles.wgsl",
        "tiles that effects draw are known when there are layers, after all crossings",
    ),
];

/// Float comparisons by equality that are meant.
const MEANT_EQUALITIES: &[(&str, &str)] = &[
    (
        "roots_in",
        "a = 0 is the flat cell, of which the second root is at infinity; q = 0 means b = 0 and D <= 0, where 0 / 0 must not \
         be taken. Any other a or q, however small, is divided by and clamped",
    ),
    (
        "cross_level",
        "a ray exactly parallel to the plane has no crossing; any other has one at a depth that the interval judges",
    ),
    (
        "depth_at_border",
        "a ray that runs along a row of cells exactly never reaches a border of it; any other does, however far",
    ),
];

fn composed() -> Vec<(&'static str, Arc<Composed>)> {
    shader::compositions()
        .iter()
        .map(|s| (s.path, shader::compose(s).unwrap_or_else(|e| panic!("{e}"))))
        .collect()
}

fn undecorated(name: &str) -> &str {
    name.split("__").next().unwrap_or(name)
}

#[test]
fn every_shader_composes() {
    let mut faults = Vec::new();
    let all = shader::compositions();
    for shader in &all {
        match shader::compose(shader) {
            Ok(composed) => assert!(
                !composed.module.entry_points.is_empty(),
                "{shader} has no entry point"
            ),
            Err(e) => faults.push(e.to_string()),
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    // Each shader at least once, and each file of the library that fills an open module in some shader.
    for (path, _) in shader::SHADERS {
        assert!(
            all.iter().any(|s| s.path == *path),
            "{path} is not composed"
        );
    }
    let resolves = all.iter().filter(|s| s.path == "passes/resolve.wgsl");
    assert!(resolves.count() >= 2, "two kinds of caps");
}

#[test]
fn only_the_listed_files_are_more_than_core() {
    let native: BTreeSet<&str> = (composed().iter())
        .filter(|(_, composed)| composed.is_native)
        .map(|(path, _)| *path)
        .collect();
    assert_eq!(
        native,
        BTreeSet::from([
            "passes/rasterise/large.wgsl",
            "passes/rasterise/small.wgsl",
            "passes/rasterise/within.wgsl",
        ]),
        "shaders with atomics of 64 bits"
    );
    // The control: what a listed file does is refused in any other.
    for (path, reason) in shader::NATIVE {
        let text = (shader::LIBRARY.iter()).find(|(p, _)| p == path);
        let text = text.expect("a file of the library").1;
        assert!(text.contains("atomic<u64>"), "{path} is listed: {reason}");
    }
    let elsewhere = "@group(0) @binding(0) var<storage, read_write> w: array<atomic<u64>>;\n\
        @compute @workgroup_size(1) fn main() { atomicMax(&w[0], 1lu); }";
    assert!(
        shader::compose_text("planted", elsewhere).is_err(),
        "atomics of 64 bits in a file that is not listed"
    );
}

#[test]
fn open_modules_want_to_be_filled_once() {
    let resolve = shader::Shader::from("passes/resolve.wgsl");
    let unfilled = shader::compose(&resolve)
        .expect_err("nothing fills it")
        .to_string();
    assert!(
        unfilled.contains("is open: fill it with one of lib/"),
        "{unfilled}"
    );
    let idle = shader::Shader::from("passes/gather.wgsl").with("lib/store/mask.wgsl");
    let idle = shader::compose(&idle)
        .expect_err("it has no such module")
        .to_string();
    assert!(
        idle.contains("no open module that lib/store/mask.wgsl"),
        "{idle}"
    );
}

#[test]
fn what_is_not_wgsl_does_not_compose() {
    for wrong in [
        "@compute @workgroup_size(1) fn main() { let a: u32 = 1.5; }",
        "#import cutaway::frame::no_such_thing\n@compute @workgroup_size(1) fn main() { no_such_thing(); }",
        // Valid WGSL, but not core WebGPU.
        "enable f16;\n@group(0) @binding(0) var<storage, read_write> h: array<f16>;\n@compute @workgroup_size(1) fn main() { h[0] = 1.5h; }",
    ] {
        assert!(shader::compose_text("planted", wrong).is_err(), "{wrong}");
    }
}

/// Whether the vertex stage of a module promises the same position for the same input in every pipeline.
fn is_invariant(module: &Module) -> bool {
    let promised = |b: &Option<naga::Binding>| {
        let position = naga::BuiltIn::Position { invariant: true };
        *b == Some(naga::Binding::BuiltIn(position))
    };
    module.entry_points.iter().any(|entry| {
        let result = entry.function.result.as_ref();
        result.is_some_and(|r| match &module.types[r.ty].inner {
            TypeInner::Struct { members, .. } => members.iter().any(|m| promised(&m.binding)),
            _ => promised(&r.binding),
        })
    })
}

#[test]
fn passes_that_must_meet_have_invariant_positions() {
    for (path, composed) in composed() {
        let meets = [
            "passes/surface.wgsl",
            "passes/solid.wgsl",
            "passes/fragments.wgsl",
            "passes/sheet/draw.wgsl",
            "strategies/surface/cutter/draw.wgsl",
            "strategies/inside/stencil/solid.wgsl",
            "strategies/inside/stencil/mark.wgsl",
        ];
        assert!(
            !meets.contains(&path) || is_invariant(&composed.module),
            "{path}: another pipeline may move its vertices"
        );
    }
    let free = "@vertex fn vertex() -> @builtin(position) vec4<f32> { return vec4<f32>(0.0); }";
    let free = shader::compose_text("planted", free).unwrap_or_else(|e| panic!("{e}"));
    assert!(!is_invariant(&free), "planted");
}

// Structs.

/// What differs between a struct of Rust and the one of the same name in a module; `None` if the module has none.
fn layout_faults<T: Layout>(module: &Module) -> Option<Vec<String>> {
    let StructLayout { fields, size } = shader::struct_layout(module, T::NAME)?;
    let wgsl: Vec<(String, usize, usize)> = fields
        .into_iter()
        .map(|(name, offset, size)| (name, offset as usize, size as usize))
        .collect();
    let rust: Vec<(String, usize, usize)> = T::fields()
        .into_iter()
        .map(|(name, offset, size)| (name.to_owned(), offset, size))
        .collect();
    let mut faults = Vec::new();
    if size as usize != size_of::<T>() {
        faults.push(format!(
            "{}: {} bytes in Rust, {size} in WGSL",
            T::NAME,
            size_of::<T>()
        ));
    }
    if wgsl != rust {
        faults.push(format!("{}: {rust:?} in Rust, {wgsl:?} in WGSL", T::NAME));
    }
    Some(faults)
}

fn holds_in_all_shaders<T: Layout>(modules: &[(&str, Arc<Composed>)]) {
    let mut met = 0;
    for (path, composed) in modules {
        if let Some(faults) = layout_faults::<T>(&composed.module) {
            met += 1;
            assert!(faults.is_empty(), "{path}: {}", faults.join("\n"));
        }
    }
    assert!(met > 0, "no shader has the struct {}", T::NAME);
}

/// Holds structs in all shaders; how many they are.
macro_rules! hold_in_all_shaders {
    ($modules:ident: $($shared:ty),* $(,)?) => {{
        $(holds_in_all_shaders::<$shared>(&$modules);)*
        [$(stringify!($shared)),*].len()
    }};
}

#[test]
fn shared_structs_are_laid_out_alike() {
    let modules = composed();
    let held = hold_in_all_shaders!(modules:
        Frame,
        ClipSurface,
        CutTable,
        Part,
        RayRow,
        RaySurface,
        RaysOfFour,
        RayTable,
        Sprite,
        Quad,
        Sweep,
        DrawnPart,
        PreclassifiedGroup,
        FragmentPool,
        SheetPool,
        Cascade,
        Pose,
        Deformer,
        Domain,
        Refinement,
        Pyramid,
        Composite,
        pack::Style,
        pack::CapPlane,
        pack::CapMaterial,
        pack::CutterFace,
        pack::VertexPaintRow,
        pack::CapMaterialPlanes,
        pack::Texture,
        pack::Ground,
        pack::ReliefSky,
        pack::HatchPlanes,
        pack::HatchLine,
        PartHatch,
        pack::Ghost,
        pack::Horizon,
        pack::Unsharp
    );
    // The list above is all there is: a struct added to the files must be added here.
    let folder = crate::common::root().join("src/plan");
    let files = fs::read_dir(folder.join("pack")).expect("a folder");
    let paths = files.map(|entry| entry.expect("an entry").path());
    let texts = paths
        .chain([folder.join("pack.rs")])
        .map(|path| fs::read_to_string(path).expect("a file"));
    let declared: usize = texts.map(|text| text.matches("\nshared! {").count()).sum();
    assert_eq!(declared, held, "structs in src/plan/pack.rs and beside it");
}

#[test]
fn a_struct_that_drifted_is_noticed() {
    let main = "@compute @workgroup_size(1) fn main() { if rows[0].corner.x > 0.0 { rows[0].corner.x = 1.0; } }";
    let planted = |body: &str| {
        let text = format!(
            "struct Quad {{ {body} }}\n@group(0) @binding(0) var<storage, read_write> rows: array<Quad>;\n{main}"
        );
        let module = shader::compose_text("planted", &text).unwrap_or_else(|e| panic!("{e}"));
        layout_faults::<Quad>(&module).expect("there is a Quad")
    };
    let rows = [
        "corner: vec4<f32>,",
        "step_u: vec4<f32>,",
        "step_v: vec4<f32>,",
    ];
    let cells = "cells: vec4<u32>,";
    assert_eq!(
        planted(&[rows.concat().as_str(), cells].concat()),
        Vec::<String>::new(),
        "the struct as it is"
    );
    let [corner, u, v] = rows;
    for (drift, body) in [
        ("a field is gone", format!("{corner}{u}{cells}")),
        ("two are exchanged", format!("{corner}{v}{u}{cells}")),
        (
            "a row is a vec3, of another size",
            format!("{corner}{u}step_v: vec3<f32>,{cells}"),
        ),
        ("one is longer", format!("{corner}{u}{v}{cells}more: u32,")),
        ("one moved", format!("{corner}gap: u32,{u}{v}{cells}")),
    ] {
        assert!(!planted(&body).is_empty(), "{drift}");
    }
}

// Constants.

/// Constants of a module by the names of their author.
fn constants(module: &Module) -> BTreeMap<String, u32> {
    let literal = |e| match module.global_expressions[e] {
        Expression::Literal(Literal::U32(n)) => Some(n),
        _ => None,
    };
    module
        .constants
        .iter()
        .filter_map(|(_, c)| Some((undecorated(c.name.as_deref()?).to_owned(), literal(c.init)?)))
        .collect()
}

/// Lengths of arrays in the structs of a module.
fn array_lengths(module: &Module) -> BTreeMap<(String, String), u32> {
    let mut lengths = BTreeMap::new();
    for (_, ty) in module.types.iter() {
        if let (Some(name), TypeInner::Struct { members, .. }) = (&ty.name, &ty.inner) {
            for m in members {
                if let TypeInner::Array {
                    size: ArraySize::Constant(n),
                    ..
                } = module.types[m.ty].inner
                {
                    let field = m.name.clone().unwrap_or_default();
                    lengths.insert((undecorated(name).to_owned(), field), n.get());
                }
            }
        }
    }
    lengths
}

/// The value that a plan gives to an override constant, in a scene with a cut and an uncut part.
fn override_of_a_plan(shader: &str, name: &str) -> f64 {
    let mut parts = shapes::shape("cube").unwrap_or_else(|e| panic!("{e}"));
    let mut far = shapes::shape("cube").unwrap_or_else(|e| panic!("{e}"));
    far[0].world_from_part = DAffine3::from_translation(DVec3::Z * 10.0);
    parts.append(&mut far);
    let plane = SceneSurface::plane(DVec3::Z * 0.1, DVec3::Z);
    let scene = Scene {
        parts,
        cuts: vec![Cut::new("c", vec![plane])],
        camera: Camera::default(),
        stage: None,
        outline: None,
        interference: None,
        style: Style::default(),
        name: String::new(),
    };
    let model = Model::new(&scene);
    let view = model.prepared.view([64, 64]);
    let plan = strategies::plan(&model, &view, Strategy::RAYCAST_MASK, &Capacities::UNKNOWN)
        .unwrap_or_else(|e| panic!("{e}"));
    let pass = plan
        .passes
        .iter()
        .find(|p| p.shader.path == shader)
        .unwrap_or_else(|| panic!("the plan has no pass of {shader}"));
    assert!(
        matches!(pass.work, Work::Draw { .. }),
        "{shader} is not a draw"
    );
    let value = pass.constants.iter().find(|(n, _)| *n == name);
    value
        .unwrap_or_else(|| panic!("{shader} is given no `{name}`"))
        .1
}

#[test]
fn constants_have_one_value_on_both_sides() {
    let modules = composed();
    let mut all: BTreeMap<String, BTreeSet<u32>> = BTreeMap::new();
    for (_, composed) in &modules {
        for (name, value) in constants(&composed.module) {
            all.entry(name).or_default().insert(value);
        }
    }
    // Constants that no whole shader imports are composed here, lest they drift unseen.
    let rest = "#import cutaway::cuts::MAX_SURFACES\n#import cutaway::relief::{REPEAT, MIRROR}\n\
        #import cutaway::deformers::{TWIST, BEND, WAVE, INFLATE}\n\
        @group(0) @binding(9) var<storage, read_write> words: array<u32>;\n\
        @compute @workgroup_size(1) fn main() { words[0] = MAX_SURFACES + REPEAT + MIRROR + TWIST + BEND + WAVE + INFLATE; }";
    let rest = shader::compose_text("rest", rest).unwrap_or_else(|e| panic!("{e}"));
    for (name, value) in constants(&rest) {
        all.entry(name).or_default().insert(value);
    }
    let words_per_pixel = {
        let layers = cutaway::layers::Layers::background([1, 1]);
        assert_eq!(layers.pixels.len(), 1, "one pixel");
        // A plan's `layers` buffer states how many words a pixel has.
        let model = Model::new(&Scene {
            parts: shapes::shape("cube").unwrap_or_else(|e| panic!("{e}")),
            ..Scene::default()
        });
        let view = model.prepared.view([1, 1]);
        let plan = strategies::plan(&model, &view, Strategy::RAYCAST_MASK, &Capacities::UNKNOWN)
            .unwrap_or_else(|e| panic!("{e}"));
        plan.resource(plan.layers.expect("layers")).shape.bytes() as u32 / 4
    };
    let expected = [
        ("NO_RELIEF", NO_RELIEF),
        ("NO_TEXTURE", pack::NO_TEXTURE),
        ("FILLED_STACK", pack::FILLED_STACK),
        ("VERTEX_PAINT_WORDS", pack::VERTEX_PAINT_WORDS as u32),
        ("MAX_SURFACES", MAX_SURFACES as u32),
        ("MOST_PLANES", pack::MOST_PLANES as u32),
        ("WORDS_PER_PIXEL", words_per_pixel),
        (
            "UNCOUNTED",
            override_of_a_plan("passes/surface.wgsl", "behind") as u32,
        ),
        ("NEAR_PLANE", u32::from(NEAR_PLANE)),
        ("BACKGROUND", Kind::Background as u32),
        ("SURFACE", Kind::Surface as u32),
        ("CAP", Kind::Cap as u32),
        // The bits that `gpu::program` takes words apart by.
        ("BACK_FACE", 4),
        ("UNRELIABLE", 8),
        ("OVERLAP", 16),
        // In the place of the shift of a lane of 32 bits: `tests/it/plans/plan/minimum.rs` finds it in the table of parts.
        ("WINDING", 32),
        // Known to the shader alone.
        ("STRIPE_PX", 10),
        // No clip-surface: known to the shaders alone, and no number of one.
        ("NONE", u32::MAX),
        // A bit of the word of a crossing: known to the shaders alone.
        ("HAS_NORMAL", 32),
        ("REPEAT", Wrap::Repeat.code()),
        ("INVOCATIONS_PER_ROW", INVOCATIONS_PER_ROW),
        ("BLOCK_WORDS", BLOCK_WORDS),
        ("NO_LANE", NO_LANE),
        ("TWIST", pack::TWIST),
        ("BEND", pack::BEND),
        ("WAVE", pack::WAVE),
        ("INFLATE", pack::INFLATE),
        // The near plane and four sides: known to the shaders alone.
        ("BORDERS", 5),
        ("BORDERS_OF_DOMAIN", pack::BORDERS_OF_DOMAIN as u32),
        // Cells that a workgroup looks at along a side: known to the shader alone.
        ("ROW", 22),
        ("MOST_HALF_BITS", pack::MOST_HALF_BITS),
        // How invocations share a patch: known to the shaders alone.
        ("SHARED", 5),
        ("MOST_OWN_HALVINGS", 10),
        ("MOST_VISITS", 2080),
        ("TOO_MANY", 1 << 20),
        // Of a workgroup that sums a block, which has 256 invocations.
        ("ROUNDS", 8),
        ("NEED_OF_SHEETS", NEED_OF_SHEETS),
        // What ends a list of sheet fragments: known to the shaders alone.
        ("ENDS", u32::MAX),
        ("LOST", u32::MAX - 1),
        ("NEED_OF_TRIANGLES", NEED_OF_TRIANGLES),
        // A bit for each of them, and one more: known to the shaders alone.
        ("ALL_BORDERS", (1 << pack::BORDERS_OF_DOMAIN) - 1),
        ("OUTSIDE", 1 << 31),
        ("MIRROR", Wrap::Mirror.code()),
        // `gpu/viewport.rs` has it too.
        ("VIEWPORT_PX", 8192),
        // How the shaders look for something: known to them alone.
        ("SHORT", 8),
        ("FIRST_LEVEL", 3),
        ("MISS", 3),
        ("CELLS_OF_BLOCK", 9),
        // A bit for each border of a screen: known to the shaders alone.
        ("BEYOND_BORDERS", 31),
        ("LOWEST", pack::LOWEST),
        ("SIDE", pack::SIDE),
        // Classes of borders, in the order of `Strokes::widths` and one more, and what makes samples alike: known to the shaders alone.
        ("NO_BORDER", 0),
        ("OUTLINE", 1),
        ("CUT", 2),
        ("PART", 3),
        ("FACE", 4),
        ("CONTOUR", 5),
        ("CREASE", 6),
        ("LIKENESS", 0xffff_ff03),
        // What limits the rounds of loops: that of crossings is the mask of a count as well.
        ("MOST_CROSSINGS", 1023),
        // `passes::lanes` has it too.
        ("MOST_LANE_WORDS", 1024),
        ("MOST_LANES", 16_384),
        ("MOST_CELLS", pack::MOST_CELLS),
        // Trees of closing triangles: `passes::pack::packed_closing` packs them.
        ("NO_CLOSING", pack::NO_CLOSING),
        ("VECTORS_OF_HEAD", 2),
        ("LEAF_COUNT_BITS", 3),
        ("MOST_LEAF_TRIANGLES", 7),
        ("MOST_BALLS", 4096),
        ("OVERFLOWING_COUNT", 255),
        ("MOST_RUNS", 48),
        ("RUN_BITS", 6),
        ("MOST_OF_RUN", 63),
        ("MOST_LISTED", 256),
        ("MOST_QUERIES", 2),
        ("VECTORS_OF_POLYNOMIAL", 4),
        ("VECTORS_OF_EXPANSION", 16),
        ("NO_EXPANSION", u32::MAX),
        ("SQUARE_PX", 8),
        ("SQUARES_OF_TILE", 4),
        ("MOST_SQUARES", 64),
        ("VECTORS_OF_LIST", 17),
        ("UNSETTLED", 1 << 31),
        ("MOST_SPHERES", 64),
        ("MOST_TURNS", 16),
        ("MOST_SIDE", 6),
        ("MOST_TILES_AROUND", 14),
        ("MOST_DASHES", 4),
        ("MOST_LINES", 64),
        ("MOST_STEPS", 64),
        ("MOST_SLICES", 32),
        ("MOST_FRAGMENTS", 4096),
        ("MOST_SHEET_FRAGMENTS", 240),
        ("MOST_SLOTS", 32),
        ("MOST_LAYERS", 256),
        ("MOST_TARGETS", 4096),
        ("MOST_JOINTS", 1024),
        ("MOST_DEFORMERS", MOST_DEFORMERS as u32),
        // The work of a workgroup over lists of pixels and samples: known to the shaders alone.
        ("PIXELS_OF_TURN", 256),
        ("PIXELS_OF_GROUP", 1024),
        ("SAMPLES_OF_GROUP", 256),
        ("MOST_GROUPS", 65_535),
        ("CROSSINGS_OF_A_WORD", Capacities::CROSSINGS_OF_A_WORD),
        // The order of planes along a ray: known to the shaders alone.
        ("BITS_OF_PLACE", 4),
        // How the queue of a screen is laid out, and dispatched: known to the shaders alone.
        ("HEAD", 2),
        ("CLIPPED", 1 << 31),
        ("NOWHERE", u32::MAX),
        ("GROUPS_OF_ROW", 32_768),
        // Pixels along the side of a workgroup and of a tile: `passes::touched` has it too.
        ("TILE_PX", 16),
    ];
    for (name, value) in expected {
        assert_eq!(
            all.get(name),
            Some(&BTreeSet::from([value])),
            "values of {name} in WGSL, {value} in Rust"
        );
    }
    let stated: BTreeSet<&str> = expected.iter().map(|(n, _)| *n).collect();
    let unchecked: Vec<&String> = all
        .keys()
        .filter(|n| !stated.contains(n.as_str()))
        .collect();
    assert!(
        unchecked.is_empty(),
        "constants that nothing holds: {unchecked:?}"
    );

    let lengths: BTreeMap<(String, String), u32> = modules
        .iter()
        .flat_map(|(_, c)| array_lengths(&c.module))
        .collect();
    for (of, field, length) in [
        ("CutTable", "surfaces", MAX_SURFACES as u32),
        ("CutTable", "surfaces_of_cut", MAX_CUTS as u32 / 4),
        ("RayTable", "surfaces", MAX_SURFACES as u32),
        ("DrawnParts", "parts", MOST_DRAWN_PARTS as u32),
        (
            "PreclassifiedGroups",
            "groups",
            MOST_PRECLASSIFIED_GROUPS as u32,
        ),
        ("Deformers", "rows", MOST_DEFORMERS as u32),
        ("Domains", "surfaces", MAX_SURFACES as u32),
        ("Refinements", "surfaces", MAX_SURFACES as u32),
        ("Refinement", "borders", pack::BORDERS_OF_DOMAIN as u32),
        ("HatchPlanes", "planes", pack::MOST_HATCH_PLANES as u32),
    ] {
        let found = lengths.get(&(of.to_owned(), field.to_owned()));
        assert_eq!(found, Some(&length), "length of {of}.{field}");
    }
}

#[test]
fn a_constant_that_drifted_is_noticed() {
    let text = "const NO_RELIEF: u32 = 0xfffffffeu;\n@group(0) @binding(0) var<storage, read_write> words: array<u32>;\n\
        @compute @workgroup_size(1) fn main() { words[0] = NO_RELIEF; }";
    let module = shader::compose_text("planted", text).unwrap_or_else(|e| panic!("{e}"));
    let found = constants(&module);
    assert_eq!(
        found.get("NO_RELIEF"),
        Some(&0xffff_fffe),
        "the planted value is read"
    );
    assert_ne!(
        found.get("NO_RELIEF"),
        Some(&NO_RELIEF),
        "and is not the right one"
    );
}

// Our rules.

#[test]
fn every_shader_keeps_the_rules() {
    let mut meant: BTreeSet<&str> = BTreeSet::new();
    let mut faults = Vec::new();
    let mut kept_apart: BTreeSet<&str> = BTreeSet::new();
    for shader in shader::compositions() {
        let path = &shader;
        let composed = shader::compose(&shader).unwrap_or_else(|e| panic!("{e}"));
        let has = |file: &str| shader.with.contains(&file);
        let apart = NEVER_TOGETHER.iter().find(|(a, b, _)| has(a) && has(b));
        for Finding { rule, place, what } in
            lint(&composed.module).unwrap_or_else(|e| panic!("{path}: {e}"))
        {
            if let (Rule::StorageBuffers, Some((file, ..))) = (rule, apart) {
                kept_apart.insert(file);
                continue;
            }
            let allowed = MEANT_EQUALITIES.iter().find(|(p, _)| *p == place);
            match (rule, allowed) {
                (Rule::FloatEquality, Some((place, _))) => {
                    meant.insert(place);
                }
                _ => faults.push(format!("{path}: {place}: {rule:?}: {what}")),
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    for (a, b, reason) in NEVER_TOGETHER {
        assert!(
            kept_apart.contains(a),
            "{a} and {b} go together by now; they were let be because {reason}"
        );
    }
    for (place, reason) in MEANT_EQUALITIES {
        assert!(
            meant.contains(place),
            "{place} compares no floats any more; it was allowed to because {reason}"
        );
    }
}

#[test]
fn every_binding_of_the_library_has_a_reader() {
    let used: BTreeSet<String> = composed()
        .iter()
        .flat_map(|(_, c)| &c.bindings)
        .map(|b| b.name.clone())
        .collect();
    for (path, text) in shader::LIBRARY {
        for line in text.lines().filter(|l| l.starts_with("@group")) {
            // `var<storage, read> name: …` and `var name: …`.
            let declared = line.split(':').next().unwrap_or_default();
            let name = declared.split(' ').next_back().unwrap_or_default();
            assert!(
                used.contains(name),
                "{path}: nothing uses the binding `{name}`"
            );
        }
    }
}

/// Names that a shader's text imports and never uses.
fn unused_imports(text: &str) -> Vec<String> {
    let body: String = text
        .lines()
        .filter(|l| !l.starts_with("#import") && !l.trim_start().starts_with("//"))
        .map(|l| l.split("//").next().unwrap_or(l).to_owned() + "\n")
        .collect();
    let words: BTreeSet<&str> = body
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .collect();
    text.lines()
        .filter_map(|l| l.strip_prefix("#import "))
        .flat_map(|import| {
            let (_, names) = import.rsplit_once("::").unwrap_or(("", import));
            names
                .trim_matches(['{', '}'])
                .split(',')
                .map(|n| n.trim().to_owned())
                .collect::<Vec<_>>()
        })
        .filter(|name| !words.contains(name.as_str()))
        .collect()
}

#[test]
fn every_import_is_used() {
    for (path, text) in shader::FILES.iter().copied().flatten() {
        let unused = unused_imports(text);
        assert!(
            unused.is_empty(),
            "{path} imports and never uses {unused:?}"
        );
    }
    let planted =
        "#import a::b::{used, idle}\n#import a::lonely\n// idle and lonely\nfn f() { used(); }";
    assert_eq!(unused_imports(planted), ["idle", "lonely"], "planted");
}

/// What a text has in its code that names are told apart by, or that is not read as a comment.
fn unreadable(text: &str) -> Vec<&str> {
    let code = text.lines().map(|l| l.split("//").next().unwrap_or(l));
    code.filter(|l| l.contains("__") || l.contains("/*"))
        .collect()
}

#[test]
fn files_have_what_is_read_of_them() {
    for (path, text) in shader::FILES.iter().copied().flatten() {
        assert_eq!(unreadable(text), Vec::<&str>::new(), "{path}");
    }
    let planted = "fn a__b() {}\nfn c() {} // d__e\n/* f */";
    assert_eq!(unreadable(planted), ["fn a__b() {}", "/* f */"], "planted");
}

/// Functions of the library that no shader comes to, by their file.
fn idle_functions(library: &[(&'static str, &'static str)]) -> Vec<String> {
    let mut used = BTreeSet::new();
    for (_, composed) in composed() {
        let functions = composed.module.functions.iter();
        used.extend(functions.filter_map(|(_, f)| f.name.clone()));
    }
    let mut idle = Vec::new();
    for (path, text) in library {
        let module = text
            .lines()
            .find_map(|l| l.strip_prefix("#define_import_path "));
        let module = module.unwrap_or_default().replace("::", "_");
        for line in text.lines() {
            if let Some((name, _)) = line.strip_prefix("fn ").and_then(|l| l.split_once('('))
                && !used.contains(&format!("{name}__{module}"))
            {
                idle.push(format!("{path}: {name}"));
            }
        }
    }
    idle
}

#[test]
fn every_function_of_the_library_is_in_a_shader() {
    assert_eq!(idle_functions(shader::LIBRARY), Vec::<String>::new());
    let planted = "#define_import_path cutaway::frame\nfn no_one_asks() -> u32 {";
    assert_eq!(
        idle_functions(&[("planted", planted)]),
        ["planted: no_one_asks"]
    );
}

/// Rules that a planted text breaks.
fn broken(text: &str) -> Vec<Rule> {
    let module = shader::compose_text("planted", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    lint(&module)
        .unwrap_or_else(|e| panic!("{e}"))
        .into_iter()
        .map(|f| f.rule)
        .collect()
}

fn compute(declarations: &str, body: &str) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read_write> words: array<u32>;\n{declarations}\n\
         @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{ {body} words[id.x] = 1u; }}"
    )
}

#[test]
fn loops_without_a_bound_are_found() {
    for (bounded, body) in [
        (true, "for (var i = 0u; i < 8u; i++) { words[i] = i; }"),
        (true, "for (var i = 0u; i < words[0]; i += 2u) { }"),
        (true, "for (var i = 9; i > 0; i--) { }"),
        (true, "for (var i = 9u; i > 0u && words[i] != 3u; i--) { }"),
        (
            true,
            "for (var i = 0u; words[i] != 3u && i < 9u; i++) { if words[i] == 7u { continue; } }",
        ),
        (true, "for (var i = 0u; 8u > i; i++) { }"),
        (
            true,
            "var i = 0u; loop { if i >= 8u { break; } continuing { i++; } }",
        ),
        (
            true,
            "let n = min(words[3], 9u); for (var i = 0u; i < n; i++) { words[i] = n; }",
        ),
        // The counter is what the round before made of the words: nothing says that it ends.
        (false, "var i = 0u; while words[i] != 0u { i = words[i]; }"),
        (false, "loop { if words[0] == 1u { break; } }"),
        (false, "for (var i = 0u; ; i++) { }"),
        // Steps away from its bound, or not at all.
        (false, "for (var i = 9u; i < 10u; i--) { }"),
        (false, "for (var i = 0u; i < 8u; i += 0u) { }"),
        (false, "for (var i = 0u; i < 8u; i += words[0]) { }"),
        // Another may hold the loop open.
        (false, "for (var i = 0u; i < 8u || words[0] == 1u; i++) { }"),
        // Set back inside, or run after.
        (
            false,
            "for (var i = 0u; i < 8u; i++) { if words[i] == 3u { i = 0u; } }",
        ),
        (
            false,
            "var n = 8u; for (var i = 0u; i < n; i++) { n += 1u; }",
        ),
        // An equality is stepped over.
        (false, "for (var i = 0u; i != 7u; i += 2u) { }"),
        // Inside a bounded one.
        (
            false,
            "for (var i = 0u; i < 8u; i++) { while words[i] != 0u { words[i] /= 2u; } }",
        ),
    ] {
        let expected = if bounded {
            vec![]
        } else {
            vec![Rule::BoundedLoops]
        };
        // `for (;;)` and endless loops make what follows them unreachable, which is valid.
        let mut found = broken(&compute("", body));
        found.retain(|rule| *rule != Rule::ConstantBounds);
        assert_eq!(found, expected, "{body}");
    }
}

#[test]
fn loops_that_grow_with_data_are_found() {
    let declarations = "override most: u32 = 9u;
        const MOST: u32 = 7u;
        fn count_of(word: u32) -> u32 { return word & 0x3ffu; }
        fn last_of(word: u32) -> u32 { return word; }
        struct Box { first: u32, size: u32 }
        fn box_of(word: u32) -> Box { return Box(word, min(word, MOST)); }
        ";
    let filling = "fn fill(count: u32) { for (var i = 0u; i < count; i++) { words[i] = i; } }";
    for (limited, body) in [
        (true, "for (var i = 0u; i < min(words[0], MOST); i++) { }"),
        (true, "for (var i = 0u; i < min(most, MOST); i++) { }"),
        (false, "for (var i = 0u; i < most; i++) { }"),
        (
            true,
            "let n = count_of(words[0]) / 2u; for (var i = 0u; i < n; i++) { }",
        ),
        (
            true,
            "let n = box_of(words[0]).size; for (var i = 0u; i < n; i++) { }",
        ),
        (true, "for (var i = i32(id.x % 3u); i < 8; i++) { }"),
        (
            true,
            "let n = select(3u, MOST, words[0] == 1u); for (var i = 0u; i < n; i++) { }",
        ),
        (true, "for (var i = min(words[0], MOST); i > 0u; i--) { }"),
        (
            true,
            "let reach = min(i32(words[0]), 3); for (var i = -reach; i <= reach; i++) { }",
        ),
        (true, "fill(min(words[0], 4u));"),
        (false, "for (var i = 0u; i < words[0]; i++) { }"),
        (
            false,
            "let n = last_of(words[0]); for (var i = 0u; i < n; i++) { }",
        ),
        (
            false,
            "let n = box_of(words[0]).first; for (var i = 0u; i < n; i++) { }",
        ),
        (false, "for (var i = 0u; i < max(words[0], MOST); i++) { }"),
        (
            false,
            "let n = select(3u, words[1], words[0] == 1u); for (var i = 0u; i < n; i++) { }",
        ),
        (false, "for (var i = words[0]; i > 0u; i--) { }"),
        // From far below a constant, and from a bound that is taken away from without limit.
        (
            false,
            "for (var i = bitcast<i32>(words[0]); i < 8; i++) { }",
        ),
        (
            false,
            "for (var i = 8 - i32(words[0] & 7u) * bitcast<i32>(words[1]); i < 8; i++) { }",
        ),
        (false, "fill(min(words[0], 4u)); fill(words[1]);"),
        // A bound that was counted up.
        (
            false,
            "var n = 0u; if words[0] == 1u { n = words[1]; } for (var i = 0u; i < n; i++) { }",
        ),
    ] {
        let expected = if limited {
            vec![]
        } else {
            vec![Rule::ConstantBounds]
        };
        let called = if body.contains("fill(") { filling } else { "" };
        let text = compute(&format!("{declarations}{called}"), body);
        assert_eq!(broken(&text), expected, "{body}");
    }
}

#[test]
fn equal_floats_are_found() {
    for (body, expected) in [
        ("if f32(id.x) == 0.5 { return; }", vec![Rule::FloatEquality]),
        (
            "if any(vec2<f32>(id.xy) != vec2<f32>(1.0)) { return; }",
            vec![Rule::FloatEquality],
        ),
        (
            "if id.x == 3u || f32(id.x) < 0.5 || f32(id.x) >= 7.0 { return; }",
            vec![],
        ),
    ] {
        assert_eq!(broken(&compute("", body)), expected, "{body}");
    }
    // In a function of the file as well as in an entry point.
    let helper = "fn same(a: f32, b: f32) -> bool { return a == b; }";
    assert_eq!(
        broken(&compute(helper, "if same(1.0, f32(id.x)) { return; }")),
        [Rule::FloatEquality],
        "{helper}"
    );
}

#[test]
fn idle_bindings_and_broken_limits_are_found() {
    let idle = "@group(0) @binding(1) var<uniform> idle: vec4<f32>;";
    assert_eq!(broken(&compute(idle, "")), [Rule::UsedBindings], "{idle}");

    let many = |n: u32| {
        let declared: String = (1..=n)
            .map(|i| format!("@group(1) @binding({i}) var<storage, read> b{i}: array<u32>;\n"))
            .collect();
        let used: String = (1..=n).map(|i| format!("words[{i}] = b{i}[0];")).collect();
        compute(&declared, &used)
    };
    assert_eq!(broken(&many(7)), [], "8 storage buffers with the output");
    assert_eq!(
        broken(&many(8)),
        [Rule::StorageBuffers],
        "9 storage buffers"
    );

    let sized = |size: &str| compute("", "").replace("@workgroup_size(64)", size);
    assert_eq!(broken(&sized("@workgroup_size(16, 16)")), [], "256");
    for size in ["@workgroup_size(257)", "@workgroup_size(16, 16, 2)"] {
        assert_eq!(broken(&sized(size)), [Rule::Workgroup], "{size}");
    }

    let renamed = compute("", "").replace("fn main", "fn run");
    assert_eq!(broken(&renamed), [Rule::EntryPoints], "not called main");
    let second = format!(
        "{}\n@compute @workgroup_size(1) fn other() {{ }}",
        compute("", "")
    );
    assert_eq!(broken(&second), [Rule::EntryPoints], "two in one file");
    let half = "@vertex fn vertex() -> @builtin(position) vec4<f32> { return vec4<f32>(0.0); }";
    assert_eq!(
        broken(half),
        [Rule::EntryPoints],
        "vertices without fragments"
    );
}
