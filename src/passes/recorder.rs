//! Recording a plan: the resources that several passes share are created at first mention, so that what nobody mentions
//! does not exist.

use super::Refusal;
use super::{Model, Relevance, ReliefWalk, Screen};
use crate::plan::pack::{self, CutTable, MAX_SURFACES, Part};
use crate::plan::{
    Binding, Clock, ColorTarget, Contents, DepthCompare, DepthTarget, Draw, Format, Pass, Plan,
    Resource, ResourceId, Role, Stencil, Vertices, Work, groups_over,
};
use crate::scene::{HeightFilter, View};
use crate::shader::Shader;

/// Word of the need buffer for crossings per pixel: `shaders/lib/crossing_list.wgsl`.
pub const NEED_OF_CROSSINGS: u32 = 0;
/// Word for the cells of a relief along a ray: `shaders/lib/relief_crossing/`.
pub const NEED_OF_CELLS: u32 = 1;
/// Word for fragments.
pub const NEED_OF_FRAGMENTS: u32 = 2;
/// Word for fragments of sheets.
pub const NEED_OF_SHEETS: u32 = 3;
/// Word for triangles that a frame makes of clip-surfaces.
pub const NEED_OF_TRIANGLES: u32 = 4;
/// First of the words for sprites, by number of the part.
pub const NEED_OF_SPRITES: u32 = 5;

/// What the mesh is drawn into.
#[derive(Clone, Copy, Debug)]
pub struct Targets {
    /// Two words per pixel.
    pub words: ResourceId,
    /// Reversed depth.
    pub depth: ResourceId,
}

/// A plan while it is recorded.
pub struct Recorder<'a> {
    /// What has been recorded.
    pub plan: Plan,
    /// The scene.
    pub model: &'a Model,
    /// The view.
    pub view: &'a View,
    /// What of the cuts matters.
    pub relevance: Relevance,
    /// Bits of a lane of the inside mask, where a strategy uses one.
    pub lane_bits: u32,
    /// The compute rasteriser may use atomics of 64 bits.
    pub wide_atomics: bool,
    /// Words of a lane of counts for each part filled nonzero; 0 where a strategy has no such lanes.
    pub winding_words: u32,
    /// How rays are followed through reliefs; `None` chooses by what the view makes of them.
    pub relief_walk: Option<ReliefWalk>,
    /// Who interpolates heights at points.
    pub height_filter: HeightFilter,
    /// Frames before had pyramids, and a camera that moves is not to build them again and again.
    pub keeps_pyramids: bool,
    pub(super) drawn: bool,
    /// What the compute rasteriser looked for the samples of the frame on.
    pub(super) screen_of_frame: Option<Screen>,
}

impl<'a> Recorder<'a> {
    /// An empty plan; the reason where the scene is too much.
    pub fn new(model: &'a Model, view: &'a View) -> Result<Self, Refusal> {
        let relevance = Relevance::of(&model.prepared, view)?;
        Ok(Self {
            plan: Plan::default(),
            model,
            view,
            relevance,
            lane_bits: 32,
            wide_atomics: false,
            winding_words: 0,
            relief_walk: None,
            height_filter: HeightFilter::Exact,
            keeps_pyramids: false,
            drawn: false,
            screen_of_frame: None,
        })
    }

    /// The resource with a name, made at first mention.
    pub fn once(&mut self, name: &str, make: impl FnOnce(&Self) -> Resource) -> ResourceId {
        match self.plan.resource_named(name) {
            Some(id) => id,
            None => {
                let resource = make(self);
                self.plan.add_resource(resource)
            }
        }
    }

    /// Contents of the scene, uploaded at first mention and bound under the name of the resource.
    pub fn uploaded(
        &mut self,
        name: &'static str,
        role: Role,
        clock: Clock,
        make: impl FnOnce(&Self) -> Contents,
    ) -> Binding {
        let id = self.once(name, |r| Resource::upload(name, role, make(r), clock));
        Binding::read(name, id)
    }

    /// The view.
    pub fn frame(&mut self) -> Binding {
        self.uploaded("frame", Role::Uniform, Clock::Frame, |r| {
            Contents::of(&[pack::frame(r.view, &r.relevance.cut_box)])
        })
    }

