//! Sheets: surfaces of triangles that are drawn only to learn where rays cross them.
//!
//! The triangles of a clip-surface leave their fragments in linked lists, one for each pixel (Yang, Hensley, Gruen and Thibieroz 2010). A
//! pass then inserts them into the one list of crossings, by the same rule as crossings that are found in closed form. From there
//! on the source of a crossing is irrelevant: the list decides, so that no tessellation, however coarse, opens the shell of a
//! solid. A coarse sheet only displaces the cap. A sheet must have no crack: where the ends of a ray
//! do not lie on the sides that its crossings imply, the pixel is marked.
//!
//! Per frame: the triangles once, by the GPU's rasteriser in every case; a pass that empties the lists and one that merges, in
//! time quadratic in the crossings of a pixel, both in those tiles alone that have something where these are known; 4 bytes per pixel and
//! 12 per fragment.
//!
//! Cannot: know before a frame how many fragments there will be. A frame that needs more than the last is drawn twice.

use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::Crossings;
use crate::passes::frame::need::{NEED_OF_SHEETS, need};
use crate::passes::frame::refusal::Refusal;
use crate::plan::pack::SheetPool;
use crate::plan::{
    Access, Binding, Bounded, Capacity, Clock, Contents, DepthTarget, Draw, Pass, Plan, Resource,
    ResourceId, Role, Vertices, Work,
};
use crate::shader::Shader;

/// Name of the bounded resource, for the report of a frame that needs more.
const FRAGMENTS_OF_SHEETS: &str = "fragments of sheets";

/// Triangles of sheets, drawn in one pass.
#[derive(Clone, Debug)]
pub(crate) struct SheetDraw {
    /// The name of its pass, unique among those of a frame.
    pub name: String,
    pub shader: Shader,
    /// Its bindings in addition to the lists.
    pub bindings: Vec<Binding>,
    /// Override constants.
    pub constants: Vec<(&'static str, f64)>,
    /// Vertex buffer.
    pub vertices: Vertices,
    /// Index buffer.
    pub indices: ResourceId,
    pub draws: Vec<Draw>,
}

/// The sheets of a frame. Clip-surfaces are bits by their index in the table.
#[derive(Clone, Debug)]
pub(crate) struct Sheets {
    /// Draws of their triangles.
    pub draws: Vec<SheetDraw>,
    /// Those whose triangles show their front to the kept side.
    pub by_facing: u32,
    /// Those that bound a solid, the removed side: they are crossed an even number of times by any line.
    pub by_parity: u32,
    /// Subset of `by_parity` whose outside is the removed side.
    pub keeps_inside: u32,
    /// Subset of `by_parity` that the near plane does not meet: an odd number of fragments marks the pixel.
    pub closed: u32,
    /// File that fills `cutaway::sheet_side`, the side of a sheet with facing on which a ray begins and ends, and its dependencies.
    pub side: Vec<&'static str>,
    /// By how much its answer may be off, in scene units: nearer to a sheet the facings of its crossings say it.
    pub beside: f64,
    /// Bindings of `side`.
    pub side_bindings: Vec<Binding>,
}

impl Default for Sheets {
    fn default() -> Self {
        Self {
            draws: Vec::new(),
            by_facing: 0,
            by_parity: 0,
            keeps_inside: 0,
            closed: 0,
            side: vec!["lib/sheet_side/none.wgsl"],
            beside: 0.0,
            side_bindings: Vec::new(),
        }
    }
}

impl Sheets {
    /// Records the passes that insert the crossings with sheets into lists that hold all others.
    pub(crate) fn merge(
        &self,
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        crossings: &Crossings,
    ) -> Result<(), Refusal> {
        let lists = SheetLists::new(plan, scene)?;
        let (share, work, tiles) = match &scene.on_screen {
            Some(on_screen) => {
                let touched = on_screen.touched;
                let tiles = Some(touched.binding(Access::Read));
                ("lib/share/touched.wgsl", touched.shared(), tiles)
            }
            None => {
                let picture = Work::over(scene.input.view.size_px);
                ("lib/share/picture.wgsl", picture, None)
            }
        };
        let mut bindings = vec![
            scene.frame.clone(),
            lists.pool.clone(),
            Binding::write("sheets", lists.buffer),
        ];
        bindings.extend(tiles.clone());
        plan.add_pass(Pass::new(
            "sheet clear",
            "the list of sheet fragments of every pixel begins empty",
            Shader::from("passes/sheet/clear.wgsl").with(share),
            bindings,
            work.clone(),
        ));
        for draw in &self.draws {
            plan.add_pass(draw.pass(&lists, scene.depth));
        }
        let need = need(plan, scene.input, Clock::Frame);
        let mut bindings = vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            Binding::update("crossing_heads", crossings.heads),
            Binding::update("crossing_z", crossings.z),
            Binding::update("crossing_surface", crossings.surfaces),
            Binding::update("need", need),
            lists.pool.clone(),
            Binding::read("sheets", lists.buffer),
        ];
        bindings.extend(tiles);
        bindings.extend(self.side_bindings.iter().cloned());
        let merge = Pass::new(
            "merge",
            "crossings with sheets go into the one list of depths per pixel",
            Shader::from("passes/sheet/merge.wgsl")
                .with(share)
                .with_all(&self.side)
                .with(crossings.surfaces_file),
            bindings,
            work,
        );
        plan.add_pass(merge.with_constants(vec![
            ("capacity", f64::from(crossings.capacity)),
            ("by_facing", f64::from(self.by_facing)),
            ("by_parity", f64::from(self.by_parity)),
            ("keeps_inside", f64::from(self.keeps_inside)),
            ("closed", f64::from(self.closed)),
            ("beside", self.beside),
        ]));
        Ok(())
    }
}

