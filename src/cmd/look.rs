//! Options of pictures: who draws them, how finely, and on what.

use clap::Args;
use glam::Vec3;

use super::open::Opened;
use super::picture::{Backdrop, Drawer, Style};
use crate::Result;
use crate::strategies::Strategy;

/// How pictures are drawn.
#[derive(Args)]
pub(super) struct LookArgs {
    /// Who draws the caps: raycast+mask, +stencil, +abuffer, +kbuffer:K, +ldi:RES or +vds:RES; grid:N and adaptive:TAU with all of these;
    /// planar (planes); stencil (one plane); or exact for the reference [default: that of the scene, or raycast+mask]
    #[arg(long, value_name = "NAME")]
    strategy: Option<String>,
    /// Draw N times as fine along each side and average in linear light, 1 to 4
    #[arg(
        long,
        value_name = "N",
        default_value_t = 2,
        value_parser = clap::value_parser!(u32).range(1..=4),
        help_heading = "Output"
    )]
    pub(super) supersample: u32,
    /// Leave what shows no model transparent
    #[arg(long, help_heading = "Output")]
    pub(super) no_background: bool,
}

impl LookArgs {
    /// Who is asked for by name, if anybody: what a scene asks for is only known once it is open.
    pub(super) fn asked(&self) -> Result<Option<Drawer>> {
        self.strategy.as_deref().map(str::parse).transpose()
    }

    /// Who draws: whoever is asked for, or else the scene's own choice.
    pub(super) fn drawer(&self, opened: &Opened) -> Result<Drawer> {
        match (self.asked()?, &opened.strategy) {
            (Some(drawer), _) => Ok(drawer),
            (None, Some(name)) => name.parse(),
            (None, None) => Ok(Drawer::By(Strategy::RAYCAST_MASK)),
        }
    }

    /// How it is drawn.
    pub(super) fn style(&self, opened: &Opened) -> Style {
        Style {
            supersample: self.supersample,
            backdrop: match opened.background {
                _ if self.no_background => Backdrop::Transparent,
                Some(color) => Backdrop::Color(color),
                None => Backdrop::Gradient,
            },
        }
    }
}

/// A colour as the options of a frame take it.
pub(super) fn bytes_of(color: Vec3) -> [u8; 3] {
    (color * 255.0).to_array().map(|c| c.round() as u8)
}
