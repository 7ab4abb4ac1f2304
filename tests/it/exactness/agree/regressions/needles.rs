//! Triangles that are narrower than rasterisers can place.

use cutaway::Model;
use cutaway::scene::{ClipSurface, Cut, Precision, Up, Wrap};
use cutaway::strategies::{Method, Strategy};
use cutaway_lab::hard_cases;
use cutaway_lab::hard_cases::random::{Bumps, RandomSolid, Recipe, Surface};
use glam::{DVec2, DVec3};

use crate::common::{Question, meshes, scenes, session};

/// A needle of 2e-5 square pixels covered a sample beside it, by corners that were rounded, with a depth beyond its own.
#[test]
fn regression_0009_beside_a_needle_nothing_is_decided() {
    let mut scene = scenes::sectioned("crank", &[]);
    let surface = scenes::relief(&scene, "-z=50%", "fractal:amplitude=4%,period=45%,seed=7");
    scene.cuts = vec![Cut::new("ragged", vec![surface])];
    let still = Question::new(&scene, [400, 300]);
    let view = still.view.sampled_at(DVec2::new(0.5 + 31.0 / 64.0, 0.5));
    let moved = still.in_view(&scene, view);
    for strategy in [Strategy::RAYCAST_MASK, Strategy::RAYCAST_STENCIL] {
        assert_eq!(moved.answer(strategy).fault_of_exact(), None, "{strategy}");
    }
}

/// A needle in a flat face was turned over as its corners were rounded, and showed its back: exact was sure of the front, for hardly any
/// depth changes in the needle.
#[test]
fn regression_0015_a_needle_in_a_flat_face_shows_its_back() {
    let plate: Vec<[i32; 3]> = (0..24 * 18).map(|i| [i % 24 - 12, i / 24 - 9, 0]).collect();
    let plain = meshes::cells(&plate, 1.0 / 12.0);
    let needled = meshes::with_needles(&plain, 1e-6);
    let [plain, needled] = [plain, needled].map(|mesh| {
        let scene = scenes::scene("plate", mesh, vec![]);
        let eye = DVec3::new(0.02, 0.01, 3.0);
        let mut camera = scenes::looking(eye, DVec3::new(0.013, 0.007, 0.0), 30.0);
        // The picture is rolled by it, so that no row of needles is a row of samples.
        camera.up = Up::PlusZ;
        hard_cases::Question::through(&scene, &camera, [200, 150])
    });
    nothing_is_wrong(&needled);
    let [plain, needled] = [plain, needled].map(|question| question.exact.undecided_px());
    assert!(plain + 20 < needled, "{plain} and {needled} px");
    assert!(needled < 200, "{needled} px");
}

/// The near plane lies within a bundle of prisms. A driver that clips each triangle by itself counted one crossing more behind a cap at the
/// near plane, at an edge that passes it farther back: exact was sure of the cap, for the edge is hidden.
#[test]
fn regression_0016_a_cap_hangs_on_edges_behind_it_where_a_driver_parts_them() {
    let prisms = RandomSolid::Prisms {
        count: 29,
        sides: 19,
    };
    let relief = Surface {
        normal: [0.0, 0.0, 1.0],
        at: [
            -0.196_238_537_507_629_2,
            -0.120_493_796_559_771_88,
            -0.006_345_779_882_336_422,
        ],
        bumps: Some(Bumps {
            size: [12, 3],
            seed: 5_577_595_225_555_562_683,
            height: 0.342_206_329_203_411_5,
            period: 0.971_651_746_526_615,
            wrap: Wrap::Mirror,
        }),
    };
    let question = Recipe {
        solids: vec![(
            prisms,
            [
                0.052_703_105_386_208_48,
                0.133_059_385_451_020_58,
                0.119_031_265_710_410_83,
            ],
        )],
        cuts: vec![vec![relief]],
        from: [
            -0.151_243_564_994_189_37,
            -0.040_143_227_313_579_04,
            -0.244_719_652_385_522_62,
        ],
        to: [
            -0.011_142_196_131_153_165,
            0.099_739_681_628_935_87,
            -0.037_562_783_437_499_59,
        ],
        near: Some(0.196_947_407_185_452_53),
        ..Recipe::default()
    }
    .question();
    nothing_is_wrong(&question);
    let coarse = Precision {
        sub_pixel_bits: 4,
        ..Precision::USUAL
    };
    let pixel = 26 * 64 + 41;
    let undecided = |precision| question.exact.at(precision).undecided[pixel];
    assert!(undecided(coarse) && !undecided(Precision::USUAL));
}

