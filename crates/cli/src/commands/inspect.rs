//! `inspect`: properties of a model, per part and in total.

use clap::Args;
use cutaway::scene::numbers::{describe_bounds, round};
use cutaway::scene::weld::thousands;
use cutaway::scene::winding::Stray;
use cutaway::scene::{Bodies, Clip, Part, Topology};
use cutaway::{Error, Result};
use cutaway_lab::report::TextTable;
use serde_json::{Value, json};

use crate::console::{Console, ConsoleArgs};
use crate::input::defects::DefectArgs;
use crate::input::edits::EditArgs;
use crate::input::holes::HoleArgs;
use crate::input::look::Defaults;
use crate::input::roles;
use crate::input::split::SplitArgs;
use crate::input::stdin::StdinArgs;
use crate::input::subject::{SceneInput, document};
use crate::input::when::TimeArgs;
use crate::verdict::Verdict;
use crate::writing::output::{Output, write_stdout};
use crate::writing::places::paths_of;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway inspect bracket.stl
  cutaway inspect shape:gears
  cutaway inspect walk.glb --clip run --time 0.5
  cutaway inspect engine.stl --split                                  # each connected body by itself
  cutaway inspect engine.stl --split --roles                          # what lies inside, for --breakaway
  cutaway inspect shape:sphere --defect holes:amount=5%,patch=12      # what the defect does to edges and rays
  curl -s https://example.org/scan.stl | cutaway inspect -             # a model from standard input
  cutaway inspect scan.ply --close-holes                              # which holes can be closed, and what is then left open
  cutaway inspect engine.glb --json - | jq '.parts[] | select(.closed | not) | .name'

Components share no vertex. A body is a connected solid together with its cavities: --split makes each body a part.
In a part that is not closed, winding numbers decide what is inside: the nearer they are to whole numbers, the surer. Coincident
faces have the same three positions as another face, in either orientation; the total also counts faces of different parts. Depth
complexity is how often axis-parallel rays cross the surface.";

/// Options of `inspect`.
#[derive(Args)]
pub(crate) struct InspectArgs {
    /// Meshes, `-` for one from standard input, `shape:NAME?param=value`, or one scene (.toml)
    #[arg(required = true, value_name = "MODEL")]
    inputs: Vec<String>,
    #[command(flatten)]
    stdin: StdinArgs,
    #[command(flatten)]
    edits: EditArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[command(flatten)]
    split: SplitArgs,
    /// Show the role of each part in cutouts and breakaways, and where it is set; unset roles are detected by which parts are visible
    /// from outside
    #[arg(long)]
    roles: bool,
    #[command(flatten)]
    defects: DefectArgs,
    #[command(flatten)]
    holes: HoleArgs,
    /// The same as JSON; `-` prints it instead of the table
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `inspect`.
pub(crate) fn run(args: &InspectArgs) -> Result<Verdict> {
    let json = args
        .json
        .as_ref()
        .map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    let console = Console::new(args.console, 2);
    console.step("opening");
    let mut document = document(&args.inputs, args.stdin, None)?;
    args.split.amend(&mut document)?;
    args.defects.amend(&mut document)?;
    args.holes.amend(&mut document)?;
    args.when.amend(&mut document)?;
    roles::amend(&mut document, &[], args.roles)?;
    let subject = SceneInput::open(document, None, Defaults::default(), &args.edits, &console)?;
    subject.save_beside(paths_of(&[("--json", json.as_ref())]), &args.edits)?;
    let clips = subject.timeline.clips();
    let parts = subject.scene.posed().parts;
    console.step("inspecting");
    let facts: Vec<MeshSummary<'_>> = parts.iter().map(MeshSummary::of).collect();
    let total = match facts.as_slice() {
        [one] => one.clone(),
        _ => MeshSummary {
            name: "total",
            topology: Topology::from_parts(&parts),
            bodies: facts.iter().map(|f| f.bodies).sum(),
            stray: None,
        },
    };
    let roles = args.roles.then(|| subject.timeline.roles()).transpose()?;
    if let Some(output) = &json {
        let mut json = to_json(&facts, &total, clips)?;
        for (i, (part, by)) in roles.iter().flatten().enumerate() {
            if let (Some(facts), Value::Object(role)) =
                (json["parts"][i].as_object_mut(), roles::to_json(part, by))
            {
                facts.extend(role);
            }
        }
        output.write(format!("{json:#}\n").as_bytes())?;
    }
    if json != Some(Output::Stdout) {
        let mut text = match &roles {
            Some(roles) => roles::to_text(roles),
            None => to_text(&facts, &total),
        };
        text.extend(clips.iter().enumerate().map(describe));
        write_stdout(text.as_bytes())?;
    }
    Ok(Verdict::Done)
}

/// Summary of a part, or of all parts.
#[derive(Clone)]
struct MeshSummary<'a> {
    name: &'a str,
    topology: Topology,
    /// Number of parts that `--split` would produce.
    bodies: usize,
    /// How far winding numbers are from whole ones, if the part is open.
    stray: Option<Stray>,
}

