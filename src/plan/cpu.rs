//! CPU work that makes an upload of a plan.
//!
//! A plan is recorded after this work is done, because its draws depend on it. The plan stores the work as data; how long it took this
//! time, and a closure that repeats it for measurements, are kept outside the plan. Bands of one picture share cached results, so only the
//! first band does the work; when work is repeated to be timed, every band repeats it.

use std::fmt;
use std::sync::Arc;

use super::{Clock, Plan, ResourceId};

/// CPU work that makes uploads: the counterpart of a pass on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct CpuStep {
    /// Unique name, like that of a pass.
    pub name: String,
    /// Clock on which the work is done again.
    pub clock: Clock,
    /// Why the work is needed.
    pub reason: String,
    /// The uploads that the step makes; empty if it prepares other CPU work, or found nothing to upload.
    pub makes: Vec<ResourceId>,
}

/// Timing record of a [`CpuStep`].
#[derive(Clone)]
pub struct CpuWork {
    /// Milliseconds that it took for this plan; `None` if all results were cached.
    pub took_ms: Option<f64>,
    /// Repeats all the work and discards its results.
    pub again: Arc<dyn Fn() + Send + Sync>,
}

impl fmt::Debug for CpuWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CpuWork ({:?} ms)", self.took_ms)
    }
}

/// A plan, with the record of its CPU work.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    /// The plan.
    pub plan: Plan,
    /// One record for each step of [`Plan::on_cpu`], in order.
    pub on_cpu: Vec<CpuWork>,
}

impl From<Plan> for Recorded {
    fn from(plan: Plan) -> Self {
        let on_cpu = Vec::new();
        Self { plan, on_cpu }
    }
}
