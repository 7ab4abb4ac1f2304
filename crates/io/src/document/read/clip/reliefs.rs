//! `[relief.NAME]`: sources of heights.
//!
//! ```toml
//! [relief.steps]
//! kind = "profile"                # one row of heights along U
//! heights = [0, 0.2, 1, 0.2]
//!
//! [relief.moving]
//! kind = "layers"                 # layer 0 at 0, layer 1 at 1, a mix of both at 0.5
//! images = "frames/%03d.png"      # or `of = ["a", "b"]`, names of other reliefs
//! at = 0.0
//! wrap = "repeat"
//! ```
//!
//! Images are read once, when the document is opened. Animated reliefs are computed from these images again at each time.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Result, did_you_mean};
use cutaway::scene::OffsetMap;
use cutaway::scene::describe::Described;
use cutaway::scene::relief::{BlendOp, Image, MAX_TEXELS, Procedure, Relief, resolve};

use crate::document::describe::ReliefDesc;
use crate::document::read::described::{self, keys_of};
use crate::document::read::reader::{Entry, Table};
use crate::load::Assets;
use crate::load::frames::Pattern;

const IMAGE_KEYS: &[&str] = &["kind", "image"];
const BLEND_KEYS: &[&str] = &["kind", "blend", "op", "share"];
const PROFILE_KEYS: &[&str] = &["kind", "heights"];
const LAYERS_KEYS: &[&str] = &["kind", "of", "images", "first", "at", "wrap"];

/// Offset maps by name.
pub(in crate::document::read) type Maps = BTreeMap<String, Arc<OffsetMap>>;

/// The images of reliefs. They are read once, because opened files do not change while a scene is played.
#[derive(Debug, Default)]
pub(crate) struct ReliefImages {
    /// The image of each relief, or its images in order, by the relief's name.
    by_relief: BTreeMap<String, Vec<Image>>,
}

impl ReliefImages {
    pub(crate) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.by_relief.values().flatten().map(|image| &image.path)
    }
}

/// Reliefs as computed for the last time of the scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Resolved {
    described: BTreeMap<String, Relief>,
    maps: Maps,
}

impl Resolved {
    /// Returns true if a relief, and all reliefs that it is blended from, are unchanged.
    fn still_holds(&self, name: &str, described: &BTreeMap<String, Relief>) -> bool {
        let relief = described.get(name);
        let parts = relief.map_or(&[] as &[String], Relief::of);
        relief == self.described.get(name)
            && self.maps.contains_key(name)
            && parts.iter().all(|n| self.still_holds(n, described))
    }
}

/// Reads all reliefs of `[relief]` and recomputes the changed ones. Unchanged reliefs keep their maps.
pub(in crate::document::read) fn read(
    entry: &Entry<'_>,
    images: &ReliefImages,
    last: &mut Resolved,
) -> Result<Maps> {
    let table = entry.open_table()?;
    let mut described = BTreeMap::new();
    for (name, relief) in table.all() {
        let images = images
            .by_relief
            .get(name)
            .map_or(&[] as &[_], Vec::as_slice);
        let read = describe(&relief, images)?;
        if let Relief::Layers { .. } = read {
            // Each image used as a layer counts as a relief, too.
            let layers = images.iter();
            described.extend(layers.map(|i| (name_of_image(&i.path), Relief::Image(i.clone()))));
        }
        described.insert(name.to_owned(), read);
    }
    let mut maps = last.maps.clone();
    maps.retain(|name, _| last.still_holds(name, &described));
    for (name, relief) in table.all() {
        resolve(name, &described, &mut maps).map_err(|e| relief.place(e))?;
    }
    let named = table.all().filter_map(|(name, _)| {
        let map = maps.get(name)?;
        Some((name.to_owned(), Arc::clone(map)))
    });
    let named = named.collect();
    last.described = described;
    last.maps = maps;
    Ok(named)
}

/// Reads the images that reliefs name.
pub(in crate::document::read) fn open(
    root: &Table<'_>,
    folder: &Path,
    assets: &mut Assets,
) -> Result<ReliefImages> {
    let mut opened = ReliefImages::default();
    let Some(reliefs) = root.get("relief") else {
        return Ok(opened);
    };
    for (name, relief) in reliefs.open_table()?.all() {
        let table = relief.open_table()?;
        let (said, paths) = match (table.get("image"), table.get("images")) {
            (Some(image), _) => {
                let path = folder.join(image.text()?);
                (image, vec![path])
            }
            // A relief that names layers by both `of` and `images` is refused later, when it is read.
            (None, Some(images)) if table.get("of").is_none() => {
                let paths = listed(&images, table.get("first"), folder, assets)?;
                (images, paths)
            }
            (None, _) => continue,
        };
        let image = |path: PathBuf| {
            let map = assets.image(&path).map_err(|e| said.place(e))?;
            let map = Arc::clone(map);
            Ok(Image { path, map })
        };
        let images = paths.into_iter().map(image).collect::<Result<_>>()?;
        opened.by_relief.insert(name.to_owned(), images);
    }
    Ok(opened)
}

/// Name of an image in the list of reliefs. Its first character can occur in keys only as an escape sequence.
fn name_of_image(path: &Path) -> String {
    format!("\u{7f}{}", path.display())
}

