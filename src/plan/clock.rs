//! Clocks: what changed since a pass last ran.

/// Input whose change makes work run again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum Clock {
    /// The mesh changed.
    Solid,
    /// A clip-surface changed.
    Cut,
    /// The view changed.
    Frame,
}

impl Clock {
    /// All clocks, slowest first.
    pub const ALL: [Self; 3] = [Self::Solid, Self::Cut, Self::Frame];

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solid => "solid",
            Self::Cut => "cut",
            Self::Frame => "frame",
        }
    }
}
