//! What a frame of `adaptive` holds, and its triangles made once more on the CPU: from the same tables, by a recursion that keeps
//! nothing and shares nothing.

use std::collections::BTreeSet;

use cutaway::plan::Plan;
use cutaway::plan::pack::{Domain, Refinement};
use cutaway::scene::{PreparedSurface, View};
use cutaway::session::Session;
use cutaway::strategies::Strategy;
use glam::{DVec2, DVec3};

/// A vertex, in steps.
pub(crate) type Vertex = [i32; 2];
/// Apex, and the ends of the hypotenuse.
pub(crate) type Triangle = [Vertex; 3];

/// The tessellation of one clip-surface in one view.
#[derive(Clone)]
pub(crate) struct Sheet {
    pub(crate) domain: Domain,
    pub(crate) refinement: Refinement,
    /// Of all domains.
    pub(crate) errors: Vec<f32>,
    /// Added to the borders: what a device may round.
    pub(crate) leeway: f32,
}

/// A row of a table that a plan uploads.
pub(crate) fn row_of<T: bytemuck::AnyBitPattern>(plan: &Plan, table: &str, index: usize) -> T {
    let id = plan.resource_named(table).expect(table);
    let contents = plan.resource(id).contents.as_ref().expect(table);
    let from = index * size_of::<T>();
    bytemuck::pod_read_unaligned(&contents.bytes()[from..from + size_of::<T>()])
}

impl Sheet {
    /// That of a clip-surface, by index in the table, in the last frame of a strategy.
    pub(crate) fn of(session: &Session, strategy: &Strategy, index: usize) -> Self {
        let plan = session.plan(strategy).expect("a plan");
        Self {
            domain: row_of(plan, "domains", index),
            refinement: row_of(plan, "refinements", index),
            errors: session
                .words(strategy, "sheet_errors")
                .expect("errors")
                .into_iter()
                .map(f32::from_bits)
                .collect(),
            leeway: 0.0,
        }
    }

    /// Texels along the sides.
    pub(crate) fn texels(&self) -> [i32; 2] {
        self.domain
            .patches
            .map(|n| (n << self.domain.patch_bits) as i32)
    }

    /// Steps along a texel.
    pub(crate) fn steps(&self) -> i32 {
        1 << self.domain.step_bits
    }

    /// Steps along a patch.
    pub(crate) fn side(&self) -> i32 {
        self.steps() << self.domain.patch_bits
    }

    pub(crate) fn greatest_depth(&self) -> u32 {
        2 * (self.domain.patch_bits + self.domain.step_bits)
    }

    /// Place of a texel's error as a vertex.
    pub(crate) fn vertex_at(&self, [x, y]: [i32; 2]) -> usize {
        let row = self.texels()[0] + 1;
        self.domain.first_vertex as usize + (y * row + x) as usize
    }

    /// Place of a cell's twist.
    pub(crate) fn cell_at(&self, [x, y]: [i32; 2]) -> usize {
        self.domain.first_cell as usize + (y * self.texels()[0] + x) as usize
    }

    fn twist(&self, cell: [i32; 2]) -> f32 {
        let size = self.texels();
        let is_in = (0..2).all(|i| (0..size[i]).contains(&cell[i]));
        if is_in {
            self.errors[self.cell_at(cell)]
        } else {
            0.0
        }
    }

    /// The error at the middle of a hypotenuse.
    pub(crate) fn error(&self, [_, a, b]: &Triangle, depth: u32) -> f32 {
        let steps = self.steps();
        let middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
        let length = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
        let texel = middle.map(|m| m.div_euclid(steps));
        if length > steps {
            return self.errors[self.vertex_at(texel)];
        }
        let side = length as f32 / steps as f32;
        if depth.is_multiple_of(2) {
            return self.twist(texel) * side * side / 4.0;
        }
        let mut beside = middle;
        beside[usize::from(a[0] != b[0])] -= 1;
        let beside = beside.map(|m| m.div_euclid(steps));
        self.twist(texel).max(self.twist(beside)) * side * side / 16.0
    }

    /// Whether a triangle is halved.
    pub(crate) fn is_halved(&self, triangle: &Triangle, depth: u32) -> bool {
        if depth >= self.greatest_depth() {
            return false;
        }
        let [_, a, b] = triangle;
        let length = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
        let reach = if depth.is_multiple_of(2) {
            length + length / 2
        } else {
            length
        };
        let [first, x, y, near] = self.refinement.depth;
        let seen_at =
            first + (a[0] + b[0]) / 2 * x + (a[1] + b[1]) / 2 * y - reach * (x.abs() + y.abs());
        self.error(triangle, depth) > self.refinement.error_per_depth * seen_at.max(near) as f32
    }

    /// The least value of each border over some vertices.
    pub(crate) fn least_of_borders(&self, vertices: &[Vertex]) -> f32 {
        let greatest = |border: &[f32; 4]| {
            let of = |v: &Vertex| border[0] + v[0] as f32 * border[1] + v[1] as f32 * border[2];
            vertices.iter().map(of).fold(f32::NEG_INFINITY, f32::max)
        };
        self.refinement
            .borders
            .iter()
            .map(greatest)
            .fold(f32::INFINITY, f32::min)
    }

    /// All triangles, sorted.
    pub(crate) fn triangles(&self) -> BTreeSet<Triangle> {
        let mut all = BTreeSet::new();
        let [width, height] = self.domain.patches.map(|n| n as i32);
        for y in 0..height {
            for x in 0..width {
                for root in roots([x, y], self.side()) {
                    self.gather(root, 0, &mut all);
                }
            }
        }
        all
    }