fn describe(entry: &Entry<'_>, images: &[Image]) -> Result<Relief> {
    let open = entry.open_table()?;
    let sources = ["image", "blend"].map(|key| open.get(key));
    if let [Some(_), Some(blend)] = sources {
        return Err(blend.fault("the relief also has an `image`", "keep one of the two"));
    }
    let kind = match (open.get("kind"), &sources) {
        (Some(kind), _) => kind.text()?,
        (None, [Some(_), _]) => "image",
        (None, [_, Some(_)]) => "blend",
        (None, _) => {
            let help = "add `kind = \"fractal\"`, `image = \"FILE\"` or `blend = [\"a\", \"b\"]`";
            return Err(entry.fault("it has no source of heights", help));
        }
    };
    match (kind, Procedure::named(kind)) {
        (_, Some(procedure)) => computed(entry, procedure),
        ("image", _) => {
            let image = entry.table(IMAGE_KEYS)?.need("image", "\"rock.png\"")?;
            let read = images.first().cloned().map(Relief::Image);
            read.ok_or_else(|| image.fault("its image was not read", "open the document again"))
        }
        ("blend", _) => blended(&entry.table(BLEND_KEYS)?),
        ("profile", _) => profile(&entry.table(PROFILE_KEYS)?),
        ("layers", _) => layers(&entry.table(LAYERS_KEYS)?, images),
        (_, None) => {
            let known = described::choices(ReliefDesc::FIELDS, "kind");
            let help = did_you_mean(kind, known.iter().copied());
            let kind_entry = open.get("kind").unwrap_or_else(|| entry.clone());
            Err(kind_entry.fault(format_args!("{kind:?} is not a kind of relief"), help))
        }
    }
}

fn computed(entry: &Entry<'_>, mut procedure: Procedure) -> Result<Relief> {
    let keys = [vec!["kind"], keys_of(procedure.fields())].concat();
    let table = entry.table(&keys)?;
    described::amend(&mut procedure, &table)?;
    if let (Some(what), Some(size)) = (procedure.defect(), table.get("size")) {
        return Err(size.fault(what, "write for example `size = [256, 256]`"));
    }
    Ok(Relief::Procedure(procedure))
}

fn blended(table: &Table<'_>) -> Result<Relief> {
    let desc: ReliefDesc = described::read(table)?;
    let blend = table.need("blend", "[\"a\", \"b\"]")?;
    let of = desc.blend;
    if of.len() < 2 {
        let help = "name them, for example `blend = [\"a\", \"b\"]`";
        return Err(blend.fault("a blend needs at least two reliefs", help));
    }
    let op = table.need("op", "\"add\"")?;
    let name = op.text()?;
    let mut operation = BlendOp::named(name).ok_or_else(|| {
        let what = format!("{name:?} is not a blend operator");
        op.fault(what, did_you_mean(name, BlendOp::NAMES))
    })?;
    if let Some(entry) = table.get("share") {
        let BlendOp::Mix { share } = &mut operation else {
            return Err(entry.fault("`share` is only valid with op = \"mix\"", "remove it"));
        };
        *share = desc.share.unwrap_or(*share);
    }
    Ok(Relief::Blend { of, op: operation })
}

fn profile(table: &Table<'_>) -> Result<Relief> {
    let list = table.need("heights", "[0, 1, 0.5]")?;
    let heights: Vec<f64> = list
        .list()?
        .iter()
        .map(Entry::number)
        .collect::<Result<_>>()?;
    let count = heights.len() as u64;
    if count == 0 || count > MAX_TEXELS {
        let what = format!("there are {count} heights");
        return Err(list.fault(what, format!("give from 1 to {MAX_TEXELS}")));
    }
    Ok(Relief::Profile(heights))
}

fn layers(table: &Table<'_>, images: &[Image]) -> Result<Relief> {
    let desc: ReliefDesc = described::read(table)?;
    let of = match (table.get("of"), table.get("images")) {
        (Some(_), Some(images)) => {
            return Err(images.fault("the layers are also named by `of`", "keep one of the two"));
        }
        (Some(of), None) => {
            if let Some(first) = table.get("first") {
                let what = "it is the number of the first image, but there are no images";
                return Err(first.fault(what, "remove it"));
            }
            let names = desc.of;
            if names.is_empty() {
                return Err(of.fault("it names no layer", "name reliefs: `of = [\"a\", \"b\"]`"));
            }
            names
        }
        (None, Some(_)) => images.iter().map(|i| name_of_image(&i.path)).collect(),
        (None, None) => {
            let help =
                "add `of = [\"a\", \"b\"]`, names of reliefs, or `images = \"frames/%03d.png\"`";
            return Err(table.entry.fault("it has no layers", help));
        }
    };
    Ok(Relief::Layers {
        of,
        at: desc.at,
        wrap: desc.wrap,
    })
}

/// The images of a pattern, numbered upwards from `first`, or by default from 0 or 1.
fn listed(
    entry: &Entry<'_>,
    first: Option<Entry<'_>>,
    folder: &Path,
    assets: &Assets,
) -> Result<Vec<PathBuf>> {
    let first = first.map(|f| f.whole::<u32>()).transpose()?;
    let pattern = Pattern::parse(entry.text()?);
    let found = pattern.and_then(|p| p.inside(folder).files(first, assets.store()));
    match found.map_err(|e| entry.place(e))? {
        (files, None) => Ok(files),
        (_, Some(gap)) => Err(entry.fault(gap, "add the missing image, or renumber the others")),
    }
}
