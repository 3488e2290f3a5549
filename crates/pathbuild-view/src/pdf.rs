//! Writes PDF documents from trees of usvg, one for each page. Lines and letters stay vectors; texts are searchable and share one embedded font.

use std::collections::BTreeMap;
use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{
    CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, TextRenderingMode, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use usvg::layout::Span;
use usvg::tiny_skia_path::{PathSegment, Transform};
use usvg::{FillRule, Group, LineCap, LineJoin, Node, Paint, PaintOrder, Path, Stroke, Text, Tree};

/// Points of PDF per px of SVG.
const POINTS_PER_PX: f32 = 72.0 / 96.0;

/// Distance in px up to which a glyph is considered to continue the previous run.
const GLYPH_TOLERANCE: f32 = 0.02;

/// Resource name of the font within the document.
const FONT: Name<'static> = Name(b"F");

/// Name of the embedded font. Six letters and `+` before it mark a subset.
const FONT_NAME: Name<'static> = Name(b"PATHBD+DejaVuSans");

/// Height of capital letters and width of stems in thousandths of an em. They are copied from the font's tables, because skrifa does not
/// read those.
const CAP_HEIGHT: f32 = 729.0;
const STEM_WIDTH: f32 = 80.0;

/// The character collection which states that the code of a glyph in a text is its number in the font.
const GLYPH_NUMBERS: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// Writes a document with a page for each tree, in the size of the tree. `font` is the TrueType font with which all texts were laid out;
/// it is embedded as a whole. The metadata (XMP) is written first, so that readers find it near the start of the file.
///
/// # Errors
/// Only if the font cannot be parsed, which is a bug, since it is part of the program.
pub(crate) fn document(trees: &[Tree], font: &[u8], metadata: Option<&str>) -> Result<Vec<u8>, String> {
    let face = FontRef::new(font).map_err(|error| error.to_string())?;
    let mut resources = Resources::default();
    let contents: Vec<Vec<u8>> = trees.iter().map(|tree| content(tree, &face, &mut resources)).collect();
    let mut refs = References(0);
    let mut pdf = Pdf::new();
    let (about, catalogue, all) = (refs.next(), refs.next(), refs.next());
    if let Some(metadata) = metadata {
        pdf.metadata(about, metadata.as_bytes());
    }
    let embedded = embed(&mut pdf, &mut refs, font, &face, &resources.glyphs);
    let states = write_opacities(&mut pdf, &mut refs, &resources);
    let mut pages = Vec::new();
    for (tree, content) in trees.iter().zip(&contents) {
        let (id, stream) = (refs.next(), refs.next());
        let [width, height] = [tree.size().width(), tree.size().height()].map(|px| px * POINTS_PER_PX);
        let mut page = pdf.page(id);
        page.media_box(Rect::new(0.0, 0.0, width, height)).parent(all).contents(stream);
        let mut resources = page.resources();
        resources.fonts().pair(FONT, embedded);
        resources.ext_g_states().pairs(states.iter().map(|(name, state)| (Name(name.as_bytes()), *state)));
        resources.finish();
        page.finish();
        pdf.stream(stream, content).filter(Filter::FlateDecode);
        pages.push(id);
    }
    pdf.pages(all).count(signed(pages.len())).kids(pages);
    let mut catalogue = pdf.catalog(catalogue);
    catalogue.pages(all);
    if metadata.is_some() {
        catalogue.metadata(about);
    }
    catalogue.finish();
    Ok(pdf.finish())
}

/// Allocator for the numbers of PDF objects.
struct References(i32);

impl References {
    fn next(&mut self) -> Ref {
        self.0 += 1;
        Ref::new(self.0)
    }
}

/// Resources shared by the pages of a document.
#[derive(Default)]
struct Resources {
    /// The glyphs used, each with the characters that it stands for.
    glyphs: BTreeMap<u16, String>,
    /// The opacities used, by the bits of their values.
    opacities: BTreeMap<u32, f32>,
}

/// The drawing instructions of a page under construction.
struct Page<'a> {
    content: Content,
    resources: &'a mut Resources,
    face: &'a FontRef<'a>,
}

/// Returns the compressed drawing instructions for a tree.
fn content(tree: &Tree, face: &FontRef<'_>, resources: &mut Resources) -> Vec<u8> {
    let mut page = Page { content: Content::new(), resources, face };
    // The y axis of PDF points up.
    page.content.transform([
        POINTS_PER_PX,
        0.0,
        0.0,
        -POINTS_PER_PX,
        0.0,
        tree.size().height() * POINTS_PER_PX,
    ]);
    page.group(tree.root());
    compressed(&page.content.finish())
}

