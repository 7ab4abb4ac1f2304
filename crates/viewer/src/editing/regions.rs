//! The boxes and wedges of a cut, and how their faces are moved.
//!
//! A moved face keeps its notation in the document: percentages remain percentages, a centre and a size remain so. Coordinates are in
//! world space, and percentages refer to the model's bounding box.

use cutaway::scene::{Amount, Block, Bounds, Wedge, next_axis, to_decimals};
use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Node, Value};
use glam::DVec3;

/// Number of decimals to which a move rounds percentages.
const PERCENT_DECIMALS: i32 = 3;

/// Lengths are rounded to this fraction of the model's size.
const FINEST_SHARE: f64 = 1e-6;

/// Number of decimals to which a move rounds angles in degrees.
const DEGREE_DECIMALS: i32 = 2;

/// A region of a cut, and its path in the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// A box.
    Block {
        /// Dotted path.
        path: String,
        /// The box.
        block: Block,
    },
    /// A wedge between two half-planes.
    Wedge {
        /// Dotted path.
        path: String,
        /// The wedge.
        wedge: Wedge,
    },
}

/// Move of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RegionMove {
    /// A face of a box.
    Face {
        /// Index into the [`regions`] of the cut.
        region: usize,
        /// 0 is x.
        axis: usize,
        /// True for the face at the maximum corner.
        is_greatest: bool,
        /// New coordinate.
        to: f64,
    },
    /// A half-plane of a wedge.
    Angle {
        /// Index into the [`regions`] of the cut.
        region: usize,
        /// True for the half-plane where the wedge ends.
        is_end: bool,
        /// New angle in degrees.
        to_deg: f64,
    },
}

/// The boxes of a cut, then its wedges. Regions that the document does not give as numbers are left out.
pub fn regions(document: &Document, cut: usize, bounds: &Bounds) -> Vec<Region> {
    let each = |key: &str| -> Vec<(String, Node)> {
        let path = format!("cut.{cut}.{key}");
        let Ok(node) = document.get(&path) else {
            return Vec::new();
        };
        match &node.value {
            Value::List(list) => {
                let numbered = list.iter().cloned().enumerate();
                numbered
                    .map(|(i, node)| (format!("{path}.{i}"), node))
                    .collect()
            }
            _ => vec![(path, node.clone())],
        }
    };
    let blocks = each("box").into_iter().filter_map(|(path, node)| {
        let block = block(&node, bounds)?;
        Some(Region::Block { path, block })
    });
    let wedges = each("wedge").into_iter().filter_map(|(path, node)| {
        let wedge = wedge(&node, bounds)?;
        Some(Region::Wedge { path, wedge })
    });
    blocks.chain(wedges).collect()
}

fn block(node: &Node, bounds: &Bounds) -> Option<Block> {
    if let Some(size) = node.get("size") {
        let centre = match node.get("centre") {
            Some(centre) => point(centre, bounds)?,
            None => bounds.centre(),
        };
        let half = sizes(size, bounds)? * 0.5;
        return Some(Block {
            min: (centre - half).to_array().map(Some),
            max: (centre + half).to_array().map(Some),
        });
    }
    let corner = |key: &str| match node.get(key) {
        Some(corner) => point(corner, bounds).map(|p| p.to_array().map(Some)),
        None => Some([None; 3]),
    };
    Some(Block {
        min: corner("min")?,
        max: corner("max")?,
    })
}

fn wedge(node: &Node, bounds: &Bounds) -> Option<Wedge> {
    let along = direction(node.get("axis")?)?;
    let ends = bounds.corners().map(|corner| corner.dot(along));
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let most = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let end = |key: &str| Some(amount(node.get(key)?)?.between(least, most));
    Some(Wedge {
        origin: match node.get("origin") {
            Some(origin) => point(origin, bounds)?,
            None => bounds.centre(),
        },
        along,
        zero: next_axis(along),
        from_deg: number(node.get("from_deg")?)?,
        to_deg: number(node.get("to_deg")?)?,
        min: end("min"),
        max: end("max"),
    })
}

