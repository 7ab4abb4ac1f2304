//! What a scene can hold: every path, with what it takes. `cutaway help scene` prints the list, and readers refuse what is not in it.
//!
//! A `*` stands for the name of an entry or its number: `part.*.translate` is `part.crank.translate` or `part.0.translate`.

use std::fmt;
use std::sync::OnceLock;

/// A value of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Dotted path.
    pub path: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// Unit of its numbers; empty where they have none.
    pub unit: &'static str,
    /// What it is, in a line.
    pub help: &'static str,
    /// A value that it takes, as TOML.
    pub example: &'static str,
    /// Whether a `[[key]]` can move it, if it is a number or a flag.
    pub moves: bool,
}

/// What a value can be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Takes {
    /// A number between two others.
    Number(f64, f64),
    /// A whole number between two others.
    Whole(f64, f64),
    /// A list of so many numbers.
    Numbers(usize),
    /// A number, or text with a percentage: `"5%"`.
    Amount,
    /// A list of three such.
    Amounts,
    /// One number, or one for each of so many directions.
    OneOrMore(usize),
    /// True or false.
    Flag,
    /// One of some words.
    Choice(&'static [&'static str]),
    /// A colour: `"#8a94a6"`, or its name in CSS.
    Color,
    /// The name of a file, from the folder of the scene.
    File,
    /// Text.
    Text,
    /// A list of texts.
    Texts,
    /// What the help says.
    Other,
}

impl fmt::Display for Takes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let range = |least: f64, most: f64| match (least.is_finite(), most.is_finite()) {
            (true, true) => format!(" from {least} to {most}"),
            (true, false) => format!(", {least} or more"),
            (false, _) => String::new(),
        };
        match self {
            Self::Number(least, most) => write!(f, "number{}", range(*least, *most)),
            Self::Whole(least, most) => write!(f, "whole number{}", range(*least, *most)),
            Self::Numbers(count) => write!(f, "{count} numbers"),
            Self::Amount => f.write_str("number or percentage"),
            Self::Amounts => f.write_str("3 numbers or percentages"),
            Self::OneOrMore(count) => write!(f, "number, or {count}"),
            Self::Flag => f.write_str("true or false"),
            Self::Choice(words) => write!(f, "{}", words.join(" | ")),
            Self::Color => f.write_str("#rrggbb or a name"),
            Self::File => f.write_str("file"),
            Self::Text => f.write_str("text"),
            Self::Texts => f.write_str("list of texts"),
            Self::Other => f.write_str("see there"),
        }
    }
}

use Takes::{
    Amount, Amounts, Choice, Color, File, Flag, Number, Numbers, OneOrMore, Other, Text, Texts,
    Whole,
};

const ANY: f64 = f64::INFINITY;
/// A number of any size.
const REAL: Takes = Number(-ANY, ANY);
/// A number that is not negative.
const SIZE: Takes = Number(0.0, ANY);
const WRAP: Takes = Choice(&["repeat", "mirror", "clamp"]);

/// Width of a stroke.
const WIDTH: Takes = Number(0.0, 20.0);
/// Unit of the lengths of a style.
const MIL: &str = "1/1000 of the height";

/// A value that keys move, or that is no number.
const fn moved(
    path: &'static str,
    takes: Takes,
    unit: &'static str,
    example: &'static str,
    help: &'static str,
) -> Path {
    Path {
        path,
        takes,
        unit,
        help,
        example,
        moves: true,
    }
}

/// A value that stays as it is while the scene is played.
const fn fixed(
    path: &'static str,
    takes: Takes,
    unit: &'static str,
    example: &'static str,
    help: &'static str,
) -> Path {
    Path {
        moves: false,
        ..moved(path, takes, unit, example, help)
    }
}

