//! Length units of models, as specified by file formats.

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Micrometres.
    Micron,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Inches.
    In,
    /// Feet.
    Ft,
    /// Metres.
    M,
}

impl LengthUnit {
    /// All units, the shortest first.
    pub const ALL: [Self; 6] = [
        Self::Micron,
        Self::Mm,
        Self::Cm,
        Self::In,
        Self::Ft,
        Self::M,
    ];

    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Micron => "um",
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::In => "in",
            Self::Ft => "ft",
            Self::M => "m",
        }
    }

    /// Its length in millimetres.
    pub fn mm(self) -> f64 {
        match self {
            Self::Micron => 0.001,
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::In => 25.4,
            Self::Ft => 304.8,
            Self::M => 1000.0,
        }
    }

    /// Its name in 3MF.
    pub fn in_3mf(self) -> &'static str {
        match self {
            Self::Micron => "micron",
            Self::Mm => "millimeter",
            Self::Cm => "centimeter",
            Self::In => "inch",
            Self::Ft => "foot",
            Self::M => "meter",
        }
    }
}