impl Page<'_> {
    fn group(&mut self, group: &Group) {
        self.content.save_state();
        self.content.transform(matrix(group.transform()));
        if let Some(clip) = group.clip_path() {
            for node in clip.root().children() {
                if let Node::Path(path) = node {
                    self.outline(path);
                }
            }
            self.content.clip_nonzero().end_path();
        }
        for node in group.children() {
            match node {
                Node::Group(inner) => self.group(inner),
                Node::Path(path) => self.path(path),
                Node::Text(text) => self.text(text),
                // No picture of this crate contains an image.
                Node::Image(_) => {}
            }
        }
        self.content.restore_state();
    }

    fn path(&mut self, path: &Path) {
        if !path.is_visible() {
            return;
        }
        if let Some(fill) = path.fill() {
            self.set_fill(fill.paint(), fill.opacity().get());
            self.outline(path);
            match fill.rule() {
                FillRule::NonZero => self.content.fill_nonzero(),
                FillRule::EvenOdd => self.content.fill_even_odd(),
            };
        }
        if let Some(stroke) = path.stroke() {
            self.set_stroke(stroke);
            self.outline(path);
            self.content.stroke();
        }
    }

    fn outline(&mut self, path: &Path) {
        let mut last = (0.0, 0.0);
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(to) => {
                    self.content.move_to(to.x, to.y);
                    last = (to.x, to.y);
                }
                PathSegment::LineTo(to) => {
                    self.content.line_to(to.x, to.y);
                    last = (to.x, to.y);
                }
                PathSegment::QuadTo(control, to) => {
                    let towards = |from: f32, to: f32| from + (to - from) * 2.0 / 3.0;
                    self.content.cubic_to(
                        towards(last.0, control.x),
                        towards(last.1, control.y),
                        towards(to.x, control.x),
                        towards(to.y, control.y),
                        to.x,
                        to.y,
                    );
                    last = (to.x, to.y);
                }
                PathSegment::CubicTo(first, second, to) => {
                    self.content.cubic_to(first.x, first.y, second.x, second.y, to.x, to.y);
                    last = (to.x, to.y);
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    /// Writes a text. If the text has a halo, the halo is drawn first and hidden from searches, which would otherwise find the text twice.
    fn text(&mut self, text: &Text) {
        for span in text.layouted().iter().filter(|span| span.visible) {
            if let (Some(stroke), PaintOrder::StrokeAndFill) = (&span.stroke, span.paint_order) {
                self.content
                    .begin_marked_content_with_properties(Name(b"Span"))
                    .properties()
                    .actual_text(TextStr(""));
                self.set_stroke(stroke);
                self.glyphs(span, TextRenderingMode::Stroke);
                self.content.end_marked_content();
            }
            if let Some(fill) = &span.fill {
                self.set_fill(fill.paint(), fill.opacity().get());
                self.glyphs(span, TextRenderingMode::Fill);
            }
        }
    }

    /// Writes the glyphs of a span. A glyph that begins where the previous one ends is written in the same run.
    fn glyphs(&mut self, span: &Span, mode: TextRenderingMode) {
        let size = span.font_size.get();
        let metrics = self.face.glyph_metrics(Size::new(size), LocationRef::default());
        let em = size / f32::from(self.face.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        self.content.begin_text().set_font(FONT, size).set_text_rendering_mode(mode);
        let mut run: Vec<u8> = Vec::new();
        let mut next: Option<Transform> = None;
        for glyph in &span.positioned_glyphs {
            let Ok(id) = u16::try_from(glyph.id.0) else { continue };
            let place = glyph.transform().pre_scale(1.0 / em, -1.0 / em);
            let continues = next.is_some_and(|next| {
                (next.tx - place.tx).abs() < GLYPH_TOLERANCE && (next.ty - place.ty).abs() < GLYPH_TOLERANCE
            });
            if !continues {
                self.show_run(&mut run);
                self.content.set_text_matrix(matrix(place));
            }
            run.extend(id.to_be_bytes());
            self.resources.glyphs.entry(id).or_insert_with(|| glyph.text.clone());
            let advance = metrics.advance_width(skrifa::GlyphId::from(id)).unwrap_or_default();
            next = Some(place.pre_translate(advance, 0.0));
        }
        self.show_run(&mut run);
        self.content.end_text();
    }

    fn show_run(&mut self, run: &mut Vec<u8>) {
        if !run.is_empty() {
            self.content.show(Str(run));
            run.clear();
        }
    }

    fn set_fill(&mut self, paint: &Paint, opacity: f32) {
        let [red, green, blue] = color(paint);
        self.set_opacity(opacity);
        self.content.set_fill_rgb(red, green, blue);
    }

    fn set_stroke(&mut self, stroke: &Stroke) {
        let [red, green, blue] = color(stroke.paint());
        self.set_opacity(stroke.opacity().get());
        self.content.set_stroke_rgb(red, green, blue).set_line_width(stroke.width().get());
        self.content.set_line_cap(match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        self.content.set_line_join(match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        });
        self.content.set_miter_limit(stroke.miterlimit().get());
        let dashes = stroke.dasharray().unwrap_or_default();
        self.content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
    }

    fn set_opacity(&mut self, opacity: f32) {
        self.resources.opacities.insert(opacity.to_bits(), opacity);
        self.content.set_parameters(Name(opacity_name(opacity.to_bits()).as_bytes()));
    }
}

/// Writes a graphics state for each opacity, and returns the names of the states.
fn write_opacities(pdf: &mut Pdf, refs: &mut References, resources: &Resources) -> Vec<(String, Ref)> {
    let state = |(bits, opacity): (&u32, &f32)| {
        let id = refs.next();
        pdf.ext_graphics(id).stroking_alpha(*opacity).non_stroking_alpha(*opacity);
        (opacity_name(*bits), id)
    };
    resources.opacities.iter().map(state).collect()
}

fn opacity_name(bits: u32) -> String {
    format!("O{bits:x}")
}

/// Embeds the font, with the widths and characters of the glyphs used.
fn embed(
    pdf: &mut Pdf,
    refs: &mut References,
    font: &[u8],
    face: &FontRef<'_>,
    glyphs: &BTreeMap<u16, String>,
) -> Ref {
    let [id, cid, descriptor, data, characters] = std::array::from_fn(|_| refs.next());
    pdf.type0_font(id)
        .base_font(FONT_NAME)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(cid)
        .to_unicode(characters);
    // PDF measures glyphs in thousandths of an em.
    let size = Size::new(1000.0);
    let widths = face.glyph_metrics(size, LocationRef::default());
    let mut writer = pdf.cid_font(cid);
    writer
        .subtype(CidFontType::Type2)
        .base_font(FONT_NAME)
        .system_info(GLYPH_NUMBERS)
        .font_descriptor(descriptor)
        .default_width(0.0)
        .cid_to_gid_map_predefined(Name(b"Identity"));
    let mut each = writer.widths();
    for glyph in glyphs.keys() {
        each.consecutive(*glyph, widths.advance_width(skrifa::GlyphId::from(*glyph)));
    }
    each.finish();
    writer.finish();
    let metrics = face.metrics(size, LocationRef::default());
    let bounds = metrics.bounds.unwrap_or_default();
    pdf.font_descriptor(descriptor)
        .name(FONT_NAME)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max))
        .italic_angle(0.0)
        .ascent(metrics.ascent)
        .descent(metrics.descent)
        .cap_height(CAP_HEIGHT)
        .stem_v(STEM_WIDTH)
        .font_file2(data);
    pdf.stream(data, &compressed(font))
        .filter(Filter::FlateDecode)
        .pair(Name(b"Length1"), signed(font.len()));
    let mut map = UnicodeCmap::new(Name(b"Custom"), GLYPH_NUMBERS);
    for (glyph, text) in glyphs {
        map.pair_with_multiple(*glyph, text.chars());
    }
    pdf.cmap(characters, &map.finish());
    id
}

fn matrix(transform: Transform) -> [f32; 6] {
    [transform.sx, transform.ky, transform.kx, transform.sy, transform.tx, transform.ty]
}

fn color(paint: &Paint) -> [f32; 3] {
    match paint {
        Paint::Color(color) => [color.red, color.green, color.blue].map(|part| f32::from(part) / 255.0),
        // No picture of this crate contains a gradient or a pattern.
        _ => [0.0; 3],
    }
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).expect("writing to memory succeeds")
}

fn signed(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}
