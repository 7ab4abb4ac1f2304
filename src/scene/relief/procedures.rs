//! Reliefs that need no file: their names, numbers and usual values. `heights.rs` computes them.

/// Most texels of a map: 128 MiB of f32, the largest buffer every WebGPU adapter can bind.
pub const MAX_TEXELS: u64 = 1 << 25;

/// Function that a procedure computes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProcedureKind {
    /// The 2 x 2 map of Diepstraten et al. 2003: repeated, its bilinear interpolation is a zigzag along `U`, one tooth
    /// per repeat and straight along `V`. Under mirror or clamp it has only one flank.
    Sawtooth,
    /// Egg-crate of cosines, by whole waves along `U` and `V`; 0 waves leaves that direction straight.
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
        /// Height of an octave over that of the coarser one.
        gain: f64,
    },
    /// Broken ground: Voronoi cells (Worley 1996), each a tilted facet of its own height, parted by grooves.
    Cracks {
        /// Cells along the longer side of the map.
        cells: u32,
        /// Half width of a groove, in cells.
        width: f64,
    },
    /// Terraces: treads up and down again along `U` and along `V`, with risers one texel wide.
    Steps {
        /// Heights in each direction, at least 2.
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

    /// The procedure of a name, with defaults that suit most models.
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

    /// Keys that [`Procedure::set`] accepts for this kind.
    pub fn keys(&self) -> &'static [&'static str] {
        match self.kind {
            ProcedureKind::Sawtooth => &[],
            ProcedureKind::Waves { .. } => &["size", "count"],
            ProcedureKind::Fractal { .. } => &["size", "seed", "cells", "octaves", "gain"],
            ProcedureKind::Cracks { .. } => &["size", "seed", "cells", "width"],
            ProcedureKind::Steps { .. } => &["size", "levels"],
            ProcedureKind::Constant { .. } => &["size", "value"],
        }
    }

    /// Sets a number by its key; `size` and `count` take one or two. What is wrong with them, if they cannot be taken.
    pub fn set(&mut self, key: &str, values: &[f64]) -> Result<(), String> {
        use ProcedureKind::{Constant, Cracks, Fractal, Steps, Waves};
        match (key, &mut self.kind) {
            ("size", _) => {
                let size = two(values, 1.0, 65_536.0)?;
                if u64::from(size[0]) * u64::from(size[1]) > MAX_TEXELS {
                    let [w, h] = size;
                    return Err(format!("{w} x {h} is more than {MAX_TEXELS} texels"));
                }
                self.size = size;
            }
            ("seed", _) => self.seed = whole(values, 0.0, 9e15)?,
            ("count", Waves { count }) => *count = two(values, 0.0, 4096.0)?,
            ("cells", Fractal { cells, .. } | Cracks { cells, .. }) => {
                *cells = small(values, 1.0, 4096.0)?;
            }
            ("octaves", Fractal { octaves, .. }) => *octaves = small(values, 1.0, 16.0)?,
            ("gain", Fractal { gain, .. }) => *gain = within(values, 0.0, 1.0)?,
            ("width", Cracks { width, .. }) => *width = within(values, 0.001, 1.0)?,
            ("levels", Steps { levels }) => *levels = small(values, 2.0, 4096.0)?,
            ("value", Constant { value }) => *value = within(values, 0.0, 1.0)?,
            _ => return Err(format!("it has no `{key}`")),
        }
        Ok(())
    }
}

fn within(values: &[f64], least: f64, most: f64) -> Result<f64, String> {
    match values {
        [v] if (least..=most).contains(v) => Ok(*v),
        _ => Err(format!("it must be a number from {least} to {most}")),
    }
}

fn whole(values: &[f64], least: f64, most: f64) -> Result<u64, String> {
    match values {
        [v] if (least..=most).contains(v) && v.fract() == 0.0 => Ok(*v as u64),
        _ => Err(format!("it must be a whole number from {least} to {most}")),
    }
}

fn small(values: &[f64], least: f64, most: f64) -> Result<u32, String> {
    whole(values, least, most).map(|v| u32::try_from(v).unwrap_or(u32::MAX))
}

fn two(values: &[f64], least: f64, most: f64) -> Result<[u32; 2], String> {
    match values {
        [both] => small(&[*both], least, most).map(|v| [v, v]),
        [a, b] => Ok([small(&[*a], least, most)?, small(&[*b], least, most)?]),
        _ => Err(format!(
            "it must be one or two whole numbers from {least} to {most}"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn senseless_numbers_are_refused() {
        let mut fractal = Procedure::named("fractal").expect("fractal");
        for (key, values) in [
            ("size", vec![0.0]),
            ("size", vec![65_536.0, 65_536.0]),
            ("size", vec![1.0, 2.0, 3.0]),
            ("size", vec![f64::NAN]),
            ("seed", vec![-1.0]),
            ("seed", vec![0.5]),
            ("octaves", vec![40.0]),
            ("gain", vec![f64::INFINITY]),
            ("levels", vec![3.0]),
        ] {
            assert!(
                fractal.set(key, &values).is_err(),
                "{key} = {values:?} was taken"
            );
        }
        fractal.set("size", &[4096.0]).expect("a large square map");
    }
}
