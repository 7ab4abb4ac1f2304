//! Work of the CPU that makes an upload of a plan.
//!
//! A plan is recorded after such work is done, for what is drawn depends on it. The plan keeps what was done, as data; its duration
//! this time, and a closure that repeats it for measurements, are kept outside the plan. Bands of one picture share what is known, so only
//! the first of them does the work; where it is done again for its time, each band does it.

use std::fmt;
use std::sync::Arc;

use super::{Clock, Plan, ResourceId};

/// Work of the CPU behind uploads, as a pass is one of the device.
#[derive(Clone, Debug, PartialEq)]
pub struct CpuStep {
    /// Unique name, as of a pass.
    pub name: String,
    /// When it is done again.
    pub clock: Clock,
    /// Why it is there.
    pub reason: String,
    /// The uploads that it makes; none where it is done for other such work, or where it found nothing to upload.
    pub makes: Vec<ResourceId>,
}

/// Record of such work.
#[derive(Clone)]
pub struct CpuWork {
    /// Milliseconds that it took for this plan; `None` where all results were known from before.
    pub took_ms: Option<f64>,
    /// Repeats all the work, and throws away its results.
    pub again: Arc<dyn Fn() + Send + Sync>,
}

impl fmt::Debug for CpuWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CpuWork ({:?} ms)", self.took_ms)
    }
}

/// A plan with the record of the CPU's work.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    /// The plan.
    pub plan: Plan,
    /// One for each of [`Plan::on_cpu`], in order.
    pub on_cpu: Vec<CpuWork>,
}

impl From<Plan> for Recorded {
    fn from(plan: Plan) -> Self {
        let on_cpu = Vec::new();
        Self { plan, on_cpu }
    }
}
