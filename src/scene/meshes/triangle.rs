//! Triangle measures used in several places.

use glam::DVec3;

/// Length of the longest edge. Twice the area divided by it is the altitude, which identifies slivers.
pub fn longest_edge([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance(b).max(b.distance(c)).max(c.distance(a))
}
