//! Work of the CPU that makes an upload of a plan: told by name and reason, and timed, as a pass is.
//!
//! A plan is recorded after such work is done, for what is drawn depends on it; what the plan keeps is what it was, how long it
//! took this time, and how to do it again where somebody measures. Bands of one picture share what is known, so only the first of them does the work; where
//! it is done again for its time, each band does it.

use std::fmt;
use std::sync::Arc;

use super::{Clock, ResourceId};

/// Work of the CPU behind uploads.
#[derive(Clone)]
pub struct CpuWork {
    /// Unique name, as of a pass.
    pub name: String,
    /// When it is done again.
    pub clock: Clock,
    /// Why it is there.
    pub reason: String,
    /// The uploads that it makes; none where it is done for other such work, or where it found nothing to upload.
    pub makes: Vec<ResourceId>,
    /// Milliseconds that it took for this plan; `None` where all of it was known from before.
    pub took_ms: Option<f64>,
    /// Does all of it again, and throws away what it makes.
    pub again: Arc<dyn Fn() + Send + Sync>,
}

/// Time is no part of what a plan is.
impl PartialEq for CpuWork {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && self.clock == other.clock
            && self.reason == other.reason
            && self.makes == other.makes
    }
}

impl fmt::Debug for CpuWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.reason)
    }
}
