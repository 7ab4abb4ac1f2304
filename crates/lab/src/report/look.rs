//! The colour and the marker of each method: one table for every chart, ranking and list of a report.
//!
//! The look depends on the kind of method, not on its parameters: all grids with a depth sprite (the paper's method) look alike. Colours
//! are classes of the page's style, after Okabe and Ito (2008): they are distinguishable with all common kinds of colour blindness. Markers
//! distinguish methods of the same colour. The colour depends on how the cap surface is found: blue methods cast rays, orange methods
//! refine a grid, green and ochre methods support only planes. Methods that are not in the table are grey with a cross.

/// Shape of a marker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Marker {
    Circle,
    Square,
    Diamond,
    Up,
    Down,
    /// Marker of methods that are not in the table.
    #[default]
    Cross,
}

/// Colour and marker of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Look {
    /// Index of the colour in the page's style.
    pub color: usize,
    pub marker: Marker,
}

/// Index of grey, the colour of methods that are not in the table.
const NO_COLOR: usize = 6;

impl Default for Look {
    fn default() -> Self {
        Self::new(NO_COLOR, Marker::Cross)
    }
}

impl Look {
    const fn new(color: usize, marker: Marker) -> Self {
        Self { color, marker }
    }
}

/// Kinds of methods with their looks.
const LOOKS: [(&str, Look); 22] = [
    ("raycast+mask", Look::new(0, Marker::Circle)),
    ("raycast+mask@compute", Look::new(5, Marker::Up)),
    ("raycast+mask@compute,32-bit", Look::new(5, Marker::Down)),
    ("raycast+mask@cells", Look::new(0, Marker::Square)),
    ("raycast+mask@pyramid", Look::new(0, Marker::Up)),
    ("raycast+winding", Look::new(5, Marker::Diamond)),
    ("raycast+winding@compute", Look::new(5, Marker::Circle)),
    ("raycast+stencil", Look::new(0, Marker::Diamond)),
    ("raycast+abuffer", Look::new(7, Marker::Square)),
    ("raycast+abuffer@compute", Look::new(7, Marker::Circle)),
    ("raycast+kbuffer", Look::new(7, Marker::Down)),
    ("raycast+ldi", Look::new(3, Marker::Square)),
    ("raycast+vds", Look::new(3, Marker::Up)),
    ("stencil", Look::new(2, Marker::Square)),
    ("planar", Look::new(4, Marker::Diamond)),
    ("adaptive+mask", Look::new(2, Marker::Up)),
    ("grid+mask", Look::new(1, Marker::Square)),
    ("grid+mask@compute", Look::new(1, Marker::Up)),
    ("grid+ldi", Look::new(1, Marker::Diamond)),
    ("grid+vds", Look::new(1, Marker::Circle)),
    ("grid+vds@hardware-filter", Look::new(1, Marker::Down)),
    ("winding", Look::new(NO_COLOR, Marker::Diamond)),
];

/// Returns the look of a method, by its name in records, experiments and charts.
pub(super) fn look(name: &str) -> Look {
    let kind = kind(name);
    let found = LOOKS.iter().find(|(known, _)| *known == kind);
    found.map_or_else(Look::default, |(_, look)| *look)
}

/// The name without parameters: `grid+vds` for `grid:{cells}+vds:1024`.
fn kind(name: &str) -> String {
    let (strategy, options) = match name.split_once('@') {
        Some((strategy, options)) => (strategy, Some(options)),
        None => (name, None),
    };
    let pieces = strategy.split('+');
    let pieces = pieces.map(|piece| piece.split(':').next().unwrap_or(piece));
    let kind = pieces.collect::<Vec<_>>().join("+");
    match options {
        Some(options) => format!("{kind}@{options}"),
        None => kind,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::strategies::Strategy;

    #[test]
    fn no_two_methods_look_alike() {
        let mut looks: Vec<Look> = LOOKS.iter().map(|(_, look)| *look).collect();
        looks.push(Look::default());
        looks.sort();
        looks.dedup();
        assert_eq!(looks.len(), LOOKS.len() + 1);
    }

    #[test]
    fn all_strategies_are_in_the_table() {
        let names = Strategy::all().into_iter().map(|s| s.to_string());
        let none: Vec<String> = names.filter(|n| look(n) == Look::default()).collect();
        assert_eq!(none, [""; 0]);
        assert_eq!(look("no such method"), Look::default(), "the control");
    }

    #[test]
    fn parameters_do_not_change_the_look() {
        let all = [
            "grid:{cells}+vds:1024",
            "grid:256+vds:{texels}",
            "grid:64+vds:64",
        ];
        assert!(all.iter().all(|name| look(name) == look("grid+vds")));
        let other = "grid:256+vds:1024@hardware-filter";
        assert_ne!(look(other), look("grid+vds"));
        assert_ne!(look(other), Look::default());
    }
}