/// All values of a scene.
#[rustfmt::skip]
pub const PATHS: &[Path] = &[
    fixed("resolution", Numbers(2), "px", "[1024, 768]", "width and height of the picture"),
    fixed("background", Color, "", "\"#ffffff\"", "what is behind the model; or \"paper\", \"gradient\", \"transparent\""),
    fixed("interference", Color, "", "\"#ff00aa\"", "hatches caps that several solids share"),
    fixed("height_filter", Choice(&["exact", "hardware"]), "", "\"exact\"", "who interpolates heights where a strategy asks for them at points"),
    fixed("supersample", Whole(1.0, 4.0), "", "2", "how many times as fine the picture is drawn along each side"),
    fixed("time_s", SIZE, "s", "0.5", "the moment that is shown"),
    fixed("clip", Text, "", "\"walk\"", "the animation that is played, by its name or its number"),
    fixed("strategy.name", Text, "", "\"auto\"", "who draws; `cutaway render --help` lists them"),
    fixed("strategy.rasteriser", Choice(&["hardware", "compute"]), "", "\"compute\"", "who rasterises the mesh"),

    fixed("style.base", Text, "", "\"technical\"", "a style by its name, or a file of one, on which the rest are changes; alone: style = \"technical\""),
    fixed("style.paper", Color, "", "\"#ffffff\"", "what is behind the model; or \"gradient\", \"transparent\""),
    fixed("style.ink", Color, "", "\"#20262e\"", "colour of strokes"),
    fixed("style.shading", Choice(&["lit", "calm", "flat", "gooch", "toon", "clay", "engraved"]), "", "\"calm\"", "how light becomes colour"),
    fixed("style.surface.color", Color, "", "\"#d8d4cc\"", "one colour for the surfaces of all parts"),
    moved("style.surface.coat", Flag, "", "true", "whether surfaces have the vertex colours and images that files bring, in the place of one colour or hues"),
    moved("style.surface.lightness", Number(0.0, 1.0), "", "0.8", "OKLab lightness of surfaces, in the hues of their parts"),
    moved("style.surface.chroma", Number(0.0, 0.4), "", "0.024", "their greatest OKLab chroma"),
    moved("style.surface.warmth", Numbers(2), "", "[0, 0]", "added to OKLab a and b"),
    fixed("style.cap.color", Color, "", "\"#e8552d\"", "one colour for the caps of all parts"),
    moved("style.cap.lightness", Number(0.0, 1.0), "", "0.955", "as of surfaces"),
    moved("style.cap.chroma", Number(0.0, 0.4), "", "0.014", "as of surfaces"),
    moved("style.cap.warmth", Numbers(2), "", "[0.003, 0.022]", "as of surfaces"),
    moved("style.cap.light", Number(0.0, 1.0), "", "1", "how much of the light caps take (calm)"),
    moved("style.cap.relief", Number(0.0, 1.0), "", "0.6", "how much of that hangs on where they face (calm)"),
    moved("style.gooch.blue", Number(0.0, 1.0), "", "0.4", "of what the light does not reach (gooch)"),
    moved("style.gooch.yellow", Number(0.0, 1.0), "", "0.3", "of what it reaches (gooch)"),
    moved("style.gooch.of_cool", Number(0.0, 1.0), "", "0.25", "share of the own colour in cool (gooch)"),
    moved("style.gooch.of_warm", Number(0.0, 1.0), "", "0.55", "share of the own colour in warm (gooch)"),
    moved("style.hatch.width", WIDTH, MIL, "1", "width of the lines on caps; 0 for none"),
    moved("style.hatch.alpha", Number(0.0, 1.0), "", "0.6", "how much of the ink they have"),
    fixed("style.hatch.color", Color, "", "\"#9cc4ff\"", "their colour, in the place of ink"),
    moved("style.hatch.angle_deg", REAL, "degrees", "45", "their direction on the first of parts that touch"),
    moved("style.hatch.per_thickness", Number(0.0, 10.0), "", "0.2", "distance from line to line over the mean thickness of the part"),
    moved("style.hatch.least", Number(0.1, 1000.0), MIL, "5.2", "the least such distance"),
    moved("style.hatch.most", Number(0.1, 1000.0), MIL, "9.5", "the greatest"),
    moved("style.hatch.solid_below", Number(0.0, 1000.0), MIL, "2.9", "parts that are thinner on the mean are filled"),
    fixed("style.hatch.anchor", Choice(&["part", "cut"]), "", "\"cut\"", "what lines are held to: parts that move as a whole carry them, or cuts do"),
    fixed("style.hatch.zoom", Choice(&["fixed", "banded"]), "", "\"banded\"", "whether lines stay as the camera comes nearer, or are doubled and halved"),
    fixed("style.occlusion.kind", Choice(&["none", "horizon", "unsharp"]), "", "\"horizon\"", "how it is found what little of the sky sees"),
    moved("style.occlusion.radius_percent", Number(0.0, 100.0), "percent", "5", "how far away something may be that hides the sky, of the diagonal of the scene (horizon)"),
    moved("style.occlusion.slices", Whole(1.0, 32.0), "", "3", "how many planes are searched for horizons (horizon)"),
    moved("style.occlusion.steps", Whole(1.0, 64.0), "", "6", "samples to each side of such a plane (horizon)"),
    moved("style.occlusion.blur_percent", Number(0.0, 10.0), "percent", "2", "standard deviation of the blur, of the diagonal of the picture (unsharp)"),
    moved("style.occlusion.strength", Number(0.0, 100.0), "", "6", "how much darker what lies deeper is (unsharp)"),
    moved("style.occlusion.surface", Number(0.0, 1.0), "", "0.7", "how much of it surfaces have"),
    moved("style.occlusion.cap", Number(0.0, 1.0), "", "0.35", "how much of it caps have"),
    moved("style.occlusion.relief", Number(0.0, 1.0), "", "0.5", "how much caps have of what their own relief hides of the sky"),
    fixed("style.ghost.kind", Choice(&["none", "lines", "glass", "both"]), "", "\"lines\"", "what is drawn of what cuts remove"),
    moved("style.ghost.width", WIDTH, MIL, "1.2", "width of phantom lines"),
    moved("style.ghost.alpha", Number(0.0, 1.0), "", "0.85", "how much of the colour they have"),
    moved("style.ghost.glass", Number(0.0, 1.0), "", "1", "how much glass is seen"),
    moved("style.shadow.strength", Number(0.0, 1.0), "", "0.35", "how dark the shadow on the ground is; 0 for none"),
    moved("style.shadow.spread_deg", Number(0.0, 70.0), "degrees", "25", "how far from straight above light comes, which makes it soft"),
    fixed("style.ghost.color", Color, "", "\"#5b6f88\"", "of lines and glass, in the place of ink"),
    moved("style.engraving.spacing", Number(1.0, 1000.0), MIL, "6.7", "about the distance from line to line on surfaces (engraved)"),
    moved("style.engraving.across", Numbers(3), "", "[1, 0.25, 0.1]", "across the lines, in the world"),
    moved("style.engraving.across_dark", Numbers(3), "", "[0.2, 1, 0.5]", "across those that only dark tones have"),
    moved("style.strokes.outline", WIDTH, MIL, "2.1", "width of strokes around the model; 0 for none"),
    moved("style.strokes.cut", WIDTH, MIL, "2.1", "where caps end"),
    moved("style.strokes.part", WIDTH, MIL, "1.5", "between parts"),
    moved("style.strokes.face", WIDTH, MIL, "1.3", "between caps of one part by two clip-surfaces"),
    moved("style.strokes.contour", WIDTH, MIL, "1.3", "where a part hides more of itself"),
    moved("style.strokes.crease", WIDTH, MIL, "1", "where a surface is folded"),
    moved("style.strokes.crease_deg", Number(1.0, 180.0), "degrees", "30", "the least fold that is a crease"),
    moved("style.strokes.depth_px", Number(0.0, 1e6), "px", "8", "the least jump in depth that is a contour, in widths of a pixel"),

    moved("camera.azimuth_deg", REAL, "degrees", "35", "turn around the up axis; or \"auto\", to where the cuts are seen"),
    moved("camera.elevation_deg", REAL, "degrees", "25", "height above the horizon; or \"auto\""),
    fixed("camera.view", Choice(&["front", "back", "left", "right", "top", "bottom", "iso", "cut"]), "", "\"iso\"", "a direction, in the place of angles; cut looks straight at the first section"),
    moved("camera.position", Numbers(3), "units", "[0, 0, 5]", "where the eye is, in the place of angles"),
    moved("camera.focal_point", Numbers(3), "units", "[0, 0, 0]", "what the eye looks at; without it the middle of the model"),
    moved("camera.view_up", Numbers(3), "", "[0, 1, 0]", "direction that is up in the picture"),
    fixed("camera.up", Choice(&["+Y", "+Z"]), "", "\"+Z\"", "which axis is up"),
    fixed("camera.projection", Choice(&["perspective", "orthographic"]), "", "\"orthographic\"", "how depth narrows the picture"),
    moved("camera.fov_y_deg", Number(0.0, 170.0), "degrees", "30", "between the lower and the upper border, in perspective"),
    moved("camera.height", SIZE, "units", "3", "height of an orthographic picture; without it what shows everything"),
    fixed("camera.fit", Choice(&["kept", "all"]), "", "\"kept\"", "what angles are fitted to: the silhouette of what the cuts keep, or the box of all"),
    moved("camera.zoom", Number(1e-3, 1e3), "", "1.5", "how much larger than fitted it is shown"),
    moved("camera.pan", Numbers(2), "heights", "[0.1, 0]", "how far the model is moved in the picture, right and up"),
    moved("camera.near", SIZE, "units", "0.5", "distance of the near plane"),
    moved("camera.near_cap", Flag, "", "false", "whether a cap shows where the near plane cuts a solid"),

    fixed("part.*.name", Text, "", "\"crank\"", "what paths and globs call it"),
    moved("part.*.enabled", Flag, "", "true", "whether it is there: without it the scene is as if it had no such part"),
    fixed("part.*.mesh", File, "", "\"crank.obj\"", "a mesh, or numbered frames: \"walk_%04d.ply\""),
    fixed("part.*.shape", Text, "", "\"crank?throws=3\"", "a built-in shape; or a table of its name and its numbers"),
    fixed("part.*.split", Flag, "", "true", "whether connected bodies are parts of their own: NAME/1, NAME/2, ..."),
    fixed("part.*.close_holes", Flag, "", "true", "whether planar and small holes of its mesh are closed"),
    fixed("part.*.only", Texts, "", "[\"gear*\"]", "solids of the file that are taken, by globs; bodies, where it is split"),
    fixed("part.*.except", Texts, "", "[\"bolt*\"]", "solids or bodies that are left out"),
    fixed("part.*.fps", SIZE, "1/s", "24", "frames a second"),
    fixed("part.*.first", Whole(0.0, ANY), "", "1", "number of the first frame"),
    fixed("part.*.loop", Flag, "", "false", "whether frames begin anew"),
    moved("part.*.translate", Numbers(3), "units", "[0, 0, 1]", "how far it is moved, last"),
    moved("part.*.rotate_deg", Numbers(3), "degrees", "[0, 90, 0]", "how it is turned about x, then y, then z"),
    moved("part.*.scale", OneOrMore(3), "", "0.5", "how it is scaled, first"),
    moved("part.*.pivot", Numbers(3), "units", "[0, 0, 0]", "about which it is scaled and turned; or \"centre\""),
    moved("part.*.matrix", Other, "", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]", "4 rows of 4 numbers, in the place of the above"),
    fixed("part.*.role", Choice(&["exterior", "interior", "whole"]), "", "\"interior\"", "interior parts are never cut, whole ones neither, but hidden where all of them is removed"),
    moved("part.*.priority", Whole(-ANY, ANY), "", "1", "which part is shown where solids share a point: the higher"),
    fixed("part.*.fill", Choice(&["even-odd", "nonzero"]), "", "\"nonzero\"", "which points the mesh encloses"),
    fixed("part.*.material.color", Color, "", "\"#8a94a6\"", "colour of the mesh"),
    fixed("part.*.material.cap_color", Color, "", "\"#d9773f\"", "colour of its caps"),
    fixed("part.*.material.hatch", Text, "", "\"steel\"", "hatch of its caps: general, none, solid, a material, or a pattern of a file, mine.pat#NAME"),
    fixed("part.*.material.cap.diffuse", File, "", "\"rust.png\"", "image of the colours of its caps, in the (u, v) of the clip-surface"),
    fixed("part.*.material.cap.normal", File, "", "\"grain.png\"", "image of normals, which add to those of a relief"),
    fixed("part.*.material.cap.light", File, "", "\"soft.png\"", "image of the light that reaches it"),
    fixed("part.*.material.cap.solid", Choice(&["wood", "marble", "granite"]), "", "\"marble\"", "what it is made of all through"),
    fixed("part.*.material.cap.images", File, "", "\"slices/%03d.png\"", "numbered images one behind the other, which fill the box of the part, in the place of `solid`"),
    fixed("part.*.material.cap.size", Amount, "units", "\"10%\"", "length of a repeat; without it images lie on the relief as they are"),
    fixed("part.*.defects.*.kind", Choice(&["holes", "flipped", "duplicated", "t-junctions", "gaps", "overlap", "open", "soup"]), "", "\"holes\"", "how the mesh is broken on purpose"),
    fixed("part.*.defects.*.amount", Amount, "", "\"5%\"", "how much of it"),
    fixed("part.*.defects.*.seed", Whole(0.0, ANY), "", "1", "which faces"),
    fixed("part.*.defects.*.patch", Whole(1.0, 100_000.0), "", "12", "faces that go together (holes, flipped, duplicated)"),
    fixed("part.*.defects.*.charts", Whole(1.0, 100_000.0), "", "8", "pieces (gaps)"),
    fixed("part.*.defects.*.copies", Whole(1.0, 100_000.0), "", "8", "small copies (overlap)"),
    fixed("part.*.defects.*.axis", Choice(&["x", "y", "z", "-x", "-y", "-z"]), "", "\"-z\"", "side that is missing (open)"),
    fixed("part.*.deform.*.kind", Choice(&["twist", "bend", "wave", "inflate"]), "", "\"twist\"", "what bends it"),
    moved("part.*.deform.*.axis", Numbers(3), "", "[0, 1, 0]", "along which; or \"x\" to \"-z\""),
    moved("part.*.deform.*.centre", Numbers(3), "units", "[0, 0, 0]", "a point of the axis"),
    moved("part.*.deform.*.across", Numbers(3), "", "[1, 0, 0]", "towards which it rolls or waves; or \"x\" to \"-z\""),
    moved("part.*.deform.*.turn_deg", REAL, "degrees", "90", "from one end to the other (twist, bend)"),
    moved("part.*.deform.*.amplitude", Amount, "units", "\"2%\"", "height of a wave"),
    moved("part.*.deform.*.period", Amount, "units", "\"25%\"", "length of a wave"),
    moved("part.*.deform.*.phase_deg", REAL, "degrees", "90", "where a wave begins"),
    moved("part.*.deform.*.by", Amount, "units", "\"2%\"", "how far the surface goes out (inflate)"),

    fixed("roles.auto", Flag, "", "true", "whether parts are interior that are not seen from outside; alone: roles = \"auto\""),
    fixed("roles.interior", Texts, "", "[\"*core*\"]", "parts that are never cut, by globs"),
    fixed("roles.exterior", Texts, "", "[\"housing*\"]", "parts that are cut"),
    fixed("roles.whole", Texts, "", "[\"bolt*\", \"shaft*\"]", "parts that are never cut, but hidden where all of them is removed"),

    fixed("relief.*.kind", Choice(&["sawtooth", "waves", "fractal", "cracks", "steps", "constant", "image", "blend", "profile", "layers"]), "", "\"fractal\"", "where heights come from"),
    moved("relief.*.size", OneOrMore(2), "texels", "[256, 256]", "size of a computed map"),
    moved("relief.*.seed", Whole(0.0, 9e15), "", "7", "which of many patterns (fractal, cracks)"),
    moved("relief.*.count", OneOrMore(2), "", "[3, 3]", "waves along both directions (waves)"),
    moved("relief.*.cells", Whole(1.0, 4096.0), "", "4", "cells along the longer side (fractal, cracks)"),
    moved("relief.*.octaves", Whole(1.0, 16.0), "", "5", "octaves (fractal)"),
    moved("relief.*.gain", Number(0.0, 1.0), "", "0.5", "height of an octave over that of the coarser one (fractal)"),
    moved("relief.*.width", Number(1e-3, 1.0), "cells", "0.12", "half width of a groove (cracks)"),
    moved("relief.*.levels", Whole(2.0, 4096.0), "", "5", "heights in each direction (steps)"),
    moved("relief.*.value", Number(0.0, 1.0), "", "0.5", "the height (constant)"),
    fixed("relief.*.image", File, "", "\"rock.png\"", "an image of heights"),
    fixed("relief.*.blend", Texts, "", "[\"a\", \"b\"]", "names of reliefs that make one, each onto those before it"),
    fixed("relief.*.op", Choice(&["add", "mix", "max", "min", "multiply", "screen", "overlay", "difference"]), "", "\"add\"", "how they make one (blend)"),
    moved("relief.*.share", Number(0.0, 1.0), "", "0.5", "of each that goes onto those before it (blend, mix)"),
    moved("relief.*.heights", Other, "", "[0, 0.2, 1]", "numbers in a row along U (profile)"),
    fixed("relief.*.of", Texts, "", "[\"a\", \"b\"]", "names of reliefs that are layers (layers)"),
    fixed("relief.*.images", File, "", "\"frames/%03d.png\"", "numbered images that are layers (layers)"),
    fixed("relief.*.first", Whole(0.0, ANY), "", "1", "number of the first image (layers)"),
    moved("relief.*.at", REAL, "", "0.5", "the place between layers: layer 0 is at 0 (layers)"),
    fixed("relief.*.wrap", WRAP, "", "\"repeat\"", "how layers go on beyond the last (layers)"),

    fixed("cut.*.name", Text, "", "\"front\"", "what paths call it"),
    moved("cut.*.enabled", Flag, "", "true", "whether anything is removed"),
    fixed("cut.*.applies_to", Texts, "", "[\"*\"]", "parts that are cut, by globs"),
    fixed("cut.*.except", Texts, "", "[\"bolt*\"]", "parts that are spared"),
    moved("cut.*.offset.*", Amount, "units", "\"5%\"", "so much more of a part is kept, by its name or a glob"),
    fixed("cut.*.surfaces.*.section", Text, "", "\"z=50%\"", "a plane whose normal points to the side that stays"),
    moved("cut.*.surfaces.*.normal", Numbers(3), "", "[0, 0, 1]", "the normal of a plane, in the place of a section"),
    moved("cut.*.surfaces.*.origin", Numbers(3), "units", "[0, 0, 0]", "a point of it"),
    moved("cut.*.surfaces.*.spin_deg", REAL, "degrees", "30", "so far a plane is turned in itself, and its relief with it: U towards V"),
    moved("cut.*.surfaces.*.u", Numbers(3), "units", "[1, 0, 0]", "the paper's own form: U"),
    moved("cut.*.surfaces.*.v", Numbers(3), "units", "[0, 1, 0]", "V; the side of U x V stays"),
    moved("cut.*.surfaces.*.scale", Numbers(3), "", "[4, 4, 0.1]", "repeats along U and V, and height"),
    fixed("cut.*.surfaces.*.relief", Text, "", "\"ragged\"", "name of a relief"),
    moved("cut.*.surfaces.*.amplitude", Amount, "units", "\"6%\"", "from the lowest to the highest point of a relief"),
    moved("cut.*.surfaces.*.period", Amount, "units", "\"40%\"", "length of one repeat of a relief"),
    fixed("cut.*.surfaces.*.wrap", WRAP, "", "\"mirror\"", "how a relief goes on"),
    moved("cut.*.surfaces.*.flip", Flag, "", "true", "keeps the other side"),
    moved("cut.*.box.min", Amounts, "units", "[\"50%\", 0, 0]", "least corner; without it the box is open there"),
    moved("cut.*.box.max", Amounts, "units", "[\"100%\", 1, 1]", "greatest corner"),
    moved("cut.*.box.centre", Amounts, "units", "[0, 0, 0]", "the middle, in the place of corners"),
    moved("cut.*.box.size", OneOrMore(3), "units", "0.5", "length of its sides"),
    fixed("cut.*.box.relief", Text, "", "\"ragged\"", "name of the relief of its faces"),
    moved("cut.*.box.amplitude", Amount, "units", "\"6%\"", "as of a surface"),
    moved("cut.*.box.period", Amount, "units", "\"40%\"", "as of a surface"),
    fixed("cut.*.box.wrap", WRAP, "", "\"mirror\"", "as of a surface"),
    fixed("cut.*.box.faces", Texts, "", "[\"+z\"]", "which faces have the relief: -x to +z"),
    moved("cut.*.wedge.axis", Numbers(3), "", "[0, 0, 1]", "about which; or \"x\" to \"-z\""),
    moved("cut.*.wedge.origin", Amounts, "units", "[\"50%\", \"50%\", 0]", "a point of the axis; without it the middle"),
    moved("cut.*.wedge.from_deg", REAL, "degrees", "0", "where it begins, counter-clockwise from the next axis"),
    moved("cut.*.wedge.to_deg", REAL, "degrees", "90", "where it ends: at most 360 more"),
    moved("cut.*.wedge.min", Amount, "units", "\"10%\"", "least coordinate along the axis"),
    moved("cut.*.wedge.max", Amount, "units", "\"90%\"", "greatest coordinate along the axis"),
    fixed("cut.*.wedge.relief", Text, "", "\"ragged\"", "name of the relief of its faces"),
    moved("cut.*.wedge.amplitude", Amount, "units", "\"6%\"", "as of a surface"),
    moved("cut.*.wedge.period", Amount, "units", "\"40%\"", "as of a surface"),
    fixed("cut.*.wedge.wrap", WRAP, "", "\"mirror\"", "as of a surface"),
    fixed("cut.*.wedge.faces", Texts, "", "[\"from\"]", "which faces have the relief: from, to, min, max"),
    fixed("cut.*.cutout.axis", Other, "", "\"auto\"", "what it goes along: \"auto\", \"main\", \"symmetry\", \"x\" to \"-z\", or a direction"),
    moved("cut.*.cutout.angle_deg", Number(0.0, 359.0), "degrees", "110", "between its two faces"),
    moved("cut.*.cutout.turn_deg", REAL, "degrees", "0", "how far it is turned away from the camera of the first moment, or with `fixed` from the second axis"),
    moved("cut.*.cutout.fixed", Flag, "", "true", "whether it lies where it does whatever the camera"),
    moved("cut.*.cutout.offset", Numbers(2), "units", "[0, 0]", "how far it is moved along the second and the third axis"),
    fixed("cut.*.cutout.relief", Text, "", "\"ragged\"", "name of the relief of its faces"),
    moved("cut.*.cutout.amplitude", Amount, "units", "\"6%\"", "as of a surface"),
    moved("cut.*.cutout.period", Amount, "units", "\"40%\"", "as of a surface"),
    fixed("cut.*.cutout.wrap", WRAP, "", "\"mirror\"", "as of a surface"),
    fixed("cut.*.cutout.faces", Texts, "", "[\"from\"]", "which faces have the relief: from, to"),
    moved("cut.*.breakaway.distance", Amount, "units", "\"1%\"", "how far the opening stays away from what is inside"),
    moved("cut.*.breakaway.bevel_deg", Number(0.0, 60.0), "degrees", "12", "how much wider than the rays of sight it opens"),
    fixed("cut.*.breakaway.clusters", Choice(&["auto", "one"]), "", "\"one\"", "whether what lies apart has openings of its own"),
    fixed("cut.*.breakaway.view", Choice(&["each", "first"]), "", "\"first\"", "whether it follows the camera, or opens to that of the first moment"),
    fixed("cut.*.volume", File, "", "\"shape:sphere\"", "a closed mesh that cuts: a file, or a shape"),
    moved("cut.*.translate", Numbers(3), "units", "[0, 0, 1]", "places the volume, as a part"),
    moved("cut.*.rotate_deg", Numbers(3), "degrees", "[0, 90, 0]", "places the volume, as a part"),
    moved("cut.*.scale", OneOrMore(3), "", "0.5", "places the volume, as a part"),
    moved("cut.*.pivot", Numbers(3), "units", "[0, 0, 0]", "places the volume, as a part"),
    moved("cut.*.matrix", Other, "", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]", "places the volume, as a part"),
    moved("cut.*.flip", Flag, "", "true", "removes what is outside the volume"),

    fixed("key.*.target", Text, "", "\"camera.azimuth_deg\"", "path of what moves"),
    fixed("key.*.times_s", Other, "s", "[0, 2]", "when, ascending"),
    fixed("key.*.values", Other, "", "[0, 360]", "its value at each time"),
    fixed("key.*.interpolation", Choice(&["linear", "step", "smooth"]), "", "\"smooth\"", "what lies between"),
];

/// Keys directly below a path, looked up once: those of `part.*` are `name`, `mesh` and so on.
pub(crate) struct Keys {
    above: &'static str,
    found: OnceLock<Vec<&'static str>>,
}

impl Keys {
    /// Those below a path; of the empty one those of the file.
    pub(crate) const fn below(above: &'static str) -> Self {
        Self {
            above,
            found: OnceLock::new(),
        }
    }

    /// All of them, in the order of [`PATHS`].
    pub(crate) fn all(&self) -> &[&'static str] {
        self.found.get_or_init(|| keys_below(self.above))
    }
}

/// Keys directly below a path.
pub(crate) fn keys_below(above: &str) -> Vec<&'static str> {
    let mut keys: Vec<&str> = Vec::new();
    for path in PATHS {
        let below = match above {
            "" => Some(path.path),
            above => (path.path.strip_prefix(above)).and_then(|rest| rest.strip_prefix('.')),
        };
        let Some(key) = below.and_then(|below| below.split('.').next()) else {
            continue;
        };
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}
