//! Reliefs as one word of the command line: `NAME[:key=value,...]` or `IMAGE[:key=value,...]`.
//!
//! A relief stands on a section so that the section plane runs through the middle of its heights: the surface never
//! leaves the slab of half its amplitude on either side, and flat heights give back the plane. The middle of the map
//! lies over the middle of the bounds. Height 1 of the map rises from the kept side, so grooves of a map are grooves of
//! the solid.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::{Procedure, Relief, resolve};
use crate::error::{Error, Result, did_you_mean};
use crate::scene::section::Amount;
use crate::scene::{Bounds, ClipSurface, OffsetMap, Wrap, range};

const EXAMPLE: &str =
    "write for example `fractal:amplitude=5%,period=20,seed=7` or `rock.png:wrap=mirror`";

/// How a map stands on a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Height from the lowest to the highest texel; percent are of the bounds' diagonal.
    pub amplitude: Amount,
    /// Length of one repeat of the map along `U`; `None` is a share of the diagonal that suits the relief.
    pub period: Option<Amount>,
    /// How the map goes on beyond one repeat.
    pub wrap: Wrap,
}

impl Default for Placement {
    fn default() -> Self {
        Self {
            amplitude: Amount::Percent(6.0),
            period: None,
            wrap: Wrap::Repeat,
        }
    }
}

/// A relief and its placement, as the user wrote them.
#[derive(Clone, Debug, PartialEq)]
pub struct ReliefSpec {
    /// The words of the user.
    pub text: String,
    /// Where the heights come from.
    pub relief: Relief,
    /// How they stand on the section.
    pub placement: Placement,
}

/// The wrap mode of a name.
pub(in crate::scene) fn parse_wrap(name: &str) -> Result<Wrap, String> {
    match name {
        "repeat" => Ok(Wrap::Repeat),
        "mirror" => Ok(Wrap::Mirror),
        "clamp" => Ok(Wrap::Clamp),
        _ => Err(did_you_mean(name, ["repeat", "mirror", "clamp"])),
    }
}

impl ReliefSpec {
    /// Reads a spec. Keys of all reliefs: `amplitude`, `period` (scene units, or `%` of the bounds' diagonal), `wrap`.
    /// Keys of procedures: those of [`Procedure::keys`], with `size=N` or `size=WxH`.
    pub fn parse(text: &str) -> Result<Self> {
        let fault =
            |what: String, mend: String| Error::input(format!("relief `{text}`"), what, mend);
        // A colon may belong to a path; only what looks like keys is read as keys.
        let (name, settings) = match text.rsplit_once(':') {
            Some((name, tail)) if tail.contains('=') => (name.trim(), tail),
            _ => (text.trim(), ""),
        };
        let mut relief = match Procedure::named(name) {
            Some(procedure) => Relief::Procedure(procedure),
            None if looks_like_a_path(name) => Relief::Image(PathBuf::from(name)),
            None => {
                let mend = format!("{}, or an image file", did_you_mean(name, Procedure::NAMES));
                return Err(fault("there is no such relief or file".into(), mend));
            }
        };
        let mut placement = Placement::default();
        for setting in settings.split(',').filter(|s| !s.trim().is_empty()) {
            let Some((key, value)) = setting.split_once('=') else {
                let what = format!("`{setting}` is not of the form key=value");
                return Err(fault(what, EXAMPLE.into()));
            };
            let (key, value) = (key.trim(), value.trim());
            let wrong = |what: String| fault(format!("{key} = `{value}`: {what}"), EXAMPLE.into());
            match key {
                "amplitude" => placement.amplitude = Amount::parse(value).map_err(wrong)?,
                "period" => placement.period = Some(Amount::parse(value).map_err(wrong)?),
                "wrap" => {
                    placement.wrap = parse_wrap(value)
                        .map_err(|mend| fault(format!("wrap = `{value}` is no mode"), mend))?;
                }
                _ => {
                    let known = match &relief {
                        Relief::Procedure(p) => p.keys(),
                        _ => &[],
                    };
                    match &mut relief {
                        Relief::Procedure(p) if known.contains(&key) => {
                            let numbers = value
                                .split('x')
                                .map(|n| n.trim().parse::<f64>())
                                .collect::<Result<Vec<f64>, _>>()
                                .map_err(|e| wrong(e.to_string()))?;
                            p.set(key, &numbers).map_err(wrong)?;
                        }
                        _ => {
                            let general = ["amplitude", "period", "wrap"];
                            let mend =
                                did_you_mean(key, general.into_iter().chain(known.iter().copied()));
                            return Err(fault(format!("`{key}` is no key of {name}"), mend));
                        }
                    }
                }
            }
        }
        if let Some(what) = placement.defect() {
            return Err(fault(what, EXAMPLE.into()));
        }
        Ok(Self {
            text: text.to_owned(),
            relief,
            placement,
        })
    }
}

