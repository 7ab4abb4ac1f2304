//! Sheets: triangulated surfaces that are drawn only to find where rays cross them.
//!
//! A clip-surface's triangles store their fragments in linked lists, one per pixel (Yang, Hensley, Gruen and Thibieroz 2010). A
//! pass then inserts them into the per-pixel crossing list, by the same rule as crossings that are found in closed form. After that
//! the source of a crossing is irrelevant: the list decides, so no tessellation, however coarse, opens a solid's
//! shell. A coarse sheet only displaces the cap. A sheet must be free of cracks: where the ends of a ray
//! do not lie on the sides that its crossings imply, the pixel is marked.
//!
//! Per frame: one draw of the triangles, always by the GPU's own rasteriser; a pass that empties the lists, and one that merges them in
//! time quadratic in the crossings of a pixel, both restricted to non-empty tiles where these are known; 4 bytes per pixel and
//! 12 per fragment.
//!
//! Cannot: predict a frame's fragment count. A frame that needs more fragments than the last one is drawn twice.

use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::Crossings;
use crate::passes::frame::need::{NEED_OF_SHEETS, need};
use crate::passes::frame::refusal::Refusal;
use crate::plan::pack::SheetPool;
use crate::plan::{
    Binding, Bounded, BufferRole, Capacity, Clock, Contents, DepthTarget, Draw, Pass, Plan,
    Resource, ResourceId, Vertices, Work,
};
use crate::shader::Shader;

/// Name of the bounded resource, for the report when a frame needs more.
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

/// The sheets of a frame. Each set of clip-surfaces is a bit set; bits are positions in the clip-surface table.
#[derive(Clone, Debug)]
pub(crate) struct Sheets {
    /// Draws of their triangles.
    pub draws: Vec<SheetDraw>,
    /// Sheets whose triangles face the kept side.
    pub by_facing: u32,
    /// Sheets that bound a solid, usually the removed side: any line crosses such a sheet an even number of times.
    pub by_parity: u32,
    /// Subset of `by_parity` whose removed side is the outside of the solid.
    pub keeps_inside: u32,
    /// Subset of `by_parity` that does not meet the near plane: an odd number of fragments marks the pixel.
    pub closed: u32,
    /// File that finds the side of a `by_facing` sheet on which a ray begins and ends (`cutaway::sheet_side`), and the files it needs.
    pub side: Vec<&'static str>,
    /// Uncertainty of that side, in scene units. For a point closer to a sheet than this, the facing of the crossings decides.
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
    /// Records the passes that insert sheet crossings into the lists that hold all other crossings.
    pub(crate) fn merge(
        &self,
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        crossings: &Crossings,
    ) -> Result<(), Refusal> {
        let lists = SheetLists::new(plan, scene)?;
        let (share, work, tiles) = scene.pixels();
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
            "inserts the crossings with sheets into the per-pixel list of depths",
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

/// The lists of sheet fragments of a frame (`shaders/lib/lists/sheet_pool.wgsl`).
struct SheetLists {
    buffer: ResourceId,
    pool: Binding,
}

impl SheetLists {
    /// One list per pixel. Together they hold as many fragments as the last frame needed; at first, one per pixel. Returns the reason if
    /// there are more pixels than 32-bit words can count.
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
        let pool = Resource::upload("sheet pool", BufferRole::Uniform, contents, Clock::Frame);
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
            "finds where rays cross the sheets",
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
