//! Sheets: surfaces of triangles that are drawn only to learn where rays cross them.
//!
//! The triangles of a clip-surface leave their fragments in lists of each pixel: counted, laid out by a prefix sum, kept. A pass per
//! pixel then inserts them into the one list of crossings, by the same rule as crossings that are found in closed form. From there
//! on nobody knows where a crossing came from: the list decides, so that no tessellation, however coarse, opens the shell of a
//! solid. What a coarse sheet costs is that the cap lies beside where it should. A sheet must have no crack: where the ends of a ray
//! do not lie on the sides that its crossings imply, the pixel is marked.
//!
//! Per frame: the triangles twice, by the GPU's rasteriser whoever draws the mesh; a pass that empties the lists, a prefix sum of one
//! to five passes, a pass that merges, in time quadratic in the crossings of a pixel; 4 bytes per pixel and 8 per fragment.
//!
//! Cannot: know before a frame how many fragments there will be. A frame that needs more than the last is drawn twice.

use super::need::need;
use super::{Crossings, FragmentLists, Refusal, SceneBuffers};
use crate::plan::{Binding, Clock, DepthTarget, Draw, Pass, Plan, ResourceId, Vertices, Work};
use crate::shader::Shader;

/// What is bounded, for the report of a frame that needs more.
const FRAGMENTS_OF_SHEETS: &str = "fragments of sheets";

/// Triangles of sheets, drawn in one pass.
#[derive(Clone, Debug)]
pub(crate) struct SheetDraw {
    /// What its two passes are named after, unique among those of a frame.
    pub name: String,
    /// The shader, but for the file that fills `cutaway::sheet_store`.
    pub shader: Shader,
    /// What it binds beside the lists.
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
    /// What draws them.
    pub draws: Vec<SheetDraw>,
    /// Those whose triangles show their front to the kept side.
    pub by_facing: u32,
    /// Those that bound a solid, the removed side: they are crossed an even number of times by any line.
    pub by_parity: u32,
    /// Of these, those whose outside is the removed side.
    pub keeps_inside: u32,
    /// Of these, those that the near plane does not meet: an odd number of fragments marks the pixel.
    pub closed: u32,
    /// File that fills `cutaway::sheet_side`, asked on which side of a sheet with facing a ray begins and ends, and what it needs.
    pub side: Vec<&'static str>,
    /// By how much its answer may be off, in scene units: nearer to a sheet the facings of its crossings say it.
    pub beside: f64,
    /// What that binds.
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
        let size = scene.input.view.size_px;
        let lists = FragmentLists::of_sheets(plan, scene.input, FRAGMENTS_OF_SHEETS)?;
        let mut bindings = vec![scene.frame.clone()];
        bindings.extend(lists.emptied());
        plan.add_pass(Pass::new(
            "sheet clear",
            "the list of sheet fragments of every pixel begins empty",
            "passes/sheet/clear.wgsl",
            bindings,
            Work::over(size),
        ));
        for draw in &self.draws {
            plan.add_pass(draw.pass(
                "count",
                "how many fragments of sheets each pixel has",
                "lib/sheet_store/count.wgsl",
                &lists,
                scene.depth,
            ));
        }
        let need = need(plan, scene.input, Clock::Frame);
        lists.lay_out(plan, "fragments of sheets", need);
        for draw in &self.draws {
            plan.add_pass(draw.pass(
                "keep",
                "where rays cross the sheets",
                "lib/sheet_store/keep.wgsl",
                &lists,
                scene.depth,
            ));
        }
        let mut bindings = vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            Binding::update("crossing_heads", crossings.heads),
            Binding::update("crossing_z", crossings.z),
            Binding::update("crossing_surface", crossings.surfaces),
            Binding::update("need", need),
        ];
        bindings.extend(lists.read());
        bindings.extend(self.side_bindings.iter().cloned());
        let merge = Pass::new(
            "merge",
            "crossings with sheets go into the one list of depths per pixel",
            Shader::from("passes/sheet/merge.wgsl")
                .with_all(&self.side)
                .with(crossings.count),
            bindings,
            Work::over(size),
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

impl SheetDraw {
    fn pass(
        &self,
        name: &str,
        reason: &str,
        store: &'static str,
        lists: &FragmentLists,
        depth: ResourceId,
    ) -> Pass {
        let mut bindings = self.bindings.clone();
        bindings.extend(lists.updated());
        let pass = Pass::new(
            format!("{} {name}", self.name),
            reason,
            self.shader.clone().with(store),
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