/// Moves a face of a region of a cut.
///
/// # Errors
///
/// The region does not exist, or is of another kind.
pub fn move_region(
    document: &mut Document,
    cut: usize,
    by: RegionMove,
    bounds: &Bounds,
) -> Result<()> {
    let regions = regions(document, cut, bounds);
    match by {
        RegionMove::Face {
            region,
            axis,
            is_greatest,
            to,
        } => match regions.get(region) {
            Some(Region::Block { path, block }) => {
                move_face(document, (path, block), (axis, is_greatest, to), bounds)
            }
            _ => Err(none("box")),
        },
        RegionMove::Angle {
            region,
            is_end,
            to_deg,
        } => match regions.get(region) {
            Some(Region::Wedge { path, .. }) => {
                let key = if is_end { "to_deg" } else { "from_deg" };
                let degrees = to_decimals(to_deg, DEGREE_DECIMALS);
                document.set(&format!("{path}.{key}"), degrees)
            }
            _ => Err(none("wedge")),
        },
    }
}

fn none(kind: &str) -> Error {
    Error::input(
        "the cut",
        format!("it has no such {kind}"),
        "select another cut, or edit the numbers of this one",
    )
}

fn move_face(
    document: &mut Document,
    (path, block): (&str, &Block),
    (axis, is_greatest, to): (usize, bool, f64),
    bounds: &Bounds,
) -> Result<()> {
    let node = document.get(path)?.clone();
    let (least, most) = (bounds.min[axis], bounds.max[axis]);
    let Some(size) = node.get("size") else {
        let key = if is_greatest { "max" } else { "min" };
        let held = node.get(key).and_then(|corner| corner.items().get(axis));
        let value = placed(held.and_then(amount), to, [least, most]);
        return document.set(&format!("{path}.{key}.{axis}"), value);
    };
    let [mut min, mut max] = [block.min, block.max].map(|corner| corner[axis].unwrap_or(to));
    *(if is_greatest { &mut max } else { &mut min }) = to;
    let middle = (min + max) * 0.5;
    let usual = Some(Amount::Percent(50.0));
    match node.get("centre") {
        Some(centre) => {
            let held = centre.items().get(axis).and_then(amount);
            let value = placed(held, middle, [least, most]);
            document.set(&format!("{path}.centre.{axis}"), value)?;
        }
        None => {
            let mut centre: [Value; 3] = std::array::from_fn(|_| Value::from("50%"));
            centre[axis] = placed(usual, middle, [least, most]);
            document.set(&format!("{path}.centre"), centre.to_vec())?;
        }
    }
    // A size is written like a coordinate in a range that begins at 0.
    let long = |held: Option<Amount>| placed(held, max - min, [0.0, most - least]);
    match &size.value {
        Value::List(list) => {
            let held = list.get(axis).and_then(amount);
            document.set(&format!("{path}.size.{axis}"), long(held))
        }
        one => {
            let mut three: [Value; 3] = std::array::from_fn(|_| one.clone());
            three[axis] = long(amount(size));
            document.set(&format!("{path}.size"), three.to_vec())
        }
    }
}

/// A coordinate in the previous value's notation: as a percentage of a range, or in units.
fn placed(held: Option<Amount>, to: f64, [least, most]: [f64; 2]) -> Value {
    match held {
        Some(Amount::Percent(_)) if most > least => {
            let percent = (to - least) / (most - least) * 100.0;
            let percent = to_decimals(percent, PERCENT_DECIMALS);
            Amount::Percent(percent).to_string().into()
        }
        _ => {
            let finest = (most - least) * FINEST_SHARE;
            let is_sound = finest > 0.0 && finest.is_finite();
            let decimals = if is_sound {
                -finest.log10().floor()
            } else {
                9.0
            };
            to_decimals(to, decimals as i32).into()
        }
    }
}

fn number(node: &Node) -> Option<f64> {
    match &node.value {
        Value::Number(number) => Some(number.value),
        _ => None,
    }
}