impl<'a> MeshSummary<'a> {
    fn of(part: &'a Part) -> Self {
        let topology = Topology::from_parts(std::slice::from_ref(part));
        Self {
            name: &part.name,
            stray: (topology.boundary_loops > 0).then(|| Stray::of(&part.mesh)),
            topology,
            bodies: Bodies::of(&part.mesh).count(),
        }
    }
}

/// An animation clip, as selected by `--clip`.
fn describe((number, clip): (usize, &Clip)) -> String {
    let length = round(clip.duration_s);
    format!("clip {number}: {}, {length} s\n", clip.name)
}

fn to_json(facts: &[MeshSummary<'_>], total: &MeshSummary<'_>, clips: &[Clip]) -> Result<Value> {
    let value = |of: &MeshSummary<'_>| {
        let mut value = serde_json::to_value(&of.topology).map_err(|e| {
            let help = "leave --json out, and report this";
            Error::input("--json", format!("cannot be encoded: {e}"), help)
        })?;
        value["bodies"] = json!(of.bodies);
        Ok(value)
    };
    let mut parts = Vec::with_capacity(facts.len());
    for of in facts {
        let mut part = json!({ "name": of.name, "winding_stray": of.stray });
        if let (Some(part), Value::Object(facts)) = (part.as_object_mut(), value(of)?) {
            part.extend(facts);
        }
        parts.push(part);
    }
    let clips: Vec<Value> = (clips.iter())
        .map(|c| json!({ "name": c.name, "duration_s": c.duration_s }))
        .collect();
    Ok(json!({ "parts": parts, "total": value(total)?, "clips": clips }))
}

fn to_text(facts: &[MeshSummary<'_>], total: &MeshSummary<'_>) -> String {
    let mut table = TextTable::new([
        "part",
        "vertices",
        "faces",
        "closed",
        "coincident",
        "boundary",
        "non-manifold",
        "inconsistent",
        "components",
        "bodies",
        "euler",
        "volume",
        "area",
        "size",
        "depth max",
        "mean",
    ]);
    for of in facts {
        table.row(row(of));
    }
    if facts.len() > 1 {
        table.row(row(total));
    }
    let mut text = table.to_text();
    let bounds = total.topology.bounds;
    let bounds = describe_bounds(bounds.min, bounds.max);
    text.push_str(&format!("bounds: {bounds}\n"));
    for MeshSummary {
        name,
        topology: facts,
        stray,
        ..
    } in facts
    {
        if let Some(at) = facts.where_open().first() {
            let loops = match facts.boundary_loops {
                1 => "1 loop".to_owned(),
                loops => format!("{loops} loops"),
            };
            text.push_str(&format!(
                "{name} is open: {} boundary edges in {loops}, one at {},{},{}\n",
                facts.boundary_edges,
                round(at.x),
                round(at.y),
                round(at.z)
            ));
        }
        if let Some(stray) = stray {
            text.push_str(&format!(
                "{name}: its winding number at {} points of its box is {:.3} from a whole number on average, {:.2} at most; the inside is in doubt near 0.5\n",
                thousands(stray.points),
                stray.mean,
                stray.largest
            ));
        }
        if facts.coincident_faces > 0 {
            text.push_str(&format!(
                "{name} has {} faces that lie on another: two of them cancel, and the solid has no interior there\n",
                facts.coincident_faces
            ));
        }
        if facts.closed && facts.volume < 0.0 {
            text.push_str(&format!("{name} is inside out: its volume is negative\n"));
        }
    }
    text.extend(bodies_hint(facts));
    text
}

/// Hint at the option that splits parts with several bodies.
fn bodies_hint(facts: &[MeshSummary<'_>]) -> Option<String> {
    let several = facts.iter().filter(|f| f.bodies > 1).collect::<Vec<_>>();
    let who = match several.as_slice() {
        [] => return None,
        [one] => format!("{} has {} bodies", one.name, thousands(one.bodies)),
        all => format!("{} parts have several bodies", thousands(all.len())),
    };
    Some(format!("{who}: --split makes each of them a part\n"))
}

fn row(of: &MeshSummary<'_>) -> Vec<String> {
    let facts = &of.topology;
    let size = [0, 1, 2].map(|i| round(facts.bounds.max[i] - facts.bounds.min[i]));
    vec![
        of.name.to_owned(),
        facts.vertices.to_string(),
        facts.faces.to_string(),
        if facts.closed { "yes" } else { "no" }.to_owned(),
        facts.coincident_faces.to_string(),
        facts.boundary_edges.to_string(),
        facts.non_manifold_edges.to_string(),
        facts.inconsistent_edges.to_string(),
        facts.components.to_string(),
        of.bodies.to_string(),
        facts.euler.to_string(),
        round(facts.volume),
        round(facts.area),
        size.join(" x "),
        facts.depth_complexity.largest.to_string(),
        format!("{:.2}", facts.depth_complexity.mean),
    ]
}
