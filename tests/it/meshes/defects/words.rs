//! What is said is read, what makes no sense is refused with a mend.

use cutaway::generate::defects::DefectKind;
use cutaway_io::document::parse_defect;

#[test]
fn defects_are_written_as_they_are_read() {
    for text in [
        "holes:amount=5%,seed=1,patch=1",
        "flipped:amount=2.5%,seed=9223372036854775807,patch=12",
        "duplicated:amount=0%,seed=3,patch=2",
        "t-junctions:amount=100%,seed=1",
        "gaps:amount=0.01,seed=1,charts=5",
        "overlap:amount=20%,seed=1,copies=2",
        "open:amount=20%,axis=-y",
        "soup:amount=1%,seed=7",
    ] {
        let defect = parse_defect(text).unwrap();
        assert_eq!(defect.to_string(), text);
    }
    for name in DefectKind::NAMES {
        let usual = parse_defect(name).unwrap();
        assert_eq!(usual.kind.name(), name);
        assert_eq!(usual, parse_defect(&usual.to_string()).unwrap());
    }
}

#[test]
fn nonsense_is_refused_with_a_mend() {
    for (text, said) in [
        ("hoels", "did you mean `holes`"),
        ("", "use one of"),
        ("holes:amuont=5%", "did you mean `amount`"),
        ("holes:axis=z", "no key of holes"),
        ("soup:patch=3", "no key of soup"),
        ("holes:5%", "key=value"),
        ("holes:amount=0.05", "in percent"),
        ("holes:amount=-1%", "0 or more"),
        ("holes:amount=101%", "from 0% to 100%"),
        ("holes:amount=nan%", "not finite"),
        ("soup:amount=-0.1", "0 or more"),
        ("soup:amount=x", "not a number"),
        ("holes:seed=-1", "whole number"),
        ("holes:patch=0", "from 1 to"),
        ("gaps:charts=99999999999", "from 1 to"),
        ("open:axis=w", "use one of: x, y, z"),
    ] {
        let message = parse_defect(text).unwrap_err().to_string();
        assert!(message.contains(said), "{text}: {message}");
        assert!(message.contains("help: "), "{text}: {message}");
    }
    let all = parse_defect("holes:amount=100%").unwrap();
    let message = all
        .apply(&crate::common::meshes::shape("cube"))
        .unwrap_err();
    assert!(message.to_string().contains("no face"), "{message}");
}

#[test]
fn a_defect_that_makes_too_many_faces_is_refused_before_it_makes_them() {
    let mesh = &cutaway::generate::shapes::shape("sphere?subdivisions=5").unwrap()[0].mesh;
    let broken = |copies: u32| {
        let words = format!("overlap:amount=1%,copies={copies}");
        parse_defect(&words).unwrap().apply(mesh)
    };
    assert!(broken(2).is_ok(), "a few copies are made");
    let message = broken(100_000).unwrap_err().to_string();
    assert!(message.contains("fewer copies"), "{message}");
}
