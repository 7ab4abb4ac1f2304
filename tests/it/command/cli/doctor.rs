//! `doctor`: what a report of a fault begins with.

use serde_json::Value;

use crate::command::cli::command::Scratch;

#[test]
fn what_is_claimed_holds_on_this_adapter() {
    let folder = Scratch::new("doctor");
    let ran = folder.run("doctor --json -").exits(0);
    let report: Value = ran.json();
    assert!(
        report["adapter"]["sub_pixel_bits"].as_u64() >= Some(4),
        "Vulkan promises 4 sub-pixel bits: {report}"
    );
    let adapters = report["adapters"].as_array().expect("a list");
    let name = report["adapter"]["name"].as_str().expect("a name");
    let is_named = |a: &Value| a.as_str().is_some_and(|a| a.starts_with(name));
    assert!(adapters.iter().any(is_named), "{report}");
    for strategy in report["strategies"].as_array().expect("a list") {
        let tried = strategy["cases"].as_u64() > Some(0) && strategy["scenes"].as_u64().is_some();
        let faults = strategy["faults"].as_array().expect("a list");
        assert!(tried && faults.is_empty(), "{strategy}");
    }
}

#[test]
fn an_adapter_that_is_not_there_is_named() {
    let folder = Scratch::new("doctor-elsewhere");
    let ran = folder.run("doctor --adapter no-such-card").exits(2);
    assert!(ran.stderr.contains("use part of one of"), "{}", ran.stderr);
}
