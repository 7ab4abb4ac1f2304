//! Passes of a plan that must run, given the previous plan: all passes on the frame clock, and slower ones whose inputs changed.
//!
//! A plan is followed as data flow. An upload or a writing pass gives a range of a resource (bytes of a buffer,
//! layers of a texture) a new value; a pass reads the current values when it runs. It follows that:
//!
//! - a pass is due if it differs from before, if a value that it reads is new, or if a resource that it writes was
//!   recreated, so that its results are lost;
//! - the passes that made a value are due if a due pass reads this value and another pass has overwritten it since. So passes can share
//!   scratch memory, and each is still rebuilt independently.
//!
//! Cost: proportional to the number of passes, and to the square of the number that write one resource. Assumed without checks: a pass that
//! names bytes ([`Binding::within`](super::Binding::within)) accesses no other bytes, and a pass with `Write` access leaves no old values
//! that a later pass reads. Frame passes write nothing that slower passes made.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::work::{ARGUMENT_BYTES, DISPATCH_ARGUMENT_BYTES, INDEX_BYTES, VERTEX_BYTES};
use super::{
    Access, Arguments, Binding, Clock, Pass, Plan, Resource, ResourceId, Shape, Vertices, Work,
};

/// Work that must run before the next frame is correct.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Due {
    /// Names of passes.
    pub passes: BTreeSet<String>,
    /// The clocks on which something changed: an upload, a resource or a pass.
    pub clocks: BTreeSet<Clock>,
}

impl Due {
    /// Adds the work of `other`.
    pub fn add(&mut self, other: &Self) {
        self.passes.extend(other.passes.iter().cloned());
        self.clocks.extend(&other.clocks);
    }
}

impl Plan {
    /// Work due after another plan ran; `is_remade` returns true for resources whose storage is new.
    pub fn due_after(&self, before: &Self, is_remade: impl Fn(&Resource) -> bool) -> Due {
        let mut due = Due::default();
        due.clocks.insert(Clock::Frame);
        let old = Old::of(before);
        let mut flow = Flow::of(self);
        for (id, resource) in self.resources.iter().enumerate() {
            let remade = is_remade(resource);
            flow.remade[id] = remade;
            flow.renewed[id] = old.renewed(resource);
            if remade || !flow.renewed[id].is_empty() {
                due.clocks.insert(resource.clock);
            }
        }
        let changed: Vec<bool> = (self.passes.iter())
            .map(|pass| !old.has(self, pass))
            .collect();
        for (index, is_due) in flow.classify(changed).into_iter().enumerate() {
            if is_due {
                due.passes.insert(self.passes[index].name.clone());
                due.clocks.insert(self.passes[index].clock);
            }
        }
        due
    }
}

/// The previous plan, by name.
struct Old<'a> {
    plan: &'a Plan,
    passes: BTreeMap<&'a str, &'a Pass>,
    resources: BTreeMap<&'a str, usize>,
}

impl<'a> Old<'a> {
    fn of(plan: &'a Plan) -> Self {
        Self {
            plan,
            passes: (plan.passes.iter()).map(|p| (p.name.as_str(), p)).collect(),
            resources: (plan.resources.iter().enumerate())
                .map(|(id, r)| (r.name.as_str(), id))
                .collect(),
        }
    }

    /// The ranges of an upload whose contents changed.
    fn renewed(&self, resource: &Resource) -> Vec<Range<u64>> {
        let Some(contents) = &resource.contents else {
            return Vec::new();
        };
        let before = (self.resources.get(resource.name.as_str()))
            .and_then(|id| self.plan.resources[*id].contents.as_ref());
        let renewed: Vec<Range<u64>> = match before {
            Some(before) => contents.not_in(before).map(|p| p.range()).collect(),
            None => contents.pieces().iter().map(|p| p.range()).collect(),
        };
        match resource.shape {
            // Ranges of a texture are layers, and it is uploaded as a whole.
            Shape::Texture { .. } if !renewed.is_empty() => vec![whole(resource)],
            _ => renewed,
        }
    }

    /// Returns true if the previous plan had the same pass, ignoring resource numbers and the wording of its reason.
    fn has(&self, plan: &Plan, pass: &Pass) -> bool {
        let Some(before) = self.passes.get(pass.name.as_str()) else {
            return false;
        };
        let same =
            |a: ResourceId, b: ResourceId| plan.resource(a).name == self.plan.resources[b.0].name;
        let same_binding = |(a, b): (&Binding, &Binding)| {
            let renamed = Binding {
                resource: b.resource,
                ..a.clone()
            };
            same(a.resource, b.resource) && renamed == *b
        };
        pass.clock == before.clock
            && pass.shader == before.shader
            && pass.constants == before.constants
            && pass.bindings.len() == before.bindings.len()
            && pass.bindings.iter().zip(&before.bindings).all(same_binding)
            && same_work(&pass.work, &before.work, same)
    }
}

