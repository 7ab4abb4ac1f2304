//! Procedural reliefs, which need no file: names, parameters and default values. `heights.rs` computes them.

use crate::scene::describe::{Described, Field, Given, Leaf, ValueType};

/// Maximum number of texels of a map: 128 MiB of f32, the largest buffer that every WebGPU adapter can bind.
pub const MAX_TEXELS: u64 = 1 << 25;

/// Function that a procedure computes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProcedureKind {
    /// The 2 x 2 map of Diepstraten et al. 2003: repeated, its bilinear interpolation is a zigzag along `U`, one tooth
    /// per repeat and straight along `V`. Under mirror or clamp it has only one flank.
    Sawtooth,
    /// Egg-crate of cosines, with a whole number of waves along `U` and `V`; 0 waves leaves that direction straight.
    Waves {
        /// Waves along `U` and along `V`.
        count: [u32; 2],
    },
    /// Fractional Brownian motion: octaves of gradient noise, each twice as fine.
    Fractal {
        /// Lattice cells of the coarsest octave along the longer side of the map.
        cells: u32,
        /// Number of octaves; those finer than two texels are left out, since they would only alias.
        octaves: u32,
        /// Amplitude of an octave relative to the next coarser one.
        gain: f64,
    },
    /// Cracked ground: Voronoi cells (Worley 1996), each a tilted facet with its own height, separated by grooves.
    Cracks {
        /// Cells along the longer side of the map.
        cells: u32,
        /// Half width of a groove, in cells.
        width: f64,
    },
    /// Terraces: steps up and down again along `U` and `V`, with risers one texel wide.
    Steps {
        /// Number of heights in each direction, at least 2.
        levels: u32,
    },
    /// One height everywhere.
    Constant {
        /// The height.
        value: f64,
    },
}

/// A procedure with its size and seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Procedure {
    /// Function to compute.
    pub kind: ProcedureKind,
    /// Width and height of the map in texels.
    pub size: [u32; 2],
    /// Picks one of the many patterns of a random procedure.
    pub seed: u64,
}

impl Procedure {
    /// Names that [`Procedure::named`] accepts.
    pub const NAMES: [&str; 6] = [
        "sawtooth", "waves", "fractal", "cracks", "steps", "constant",
    ];

    /// The procedure with a given name, with defaults that suit most models.
    pub fn named(name: &str) -> Option<Self> {
        use ProcedureKind::{Constant, Cracks, Fractal, Sawtooth, Steps, Waves};
        let (kind, size) = match name {
            "sawtooth" => (Sawtooth, 2),
            "waves" => (Waves { count: [3, 3] }, 256),
            "fractal" => (
                Fractal {
                    cells: 4,
                    octaves: 5,
                    gain: 0.5,
                },
                256,
            ),
            "cracks" => (
                Cracks {
                    cells: 6,
                    width: 0.12,
                },
                256,
            ),
            "steps" => (Steps { levels: 5 }, 256),
            "constant" => (Constant { value: 0.5 }, 1),
            _ => return None,
        };
        Some(Self {
            kind,
            size: [size, size],
            seed: 1,
        })
    }

    /// Returns the reason if the map would be too large.
    pub fn defect(&self) -> Option<String> {
        let [w, h] = self.size;
        (u64::from(w) * u64::from(h) > MAX_TEXELS)
            .then(|| format!("{w} x {h} is more than {MAX_TEXELS} texels"))
    }

    /// Declarations of the parameters of all kinds.
    pub const FIELDS: &'static [Field] = &[
        SIZE, SEED, COUNT, CELLS, OCTAVES, GAIN, WIDTH, LEVELS, VALUE,
    ];
}