fn amount(node: &Node) -> Option<Amount> {
    match &node.value {
        Value::Number(number) => Some(Amount::Units(number.value)),
        Value::Text(text) => Amount::parse(text).ok(),
        _ => None,
    }
}

fn three(node: &Node) -> Option<[Amount; 3]> {
    let amounts: Option<Vec<Amount>> = node.items().iter().map(amount).collect();
    amounts?.try_into().ok()
}

fn point(node: &Node, bounds: &Bounds) -> Option<DVec3> {
    let amounts = three(node)?;
    let at = |i: usize| amounts[i].between(bounds.min[i], bounds.max[i]);
    Some(DVec3::new(at(0), at(1), at(2)))
}

fn sizes(node: &Node, bounds: &Bounds) -> Option<DVec3> {
    let amounts = match node.value {
        Value::List(_) => three(node)?,
        _ => [amount(node)?; 3],
    };
    let whole = bounds.size();
    let along = |i: usize| amounts[i].between(0.0, whole[i]);
    Some(DVec3::new(along(0), along(1), along(2)))
}

fn direction(node: &Node) -> Option<DVec3> {
    if let Some(text) = node.text() {
        let (sign, letter) = match text.strip_prefix('-') {
            Some(letter) => (-1.0, letter),
            None => (1.0, text),
        };
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == letter)?;
        return Some(DVec3::AXES[axis] * sign);
    }
    let numbers: Option<Vec<f64>> = node.items().iter().map(number).collect();
    let vector = DVec3::from_array(numbers?.try_into().ok()?);
    vector.try_normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_are_moved_in_their_own_words() {
        let bounds = Bounds::from_points([DVec3::ZERO, DVec3::new(4.0, 10.0, 2.0)]);
        let face = |axis, is_greatest, to| RegionMove::Face {
            region: 0,
            axis,
            is_greatest,
            to,
        };
        for (cut, by, expected) in [
            (
                "box = { min = [\"50%\", 0, 0] }",
                face(0, false, 1.0),
                "min = [\"25%\", 0, 0]",
            ),
            (
                "box = { min = [\"50%\", 0, 0], max = [3, 4, 1] }",
                face(1, true, 4.25),
                "max = [3, 4.25, 1]",
            ),
            (
                "box = { centre = [\"50%\", 5, 1], size = \"50%\" }",
                face(0, true, 4.0),
                "centre = [\"62.5%\", 5, 1], size = [\"75%\", \"50%\", \"50%\"]",
            ),
            (
                "box = { size = [2, 2, 2] }",
                face(2, false, 1.0),
                "size = [2, 2, 1.0]; centre = [\"50%\", \"50%\", \"75%\"]",
            ),
            (
                "wedge = { axis = \"-y\", from_deg = 0, to_deg = 90 }",
                RegionMove::Angle {
                    region: 0,
                    is_end: true,
                    to_deg: 91.237,
                },
                "to_deg = 91.24",
            ),
            (
                "wedge = [{ axis = \"z\", from_deg = 0, to_deg = 90 }, { axis = [0, 2, 0], from_deg = 5, to_deg = 90 }]",
                RegionMove::Angle {
                    region: 1,
                    is_end: false,
                    to_deg: -3.0,
                },
                "from_deg = -3.0",
            ),
        ] {
            let text = format!("[[part]]\nshape = \"cube\"\n\n[[cut]]\n{cut}\n");
            let mut document = Document::parse("scene.toml", &text).expect(cut);
            move_region(&mut document, 0, by, &bounds).expect(cut);
            for expected in expected.split("; ") {
                assert!(document.to_string().contains(expected), "{document}");
            }
            if let RegionMove::Face {
                axis,
                is_greatest,
                to,
                ..
            } = by
            {
                let Region::Block { block, .. } = &regions(&document, 0, &bounds)[0] else {
                    panic!("{cut}");
                };
                let corner = if is_greatest { block.max } else { block.min };
                assert!((corner[axis].expect("a face") - to).abs() < 1e-9, "{cut}");
            }
        }
    }
}
