//! Who draws the pictures of a command: whom it names, or whom scene and adapter ask for.

use cutaway::Result;
use cutaway::gpu::Gpu;
use cutaway::passes::Model;
use cutaway::scene::View;
use cutaway::strategies::{AUTO, Choice, Means, choose};
use cutaway_lab::experiment::Renderer;

use super::console::Console;

/// Who is to draw.
#[derive(Clone, Copy, Debug)]
pub(super) enum Drawer {
    /// A renderer.
    Named(Renderer),
    /// Who is chosen, by these means where they say some.
    Auto(Means),
}

/// Who draws.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    pub(super) renderer: Renderer,
    /// Why, where it was chosen.
    pub(super) reason: Option<String>,
}

impl Drawer {
    /// The drawer that a name stands for, by these means where it says no others; `auto` and no name are settled later.
    ///
    /// # Errors
    ///
    /// A name that stands for none, with the one that may have been meant.
    pub(super) fn named(name: Option<&str>, means: Means) -> Result<Self> {
        Ok(match name {
            None | Some(AUTO) => Self::Auto(means),
            Some(name) => Self::Named(name.parse::<Renderer>()?.or(means)),
        })
    }

    /// Chooses where nobody is named, for a scene in a view on a device; says so to who wants to know everything. Without a device what draws
    /// is chosen as for one with fixed functions.
    pub(super) fn settle(
        self,
        gpu: Option<&Gpu>,
        (model, view): (&Model, &View),
        console: &Console,
    ) -> Chosen {
        let means = match self {
            Self::Named(renderer) => {
                return Chosen {
                    renderer,
                    reason: None,
                };
            }
            Self::Auto(means) => means,
        };
        let Choice { method, reason } = choose(model, view, means, gpu.map(Gpu::traits));
        console.detail(format!("{AUTO}: {method}, for {reason}"));
        Chosen {
            renderer: method.into(),
            reason: Some(reason),
        }
    }
}
