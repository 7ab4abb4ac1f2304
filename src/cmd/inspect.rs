//! `inspect`: what a model is like, part by part and in total.

use clap::Args;
use serde_json::{Value, json};

use super::Verdict;
use super::console::{Console, ConsoleArgs};
use super::defects::DefectArgs;
use super::edits::EditArgs;
use super::look::Usual;
use super::output::{Output, write_stdout};
use super::places::paths_of;
use super::subject::{Subject, document};
use super::when::TimeArgs;
use crate::report::Table;
use crate::scene::numbers::round;
use crate::scene::{Clip, Part, Topology};
use crate::{Error, Result};

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway inspect bracket.stl
  cutaway inspect shape:gears
  cutaway inspect walk.glb --clip run --time 0.5
  cutaway inspect shape:sphere --defect holes:amount=5%,patch=12      # what the defect does to edges and rays
  cutaway inspect engine.glb --json - | jq '.parts[] | select(.closed | not) | .name'

A part that is not closed has no inside everywhere: caps can be wrong along rays through its holes. Coincident
faces lie on the same three positions as another face, turned either way; in total also those of different parts. Depth
complexity is how often axis-parallel rays cross the surface.";

/// Options of `inspect`.
#[derive(Args)]
pub(super) struct InspectArgs {
    /// Meshes, `shape:NAME?param=value`, or one scene (.toml)
    #[arg(required = true, value_name = "MODEL")]
    inputs: Vec<String>,
    #[command(flatten)]
    edits: EditArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[command(flatten)]
    defects: DefectArgs,
    /// The same as JSON; with `-` instead of the table
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `inspect`.
pub(super) fn run(args: &InspectArgs) -> Result<Verdict> {
    let json = args
        .json
        .as_ref()
        .map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    let console = Console::new(args.console, 2);
    console.step("opening");
    let mut document = document(&args.inputs, None)?;
    args.defects.amend(&mut document)?;
    args.when.amend(&mut document)?;
    let subject = Subject::open(document, None, Usual::default(), &args.edits, &console)?;
    subject.save_beside(paths_of(&[("--json", json.as_ref())]), &args.edits)?;
    let clips = subject.timeline.clips();
    let parts = subject.scene.posed().parts;
    console.step("inspecting");
    let facts: Vec<(&str, Topology)> = parts
        .iter()
        .map(|p| {
            (
                p.name.as_str(),
                Topology::from_parts(std::slice::from_ref(p)),
            )
        })
        .collect();
    let total = match facts.as_slice() {
        [(_, one)] => one.clone(),
        _ => Topology::from_parts(&parts),
    };
    if let Some(output) = &json {
        let json = to_json(&facts, &total, clips)?;
        output.write(format!("{json:#}\n").as_bytes())?;
    }
    if json != Some(Output::Stdout) {
        let mut text = to_text(&parts, &facts, &total);
        text.extend(clips.iter().enumerate().map(describe));
        write_stdout(text.as_bytes())?;
    }
    Ok(Verdict::Done)
}

/// A clip, as `--clip` takes it.
fn describe((number, clip): (usize, &Clip)) -> String {
    let length = round(clip.duration_s);
    format!("clip {number}: {}, {length} s\n", clip.name)
}

fn to_json(facts: &[(&str, Topology)], total: &Topology, clips: &[Clip]) -> Result<Value> {
    let value = |t: &Topology| {
        serde_json::to_value(t).map_err(|e| {
            let help = "leave --json out, and report this";
            Error::input("--json", format!("cannot be encoded: {e}"), help)
        })
    };
    let mut parts = Vec::with_capacity(facts.len());
    for (name, facts) in facts {
        let mut part = json!({ "name": name });
        if let (Some(part), Value::Object(facts)) = (part.as_object_mut(), value(facts)?) {
            part.extend(facts);
        }
        parts.push(part);
    }
    let clips: Vec<Value> = (clips.iter())
        .map(|c| json!({ "name": c.name, "duration_s": c.duration_s }))
        .collect();
    Ok(json!({ "parts": parts, "total": value(total)?, "clips": clips }))
}

fn to_text(parts: &[Part], facts: &[(&str, Topology)], total: &Topology) -> String {
    let mut table = Table::new([
        "part",
        "vertices",
        "faces",
        "closed",
        "coincident",
        "boundary",
        "non-manifold",
        "inconsistent",
        "components",
        "euler",
        "volume",
        "area",
        "size",
        "depth max",
        "mean",
    ]);
    for (name, facts) in facts {
        table.row(row(name, facts));
    }
    if facts.len() > 1 {
        table.row(row("total", total));
    }
    let mut text = table.to_text();
    let (min, max) = (total.bounds.min, total.bounds.max);
    for axis in 0..3 {
        let name = ["x", "y", "z"][axis];
        text.push_str(&format!(
            "{}{name} {} to {}",
            if axis == 0 { "bounds: " } else { ", " },
            round(min[axis]),
            round(max[axis])
        ));
    }
    text.push('\n');
    for (part, (name, facts)) in parts.iter().zip(facts) {
        if let Some(at) = facts.where_open().first() {
            text.push_str(&format!(
                "{name} is open: {} boundary edges, one at {},{},{}\n",
                facts.boundary_edges,
                round(at.x),
                round(at.y),
                round(at.z)
            ));
        }
        if facts.coincident_faces > 0 {
            text.push_str(&format!(
                "{name} has {} faces that lie on another: two of them cancel, and the solid has no inside there\n",
                facts.coincident_faces
            ));
        }
        if facts.closed && facts.volume < 0.0 {
            text.push_str(&format!(
                "{} is inside out: its volume is negative\n",
                part.name
            ));
        }
    }
    text
}

fn row(name: &str, facts: &Topology) -> Vec<String> {
    let size = [0, 1, 2].map(|i| round(facts.bounds.max[i] - facts.bounds.min[i]));
    vec![
        name.to_owned(),
        facts.vertices.to_string(),
        facts.faces.to_string(),
        if facts.closed { "yes" } else { "no" }.to_owned(),
        facts.coincident_faces.to_string(),
        facts.boundary_edges.to_string(),
        facts.non_manifold_edges.to_string(),
        facts.inconsistent_edges.to_string(),
        facts.components.to_string(),
        facts.euler.to_string(),
        round(facts.volume),
        round(facts.area),
        size.join(" x "),
        facts.depth_complexity.largest.to_string(),
        format!("{:.2}", facts.depth_complexity.mean),
    ]
}