fn same_work(a: &Work, b: &Work, same: impl Fn(ResourceId, ResourceId) -> bool) -> bool {
    let mut renamed = a.clone();
    if let (
        Work::ComputeIndirect { arguments },
        Work::ComputeIndirect {
            arguments: arguments_b,
        },
    ) = (&mut renamed, b)
    {
        if !same(arguments.resource, arguments_b.resource) {
            return false;
        }
        arguments.resource = arguments_b.resource;
    }
    if let (
        Work::Draw {
            color,
            depth,
            vertices,
            indices,
            draws,
        },
        Work::Draw {
            color: color_b,
            depth: depth_b,
            vertices: vertices_b,
            indices: indices_b,
            draws: draws_b,
        },
    ) = (&mut renamed, b)
    {
        let mut all = same(depth.resource, depth_b.resource) && same(*indices, *indices_b);
        depth.resource = depth_b.resource;
        *indices = *indices_b;
        if let (Some(c), Some(d)) = (color, color_b) {
            all &= same(c.resource, d.resource);
            c.resource = d.resource;
        }
        if let (Vertices::Mesh(v), Vertices::Mesh(w)) = (vertices, vertices_b) {
            all &= same(*v, *w);
            *v = *w;
        }
        for (d, e) in draws.iter_mut().zip(draws_b) {
            if let (Some(a), Some(b)) = (&mut d.arguments, e.arguments) {
                all &= same(a.resource, b.resource);
                a.resource = b.resource;
            }
        }
        if !all {
            return false;
        }
    }
    renamed == *b
}

/// A range of a resource, and how a pass accesses it.
struct ResourceUse {
    resource: usize,
    stretch: Range<u64>,
    access: Access,
}

/// A range that a pass reads, and the passes that made the values there.
struct Reading {
    resource: usize,
    stretch: Range<u64>,
    /// Makers on slower clocks.
    makers: Vec<usize>,
    /// True if the range also contains uploaded values.
    uploaded: bool,
}

struct Flow<'a> {
    plan: &'a Plan,
    /// Readings of each pass.
    readings: Vec<Vec<Reading>>,
    /// For each resource, the passes of slower clocks that write it, with their ranges.
    writers: Vec<Vec<(usize, Range<u64>)>>,
    /// For each resource, true if its storage is new.
    remade: Vec<bool>,
    /// For each resource, the ranges whose upload changed.
    renewed: Vec<Vec<Range<u64>>>,
}

impl<'a> Flow<'a> {
    fn of(plan: &'a Plan) -> Self {
        let count = plan.resources.len();
        let mut flow = Self {
            plan,
            readings: Vec::with_capacity(plan.passes.len()),
            writers: vec![Vec::new(); count],
            remade: vec![false; count],
            renewed: vec![Vec::new(); count],
        };
        // The current values, each with its maker; `None` stands for uploads.
        let mut there: Vec<Vec<(Range<u64>, Option<usize>)>> = (plan.resources.iter())
            .map(|r| vec![(whole(r), None)])
            .collect();
        for (index, pass) in plan.passes.iter().enumerate() {
            let uses = uses(plan, pass);
            let mut readings = Vec::new();
            for u in uses.iter().filter(|u| u.access != Access::Write) {
                let met = there[u.resource]
                    .iter()
                    .filter(|(s, _)| meet(s, &u.stretch));
                let makers: Vec<Option<usize>> = met.map(|(_, maker)| *maker).collect();
                readings.push(Reading {
                    resource: u.resource,
                    stretch: u.stretch.clone(),
                    uploaded: makers.contains(&None),
                    makers: makers.into_iter().flatten().collect(),
                });
            }
            flow.readings.push(readings);
            if pass.clock == Clock::Frame {
                continue;
            }
            for u in uses.iter().filter(|u| u.access != Access::Read) {
                let values = &mut there[u.resource];
                if u.access == Access::Write {
                    *values = values
                        .iter()
                        .flat_map(|(s, maker)| without(s, &u.stretch).map(|s| (s, *maker)))
                        .collect();
                }
                values.push((u.stretch.clone(), Some(index)));
                flow.writers[u.resource].push((index, u.stretch.clone()));
            }
        }
        flow
    }

