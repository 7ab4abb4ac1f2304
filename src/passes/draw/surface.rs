//! Drawing surfaces with the GPU's own rasteriser: the targets, and the parts that no cut reaches, which are drawn unclipped.
//!
//! One pass draws all parts that no cut reaches, and another draws their coincident faces, if there are any.

use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::input::counted;
use crate::plan::{
    Binding, Clock, ColorTarget, DepthCompare, DepthTarget, Draw, Format, Pass, Plan, Resource,
    ResourceId, Stencil, Vertices, Work,
};
use crate::shader::Shader;

/// Crossing count of a surface drawn without a crossing list; must match `UNCOUNTED` in `shaders/lib/layers.wgsl`.
const UNCOUNTED: f64 = 254.0;

/// The nearest surface of each pixel, as render targets: the first pass clears them.
#[derive(Debug)]
pub(crate) struct Surfaces {
    /// Two words per pixel.
    pub words: ResourceId,
    /// Reversed depth.
    pub depth: ResourceId,
    is_cleared: bool,
}

/// A draw of surfaces.
#[derive(Clone, Debug)]
pub(crate) struct DrawPass {
    /// Unique name.
    pub name: String,
    /// Why the pass is there.
    pub reason: String,
    pub shader: Shader,
    /// Resources by the names of the shader's variables.
    pub bindings: Vec<Binding>,
    /// Override constants.
    pub constants: Vec<(&'static str, f64)>,
    /// Vertex buffer.
    pub vertices: Vertices,
    /// Index buffer.
    pub indices: ResourceId,
    pub draws: Vec<Draw>,
}

impl Surfaces {
    /// Empty targets whose depth texture also has a stencil.
    pub(crate) fn with_stencil(plan: &mut Plan, scene: &SceneBuffers<'_>) -> Self {
        let depth = &mut plan.resources[scene.depth.0];
        let format = Format::Depth32FloatStencil8;
        depth.shape =
            Resource::texture("", scene.input.view.size_px, 1, format, Clock::Frame).shape;
        Self::new(plan, scene)
    }

    /// Empty targets.
    pub(crate) fn new(plan: &mut Plan, scene: &SceneBuffers<'_>) -> Self {
        let size = scene.input.view.size_px;
        let words = Resource::texture("surface_words", size, 1, Format::Rg32Uint, Clock::Frame);
        Self {
            words: plan.add_resource(words),
            depth: scene.depth,
            is_cleared: false,
        }
    }

    /// Additional empty targets besides the frame's own, with given names for words and depth.
    pub(crate) fn named(
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        [words, depth]: [&'static str; 2],
    ) -> Self {
        let size = scene.input.view.size_px;
        let mut texture = |name, format| {
            plan.add_resource(Resource::texture(name, size, 1, format, Clock::Frame))
        };
        Self {
            words: texture(words, Format::Rg32Uint),
            depth: texture(depth, Format::Depth32Float),
            is_cleared: false,
        }
    }

    /// Bindings for a pass that reads the targets.
    pub(crate) fn bindings(&self) -> [Binding; 2] {
        [
            Binding::read("surface_words", self.words),
            Binding::read("surface_depth", self.depth),
        ]
    }

    /// Records a pass that draws.
    pub(crate) fn draw(&mut self, plan: &mut Plan, pass: DrawPass) {
        self.draw_with(plan, pass, None);
    }

    /// As [`Self::draw`], with a stencil; the targets must have been made by [`Self::with_stencil`].
    pub(crate) fn draw_with(&mut self, plan: &mut Plan, pass: DrawPass, stencil: Option<Stencil>) {
        let clear = !std::mem::replace(&mut self.is_cleared, true);
        let work = Work::Draw {
            color: Some(ColorTarget {
                resource: self.words,
                clear,
            }),
            depth: DepthTarget {
                resource: self.depth,
                layer: 0,
                clear,
                compare: DepthCompare::Greater,
                stencil,
            },
            vertices: pass.vertices,
            indices: pass.indices,
            draws: pass.draws,
        };
        let drawn = Pass::new(pass.name, pass.reason, pass.shader, pass.bindings, work);
        plan.add_pass(drawn.with_constants(pass.constants));
    }

    /// Draws the parts that no cut reaches. In frames with crossing `lists`, a later pass counts the crossings in front of each surface.
    pub(crate) fn draw_plain_parts(
        &mut self,
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        lists: bool,
    ) {
        let input = scene.input;
        let ranks = input.active_cuts.plain_parts();
        if ranks.is_empty() && self.is_cleared {
            return;
        }
        let (vertices, indices) = scene.mesh();
        let bindings = vec![scene.frame.clone(), scene.parts.clone()];
        let reason = if ranks.is_empty() {
            "clears the targets: every part is removed or capped".to_owned()
        } else if input.active_cuts.lanes == 0 {
            "no part is cut: draws the solids unclipped".to_owned()
        } else {
            format!(
                "no cut reaches {}: drawn plainly",
                counted(ranks.len(), "part")
            )
        };
        let mut constants = Vec::new();
        if lists {
            constants.push(("behind", UNCOUNTED));
        }
        if !input.view.near_cap {
            constants.push(("passes_exits", 1.0));
        }
        let plain = DrawPass {
            name: "surface".to_owned(),
            reason,
            shader: "passes/surface.wgsl".into(),
            bindings,
            constants,
            vertices,
            indices,
            draws: input.draws_of_rest(ranks),
        };
        let doubled = scene.preclassified.as_ref().map(|preclassified| DrawPass {
            name: "surface doubled".to_owned(),
            reason: "draws the coincident face that faces the eye; in a plane shared by parts, the face of the part first in rank".to_owned(),
            shader: "passes/doubled.wgsl".into(),
            bindings: vec![scene.frame.clone(), scene.parts.clone(), preclassified.clone()],
            draws: input.draws_of_groups(ranks),
            ..plain.clone()
        });
        self.draw(plan, plain);
        if let Some(doubled) = doubled.filter(|d| !d.draws.is_empty()) {
            self.draw(plan, doubled);
        }
    }
}