fn looks_like_a_path(name: &str) -> bool {
    name.contains(['/', '\\', '.']) || std::path::Path::new(name).exists()
}

impl Placement {
    /// Why the numbers make no placement, if they do not.
    pub fn defect(&self) -> Option<String> {
        match self.period {
            Some(Amount::Units(v) | Amount::Percent(v)) if v <= 0.0 => {
                Some(format!("the period must be above 0, but is {v}"))
            }
            _ => None,
        }
    }
}

/// A section made a relief: the same section, with the heights of the spec on it. Images are read here.
pub fn apply_relief(
    surface: ClipSurface,
    spec: &ReliefSpec,
    bounds: &Bounds,
) -> Result<ClipSurface> {
    let name = "relief";
    if !spec.relief.of().is_empty() {
        let mend = "describe it in a scene file: [relief.NAME] blend = [\"a\", \"b\"]";
        return Err(Error::input(
            &spec.text,
            "it is made of others by name",
            mend,
        ));
    }
    let only = BTreeMap::from([(name.to_owned(), spec.relief.clone())]);
    let map = resolve(name, &only, &mut BTreeMap::new())?;
    place_map(surface, map, &spec.placement, bounds)
        .map_err(|what| Error::input(format!("relief `{}`", spec.text), what, EXAMPLE))
}

/// The period in percent of the diagonal where none is given: one clamped map over all of the model, about ten teeth of
/// a saw-tooth, whose map is 2 x 2, and little more than one repeat of the others.
fn usual_period(map: &OffsetMap, wrap: Wrap) -> f64 {
    match (wrap, map.size) {
        (Wrap::Clamp, _) => 100.0,
        (_, [2, 2]) => 10.0,
        _ => 60.0,
    }
}

