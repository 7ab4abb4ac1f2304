//! Choice of a command's renderer: named explicitly, or derived from scene and adapter.

use cutaway::Result;
use cutaway::gpu::Gpu;
use cutaway::passes::Model;
use cutaway::scene::View;
use cutaway::strategies::{AUTO, Choice, DrawOptions, choose};
use cutaway_lab::experiment::Renderer;

use super::console::Console;

/// Requested renderer.
#[derive(Clone, Copy, Debug)]
pub(super) enum RendererRequest {
    /// A renderer.
    Named(Renderer),
    /// Automatic choice, with these options.
    Auto(DrawOptions),
}

/// Renderer of the pictures.
#[derive(Clone, Debug)]
pub(super) struct RendererChoice {
    pub(super) renderer: Renderer,
    /// Reason for an automatic choice.
    pub(super) reason: Option<String>,
}

impl RendererRequest {
    /// Parses a renderer's name. `options` apply unless the name sets others; `auto` and a missing name are resolved later.
    ///
    /// # Errors
    ///
    /// An unknown name; the error suggests a similar known name.
    pub(super) fn named(name: Option<&str>, options: DrawOptions) -> Result<Self> {
        Ok(match name {
            None | Some(AUTO) => Self::Auto(options),
            Some(name) => Self::Named(name.parse::<Renderer>()?.or(options)),
        })
    }

    /// Resolves an automatic choice for a scene in a view on a device, and reports the choice with `--verbose`. Without a device, a device
    /// with fixed functions is assumed.
    pub(super) fn classify(
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
