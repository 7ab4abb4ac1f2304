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

use super::Refusal;
use super::{Crossings, FragmentLists, Recorder};
use crate::plan::{
    Binding, Capacities, Clock, DepthCompare, DepthTarget, Draw, Format, Pass, Resource,
    ResourceId, Vertices, Work,
};
use crate::shader::Shader;

/// What is bounded, for the report of a frame that needs more.
const FRAGMENTS_OF_SHEETS: &str = "fragments of sheets";

/// Triangles of sheets, drawn in one pass.
#[derive(Clone, Debug)]
pub struct SheetDraw {
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
    /// Draws.
    pub draws: Vec<Draw>,
}

/// The sheets of a frame. Clip-surfaces are bits by their index in the table.
#[derive(Clone, Debug)]
pub struct Sheets {
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

impl Recorder<'_> {
    /// Records the passes that insert the crossings with sheets into lists that hold all others.
    pub fn merge_sheets(
        &mut self,
        sheets: &Sheets,
        crossings: &Crossings,
        capacity: u32,
        capacities: &Capacities,
    ) -> Result<(), Refusal> {
        let lists = self.sheet_lists(capacities, FRAGMENTS_OF_SHEETS)?;
        let mut bindings = vec![self.frame()];
        bindings.extend(lists.emptied());
        self.compute(
            "sheet clear",
            Clock::Frame,
            "the list of sheet fragments of every pixel begins empty",
            "passes/sheet/clear.wgsl",
            bindings,
            Vec::new(),
            self.view.size_px,
        );
        for draw in &sheets.draws {
            self.draw_sheet(
                "count",
                "how many fragments of sheets each pixel has",
                "lib/sheet_store/count.wgsl",
                draw,
                &lists,
            );
        }
        let need = self.need(Clock::Frame);
        self.lay_out(&lists, "fragments of sheets", need);
        for draw in &sheets.draws {
            self.draw_sheet(
                "keep",
                "where rays cross the sheets",
                "lib/sheet_store/keep.wgsl",
                draw,
                &lists,
            );
        }
        let mut bindings = vec![
            self.frame(),
            self.cut_table(),
            Binding::update("crossing_heads", crossings.heads),
            Binding::update("crossing_z", crossings.z),
            Binding::update("crossing_surface", crossings.surfaces),
            Binding::update("need", need),
        ];
        bindings.extend(lists.read());
        bindings.extend(sheets.side_bindings.iter().cloned());
        self.compute(
            "merge",
            Clock::Frame,
            "crossings with sheets go into the one list of depths per pixel",
            Shader::from("passes/sheet/merge.wgsl").with_all(&sheets.side),
            bindings,
            vec![
                ("capacity", f64::from(capacity)),
                ("by_facing", f64::from(sheets.by_facing)),
                ("by_parity", f64::from(sheets.by_parity)),
                ("keeps_inside", f64::from(sheets.keeps_inside)),
                ("closed", f64::from(sheets.closed)),
                ("beside", sheets.beside),
            ],
            self.view.size_px,
        );
        Ok(())
    }

    fn draw_sheet(
        &mut self,
        name: &str,
        reason: &str,
        store: &'static str,
        draw: &SheetDraw,
        lists: &FragmentLists,
    ) {
        // Nothing is drawn into it: a pass that draws must have one.
        let target = self.once("surface_depth", |r| {
            let format = Format::Depth32Float;
            Resource::texture("surface_depth", r.view.size_px, 1, format, Clock::Frame)
        });
        let mut bindings = draw.bindings.clone();
        bindings.extend(lists.updated());
        self.plan.add_pass(Pass {
            name: format!("{} {name}", draw.name),
            clock: Clock::Frame,
            reason: reason.to_owned(),
            shader: draw.shader.clone().with(store),
            bindings,
            constants: draw.constants.clone(),
            work: Work::Draw {
                color: None,
                depth: DepthTarget {
                    resource: target,
                    layer: 0,
                    clear: true,
                    compare: DepthCompare::Always,
                    stencil: None,
                },
                vertices: draw.vertices,
                indices: draw.indices,
                draws: draw.draws.clone(),
            },
        });
    }
}
