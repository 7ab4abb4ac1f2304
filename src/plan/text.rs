//! The plan as text and as JSON: what `cutaway plan` prints.

use std::fmt::Write;

use super::{Clock, CpuStep, Pass, Plan, ResourceId, StencilStep, Work};

impl Plan {
    /// One paragraph per pass, by clock, and the bytes of each clock.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for clock in Clock::ALL {
            let passes: Vec<&Pass> = self.passes_on(clock).collect();
            let bytes = self.bytes_on(clock);
            let works: Vec<&CpuStep> = self.on_cpu.iter().filter(|w| w.clock == clock).collect();
            if passes.is_empty() && works.is_empty() && bytes == 0 {
                continue;
            }
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "per {}: {} pass{}, {}",
                clock.name(),
                passes.len(),
                if passes.len() == 1 { "" } else { "es" },
                human_bytes(bytes)
            );
            for w in works {
                let _ = writeln!(text, "  {}  [on the CPU]", w.name);
                let _ = writeln!(text, "    why     {}", w.reason);
                if !w.makes.is_empty() {
                    let _ = writeln!(text, "    writes  {}", self.names(&w.makes));
                }
            }
            for p in passes {
                let _ = writeln!(text, "  {}  [{}]", p.name, describe(&p.work));
                let _ = writeln!(text, "    why     {}", p.reason);
                let _ = writeln!(text, "    reads   {}", self.names(&p.reads()));
                let _ = writeln!(text, "    writes  {}", self.names(&p.writes()));
            }
        }
        text
    }

    /// The passes with `name`, `clock`, `reads`, `writes`, `reason`.
    #[cfg(feature = "serde")]
    pub fn to_json(&self) -> serde_json::Value {
        use serde_json::{Value, json};
        let list = |ids: Vec<ResourceId>| -> Vec<&str> {
            ids.iter()
                .map(|id| self.resource(*id).name.as_str())
                .collect()
        };
        let passes: Vec<Value> = self
            .passes
            .iter()
            .map(|p| {
                json!({ "name": p.name, "clock": p.clock, "shader": p.shader.to_string(), "work": describe(&p.work),
                    "reads": list(p.reads()), "writes": list(p.writes()), "reason": p.reason })
            })
            .collect();
        let on_cpu: Vec<Value> = self
            .on_cpu
            .iter()
            .map(|w| json!({ "name": w.name, "clock": w.clock, "writes": list(w.makes.clone()), "reason": w.reason }))
            .collect();
        let resources: Vec<Value> = self
            .resources
            .iter()
            .map(|r| json!({ "name": r.name, "clock": r.clock, "bytes": r.shape.bytes(), "scene": r.is_scene }))
            .collect();
        let [solid, cut, frame] = Clock::ALL.map(|c| self.bytes_on(c));
        let scene: u64 = Clock::ALL.map(|c| self.scene_bytes_on(c)).iter().sum();
        json!({ "passes": passes, "on_cpu": on_cpu, "resources": resources,
            "bytes": { "solid": solid, "cut": cut, "frame": frame, "scene": scene } })
    }

    fn names(&self, ids: &[ResourceId]) -> String {
        if ids.is_empty() {
            return "nothing".to_owned();
        }
        ids.iter()
            .map(|id| self.resource(*id).name.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    }
}

fn describe(work: &Work) -> String {
    match work {
        Work::Compute { groups: [x, y, z] } => format!("compute {x} x {y} x {z} groups"),
        Work::ComputeIndirect { .. } => "compute, groups counted on the device".to_owned(),
        Work::Draw { draws, depth, .. } => {
            let triangles: u64 = draws
                .iter()
                .map(|d| u64::from(d.indices.end - d.indices.start) / 3)
                .sum();
            // The device may draw fewer triangles than there is room for.
            let at_most = if draws.iter().any(|d| d.arguments.is_some()) {
                "up to "
            } else {
                ""
            };
            let [of_draws, of_triangles] =
                [draws.len() as u64, triangles].map(|n| if n == 1 { "" } else { "s" });
            let stencil = match depth.stencil.map(|s| s.step) {
                None => String::new(),
                Some(StencilStep::Flip { bits }) => format!(", stencil bits {bits:#04x} flip"),
                Some(StencilStep::Wind | StencilStep::WindAll) => ", stencil winds".to_owned(),
                Some(StencilStep::Take { bits }) => format!(", where stencil & {bits:#04x} != 0"),
            };
            format!(
                "draw {at_most}{triangles} triangle{of_triangles} in {} draw{of_draws}{stencil}",
                draws.len()
            )
        }
    }
}

/// A byte count with a unit.
pub(crate) fn human_bytes(bytes: u64) -> String {
    match bytes {
        0..1024 => format!("{bytes} B"),
        1024..1_048_576 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        _ => format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
    }
}