/// Puts a map on a plane; what is wrong if the placement has no length. Texels of images that have both a width and a
/// height stay as square as they are: `|V|` follows from the period, `|U|`.
pub fn place_map(
    surface: ClipSurface,
    map: Arc<OffsetMap>,
    placement: &Placement,
    bounds: &Bounds,
) -> Result<ClipSurface, String> {
    let diagonal = bounds.size().length();
    let of_diagonal = |amount: Amount| match amount {
        Amount::Units(v) => v,
        Amount::Percent(p) => diagonal * p / 100.0,
    };
    let amplitude = of_diagonal(placement.amplitude);
    let usual = Amount::Percent(usual_period(&map, placement.wrap));
    let period = of_diagonal(placement.period.unwrap_or(usual));
    let [w, h] = map.size.map(f64::from);
    let lengths = [
        period,
        if w > 1.0 && h > 1.0 {
            period * h / w
        } else {
            period
        },
    ];
    if !(amplitude.is_finite() && lengths.iter().all(|l| l.is_finite() && *l > 0.0)) {
        return Err(format!(
            "amplitude {amplitude} and period {period} make no relief"
        ));
    }
    let shortest = lengths[0].min(lengths[1]);
    if let Some(what) = range::beside(amplitude, bounds) {
        return Err(format!("the amplitude {amplitude:.2e} is {what}"));
    }
    // As many repeats of the map lie across the model.
    if diagonal > 0.0 && shortest < diagonal / range::MOST_RADII {
        let (most, shortest) = (range::MOST_RADII, shortest);
        return Err(format!(
            "the period {shortest:.2e} is less than a {most:.0e}th of the bounds' diagonal"
        ));
    }
    let [lo, hi] = map.range().map(f64::from);
    let frame = surface.frame();
    let (u, v) = (frame.u_hat * lengths[0], frame.v_hat * lengths[1]);
    let to_centre = bounds.centre() - surface.origin;
    let middle = surface.origin
        + frame.u_hat * to_centre.dot(frame.u_hat)
        + frame.v_hat * to_centre.dot(frame.v_hat);
    let height = if hi > lo {
        amplitude / (hi - lo)
    } else {
        amplitude
    };
    let surface = ClipSurface {
        // The surface lies at -f.Sz along N: the middle height must come to lie on the plane.
        origin: middle - (u + v) * 0.5 + frame.normal * (height * (lo + hi) * 0.5),
        u,
        v,
        scale: glam::DVec3::new(1.0, 1.0, height),
        relief: Some(map),
        wrap: placement.wrap,
    };
    match surface.defect_beside(bounds) {
        Some(what) => Err(what),
        None => Ok(surface),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn bounds() -> Bounds {
        Bounds {
            min: DVec3::new(-1.0, -2.0, 0.0),
            max: DVec3::new(3.0, 2.0, 7.0),
        }
    }

    #[test]
    fn names_paths_and_keys_are_told_apart() {
        let spec =
            ReliefSpec::parse("fractal:seed=7,size=64x32,amplitude=0.5,period=25%,wrap=mirror")
                .expect("a plain spec");
        let Relief::Procedure(p) = spec.relief else {
            panic!("{:?} is no procedure", spec.relief);
        };
        assert_eq!((p.seed, p.size), (7, [64, 32]), "seed and size");
        assert_eq!(spec.placement.amplitude, Amount::Units(0.5), "amplitude");
        assert_eq!(spec.placement.period, Some(Amount::Percent(25.0)), "period");
        assert_eq!(spec.placement.wrap, Wrap::Mirror, "wrap");

        let spec = ReliefSpec::parse(r"C:\maps\rock.png").expect("a path with a colon");
        assert_eq!(
            spec.relief,
            Relief::Image(r"C:\maps\rock.png".into()),
            "path"
        );
        let spec = ReliefSpec::parse("maps/rock.png:wrap=clamp").expect("a path with a key");
        assert_eq!(spec.relief, Relief::Image("maps/rock.png".into()), "path");
    }

    #[test]
    fn the_relief_fills_the_slab_around_its_section() {
        for (text, half) in [
            ("fractal:amplitude=1", 0.5),
            ("sawtooth:amplitude=2", 1.0),
            ("waves:amplitude=-2,wrap=mirror", 1.0),
        ] {
            let plane = ClipSurface::plane(DVec3::new(0.0, 0.0, 3.0), DVec3::Z);
            let spec = ReliefSpec::parse(text).expect(text);
            let relief = apply_relief(plane.clone(), &spec, &bounds()).expect(text);
            assert_eq!(relief.defect(), None, "{text}");
            assert_eq!(relief.frame().normal, DVec3::Z, "{text} turned the section");
            let [mut lo, mut hi] = [f64::INFINITY, f64::NEG_INFINITY];
            for i in 0..20_000 {
                let p = DVec3::new(f64::from(i) * 0.0713, f64::from(i % 173) * 0.0417, 3.0);
                lo = lo.min(relief.kept_height(p));
                hi = hi.max(relief.kept_height(p));
            }
            assert!(
                hi <= half + 1e-9 && lo >= -half - 1e-9,
                "{text}: {lo}..{hi}"
            );
            assert!(
                hi > 0.8 * half && lo < -0.8 * half,
                "{text} is flat: {lo}..{hi}"
            );
        }
    }

    #[test]
    fn a_clamped_map_covers_the_bounds_from_its_middle() {
        for normal in [DVec3::Z, DVec3::new(1.0, -2.0, 0.5)] {
            let plane = ClipSurface::plane(bounds().centre(), normal);
            let spec = ReliefSpec::parse("fractal:wrap=clamp").expect("a plain spec");
            let relief = apply_relief(plane, &spec, &bounds()).expect("a plain spec");
            let middle = relief.map_from_world(bounds().centre());
            assert!((middle - 0.5).length() < 1e-12, "the middle is at {middle}");
            for corner in bounds().corners() {
                let t = relief.map_from_world(corner);
                assert!(
                    t.cmpge(glam::DVec2::ZERO).all() && t.cmple(glam::DVec2::ONE).all(),
                    "{corner} is at {t}"
                );
            }
        }
    }

    #[test]
    fn a_constant_relief_is_the_section() {
        let plane = ClipSurface::plane(DVec3::new(0.0, 0.0, 3.0), DVec3::NEG_Z);
        for text in [
            "constant",
            "constant:value=1",
            "constant:value=0,amplitude=50%",
        ] {
            let spec = ReliefSpec::parse(text).expect(text);
            let relief = apply_relief(plane.clone(), &spec, &bounds()).expect(text);
            for corner in bounds().corners() {
                let (a, b) = (plane.kept_height(corner), relief.kept_height(corner));
                assert!((a - b).abs() < 1e-12, "{text}: {b} is not {a} at {corner}");
            }
        }
    }
}
