//! Play count of a GIF or an animated PNG: the value of `--loop`.

use std::str::FromStr;

use clap::Args;
use cutaway::Error;

use super::target::AnimationOutput;

/// Play count of an animation, as an option.
#[derive(Args, Clone, Copy)]
pub(crate) struct LoopArgs {
    /// Number of times that a GIF or an animated PNG plays [default: forever]
    #[arg(
        long = "loop",
        value_name = "N|forever",
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    plays: Option<Plays>,
}

impl LoopArgs {
    /// Rejects a play count for a format that does not store it.
    pub(super) fn must_fit(self, target: &AnimationOutput) -> cutaway::Result<()> {
        if self.plays.is_none() || target.counts_plays() {
            return Ok(());
        }
        let what = "only a GIF or an animated PNG stores how often it plays";
        let help = "leave it out, or write a .gif or a .png";
        Err(Error::input("--loop", what, help))
    }

    /// The play count.
    pub(super) fn plays(self) -> Plays {
        self.plays.unwrap_or(Plays::Forever)
    }
}

/// Play count of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Plays {
    /// Endless repetition.
    Forever,
    /// Number of plays; never 0.
    Times(u16),
}

impl Plays {
    /// The value stored in an animated PNG.
    pub(super) fn count(self) -> u32 {
        match self {
            Self::Forever => 0,
            Self::Times(n) => u32::from(n),
        }
    }
}

impl FromStr for Plays {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("forever", _) => Ok(Self::Forever),
            (_, Ok(n)) if n > 0 => Ok(Self::Times(n)),
            _ => Err(
                "it must be forever, or a number from 1 to 65535\n  help: --loop 1 plays it once"
                    .to_owned(),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_rounds_are_read_or_refused() {
        assert_eq!("forever".parse(), Ok(Plays::Forever));
        assert_eq!("3".parse(), Ok(Plays::Times(3)));
        for text in ["0", "-1", "70000", "ever", ""] {
            assert!(text.parse::<Plays>().is_err(), "{text}");
        }
    }
}
