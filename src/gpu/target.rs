//! A host's targets for a frame: its picture, or the G-buffer that its own lighting reads.

use crate::scene::HostDepth;
use crate::{Error, Result};

/// A host's picture.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// The colour attachment; where the frame shows nothing, its content is kept.
    pub color: &'a wgpu::TextureView,
    /// Format of the colour attachment. sRGB and float formats receive linear light, other formats sRGB-encoded values.
    pub color_format: wgpu::TextureFormat,
    /// The depth attachment for depth test and depth writes; without one the frame covers the existing content.
    pub depth: Option<TargetDepth<'a>>,
    /// Samples per pixel of the attachments.
    pub sample_count: u32,
    /// Upper left corner of the frame in the attachments, in pixels.
    pub origin_px: [u32; 2],
    /// True if the sky is drawn where no model is visible; not with `caps_only`.
    pub background: bool,
    /// True to draw only caps: the host draws the surfaces itself, clipped by [`Session::clip_group`](crate::Session::clip_group).
    pub caps_only: bool,
}

/// A host's depth attachment.
#[derive(Clone, Copy, Debug)]
pub struct TargetDepth<'a> {
    /// The attachment.
    pub view: &'a wgpu::TextureView,
    /// Its format.
    pub format: wgpu::TextureFormat,
    /// Mapping from distances to depth values.
    pub convention: HostDepth,
}

/// A host's colour attachment.
#[derive(Clone, Copy, Debug)]
pub struct Attachment<'a> {
    /// The attachment.
    pub view: &'a wgpu::TextureView,
    /// Its format.
    pub format: wgpu::TextureFormat,
}

/// G-buffer of a host with its own lighting. All attachments are single-sampled; where no model is visible, their content is kept.
#[derive(Clone, Copy, Debug)]
pub struct GBuffer<'a> {
    /// The unlit colour of the part or of its caps, encoded as described at [`Target::color_format`].
    pub base_color: Attachment<'a>,
    /// The normal in the host's world space: a unit vector that faces the eye, in `Rgba16Float` or `Rgba32Float`.
    pub normal: Attachment<'a>,
    /// Visible element, in format `R32Uint`. The host clears it, because only pixels that show the model are written. From bit 0 on: 2 bits
    /// for the kind (1 a surface, 2 a cap), 1 for a back face, 1 for a pixel whose result may be wrong, 1 for a cap shared by several
    /// solids, 3 unused, 8 for the clip-surface of a cap (255 is the near plane), 16 for the part.
    pub what: &'a wgpu::TextureView,
    /// The depth attachment for depth test and depth writes.
    pub depth: TargetDepth<'a>,
    /// Upper left corner of the frame in the attachments, in pixels.
    pub origin_px: [u32; 2],
}

/// Maximum number of colour attachments of a destination.
pub(super) const MOST_COLORS: usize = 3;

/// Either kind of target, in the form that the compositing pass uses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Destination<'a> {
    pub(super) colors: [Option<Attachment<'a>>; MOST_COLORS],
    pub(super) depth: Option<TargetDepth<'a>>,
    pub(super) sample_count: u32,
    pub(super) origin_px: [u32; 2],
    pub(super) has_background: bool,
    pub(super) caps_only: bool,
}

impl<'a> From<&Target<'a>> for Destination<'a> {
    fn from(target: &Target<'a>) -> Self {
        let color = Attachment {
            view: target.color,
            format: target.color_format,
        };
        Self {
            colors: [Some(color), None, None],
            depth: target.depth,
            sample_count: target.sample_count,
            origin_px: target.origin_px,
            has_background: target.background,
            caps_only: target.caps_only,
        }
    }
}

impl<'a> From<&GBuffer<'a>> for Destination<'a> {
    fn from(buffer: &GBuffer<'a>) -> Self {
        let what = Attachment {
            view: buffer.what,
            format: wgpu::TextureFormat::R32Uint,
        };
        Self {
            colors: [buffer.base_color, buffer.normal, what].map(Some),
            depth: Some(buffer.depth),
            sample_count: 1,
            origin_px: buffer.origin_px,
            has_background: false,
            caps_only: false,
        }
    }
}

impl Destination<'_> {
    /// Returns an error if the frame extends beyond the attachments or an attachment does not match its description; wgpu would report such
    /// errors only when the host finishes its encoder. Sizes are those of mip level 0.
    pub(crate) fn must_hold(&self, size_px: [u32; 2]) -> Result<()> {
        let names = match self.colors[1] {
            None => ["the colour attachment", "", ""],
            Some(_) => ["the base colour", "the normals", "the attachment `what`"],
        };
        let colors = self.colors.iter().zip(names);
        let colors =
            colors.filter_map(|(a, name)| Some((name, a.as_ref()?.view, a.as_ref()?.format)));
        let depth = (self.depth.iter()).map(|d| ("the depth attachment", d.view, d.format));
        let mut first: Option<(&str, wgpu::Extent3d)> = None;
        for (name, view, format) in colors.chain(depth) {
            let texture = view.texture();
            let have = texture.size();
            let fault = |what: String, help: &str| {
                Err(Error::input(format!("{name} of the host"), what, help))
            };
            let reach = [0, 1].map(|i| self.origin_px[i].saturating_add(size_px[i]));
            if reach[0] > have.width || reach[1] > have.height {
                let ([width, height], [x, y]) = (size_px, self.origin_px);
                return fault(
                    format!(
                        "a frame of {width} x {height} px at ({x}, {y}) does not fit into {} x {} px",
                        have.width, have.height
                    ),
                    "give attachments that are at least as large as the view, plus the origin",
                );
            }
            let (of, size) = *first.get_or_insert((name, have));
            if [size.width, size.height] != [have.width, have.height] {
                let [[w, h], [v, g]] = [have, size].map(|s| [s.width, s.height]);
                return fault(
                    format!("it has {w} x {h} px, and {of} has {v} x {g} px"),
                    "give attachments of equal size",
                );
            }
            if texture.format().remove_srgb_suffix() != format.remove_srgb_suffix() {
                return fault(
                    format!("its format is {:?}, not {format:?}", texture.format()),
                    "set the format to that of the view",
                );
            }
            if texture.sample_count() != self.sample_count {
                let (have, said) = (texture.sample_count(), self.sample_count);
                return fault(
                    format!("it has {have} samples per pixel, not {said}"),
                    "give attachments with `sample_count` samples per pixel, or a G-buffer with one",
                );
            }
            if !(texture.usage()).contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
                return fault(
                    "it cannot be drawn into".to_owned(),
                    "create its texture with TextureUsages::RENDER_ATTACHMENT",
                );
            }
        }
        match self.colors[1] {
            Some(normal) if !holds_signs(normal.format) => Err(Error::input(
                "the normals of the host",
                format!("the format {:?} holds no negative numbers", normal.format),
                "give an attachment of Rgba16Float or Rgba32Float",
            )),
            _ => Ok(()),
        }
    }
}

fn holds_signs(format: wgpu::TextureFormat) -> bool {
    use wgpu::TextureFormat::{Rgba8Snorm, Rgba16Float, Rgba16Snorm, Rgba32Float};
    matches!(format, Rgba8Snorm | Rgba16Float | Rgba16Snorm | Rgba32Float)
}
