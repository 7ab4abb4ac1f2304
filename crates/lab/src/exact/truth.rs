//! The exact images of a view, one per precision: which pixels are undecided depends on the rasteriser that drew the picture.
//!
//! Nearly all pictures are judged by the usual image, which is evaluated at once. A coarser rasteriser has fewer sub-pixel bits, or
//! interpolates depths in f32 in a scene with triangles so long and narrow that the error matters. The coarser image is evaluated for the
//! first picture that needs it, at the same cost. Both images have the same layers; they differ in which pixels are undecided.

use std::borrow::Borrow;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use cutaway::scene::{Precision, Prepared, View};

use super::facet::slopes_matter;
use super::{Exact, evaluate};

/// The exact images of one view of a scene; dereferences to the usual image.
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

    /// The image for pictures of this precision. More sub-pixel bits than usual count as the usual number: f32 leaves the same pixels open.
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