const SIZE: Field = Field::leaf(
    "size",
    "size of a computed height map",
    ValueType::OneOrMore(&ValueType::Whole(1.0, 65_536.0), 2),
    "[256, 256]",
)
.unit("texels");
const SEED: Field = Field::leaf(
    "seed",
    "random seed (fractal, cracks)",
    u64::TYPE.within(0.0, 9e15),
    "7",
);
const COUNT: Field = Field::leaf(
    "count",
    "number of waves in each direction (waves)",
    ValueType::OneOrMore(&ValueType::Whole(0.0, 4096.0), 2),
    "[3, 3]",
);
const CELLS: Field = Field::leaf(
    "cells",
    "cells along the longer side (fractal, cracks)",
    ValueType::Whole(1.0, 4096.0),
    "4",
);
const OCTAVES: Field = Field::leaf(
    "octaves",
    "number of octaves (fractal)",
    ValueType::Whole(1.0, 16.0),
    "5",
);
const GAIN: Field = Field::leaf(
    "gain",
    "amplitude ratio from one octave to the next finer one (fractal)",
    ValueType::Number(0.0, 1.0),
    "0.5",
);
const WIDTH: Field = Field::leaf(
    "width",
    "half width of a groove (cracks)",
    ValueType::Number(1e-3, 1.0),
    "0.12",
)
.unit("cells");
const LEVELS: Field = Field::leaf(
    "levels",
    "number of heights in each direction (steps)",
    ValueType::Whole(2.0, 4096.0),
    "5",
);
const VALUE: Field = Field::leaf(
    "value",
    "height (constant)",
    ValueType::Number(0.0, 1.0),
    "0.5",
);

/// The parameters of its kind.
impl Described for Procedure {
    fn fields(&self) -> &'static [Field] {
        match self.kind {
            ProcedureKind::Sawtooth => &[],
            ProcedureKind::Waves { .. } => &[SIZE, COUNT],
            ProcedureKind::Fractal { .. } => &[SIZE, SEED, CELLS, OCTAVES, GAIN],
            ProcedureKind::Cracks { .. } => &[SIZE, SEED, CELLS, WIDTH],
            ProcedureKind::Steps { .. } => &[SIZE, LEVELS],
            ProcedureKind::Constant { .. } => &[SIZE, VALUE],
        }
    }

    fn set(&mut self, field: usize, given: Given) -> bool {
        use ProcedureKind::{Constant, Cracks, Fractal, Steps, Waves};
        let key = self.fields().get(field).map_or("", |f| f.key);
        match (key, &mut self.kind) {
            ("size", _) => self.size.set(given),
            ("seed", _) => self.seed.set(given),
            ("count", Waves { count }) => count.set(given),
            ("cells", Fractal { cells, .. } | Cracks { cells, .. }) => cells.set(given),
            ("octaves", Fractal { octaves, .. }) => octaves.set(given),
            ("gain", Fractal { gain, .. }) => gain.set(given),
            ("width", Cracks { width, .. }) => width.set(given),
            ("levels", Steps { levels }) => levels.set(given),
            ("value", Constant { value }) => value.set(given),
            _ => false,
        }
    }

    fn get(&self, field: usize) -> Option<Given> {
        use ProcedureKind::{Constant, Cracks, Fractal, Steps, Waves};
        match (self.fields().get(field)?.key, &self.kind) {
            ("size", _) => self.size.get(),
            ("seed", _) => self.seed.get(),
            ("count", Waves { count }) => count.get(),
            ("cells", Fractal { cells, .. } | Cracks { cells, .. }) => cells.get(),
            ("octaves", Fractal { octaves, .. }) => octaves.get(),
            ("gain", Fractal { gain, .. }) => gain.get(),
            ("width", Cracks { width, .. }) => width.get(),
            ("levels", Steps { levels }) => levels.get(),
            ("value", Constant { value }) => value.get(),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_that_are_too_large_are_refused() {
        let mut fractal = Procedure::named("fractal").expect("fractal");
        for (size, fits) in [([4096, 4096], true), ([65_536, 65_536], false)] {
            fractal.size = size;
            assert_eq!(fractal.defect().is_none(), fits, "{size:?}");
        }
    }

    #[test]
    fn every_number_is_set_and_read_back() {
        for name in Procedure::NAMES {
            let mut procedure = Procedure::named(name).expect(name);
            let before = procedure;
            for (index, field) in procedure.fields().iter().enumerate() {
                let given = procedure
                    .get(index)
                    .unwrap_or_else(|| panic!("{}", field.key));
                procedure.set(index, given);
                assert!(Procedure::FIELDS.contains(field), "{}", field.key);
            }
            assert_eq!(procedure, before, "{name}");
        }
    }
}
