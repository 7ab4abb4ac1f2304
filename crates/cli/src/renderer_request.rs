//! Who draws the pictures of a command: whom it names, or whom scene and adapter ask for.

use cutaway::Result;
use cutaway::gpu::Gpu;
use cutaway::passes::Model;
use cutaway::scene::View;
use cutaway::strategies::{AUTO, Choice, DrawOptions, choose};
use cutaway_lab::experiment::Renderer;

use super::console::Console;

/// Who is to draw.
#[derive(Clone, Copy, Debug)]
pub(super) enum RendererRequest {
    /// A renderer.
    Named(Renderer),
    /// Who is chosen, by these means where they say some.
    Auto(DrawOptions),
}

/// Who draws.
#[derive(Clone, Debug)]
pub(super) struct RendererChoice {
    pub(super) renderer: Renderer,
    /// Why, where it was chosen.
    pub(super) reason: Option<String>,
}

impl RendererRequest {
    /// The drawer that a name stands for, by these means where it says no others; `auto` and no name are settled later.
    ///
    /// # Errors
    ///
    /// A name that stands for none, with the one that may have been meant.
    pub(super) fn named(name: Option<&str>, options: DrawOptions) -> Result<Self> {
        Ok(match name {
            None | Some(AUTO) => Self::Auto(options),
            Some(name) => Self::Named(name.parse::<Renderer>()?.or(options)),
        })
    }

    /// Chooses where nobody is named, for a scene in a view on a device; says so to who wants to know everything. Without a device what draws
    /// is chosen as for one with fixed functions.
    pub(super) fn settle(
        self,
        gpu: Option<&Gpu>,
        (model, view): (&Model, &View),
        console: &Console,
    ) -> RendererChoice {
        let options = match self {
            Self::Named(renderer) => {
                return RendererChoice {
                    renderer,
                    reason: None,
                };
            }
            Self::Auto(options) => options,
        };
        let Choice { method, reason } = choose(model, view, options, gpu.map(Gpu::traits));
        console.detail(format!("{AUTO}: {method}, for {reason}"));
        RendererChoice {
            renderer: method.into(),
            reason: Some(reason),
        }
    }
}