    /// The cuts and clip-surfaces that matter.
    pub fn cut_table(&mut self) -> Binding {
        self.uploaded("cut_table", Role::Uniform, Clock::Cut, |r| {
            let mut table: CutTable = bytemuck::Zeroable::zeroed();
            table.surface_count = r.relevance.surfaces.len() as u32;
            table.cut_count = r.relevance.cuts.len() as u32;
            table.has_normals = u32::from(r.has_cutters());
            for (i, bits) in r.relevance.cuts.iter().enumerate() {
                table.surfaces_of_cut[i / 4][i % 4] = *bits;
            }
            let reach = r.relevance.reach();
            for (slot, number) in table.surfaces.iter_mut().zip(&r.relevance.surfaces) {
                let surface = &r.model.prepared.surfaces[*number];
                *slot = pack::clip_surface(surface, *number, r.model.first_texel[*number], reach);
            }
            Contents::of(&[table])
        })
    }

    /// The parts that are drawn, in table order.
    pub fn parts(&mut self) -> Binding {
        self.uploaded("parts", Role::Storage, Clock::Cut, |r| {
            let lanes = r.lane_table().places;
            let rows: Vec<Part> = (r.relevance.order.iter().enumerate())
                .map(|(place, rank)| {
                    let part = &r.model.prepared.parts[*rank];
                    let [lane_word, lane_shift] = lanes.get(place).copied().unwrap_or_default();
                    Part {
                        cuts: r.relevance.cuts_of(*rank),
                        lane_word,
                        lane_shift,
                        part: part.part as u32,
                        color: part.material.color.extend(1.0).to_array(),
                        cap_color: part.material.cap_color().extend(1.0).to_array(),
                    }
                })
                .collect();
            Contents::of(&or_one(rows))
        })
    }

    /// Whether some clip-surface that matters is a relief.
    pub fn has_reliefs(&self) -> bool {
        let surfaces = &self.relevance.surfaces;
        surfaces.iter().any(|s| self.model.is_relief(*s))
    }

    /// Whether some clip-surface that matters is a cutter.
    pub fn has_cutters(&self) -> bool {
        let surfaces = &self.relevance.surfaces;
        surfaces.iter().any(|s| self.model.is_cutter(*s))
    }

    /// The clip-surfaces as rays see them.
    pub fn ray_table(&mut self) -> Binding {
        self.uploaded("ray_table", Role::Uniform, Clock::Frame, |r| {
            let mut table = [<pack::RaySurface as bytemuck::Zeroable>::zeroed(); MAX_SURFACES];
            for (slot, number) in table.iter_mut().zip(&r.relevance.surfaces) {
                *slot = pack::ray_surface(&r.model.prepared.surfaces[*number], r.view);
            }
            Contents::of(&table)
        })
    }

    /// The mesh of all parts, for passes of the frame: vertices and indices.
    pub fn mesh(&mut self) -> (Vertices, ResourceId) {
        (Vertices::Mesh(self.vertices()), self.indices())
    }

    /// The mesh of all parts, for passes on the clock of the solid.
    pub fn solid_mesh(&mut self) -> (Vertices, ResourceId) {
        (Vertices::Mesh(self.vertices()), self.solid_indices())
    }

    /// The vertices of all parts.
    pub(super) fn vertices(&mut self) -> ResourceId {
        let contents = self.model.vertices.clone();
        let vertices = self.uploaded("vertices", Role::Vertex, Clock::Solid, |_| contents);
        vertices.resource
    }

    /// The indices of all parts as they are, whatever cuts them.
    pub(super) fn solid_indices(&mut self) -> ResourceId {
        let contents = self.model.indices.clone();
        let indices = self.uploaded("indices", Role::Index, Clock::Solid, |_| contents);
        indices.resource
    }

    /// What the mesh is drawn into, at the resolution of the view.
    pub fn targets(&mut self) -> Targets {
        let texture = |name: &str, format| {
            let name = name.to_owned();
            move |r: &Self| Resource::texture(name, r.view.size_px, 1, format, Clock::Frame)
        };
        Targets {
            words: self.once("surface_words", texture("surface_words", Format::Rg32Uint)),
            depth: self.once(
                "surface_depth",
                texture("surface_depth", Format::Depth32Float),
            ),
        }
    }

