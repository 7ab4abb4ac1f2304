//! Where a host wants a frame: in its picture, or in the attachments that its own lights read.

use crate::scene::HostDepth;
use crate::{Error, Result};

/// The picture of a host.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// The colour attachment; what is there stays where the frame shows nothing.
    pub color: &'a wgpu::TextureView,
    /// Its format. Formats that are sRGB or floats get linear light, others sRGB as it is.
    pub color_format: wgpu::TextureFormat,
    /// The depth attachment that the frame is tested against and written to; without one the frame covers what is there.
    pub depth: Option<TargetDepth<'a>>,
    /// Samples of a pixel of the attachments.
    pub sample_count: u32,
    /// Upper left corner of the frame in the attachments, in pixels.
    pub origin_px: [u32; 2],
    /// Whether the sky is drawn where no model is seen.
    pub background: bool,
    /// Draws caps alone: the host draws the surfaces itself, less what [`Session::clip_group`](crate::Session::clip_group) says is
    /// removed.
    pub caps_only: bool,
}

/// The depth attachment of a host.
#[derive(Clone, Copy, Debug)]
pub struct TargetDepth<'a> {
    /// The attachment.
    pub view: &'a wgpu::TextureView,
    /// Its format.
    pub format: wgpu::TextureFormat,
    /// What distances become in it.
    pub convention: HostDepth,
}

/// A colour attachment of a host.
#[derive(Clone, Copy, Debug)]
pub struct Attachment<'a> {
    /// The attachment.
    pub view: &'a wgpu::TextureView,
    /// Its format.
    pub format: wgpu::TextureFormat,
}

/// The G-buffer of a host that lights by itself. All attachments have one sample; what is there stays where no model is seen.
#[derive(Clone, Copy, Debug)]
pub struct GBuffer<'a> {
    /// The colour of the part, or of its caps, without light. As [`Target::color_format`].
    pub base_color: Attachment<'a>,
    /// The normal in the host's world: a unit vector towards the eye, for example in `Rgba16Float`.
    pub normal: Attachment<'a>,
    /// What is seen, of the format `R32Uint`: bits 0-1 1 for a surface and 2 for a cap, 2 a back face, 3 undecided, 4 an overlap, 8-15
    /// the clip-surface of a cap, 16-31 the part.
    pub what: Attachment<'a>,
    /// The depth attachment that the frame is tested against and written to.
    pub depth: TargetDepth<'a>,
    /// Upper left corner of the frame in the attachments, in pixels.
    pub origin_px: [u32; 2],
}

/// Most colour attachments of a destination.
pub(super) const MOST_COLORS: usize = 3;

/// Either of them, as a pass sees it.
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
        Self {
            colors: [buffer.base_color, buffer.normal, buffer.what].map(Some),
            depth: Some(buffer.depth),
            sample_count: 1,
            origin_px: buffer.origin_px,
            has_background: false,
            caps_only: false,
        }
    }
}

impl Destination<'_> {
    /// Refuses a frame that reaches beyond the attachments.
    pub(crate) fn must_hold(&self, size_px: [u32; 2]) -> Result<()> {
        for attachment in self.colors.iter().flatten() {
            let have = attachment.view.texture().size();
            let reach = [0, 1].map(|i| self.origin_px[i].saturating_add(size_px[i]));
            if reach[0] > have.width || reach[1] > have.height {
                let ([width, height], [x, y]) = (size_px, self.origin_px);
                return Err(Error::input(
                    "the target of the host",
                    format!(
                        "a frame of {width} x {height} px at ({x}, {y}) does not fit into {} x {} px",
                        have.width, have.height
                    ),
                    "give attachments as large as the view",
                ));
            }
        }
        Ok(())
    }
}
