//! The exact images of a view, by what snaps vertices: a picture is judged by the band of doubt of the rasteriser that drew it.
//!
//! Nearly all are judged by the usual one, which is evaluated at once. That of an adapter with fewer sub-pixel bits is evaluated when the
//! first of its pictures is judged, and costs as much again. Both have the same layers; they differ in what is undecided.

use std::borrow::Borrow;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use super::{Exact, evaluate};
use crate::scene::{Prepared, USUAL_SUB_PIXEL_BITS, View};

/// The exact images of one view of a scene; as a reference it is the usual one.
pub struct Truth<P> {
    prepared: P,
    view: View,
    usual: Arc<Exact>,
    /// With fewer sub-pixel bits: adapters have one number of them.
    coarse: OnceLock<(u32, Arc<Exact>)>,
}

impl<P: Borrow<Prepared>> Truth<P> {
    /// Evaluates the usual one. The scene must be whole: [`Prepared::must_be_whole`].
    pub fn new(prepared: P, view: View) -> Self {
        Self {
            usual: Arc::new(evaluate(prepared.borrow(), &view)),
            prepared,
            view,
            coarse: OnceLock::new(),
        }
    }

    /// The one for pictures whose vertices were snapped to 2^-bits px. More bits than usual are judged as the usual ones: what f32 leaves
    /// open stays open.
    pub fn at(&self, sub_pixel_bits: u32) -> Arc<Exact> {
        if sub_pixel_bits >= USUAL_SUB_PIXEL_BITS {
            return self.usual.clone();
        }
        let view = View {
            sub_pixel_bits,
            ..self.view
        };
        let evaluated = || Arc::new(evaluate(self.prepared.borrow(), &view));
        let (bits, exact) = self.coarse.get_or_init(|| (sub_pixel_bits, evaluated()));
        match *bits == sub_pixel_bits {
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
