//! The exact images of a view, one per precision: a picture is judged with the undecided pixels of the rasteriser that drew it.
//!
//! Nearly all pictures are judged by the usual image, which is evaluated at once. A coarser rasteriser is one with fewer sub-pixel bits,
//! or one that interpolates depths in f32 where triangles are so long and narrow that it shows. Its image is evaluated when its first
//! picture is judged, and costs as much again. Both images have the same layers; they differ in what is undecided.

use std::borrow::Borrow;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use cutaway::scene::{Precision, Prepared, View};

use super::facet::slopes_matter;
use super::{Exact, evaluate};

/// The exact images of one view of a scene; it dereferences to the usual one.
pub struct Truth<P> {
    prepared: P,
    view: View,
    usual: Arc<Exact>,
    /// True if depth slopes in f32 are coarser than the usual precision.
    slopes_matter: OnceLock<bool>,
    /// Image at a lower precision; an adapter has at most one.
    coarse: OnceLock<(Precision, Arc<Exact>)>,
}

impl<P: Borrow<Prepared>> Truth<P> {
    /// Evaluates the usual image. The scene must be whole: [`Prepared::must_be_whole`].
    pub fn new(prepared: P, view: View) -> Self {
        Self {
            usual: Arc::new(evaluate(prepared.borrow(), &view)),
            prepared,
            view,
            slopes_matter: OnceLock::new(),
            coarse: OnceLock::new(),
        }
    }

    /// The image for pictures drawn with this precision. More bits than usual are judged like the usual: f32 leaves the same pixels open.
    pub fn at(&self, precision: Precision) -> Arc<Exact> {
        let usual = Precision::USUAL;
        let mut precision = Precision {
            sub_pixel_bits: precision.sub_pixel_bits.min(usual.sub_pixel_bits),
            ..precision
        };
        if precision.slopes_in_f32 {
            let matter = || slopes_matter(self.prepared.borrow(), &self.view);
            precision.slopes_in_f32 = *self.slopes_matter.get_or_init(matter);
        }
        if precision == usual {
            return self.usual.clone();
        }
        let view = View {
            precision,
            ..self.view
        };
        let evaluated = || Arc::new(evaluate(self.prepared.borrow(), &view));
        let (known, exact) = self.coarse.get_or_init(|| (precision, evaluated()));
        match *known == precision {
            true => exact.clone(),
            false => evaluated(),
        }
    }
}

impl<P> Deref for Truth<P> {
    type Target = Exact;

    fn deref(&self) -> &Exact {
        &self.usual
    }
}