/// A triangle whose corners lie on a line was drawn at the near plane, before all that hides it: exact was sure of what hides it, for its
/// corners lie behind.
#[test]
fn regression_0017_a_triangle_without_a_plane_has_any_depth() {
    let plane = |normal, at| Surface {
        normal,
        at,
        bumps: None,
    };
    let prisms = RandomSolid::Prisms {
        count: 31,
        sides: 17,
    };
    let question = Recipe {
        solids: vec![
            (
                prisms,
                [
                    0.086_794_634_953_997_53,
                    0.129_110_569_096_854_98,
                    -0.004_990_727_517_747_928,
                ],
            ),
            (
                RandomSolid::Cells(vec![
                    [-2, 0, 1],
                    [-1, -2, -2],
                    [1, -1, 1],
                    [1, 1, -1],
                    [1, 1, 0],
                ]),
                [
                    -0.064_832_774_596_038_56,
                    0.080_337_435_971_116_14,
                    -0.149_724_213_731_888_52,
                ],
            ),
        ],
        cuts: vec![vec![
            plane(
                [
                    -0.293_095_518_380_943_83,
                    -0.889_636_394_375_496_6,
                    0.121_564_031_377_325_19,
                ],
                [-0.5, -0.5, 0.25],
            ),
            plane(
                [
                    0.349_348_810_329_670_4,
                    -0.864_253_185_591_135_3,
                    -0.971_805_393_345_355_7,
                ],
                [
                    -0.090_611_443_541_326_61,
                    0.141_738_338_224_516_62,
                    -0.265_940_739_990_637_4,
                ],
            ),
        ]],
        from: [
            0.142_801_175_719_102_72,
            -0.342_275_486_632_751,
            -0.075_576_675_827_793_76,
        ],
        to: [
            0.015_050_516_403_223_69,
            -0.009_557_564_124_053_203,
            -0.152_063_025_999_61,
        ],
        fov_deg: Some(37.609_663_102_281_644),
        turned: [
            2.624_290_075_725_555,
            3.025_518_443_207_573_7,
            2.928_187_785_918_958,
        ],
        needles: Some(6.827_346_840_786_34e-7),
        ..Recipe::default()
    }
    .question();
    nothing_is_wrong(&question);
}

/// Beside a wall is a narrower one, which was crossed in its place: its depths are interpolated in f32, and lay behind the next
/// wall. Exact was sure of the first, whose own depths are good.
#[test]
fn regression_0018_beyond_a_seam_depths_are_worse() {
    let mut scene = scenes::scene("rod", meshes::toothed(900), vec![]);
    let half = ClipSurface::parse("0.3,0.5,0.8@50%,50%,50%", &scene.bounds()).expect("a plane");
    scene.cuts = vec![Cut::new("half", vec![half])];
    let model = Model::new(&scene);
    let view = model.prepared.view([2400, 1800]).rows(1560, 8);
    let question = hard_cases::Question::of_model(model, &scene, view);
    nothing_is_wrong(&question);
    let in_f32 = Precision {
        slopes_in_f32: true,
        ..Precision::USUAL
    };
    let pixel = 7 * 2400 + 809;
    let undecided = |precision| question.exact.at(precision).undecided[pixel];
    assert!(undecided(in_f32) && !undecided(Precision::USUAL));
}

fn nothing_is_wrong(question: &hard_cases::Question) {
    for method in ["raycast+mask", "raycast+mask@compute"] {
        let method: Method = method.parse().expect("a method");
        let judged = question.answer(&mut session(), &method).expect("a frame");
        assert_eq!(judged.fault_of_exact(), None, "{method}");
    }
}