    /// The same with a stencil beside the depth, if it is asked for before anything is drawn.
    pub fn targets_with_stencil(&mut self) -> Targets {
        let format = Format::Depth32FloatStencil8;
        self.once("surface_depth", |r| {
            Resource::texture("surface_depth", r.view.size_px, 1, format, Clock::Frame)
        });
        self.targets()
    }

    /// The draws of some parts, by rank; the instance is the part's place in the table.
    pub fn draws_of(&self, ranks: &[usize]) -> Vec<Draw> {
        ranks
            .iter()
            .map(|rank| {
                let range = &self.model.ranges[*rank];
                Draw {
                    indices: range.indices.clone(),
                    base_vertex: range.base_vertex,
                    vertex_count: range.vertex_count,
                    instance: self.relevance.place_of(*rank) as u32,
                    arguments: None,
                }
            })
            .collect()
    }

    /// A pass that draws into the targets, cleared by whichever pass draws first.
    pub fn draw(&mut self, pass: DrawPass) {
        self.draw_with(pass, None);
    }

    /// As [`Self::draw`], with a stencil, which [`Self::targets_with_stencil`] gave the targets.
    pub fn draw_with(&mut self, pass: DrawPass, stencil: Option<Stencil>) {
        let targets = self.targets();
        let clear = !std::mem::replace(&mut self.drawn, true);
        let DrawPass {
            name,
            reason,
            shader,
            bindings,
            constants,
            vertices,
            indices,
            draws,
        } = pass;
        self.plan.add_pass(Pass {
            name,
            clock: Clock::Frame,
            reason,
            shader,
            bindings,
            constants,
            work: Work::Draw {
                color: Some(ColorTarget {
                    resource: targets.words,
                    clear,
                }),
                depth: DepthTarget {
                    resource: targets.depth,
                    layer: 0,
                    clear,
                    compare: DepthCompare::Greater,
                    stencil,
                },
                vertices,
                indices,
                draws,
            },
        });
    }

    /// A compute pass with one invocation per pixel (or texel) of a picture.
    #[allow(
        clippy::too_many_arguments,
        reason = "the sentence form of a pass: each word is one argument"
    )]
    pub fn compute(
        &mut self,
        name: impl Into<String>,
        clock: Clock,
        reason: impl Into<String>,
        shader: impl Into<Shader>,
        bindings: Vec<Binding>,
        constants: Vec<(&'static str, f64)>,
        size: [u32; 2],
    ) {
        self.plan.add_pass(Pass {
            name: name.into(),
            clock,
            reason: reason.into(),
            shader: shader.into(),
            bindings,
            constants,
            work: Work::Compute {
                groups: groups_over(size),
            },
        });
    }

    /// The words that bounded buffers report their need in, at the `NEED_OF` places; `clock` is the slowest of the passes
    /// that write them.
    pub fn need(&mut self, clock: Clock) -> ResourceId {
        let id = self.once("need", |r| {
            let words = NEED_OF_SPRITES as usize + r.model.prepared.parts.len();
            Resource::storage("need", words as u64 * 4, clock)
        });
        self.plan.need = Some(id);
        id
    }
}

/// A draw into the targets, as a sentence.
pub struct DrawPass {
    /// Unique name.
    pub name: String,
    /// Why it is there.
    pub reason: String,
    /// The shader.
    pub shader: Shader,
    /// Resources by name.
    pub bindings: Vec<Binding>,
    /// Override constants.
    pub constants: Vec<(&'static str, f64)>,
    /// Vertex buffer.
    pub vertices: Vertices,
    /// Index buffer.
    pub indices: ResourceId,
    /// Draws.
    pub draws: Vec<Draw>,
}

/// `1 part`, `2 parts`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Pixels of a picture.
pub fn pixels(size: [u32; 2]) -> u64 {
    u64::from(size[0]) * u64::from(size[1])
}

/// WebGPU has no empty bindings: a table with no rows gets one of zeros.
pub(super) fn or_one<T: bytemuck::Zeroable>(mut rows: Vec<T>) -> Vec<T> {
    if rows.is_empty() {
        rows.push(T::zeroed());
    }
    rows
}
