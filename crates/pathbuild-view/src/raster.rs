//! Pictures as PNG and PDF. The font is part of the program; system fonts are never used, so that pictures are the same everywhere.

use std::sync::{Arc, LazyLock};

use pathbuild_diagnostic::reasons::PICTURE_TOO_LARGE;
use pathbuild_diagnostic::{Lang, Value};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref};
use resvg::tiny_skia::{Pixmap, Transform};
use usvg::fontdb::Database;
use usvg::{Options, Tree};

use crate::scene::Scene;
use crate::svg::{Sheet, VisibleParts, sheet_pages, svg, xmp};

/// A subset of `DejaVu Sans` with the characters that pictures need.
const FONT: &[u8] = include_bytes!("../fonts/DejaVuSans-subset.ttf");

/// The name of the font family.
const FAMILY: &str = "DejaVu Sans";

/// Pixels of a PNG per px of the page.
const PIXELS: f32 = 2.0;

/// The font database, loaded once.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family(FAMILY);
    fonts.set_serif_family(FAMILY);
    fonts.set_monospace_family(FAMILY);
    Arc::new(fonts)
});

/// Renders a scene as PNG.
///
/// # Errors
/// The picture is too large for memory, or there is a bug.
pub fn png(scene: &Scene, shown: VisibleParts) -> Result<Vec<u8>, Value> {
    let tree = tree(&svg(scene, shown))?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(PIXELS)
        .ok_or_else(|| Value::foreign("the picture has no size"))?;
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or(&PICTURE_TOO_LARGE)?;
    resvg::render(&tree, Transform::from_scale(PIXELS, PIXELS), &mut pixels.as_mut());
    pixels.encode_png().map_err(Value::foreign)
}

/// Renders a scene as PDF.
///
/// # Errors
/// Only if there is a bug.
pub fn pdf(scene: &Scene, shown: VisibleParts) -> Result<Vec<u8>, Value> {
    let tree = tree(&svg(scene, shown))?;
    let pdf = svg2pdf::to_pdf(&tree, svg2pdf::ConversionOptions::default(), svg2pdf::PageOptions::default());
    pdf.map(|pdf| in_order(&pdf)).map_err(Value::foreign)
}

/// Renders a setup sheet as PDF, with A4 pages.
///
/// # Errors
/// Only if there is a bug.
pub fn sheet_pdf(sheet: &Sheet, lang: Lang) -> Result<Vec<u8>, Value> {
    let pages = sheet_pages(sheet, lang);
    let trees: Vec<Tree> = pages.iter().map(|page| tree(page)).collect::<Result<_, _>>()?;
    joined(&trees, &xmp(&sheet.head)).map_err(Value::foreign)
}

fn tree(svg: &str) -> Result<Tree, Value> {
    let options =
        Options { font_family: FAMILY.to_owned(), fontdb: Arc::clone(&FONTS), ..Options::default() };
    Tree::from_str(svg, &options).map_err(Value::foreign)
}

// Joins several pictures as the pages of a PDF.

/// Size of an A4 page in points.
const PAPER: [f32; 2] = [595.276, 841.89];

/// The name by which a page refers to its picture.
const PICTURE: Name<'static> = Name(b"S");

/// A PDF with one picture on each page. The metadata comes first, so that it is found in the head of the file.
pub(crate) fn joined(trees: &[Tree], metadata: &str) -> Result<Vec<u8>, String> {
    let mut next = 1..;
    let mut fresh = move || Ref::new(next.next().unwrap_or(i32::MAX));
    let mut pdf = Pdf::new();
    let (about, catalogue, all) = (fresh(), fresh(), fresh());
    pdf.metadata(about, metadata.as_bytes());
    let mut pages = Vec::new();
    for tree in trees {
        let (chunk, picture) = svg2pdf::to_chunk(tree, svg2pdf::ConversionOptions::default())
            .map_err(|error| error.to_string())?;
        let mut renumbered = std::collections::HashMap::new();
        let mut number = |old: Ref| *renumbered.entry(old).or_insert_with(&mut fresh);
        let chunk = chunk.renumber(&mut number);
        let picture = number(picture);
        let (page, content) = (fresh(), fresh());
        let mut writer = pdf.page(page);
        writer.media_box(Rect::new(0.0, 0.0, PAPER[0], PAPER[1])).parent(all).contents(content);
        writer.resources().x_objects().pair(PICTURE, picture);
        writer.finish();
        let mut drawn = Content::new();
        drawn.transform([PAPER[0], 0.0, 0.0, PAPER[1], 0.0, 0.0]).x_object(PICTURE);
        pdf.stream(content, &drawn.finish());
        pdf.extend(&chunk);
        pages.push(page);
    }
    pdf.pages(all).count(i32::try_from(pages.len()).unwrap_or(i32::MAX)).kids(pages);
    pdf.catalog(catalogue).pages(all).metadata(about);
    Ok(in_order(&pdf.finish()))
}

/// Sorts the dictionary entries that refer to objects: svg2pdf writes them in the order of a hash table, which differs between runs. The
/// order has no meaning in PDF, and the offsets of objects stay the same.
fn in_order(pdf: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = pdf.split_inclusive(|byte| *byte == b'\n').collect();
    for entries in lines.chunk_by_mut(|a, b| is_entry(a) && is_entry(b)) {
        entries.sort_unstable_by_key(|entry| (entry.len(), *entry));
    }
    lines.concat()
}

/// Whether a line is an entry such as `/gs12 16 0 R`.
fn is_entry(line: &[u8]) -> bool {
    let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    let is_number = |word: &[u8]| word.iter().all(u8::is_ascii_digit);
    words.next().is_some_and(|name| name.starts_with(b"/"))
        && words.next().is_some_and(is_number)
        && words.eq([b"0".as_slice(), b"R"])
}