/// The lists of sheet fragments of a frame: `shaders/lib/lists/sheet_pool.wgsl`.
struct SheetLists {
    buffer: ResourceId,
    pool: Binding,
}

impl SheetLists {
    /// A list for each pixel, and as many fragments in them as the last frame needed: at first one for each pixel. The reason where there are
    /// more pixels than words can count.
    fn new(plan: &mut Plan, scene: &SceneBuffers<'_>) -> Result<Self, Refusal> {
        let pixels = scene.input.pixel_count();
        let lists = u32::try_from(pixels).map_err(|_| {
            Refusal::amount(format!(
                "{pixels} lists of {FRAGMENTS_OF_SHEETS} are more than 32 bits can count"
            ))
        })?;
        let capacity = scene.input.capacities.sheets.unwrap_or(lists);
        let words = u64::from(lists) + 1 + 3 * u64::from(capacity);
        let buffer = Resource::storage(FRAGMENTS_OF_SHEETS, 4 * words, Clock::Frame);
        let layout = SheetPool {
            lists,
            capacity,
            padding: [0; 2],
        };
        let contents = Contents::from_values(&[layout]);
        let pool = Resource::upload("sheet pool", Role::Uniform, contents, Clock::Frame);
        plan.bounded.push(Bounded {
            what: FRAGMENTS_OF_SHEETS.to_owned(),
            slot: NEED_OF_SHEETS,
            capacity,
            resizes: Some(Capacity::Sheets),
            exact: false,
        });
        Ok(Self {
            buffer: plan.add_resource(buffer),
            pool: Binding::read("sheet_pool", plan.add_resource(pool)),
        })
    }
}

impl SheetDraw {
    fn pass(&self, lists: &SheetLists, depth: ResourceId) -> Pass {
        let mut bindings = self.bindings.clone();
        bindings.extend([lists.pool.clone(), Binding::update("sheets", lists.buffer)]);
        let pass = Pass::new(
            self.name.clone(),
            "where rays cross the sheets",
            self.shader.clone(),
            bindings,
            Work::Draw {
                color: None,
                depth: DepthTarget::untouched(depth),
                vertices: self.vertices,
                indices: self.indices,
                draws: self.draws.clone(),
            },
        );
        pass.with_constants(self.constants.clone())
    }
}
