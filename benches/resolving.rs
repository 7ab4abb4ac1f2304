//! How long it takes to know a scene at a time: 250 parts in a scene file, each moved by four keys, at 200 times.
//!
//! Nothing is drawn, and the parts share one mesh: what is left is the document, its keys and its readers.

use std::fmt::Write as _;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use cutaway::scene::Scene;
use cutaway_io::document::{Document, Timeline};
use cutaway_io::load::Assets;

const PARTS: usize = 250;
const FRAMES: u32 = 200;

fn timeline() -> Timeline {
    let mut text = String::new();
    for part in 0..PARTS {
        let x = part % 16;
        let y = part / 16;
        write!(
            text,
            "[[part]]\nname = \"cube {part}\"\nshape = \"cube\"\ntranslate = [{x}, {y}, 0]\nrotate_deg = [0, 0, 0]\nscale = 0.5\npivot = [0, 0, 0]\n"
        )
        .expect("a text takes all");
        for (field, values) in [
            ("translate", format!("[[{x}, {y}, 0], [{x}, {y}, 1]]")),
            ("rotate_deg", "[[0, 0, 0], [0, 90, 0]]".to_owned()),
            ("scale", "[0.5, 0.25]".to_owned()),
            ("pivot", "[[0, 0, 0], [0.1, 0, 0]]".to_owned()),
        ] {
            write!(
                text,
                "[[key]]\ntarget = \"part.cube {part}.{field}\"\ntimes_s = [0, 8]\nvalues = {values}\n"
            )
            .expect("a text takes all");
        }
    }
    text.push_str("[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n");
    let document = Document::parse("moving.toml", &text).expect("a scene");
    let timeline = document.timeline(&mut Assets::default()).expect("a scene");
    assert_eq!(timeline.keys().count(), 4 * PARTS, "a key for each number");
    timeline
}

fn resolving(criterion: &mut Criterion) {
    let timeline = timeline();
    let at = |frame: u32| -> Scene {
        let time_s = f64::from(frame) * 8.0 / f64::from(FRAMES);
        timeline.at(time_s).expect("a scene at every time")
    };
    let [first, last] = [0, FRAMES].map(|frame| at(frame).parts[0].world_from_part);
    assert_ne!(first, last, "the keys move it");
    let mut group = criterion.benchmark_group("resolving");
    group.throughput(Throughput::Elements(u64::from(FRAMES)));
    group.bench_function("1000 keys", |b| {
        b.iter(|| (0..FRAMES).for_each(|frame| drop(black_box(at(frame)))));
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = resolving
}
criterion_main!(benches);
