//! Renders pictures as PNG and PDF. The font is part of the program; system fonts are never used, so that pictures are the same
//! everywhere.

use std::sync::{Arc, LazyLock};

use pathbuild_diagnostic::reasons::PICTURE_TOO_LARGE;
use pathbuild_diagnostic::{Lang, Value};
use resvg::tiny_skia::{Pixmap, Transform};
use usvg::fontdb::Database;
use usvg::{Options, Tree};

use crate::pdf::document;
use crate::scene::Scene;
use crate::svg::{Sheet, VisibleParts, sheet_pages, svg, xmp};

/// A subset of `DejaVu Sans` with the characters that pictures need.
const FONT: &[u8] = include_bytes!("../fonts/DejaVuSans-subset.ttf");

const FAMILY: &str = "DejaVu Sans";

/// Pixels of a PNG per px of the SVG.
const PIXELS_PER_PX: f32 = 2.0;

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family(FAMILY);
    fonts.set_serif_family(FAMILY);
    fonts.set_monospace_family(FAMILY);
    Arc::new(fonts)
});

/// Renders a scene as PNG. The scene is dropped before its picture is rendered, because a large scene takes more memory than its picture.
///
/// # Errors
/// The picture is too large for memory. Any other error is a bug.
pub fn png(scene: Scene, shown: VisibleParts) -> Result<Vec<u8>, Value> {
    let tree = scene_tree(scene, shown)?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(PIXELS_PER_PX)
        .ok_or_else(|| Value::foreign("the picture has no size"))?;
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or(&PICTURE_TOO_LARGE)?;
    resvg::render(&tree, Transform::from_scale(PIXELS_PER_PX, PIXELS_PER_PX), &mut pixels.as_mut());
    drop(tree);
    pixels.encode_png().map_err(Value::foreign)
}

/// Renders a scene as PDF. The scene is dropped before its picture is rendered, as for a PNG.
///
/// # Errors
/// An error is always a bug.
pub fn pdf(scene: Scene, shown: VisibleParts) -> Result<Vec<u8>, Value> {
    document(&[scene_tree(scene, shown)?], FONT, None).map_err(Value::foreign)
}

/// Renders a setup sheet as PDF, with A4 pages.
///
/// # Errors
/// An error is always a bug.
pub fn sheet_pdf(sheet: &Sheet, lang: Lang) -> Result<Vec<u8>, Value> {
    let pages = sheet_pages(sheet, lang);
    let trees: Vec<Tree> = pages.iter().map(|page| tree(page)).collect::<Result<_, _>>()?;
    document(&trees, FONT, Some(&xmp(&sheet.head))).map_err(Value::foreign)
}

fn scene_tree(scene: Scene, shown: VisibleParts) -> Result<Tree, Value> {
    let svg = svg(&scene, shown);
    drop(scene);
    tree(&svg)
}

fn tree(svg: &str) -> Result<Tree, Value> {
    let options =
        Options { font_family: FAMILY.to_owned(), fontdb: Arc::clone(&FONTS), ..Options::default() };
    Tree::from_str(svg, &options).map_err(Value::foreign)
}
