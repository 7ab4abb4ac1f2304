//! Options that each set one value of the scene. The value's declaration defines how the option is parsed and checked.

use clap::builder::{PossibleValuesParser, TypedValueParser as _, ValueParser};
use cutaway::Error;
use cutaway_io::document::paths::{self, ValueType};
use cutaway_io::document::{Value, parse_value};

/// Parser of an option for the value at a path.
pub(crate) fn declared(path: &'static str) -> ValueParser {
    let Some(path) = paths::find(path) else {
        unreachable!("`{path}` is no path of a scene");
    };
    if let ValueType::Choice(words) = path.takes {
        let parser = PossibleValuesParser::new(words);
        return parser.map(Value::from).into();
    }
    let parse = move |text: &str| -> Result<Value, String> {
        parse_value(path, text).map_err(|e| match e {
            Error::Input { what, .. } if path.takes.is_numeric() => {
                let example = path.example.replace(['[', ']', ' ', '"'], "");
                format!("{what}\n  help: write for example {example}")
            }
            Error::Input { what, help, .. } => format!("{what}\n  help: {help}"),
            other => other.to_string(),
        })
    };
    parse.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_read_or_refused_with_an_example() {
        let path = |path: &str| paths::find(path).expect("a path");
        for (at, text, expected) in [
            ("camera.position", "1,-2,3e1", "[1, -2, 3e1]"),
            ("camera.pan", "0.1,-2", "[0.1, -2]"),
            ("resolution", "640x480", "[640, 480]"),
            ("resolution", "640, 480", "[640, 480]"),
            ("time_s", "1.5", "1.5"),
            ("time_s", ".5", "0.5"),
            ("camera.position", ".5,-1,03", "[0.5, -1, 3]"),
            ("resolution", "064,48", "[64, 48]"),
            ("time_s", "0", "0"),
            ("camera.azimuth_deg", "auto", "auto"),
            ("background", "none", "none"),
        ] {
            let value = parse_value(path(at), text).unwrap_or_else(|e| panic!("{at}: {e}"));
            assert_eq!(value, Value::read(expected), "{at}: {text}");
        }
        for (at, texts) in [
            (
                "camera.position",
                &["1,2", "1,2,3,4", "1,2,nan", "1,2,inf", ""][..],
            ),
            ("camera.pan", &["1", "1,2,3", "a,b", ""]),
            ("camera.zoom", &["0", "x", "1 # one", "0x10", "1_0"]),
            ("camera.azimuth_deg", &["cut", "30deg", ""]),
            (
                "resolution",
                &["640", "0,480", "640,-1", "640,480,2", "99999,1", "a,b", ""],
            ),
            ("time_s", &["-1", "nan", "inf", "1s", ""]),
        ] {
            for text in texts {
                assert!(parse_value(path(at), text).is_err(), "{at}: {text}");
            }
        }
    }
}
