//! Schema of a scene: every path, with its value type. `cutaway help scene` prints the list, and readers refuse any other path.
//!
//! A `*` stands for the name of an entry or its number: `part.*.translate` is `part.crank.translate` or `part.0.translate`.

use std::fmt;
use std::sync::OnceLock;

/// A value of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Dotted path.
    pub path: &'static str,
    /// Type of its value.
    pub takes: ValueType,
    /// Unit of its numbers; empty where they have none.
    pub unit: &'static str,
    /// Description in one line.
    pub help: &'static str,
    /// A value that it takes, as TOML.
    pub example: &'static str,
    /// True if a `[[key]]` can animate it, provided that it is a number or a flag.
    pub moves: bool,
}

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueType {
    /// A number between two others.
    Number(f64, f64),
    /// A whole number between two others.
    Whole(f64, f64),
    /// A list of this count of numbers.
    Numbers(usize),
    /// A number, or text with a percentage: `"5%"`.
    Amount,
    /// A list of three such.
    Amounts,
    /// One number, or one for each of this count of directions.
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
    /// Described in the help.
    Other,
}

impl fmt::Display for ValueType {
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

use ValueType::{
    Amount, Amounts, Choice, Color, File, Flag, Number, Numbers, OneOrMore, Other, Text, Texts,
    Whole,
};

const ANY: f64 = f64::INFINITY;
/// A number of any size.
const REAL: ValueType = Number(-ANY, ANY);
/// A number that is not negative.
const SIZE: ValueType = Number(0.0, ANY);
const WRAP: ValueType = Choice(&["repeat", "mirror", "clamp"]);

/// Width of a stroke.
const WIDTH: ValueType = Number(0.0, 20.0);
/// Unit of the lengths of a style.
const MIL: &str = "1/1000 of the height";

/// A value that keys move, or that is no number.
const fn moved(
    path: &'static str,
    takes: ValueType,
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
    takes: ValueType,
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
    fixed("background", Color, "", "\"#ffffff\"", "background of the picture; or \"paper\", \"gradient\", \"transparent\""),
    fixed("interference", Color, "", "\"#ff00aa\"", "hatches caps where several solids overlap"),
    fixed("height_filter", Choice(&["exact", "hardware"]), "", "\"exact\"", "height-map filter for point samples"),
    fixed("supersample", Whole(1.0, 4.0), "", "2", "samples per pixel along each side"),
    fixed("time_s", SIZE, "s", "0.5", "time of the picture"),
    fixed("clip", Text, "", "\"walk\"", "animation to play, by name or number"),
    fixed("strategy.name", Text, "", "\"auto\"", "capping strategy; `cutaway render --help` lists them"),
    fixed("strategy.rasteriser", Choice(&["hardware", "compute"]), "", "\"compute\"", "rasteriser of the meshes"),

    fixed("style.base", Text, "", "\"technical\"", "name or file of the style that the other keys change; alone: style = \"technical\""),
    fixed("style.paper", Color, "", "\"#ffffff\"", "background colour of the style; or \"gradient\", \"transparent\""),
    fixed("style.ink", Color, "", "\"#20262e\"", "line colour"),
    fixed("style.shading", Choice(&["lit", "calm", "flat", "gooch", "toon", "clay", "engraved"]), "", "\"calm\"", "shading model"),
    fixed("style.surface.color", Color, "", "\"#d8d4cc\"", "one colour for the surfaces of all parts"),
    moved("style.surface.coat", Flag, "", "true", "draws vertex colours and textures from files instead of part colours"),
    moved("style.surface.lightness", Number(0.0, 1.0), "", "0.8", "OKLab lightness of surfaces; hues stay those of the parts"),
    moved("style.surface.chroma", Number(0.0, 0.4), "", "0.024", "largest OKLab chroma of surfaces"),
    moved("style.surface.warmth", Numbers(2), "", "[0, 0]", "offset added to OKLab a and b of surfaces"),
    fixed("style.cap.color", Color, "", "\"#e8552d\"", "one colour for the caps of all parts"),
    moved("style.cap.lightness", Number(0.0, 1.0), "", "0.955", "OKLab lightness of caps"),
    moved("style.cap.chroma", Number(0.0, 0.4), "", "0.014", "largest OKLab chroma of caps"),
    moved("style.cap.warmth", Numbers(2), "", "[0.003, 0.022]", "offset added to OKLab a and b of caps"),
    moved("style.cap.light", Number(0.0, 1.0), "", "1", "share of the light that caps receive (calm)"),
    moved("style.cap.relief", Number(0.0, 1.0), "", "0.6", "share of cap shading that depends on the normal (calm)"),
    moved("style.gooch.blue", Number(0.0, 1.0), "", "0.4", "amount of blue in the cool tone (gooch)"),
    moved("style.gooch.yellow", Number(0.0, 1.0), "", "0.3", "amount of yellow in the warm tone (gooch)"),
    moved("style.gooch.of_cool", Number(0.0, 1.0), "", "0.25", "base-colour weight in the cool tone (Gooch alpha)"),
    moved("style.gooch.of_warm", Number(0.0, 1.0), "", "0.55", "base-colour weight in the warm tone (Gooch beta)"),
    moved("style.hatch.width", WIDTH, MIL, "1", "width of hatch lines on caps; 0 for none"),
    moved("style.hatch.alpha", Number(0.0, 1.0), "", "0.6", "opacity of hatch lines"),
    fixed("style.hatch.color", Color, "", "\"#9cc4ff\"", "colour of hatch lines, instead of the line colour"),
    moved("style.hatch.angle_deg", REAL, "degrees", "45", "line direction on the first of a group of touching parts"),
    moved("style.hatch.per_thickness", Number(0.0, 10.0), "", "0.2", "line spacing as a multiple of the mean thickness of the part"),
    moved("style.hatch.least", Number(0.1, 1000.0), MIL, "5.2", "smallest line spacing"),
    moved("style.hatch.most", Number(0.1, 1000.0), MIL, "9.5", "largest line spacing"),
    moved("style.hatch.solid_below", Number(0.0, 1000.0), MIL, "2.9", "parts with a smaller mean thickness are filled instead of hatched"),
    fixed("style.hatch.anchor", Choice(&["part", "cut"]), "", "\"cut\"", "frame that lines are fixed to: the part that moves, or the cut"),
    fixed("style.hatch.zoom", Choice(&["fixed", "banded"]), "", "\"banded\"", "keeps lines when the camera comes closer, or doubles and halves their number"),
    fixed("style.occlusion.kind", Choice(&["none", "horizon", "unsharp"]), "", "\"horizon\"", "ambient-occlusion method"),
    moved("style.occlusion.radius_percent", Number(0.0, 100.0), "percent", "5", "largest distance of an occluder, in percent of the scene's diagonal (horizon)"),
    moved("style.occlusion.slices", Whole(1.0, 32.0), "", "3", "planes searched for horizons per pixel (horizon)"),
    moved("style.occlusion.steps", Whole(1.0, 64.0), "", "6", "samples on each side of a plane (horizon)"),
    moved("style.occlusion.blur_percent", Number(0.0, 10.0), "percent", "2", "standard deviation of the blur, in percent of the picture's diagonal (unsharp)"),
    moved("style.occlusion.strength", Number(0.0, 100.0), "", "6", "darkening of deeper pixels (unsharp)"),
    moved("style.occlusion.surface", Number(0.0, 1.0), "", "0.7", "weight of occlusion on surfaces"),
    moved("style.occlusion.cap", Number(0.0, 1.0), "", "0.35", "weight of occlusion on caps"),
    moved("style.occlusion.relief", Number(0.0, 1.0), "", "0.5", "weight of a cap's occlusion by its own relief"),
    fixed("style.ghost.kind", Choice(&["none", "lines", "glass", "both"]), "", "\"lines\"", "drawing of removed geometry"),
    moved("style.ghost.width", WIDTH, MIL, "1.2", "width of phantom lines"),
    moved("style.ghost.alpha", Number(0.0, 1.0), "", "0.85", "opacity of phantom lines"),
    moved("style.ghost.glass", Number(0.0, 1.0), "", "1", "opacity of glass"),
    moved("style.shadow.strength", Number(0.0, 1.0), "", "0.35", "darkness of the ground shadow; 0 for none"),
    moved("style.shadow.spread_deg", Number(0.0, 70.0), "degrees", "25", "angular radius of the light around the zenith; a larger one makes softer shadows"),
    fixed("style.ghost.color", Color, "", "\"#5b6f88\"", "colour of phantom lines and glass, instead of the line colour"),
    moved("style.engraving.spacing", Number(1.0, 1000.0), MIL, "6.7", "approximate distance between lines on surfaces (engraved)"),
    moved("style.engraving.across", Numbers(3), "", "[1, 0.25, 0.1]", "direction across the lines, in the world"),
    moved("style.engraving.across_dark", Numbers(3), "", "[0.2, 1, 0.5]", "direction across the second set of lines, drawn in dark tones only"),
    moved("style.strokes.outline", WIDTH, MIL, "2.1", "width of strokes around the model; 0 for none"),
    moved("style.strokes.cut", WIDTH, MIL, "2.1", "width of strokes around caps"),
    moved("style.strokes.part", WIDTH, MIL, "1.5", "width of strokes between parts"),
    moved("style.strokes.face", WIDTH, MIL, "1.3", "width of strokes between caps of one part by two clip-surfaces"),
    moved("style.strokes.contour", WIDTH, MIL, "1.3", "width of strokes where a part occludes itself"),
    moved("style.strokes.crease", WIDTH, MIL, "1", "width of strokes along creases"),
    moved("style.strokes.crease_deg", Number(1.0, 180.0), "degrees", "30", "smallest dihedral angle of a crease"),
    moved("style.strokes.depth_px", Number(0.0, 1e6), "px", "8", "smallest depth step of a contour, in pixel widths"),

    moved("camera.azimuth_deg", REAL, "degrees", "35", "rotation around the up axis; or \"auto\", facing the cuts"),
    moved("camera.elevation_deg", REAL, "degrees", "25", "angle above the horizon; or \"auto\""),
    fixed("camera.view", Choice(&["front", "back", "left", "right", "top", "bottom", "iso", "cut"]), "", "\"iso\"", "named direction, instead of angles; `cut` faces the first section"),
    moved("camera.position", Numbers(3), "units", "[0, 0, 5]", "position of the eye, instead of angles"),
    moved("camera.focal_point", Numbers(3), "units", "[0, 0, 0]", "point in the middle of the picture; default: the middle of the model"),
    moved("camera.view_up", Numbers(3), "", "[0, 1, 0]", "direction that points up in the picture"),
    fixed("camera.up", Choice(&["+Y", "+Z"]), "", "\"+Z\"", "up axis of the world"),
    fixed("camera.projection", Choice(&["perspective", "orthographic"]), "", "\"orthographic\"", "perspective or orthographic"),
    moved("camera.fov_y_deg", Number(0.0, 170.0), "degrees", "30", "vertical field of view, in perspective"),
    moved("camera.height", SIZE, "units", "3", "height of an orthographic picture; default: fits the model"),
    fixed("camera.fit", Choice(&["kept", "all"]), "", "\"kept\"", "framing of an orbit: the silhouette of what the cuts keep, or the box of the whole model"),
    moved("camera.zoom", Number(1e-3, 1e3), "", "1.5", "magnification relative to the fitted view"),
    moved("camera.pan", Numbers(2), "heights", "[0.1, 0]", "offset of the model in the picture, right and up"),
    moved("camera.near", SIZE, "units", "0.5", "distance of the near plane"),
    moved("camera.near_cap", Flag, "", "false", "draws a cap where the near plane cuts a solid"),

    fixed("part.*.name", Text, "", "\"crank\"", "name in paths and globs"),
    moved("part.*.enabled", Flag, "", "true", "includes the part in the scene"),
    fixed("part.*.mesh", File, "", "\"crank.obj\"", "mesh file, or numbered frames: \"walk_%04d.ply\""),
    fixed("part.*.shape", Text, "", "\"crank?throws=3\"", "built-in shape; or a table of its name and parameters"),
    fixed("part.*.split", Flag, "", "true", "makes each connected body a part: NAME/1, NAME/2, ..."),
    fixed("part.*.close_holes", Flag, "", "true", "closes planar and small holes of the mesh"),
    fixed("part.*.only", Texts, "", "[\"gear*\"]", "globs of the solids to take from the file; of bodies, with `split`"),
    fixed("part.*.except", Texts, "", "[\"bolt*\"]", "globs of the solids or bodies to leave out"),
    fixed("part.*.fps", SIZE, "1/s", "24", "frames per second"),
    fixed("part.*.first", Whole(0.0, ANY), "", "1", "number of the first frame"),
    fixed("part.*.loop", Flag, "", "false", "repeats the frames"),
    moved("part.*.translate", Numbers(3), "units", "[0, 0, 1]", "translation, applied last"),
    moved("part.*.rotate_deg", Numbers(3), "degrees", "[0, 90, 0]", "rotation about x, then y, then z"),
    moved("part.*.scale", OneOrMore(3), "", "0.5", "scale, applied first"),
    moved("part.*.pivot", Numbers(3), "units", "[0, 0, 0]", "fixed point of scale and rotation; or \"centre\""),
    moved("part.*.matrix", Other, "", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]", "4 rows of 4 numbers, instead of the keys above"),
    fixed("part.*.role", Choice(&["exterior", "interior", "whole"]), "", "\"interior\"", "interior parts are never cut; whole parts neither, but are hidden where they are removed entirely"),
    moved("part.*.priority", Whole(-ANY, ANY), "", "1", "the part with the higher priority is shown where solids overlap"),
    fixed("part.*.fill", Choice(&["even-odd", "nonzero"]), "", "\"nonzero\"", "fill rule of the mesh"),
    fixed("part.*.material.color", Color, "", "\"#8a94a6\"", "colour of the surface"),
    fixed("part.*.material.cap_color", Color, "", "\"#d9773f\"", "colour of caps"),
    fixed("part.*.material.hatch", Text, "", "\"steel\"", "hatch of caps: general, none, solid, a material, or a pattern of a file, mine.pat#NAME"),
    fixed("part.*.material.cap.diffuse", File, "", "\"rust.png\"", "colour texture of caps, in the (u, v) of the clip-surface"),
    fixed("part.*.material.cap.normal", File, "", "\"grain.png\"", "normal map of caps, added to the relief"),
    fixed("part.*.material.cap.light", File, "", "\"soft.png\"", "light map of caps"),
    fixed("part.*.material.cap.solid", Choice(&["wood", "marble", "granite"]), "", "\"marble\"", "solid texture"),
    fixed("part.*.material.cap.images", File, "", "\"slices/%03d.png\"", "numbered slices that fill the part's box, instead of `solid`"),
    fixed("part.*.material.cap.size", Amount, "units", "\"10%\"", "length of one repeat; default: images are placed as the relief is"),
    fixed("part.*.defects.*.kind", Choice(&["holes", "flipped", "duplicated", "t-junctions", "gaps", "overlap", "open", "soup"]), "", "\"holes\"", "kind of deliberate mesh damage"),
    fixed("part.*.defects.*.amount", Amount, "", "\"5%\"", "amount of damage"),
    fixed("part.*.defects.*.seed", Whole(0.0, ANY), "", "1", "seed for the choice of faces"),
    fixed("part.*.defects.*.patch", Whole(1.0, 100_000.0), "", "12", "adjacent faces per patch (holes, flipped, duplicated)"),
    fixed("part.*.defects.*.charts", Whole(1.0, 100_000.0), "", "8", "number of pieces (gaps)"),
    fixed("part.*.defects.*.copies", Whole(1.0, 100_000.0), "", "8", "number of small copies (overlap)"),
    fixed("part.*.defects.*.axis", Choice(&["x", "y", "z", "-x", "-y", "-z"]), "", "\"-z\"", "side to remove (open)"),
    fixed("part.*.deform.*.kind", Choice(&["twist", "bend", "wave", "inflate"]), "", "\"twist\"", "kind of deformation"),
    moved("part.*.deform.*.axis", Numbers(3), "", "[0, 1, 0]", "axis of the deformation; or \"x\" to \"-z\""),
    moved("part.*.deform.*.centre", Numbers(3), "units", "[0, 0, 0]", "point on the axis"),
    moved("part.*.deform.*.across", Numbers(3), "", "[1, 0, 0]", "direction to bend or wave towards; or \"x\" to \"-z\""),
    moved("part.*.deform.*.turn_deg", REAL, "degrees", "90", "angle from one end to the other (twist, bend)"),
    moved("part.*.deform.*.amplitude", Amount, "units", "\"2%\"", "amplitude of the wave"),
    moved("part.*.deform.*.period", Amount, "units", "\"25%\"", "wavelength"),
    moved("part.*.deform.*.phase_deg", REAL, "degrees", "90", "phase of the wave"),
    moved("part.*.deform.*.by", Amount, "units", "\"2%\"", "displacement along the normal (inflate)"),

    fixed("roles.auto", Flag, "", "true", "makes parts interior that are not visible from outside; alone: roles = \"auto\""),
    fixed("roles.interior", Texts, "", "[\"*core*\"]", "globs of parts that are never cut"),
    fixed("roles.exterior", Texts, "", "[\"housing*\"]", "globs of parts that are cut"),
    fixed("roles.whole", Texts, "", "[\"bolt*\", \"shaft*\"]", "globs of parts that are never cut, but hidden where they are removed entirely"),

    fixed("relief.*.kind", Choice(&["sawtooth", "waves", "fractal", "cracks", "steps", "constant", "image", "blend", "profile", "layers"]), "", "\"fractal\"", "source of the heights"),
    moved("relief.*.size", OneOrMore(2), "texels", "[256, 256]", "size of a computed height map"),
    moved("relief.*.seed", Whole(0.0, 9e15), "", "7", "random seed (fractal, cracks)"),
    moved("relief.*.count", OneOrMore(2), "", "[3, 3]", "number of waves in each direction (waves)"),
    moved("relief.*.cells", Whole(1.0, 4096.0), "", "4", "cells along the longer side (fractal, cracks)"),
    moved("relief.*.octaves", Whole(1.0, 16.0), "", "5", "number of octaves (fractal)"),
    moved("relief.*.gain", Number(0.0, 1.0), "", "0.5", "amplitude ratio from one octave to the next finer one (fractal)"),
    moved("relief.*.width", Number(1e-3, 1.0), "cells", "0.12", "half width of a groove (cracks)"),
    moved("relief.*.levels", Whole(2.0, 4096.0), "", "5", "number of heights in each direction (steps)"),
    moved("relief.*.value", Number(0.0, 1.0), "", "0.5", "height (constant)"),
    fixed("relief.*.image", File, "", "\"rock.png\"", "image of heights"),
    fixed("relief.*.blend", Texts, "", "[\"a\", \"b\"]", "names of the reliefs to combine, in order"),
    fixed("relief.*.op", Choice(&["add", "mix", "max", "min", "multiply", "screen", "overlay", "difference"]), "", "\"add\"", "operator that combines them (blend)"),
    moved("relief.*.share", Number(0.0, 1.0), "", "0.5", "weight of each relief against those before it (blend, mix)"),
    moved("relief.*.heights", Other, "", "[0, 0.2, 1]", "heights at equal steps along U (profile)"),
    fixed("relief.*.of", Texts, "", "[\"a\", \"b\"]", "names of the reliefs used as layers (layers)"),
    fixed("relief.*.images", File, "", "\"frames/%03d.png\"", "numbered images used as layers (layers)"),
    fixed("relief.*.first", Whole(0.0, ANY), "", "1", "number of the first image (layers)"),
    moved("relief.*.at", REAL, "", "0.5", "position between layers; layer 0 is at 0 (layers)"),
    fixed("relief.*.wrap", WRAP, "", "\"repeat\"", "wrap mode beyond the last layer (layers)"),

    fixed("cut.*.name", Text, "", "\"front\"", "name in paths"),
    moved("cut.*.enabled", Flag, "", "true", "applies the cut"),
    fixed("cut.*.applies_to", Texts, "", "[\"*\"]", "globs of the parts to cut"),
    fixed("cut.*.except", Texts, "", "[\"bolt*\"]", "globs of the parts to leave uncut"),
    moved("cut.*.offset.*", Amount, "units", "\"5%\"", "distance by which more of a part is kept, by name or glob"),
    fixed("cut.*.surfaces.*.section", Text, "", "\"z=50%\"", "plane whose normal points to the kept side"),
    moved("cut.*.surfaces.*.normal", Numbers(3), "", "[0, 0, 1]", "normal of a plane, instead of a section"),
    moved("cut.*.surfaces.*.origin", Numbers(3), "units", "[0, 0, 0]", "point on the plane"),
    moved("cut.*.surfaces.*.spin_deg", REAL, "degrees", "30", "rotation of the plane and its relief about the normal, from U towards V"),
    moved("cut.*.surfaces.*.u", Numbers(3), "units", "[1, 0, 0]", "vector U of the paper's form"),
    moved("cut.*.surfaces.*.v", Numbers(3), "units", "[0, 1, 0]", "vector V; the side of U x V is kept"),
    moved("cut.*.surfaces.*.scale", Numbers(3), "", "[4, 4, 0.1]", "repeats along U and V, and height"),
    fixed("cut.*.surfaces.*.relief", Text, "", "\"ragged\"", "name of the relief"),
    moved("cut.*.surfaces.*.amplitude", Amount, "units", "\"6%\"", "height from the lowest to the highest point of the relief"),
    moved("cut.*.surfaces.*.period", Amount, "units", "\"40%\"", "length of one repeat of the relief"),
    fixed("cut.*.surfaces.*.wrap", WRAP, "", "\"mirror\"", "wrap mode of the relief"),
    moved("cut.*.surfaces.*.flip", Flag, "", "true", "keeps the other side"),
    moved("cut.*.box.min", Amounts, "units", "[\"50%\", 0, 0]", "lower corner; default: open on that side"),
    moved("cut.*.box.max", Amounts, "units", "[\"100%\", 1, 1]", "upper corner"),
    moved("cut.*.box.centre", Amounts, "units", "[0, 0, 0]", "centre, instead of corners"),
    moved("cut.*.box.size", OneOrMore(3), "units", "0.5", "side lengths"),
    fixed("cut.*.box.relief", Text, "", "\"ragged\"", "name of the relief of the faces"),
    moved("cut.*.box.amplitude", Amount, "units", "\"6%\"", "height from the lowest to the highest point of the relief"),
    moved("cut.*.box.period", Amount, "units", "\"40%\"", "length of one repeat of the relief"),
    fixed("cut.*.box.wrap", WRAP, "", "\"mirror\"", "wrap mode of the relief"),
    fixed("cut.*.box.faces", Texts, "", "[\"+z\"]", "faces with the relief: -x to +z"),
    moved("cut.*.wedge.axis", Numbers(3), "", "[0, 0, 1]", "axis of the wedge; or \"x\" to \"-z\""),
    moved("cut.*.wedge.origin", Amounts, "units", "[\"50%\", \"50%\", 0]", "point on the axis; default: the middle of the model"),
    moved("cut.*.wedge.from_deg", REAL, "degrees", "0", "start angle, counter-clockwise from the next axis"),
    moved("cut.*.wedge.to_deg", REAL, "degrees", "90", "end angle, at most 360 more"),
    moved("cut.*.wedge.min", Amount, "units", "\"10%\"", "smallest coordinate along the axis"),
    moved("cut.*.wedge.max", Amount, "units", "\"90%\"", "largest coordinate along the axis"),
    fixed("cut.*.wedge.relief", Text, "", "\"ragged\"", "name of the relief of the faces"),
    moved("cut.*.wedge.amplitude", Amount, "units", "\"6%\"", "height from the lowest to the highest point of the relief"),
    moved("cut.*.wedge.period", Amount, "units", "\"40%\"", "length of one repeat of the relief"),
    fixed("cut.*.wedge.wrap", WRAP, "", "\"mirror\"", "wrap mode of the relief"),
    fixed("cut.*.wedge.faces", Texts, "", "[\"from\"]", "faces with the relief: from, to, min, max"),
    fixed("cut.*.cutout.axis", Other, "", "\"auto\"", "axis: \"auto\", \"main\", \"symmetry\", \"x\" to \"-z\", or a direction"),
    moved("cut.*.cutout.angle_deg", Number(0.0, 359.0), "degrees", "110", "angle between the two faces"),
    moved("cut.*.cutout.turn_deg", REAL, "degrees", "0", "rotation away from the first camera, or with `fixed` from the second axis"),
    moved("cut.*.cutout.fixed", Flag, "", "true", "keeps the cutout in place when the camera moves"),
    moved("cut.*.cutout.offset", Numbers(2), "units", "[0, 0]", "translation along the second and the third axis"),
    fixed("cut.*.cutout.relief", Text, "", "\"ragged\"", "name of the relief of the faces"),
    moved("cut.*.cutout.amplitude", Amount, "units", "\"6%\"", "height from the lowest to the highest point of the relief"),
    moved("cut.*.cutout.period", Amount, "units", "\"40%\"", "length of one repeat of the relief"),
    fixed("cut.*.cutout.wrap", WRAP, "", "\"mirror\"", "wrap mode of the relief"),
    fixed("cut.*.cutout.faces", Texts, "", "[\"from\"]", "faces with the relief: from, to"),
    moved("cut.*.breakaway.distance", Amount, "units", "\"1%\"", "clearance between the opening and what is inside"),
    moved("cut.*.breakaway.bevel_deg", Number(0.0, 60.0), "degrees", "12", "angle by which the opening is wider than the lines of sight"),
    fixed("cut.*.breakaway.clusters", Choice(&["auto", "one"]), "", "\"one\"", "one opening, or one per cluster of interior parts"),
    fixed("cut.*.breakaway.view", Choice(&["each", "first"]), "", "\"first\"", "follows the camera, or stays open to the first one"),
    fixed("cut.*.volume", File, "", "\"shape:sphere\"", "closed mesh that cuts: a file, or a shape"),
    moved("cut.*.translate", Numbers(3), "units", "[0, 0, 1]", "translation of the volume, applied last"),
    moved("cut.*.rotate_deg", Numbers(3), "degrees", "[0, 90, 0]", "rotation of the volume about x, then y, then z"),
    moved("cut.*.scale", OneOrMore(3), "", "0.5", "scale of the volume, applied first"),
    moved("cut.*.pivot", Numbers(3), "units", "[0, 0, 0]", "fixed point of the volume's scale and rotation"),
    moved("cut.*.matrix", Other, "", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]", "4 rows of 4 numbers that place the volume"),
    moved("cut.*.flip", Flag, "", "true", "removes what is outside the volume"),

    fixed("key.*.target", Text, "", "\"camera.azimuth_deg\"", "path of the animated value"),
    fixed("key.*.times_s", Other, "s", "[0, 2]", "times, ascending"),
    fixed("key.*.values", Other, "", "[0, 360]", "value at each time"),
    fixed("key.*.interpolation", Choice(&["linear", "step", "smooth"]), "", "\"smooth\"", "interpolation between times"),
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