    fn gather(&self, triangle: Triangle, depth: u32, all: &mut BTreeSet<Triangle>) {
        if depth <= 5 && self.least_of_borders(&triangle) + self.leeway < 0.0 {
            return;
        }
        if !self.is_halved(&triangle, depth) {
            all.insert(triangle);
            return;
        }
        for half in halves(&triangle) {
            self.gather(half, depth + 1, all);
        }
    }

    /// Texture coordinates of a point, in steps.
    pub(crate) fn texture(&self, surface: &PreparedSurface, at: DVec2) -> DVec2 {
        let map = surface.relief.as_ref().expect("a relief");
        let size = DVec2::new(f64::from(map.size()[0]), f64::from(map.size()[1]));
        let [x, y] = self.domain.first_texel.map(f64::from);
        (DVec2::new(x, y) + at / f64::from(self.steps()) + 0.5) / size
    }

    /// Height of the relief over a point in steps, in scene units.
    pub(crate) fn height(&self, surface: &PreparedSurface, at: DVec2) -> f64 {
        let map = surface.relief.as_ref().expect("a relief");
        map.sample(surface.wrap, self.texture(surface, at)).0 * surface.height_scale
    }

    /// A point of the plane, moved by a height.
    pub(crate) fn point(&self, surface: &PreparedSurface, at: DVec2, height: f64) -> DVec3 {
        let map = surface.relief.as_ref().expect("a relief");
        let per_unit = [0, 1].map(|i| surface.map_per_unit[i] * f64::from(map.size()[i]));
        let texel =
            DVec2::from(self.domain.first_texel.map(f64::from)) + at / f64::from(self.steps());
        surface.origin
            + surface.frame.u_hat * ((texel.x + 0.5) / per_unit[0])
            + surface.frame.v_hat * ((texel.y + 0.5) / per_unit[1])
            - surface.frame.normal * height
    }
}

/// The triangles of a patch.
pub(crate) fn roots([x, y]: [i32; 2], side: i32) -> [Triangle; 2] {
    let ([l, b], [r, t]) = ([x * side, y * side], [(x + 1) * side, (y + 1) * side]);
    if (x + y) % 2 == 0 {
        [[[r, b], [r, t], [l, b]], [[l, t], [l, b], [r, t]]]
    } else {
        [[[l, b], [r, b], [l, t]], [[r, t], [l, t], [r, b]]]
    }
}

/// The halves of a triangle.
pub(crate) fn halves([apex, a, b]: &Triangle) -> [Triangle; 2] {
    let middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    [[middle, *apex, *a], [middle, *b, *apex]]
}

/// The triangles that the device made for the clip-surface that is tessellated as number `slot`, turned as the domain turns.
pub(crate) fn drawn(session: &Session, strategy: &Strategy, slot: usize) -> Vec<Triangle> {
    let arguments = session.words(strategy, "arguments").expect("arguments");
    let [count, instances, first, base, instance] =
        [0, 1, 2, 3, 4].map(|i| arguments[5 * slot + i] as usize);
    assert_eq!(
        [instances, base, instance],
        [1, 0, 0],
        "arguments of a draw"
    );
    let words = session.words(strategy, "triangles").expect("indices");
    let vertices = words[first..first + count]
        .iter()
        .map(|w| [(w & 0xffff) as i32, (w >> 16) as i32]);
    let vertices: Vec<Vertex> = vertices.collect();
    let (triangles, rest) = vertices.as_chunks::<3>();
    assert!(rest.is_empty(), "{count} indices");
    triangles.to_vec()
}

/// What is wrong with triangles as the cover of a domain: edges that no other triangle has the other way round, unless they lie on the
/// border of the domain or beyond a border of the view. One of them is a crack.
pub(crate) fn cracks(sheet: &Sheet, triangles: impl IntoIterator<Item = Triangle>) -> Vec<String> {
    let mut edges: BTreeSet<(Vertex, Vertex)> = BTreeSet::new();
    let mut faults = Vec::new();
    for t in triangles {
        let [a, b, c] = t;
        let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        if i64::from(u[0]) * i64::from(v[1]) - i64::from(u[1]) * i64::from(v[0]) <= 0 {
            faults.push(format!("{t:?} turns the other way"));
        }
        for edge in [(a, b), (b, c), (c, a)] {
            if !edges.insert(edge) {
                faults.push(format!("{edge:?} is there twice"));
            }
        }
    }
    let end = sheet.texels().map(|n| n * sheet.steps());
    for (a, b) in &edges {
        let on_border = (0..2).any(|i| a[i] == b[i] && (a[i] == 0 || a[i] == end[i]));
        if edges.contains(&(*b, *a)) || on_border || sheet.least_of_borders(&[*a, *b]) < 1e-5 {
            continue;
        }
        faults.push(format!("{a:?} to {b:?} has no other side"));
    }
    faults
}

/// Whether a point is in the picture and in the box of the cut solids.
pub(crate) fn is_seen(view: &View, cut_box: &cutaway::scene::Bounds, point: DVec3) -> bool {
    let (at, depth) = view.project(point);
    let size = DVec2::new(f64::from(view.size_px[0]), f64::from(view.size_px[1]));
    depth > view.near
        && at.cmpge(DVec2::ZERO).all()
        && at.cmple(size).all()
        && point.cmpge(cut_box.min).all()
        && point.cmple(cut_box.max).all()
}