    /// Repeats until nothing more becomes due.
    fn classify(&self, mut due: Vec<bool>) -> Vec<bool> {
        for (resource, writers) in self.writers.iter().enumerate() {
            for (writer, _) in writers.iter().filter(|_| self.remade[resource]) {
                due[*writer] = true;
            }
        }
        for (index, pass) in self.plan.passes.iter().enumerate() {
            due[index] |= pass.clock == Clock::Frame;
        }
        loop {
            let before = due.clone();
            for index in 0..due.len() {
                due[index] =
                    due[index] || self.readings[index].iter().any(|r| self.is_new(r, &due));
                if due[index] {
                    for reading in &self.readings[index] {
                        if self.is_gone(reading, &due) {
                            reading.makers.iter().for_each(|m| due[*m] = true);
                        }
                    }
                }
            }
            if due == before {
                return due;
            }
        }
    }

    fn is_new(&self, reading: &Reading, due: &[bool]) -> bool {
        let renewed = &self.renewed[reading.resource];
        (reading.uploaded && renewed.iter().any(|s| meet(s, &reading.stretch)))
            || reading.makers.iter().any(|m| due[*m])
    }

    /// Returns true if another pass overwrites a value: a later pass did so last time, or an earlier pass does so this time.
    fn is_gone(&self, reading: &Reading, due: &[bool]) -> bool {
        let Some(first) = reading.makers.iter().min() else {
            return false;
        };
        self.writers[reading.resource]
            .iter()
            .any(|(writer, stretch)| {
                meet(stretch, &reading.stretch)
                    && !reading.makers.contains(writer)
                    && (writer > first || due[*writer])
            })
    }
}

fn meet(a: &Range<u64>, b: &Range<u64>) -> bool {
    a.start < b.end && b.start < a.end
}

/// What remains of a range before and after another.
fn without(stretch: &Range<u64>, gone: &Range<u64>) -> impl Iterator<Item = Range<u64>> + use<> {
    let before = stretch.start..stretch.end.min(gone.start);
    let behind = stretch.start.max(gone.end)..stretch.end;
    [before, behind].into_iter().filter(|s| !s.is_empty())
}

/// All bytes of a buffer, or all layers of a texture.
fn whole(resource: &Resource) -> Range<u64> {
    match resource.shape {
        Shape::Buffer { bytes, .. } => 0..bytes,
        Shape::Texture { layers, .. } => 0..u64::from(layers),
        Shape::Sampler { .. } => 0..1,
    }
}

/// Ranges that a pass uses, with the access. Clearing a target counts as writing it, even if nothing is then drawn into it.
fn uses(plan: &Plan, pass: &Pass) -> Vec<ResourceUse> {
    let layer = |layer: u32| u64::from(layer)..u64::from(layer) + 1;
    let mut all: Vec<ResourceUse> = (pass.bindings.iter())
        .map(|b| ResourceUse {
            resource: b.resource.0,
            stretch: match (&b.bytes, b.layer) {
                (Some(bytes), _) => bytes.clone(),
                (None, Some(l)) => layer(l),
                (None, None) => whole(plan.resource(b.resource)),
            },
            access: b.access,
        })
        .collect();
    let read_arguments = |arguments: &Arguments, bytes: u64| ResourceUse {
        resource: arguments.resource.0,
        stretch: arguments.offset..arguments.offset + bytes,
        access: Access::Read,
    };
    let (color, depth, vertices, indices, draws) = match &pass.work {
        Work::Compute { .. } => return all,
        Work::ComputeIndirect { arguments } => {
            all.push(read_arguments(arguments, DISPATCH_ARGUMENT_BYTES));
            return all;
        }
        Work::Draw {
            color,
            depth,
            vertices,
            indices,
            draws,
        } => (color, depth, vertices, indices, draws),
    };
    let drawn_into = |clear| {
        if clear {
            Access::Write
        } else {
            Access::ReadWrite
        }
    };
    all.extend(color.map(|c| ResourceUse {
        resource: c.resource.0,
        stretch: 0..1,
        access: drawn_into(c.clear),
    }));
    all.push(ResourceUse {
        resource: depth.resource.0,
        stretch: layer(depth.layer),
        access: drawn_into(depth.clear),
    });
    for draw in draws {
        let read = |id: ResourceId, first: u64, count: u64, size: u64| ResourceUse {
            resource: id.0,
            stretch: first * size..(first + count) * size,
            access: Access::Read,
        };
        let (first, end) = (u64::from(draw.indices.start), u64::from(draw.indices.end));
        all.push(read(*indices, first, end - first, INDEX_BYTES));
        let arguments = draw.arguments.as_ref();
        all.extend(arguments.map(|a| read_arguments(a, ARGUMENT_BYTES)));
        if let Vertices::Mesh(id) = vertices {
            let first = u64::from(draw.base_vertex.unsigned_abs());
            all.push(read(*id, first, u64::from(draw.vertex_count), VERTEX_BYTES));
        }
    }
    all
}
