//! Draws pages with positioned items as SVG.

use pathbuild_diagnostic::Lang;

use super::blocks;
use super::data::{PAPER, Sheet, UNITS_PER_MM};
use super::flow::{Block, Column, Item, LETTER_SIZE, MAX_PICTURE_HEIGHT, lay_out};
use super::picture::{self, PlacedPicture};
use crate::scene::Point;
use crate::svg::canvas::{Anchor, Canvas, INK_COLOUR, TEXT_COLOUR, svg_number, text_width, wrap_text};

/// Size of a page and its margins, in units.
pub(super) const SIZE: Point = [PAPER[0] * UNITS_PER_MM, PAPER[1] * UNITS_PER_MM];
pub(super) const LEFT_EDGE: f64 = 39.0;
pub(super) const RIGHT_EDGE: f64 = SIZE[0] - 33.0;
const TOP_MARGIN: f64 = 36.0;
const FOOTER_TOP: f64 = SIZE[1] - 30.0;
const BOTTOM_EDGE: f64 = FOOTER_TOP - 16.0;

/// Top of the text below the title, in units.
const TEXT_TOP: f64 = TOP_MARGIN + 32.0;

/// Space between the columns of the first page, in units.
const GUTTER: f64 = 18.0;

/// Minimum space for starting a table on the first page, in units.
const MIN_TABLE_HEIGHT: f64 = 90.0;

/// Share of the first page's width for the checklist.
const CHECKLIST_SHARE: f64 = 0.54;

#[derive(Debug, Default)]
pub(super) struct Page {
    pub(super) items: Vec<Item>,
    pub(super) picture: Option<PlacedPicture>,
}

/// Returns the pages of a setup sheet, each as an SVG file.
pub(crate) fn sheet_pages(sheet: &Sheet, lang: Lang) -> Vec<String> {
    let pages = pages(sheet, lang);
    let count = pages.len();
    let drawn = pages.iter().enumerate().map(|(index, page)| {
        let text = page.draw(sheet, lang, index, count);
        if index == 0 {
            return text;
        }
        // Several pages may be joined in one document, where ids must be unique. Quotes within texts are escaped, so these replacements do
        // not change texts.
        let number = index + 1;
        text.replace("id=\"", &format!("id=\"p{number}-")).replace("url(#", &format!("url(#p{number}-"))
    });
    drawn.collect()
}

pub(super) fn pages(sheet: &Sheet, lang: Lang) -> Vec<Page> {
    let mut first = Page::default();
    let placed = picture::first_page_picture(
        sheet,
        Column::new([LEFT_EDGE, TEXT_TOP], [RIGHT_EDGE, TEXT_TOP + MAX_PICTURE_HEIGHT]),
    );
    let top = placed.bottom() + 6.0;
    let is_whole = placed.is_whole();
    first.picture = Some(placed);
    let middle = LEFT_EDGE + (RIGHT_EDGE - LEFT_EDGE) * CHECKLIST_SHARE;
    let left = Column::new([LEFT_EDGE, top], [middle, BOTTOM_EDGE]);
    let right = Column::new([middle + GUTTER, top], [RIGHT_EDGE, BOTTOM_EDGE]);
    let (checks, facts) = (blocks::checklist(sheet, lang), blocks::facts(sheet, lang));
    let mut rest: Vec<Block> = Vec::new();
    let mut below = top;
    for (blocks, column) in [(&checks, left), (&facts, right)] {
        let (open, bottom) = lay_out(blocks, column, &mut first.items);
        rest.extend_from_slice(open);
        below = below.max(bottom);
    }
    let has_room = rest.is_empty() && below + MIN_TABLE_HEIGHT < BOTTOM_EDGE;
    rest.extend(blocks::tables(sheet, lang));
    let mut rest: &[Block] = &rest;
    if has_room {
        let column = Column::new([LEFT_EDGE, below + 12.0], [RIGHT_EDGE, BOTTOM_EDGE]);
        rest = lay_out(rest, column, &mut first.items).0;
    }
    let whole_page = Column::new([LEFT_EDGE, TEXT_TOP], [RIGHT_EDGE, BOTTOM_EDGE]);
    let mut pages = vec![first];
    while !rest.is_empty() {
        let mut page = Page::default();
        rest = lay_out(rest, whole_page, &mut page.items).0;
        pages.push(page);
    }
    let larger = if is_whole { None } else { picture::larger_picture(sheet, whole_page) };
    let pictures = larger.into_iter().chain(picture::stock_picture(sheet, whole_page));
    pages.extend(pictures.map(|placed| Page { picture: Some(placed), ..Page::default() }));
    pages
}

impl Page {
    fn draw(&self, sheet: &Sheet, lang: Lang, index: usize, count: usize) -> String {
        let mut canvas = Canvas::paper(PAPER, SIZE);
        if let Some(picture) = &self.picture {
            picture.draw(&mut canvas, sheet, lang);
        }
        for item in title(sheet, lang) {
            item.draw(&mut canvas);
        }
        for item in &self.items {
            item.draw(&mut canvas);
        }
        draw_footer(&mut canvas, sheet, lang, index + 1, count);
        canvas.finish()
    }
}

/// Returns the items of the title: the name of the path or of the joined paths, the drawings, and a rule.
fn title(sheet: &Sheet, lang: Lang) -> Vec<Item> {
    let (size, width) = (20.0, (RIGHT_EDGE - LEFT_EDGE) * 0.62);
    let name = wrap_text(&sheet.title, width, size);
    let name = if name.len() > 1 { format!("{}…", name[0]) } else { name[0].clone() };
    let drawings = sheet.drawings.join(", ");
    let beside = LEFT_EDGE + text_width(&name, size) + 14.0;
    let drawings = lang.choose(format!("drawing {drawings}"), format!("Zeichnung {drawings}"));
    let lines = wrap_text(&drawings, RIGHT_EDGE - beside, LETTER_SIZE);
    let first = if lines.len() > 1 { format!("{}…", lines[0]) } else { lines[0].clone() };
    vec![
        Item::text([LEFT_EDGE, TOP_MARGIN + 14.0], size, &name).bold(),
        Item::text([beside, TOP_MARGIN + 14.0], LETTER_SIZE, &first),
        Item::rule([LEFT_EDGE, TOP_MARGIN + 21.0], [RIGHT_EDGE, TOP_MARGIN + 21.0]),
    ]
}

/// Draws the page footer: identification in case the pages get separated, and a ruler for checking the scale of the print.
fn draw_footer(canvas: &mut Canvas, sheet: &Sheet, lang: Lang, number: usize, count: usize) {
    let page = lang.choose(format!("page {number} of {count}"), format!("Seite {number} von {count}"));
    let text = format!("{} · {page}", sheet.hashes);
    canvas.text([LEFT_EDGE, FOOTER_TOP + 8.0], 9.0, Anchor::Start, &format!("fill=\"{TEXT_COLOUR}\""), &text);
    let ruler = lang.choose("50 mm, when printed at 100 %", "50 mm, wenn mit 100 % gedruckt");
    let end = RIGHT_EDGE - 50.0 * UNITS_PER_MM;
    let y = FOOTER_TOP + 4.0;
    canvas.path(
        &format!(
            "M{l} {t}V{b}M{l} {y}H{r}M{r} {t}V{b}",
            l = svg_number(end),
            r = svg_number(RIGHT_EDGE),
            t = svg_number(y - 4.0),
            b = svg_number(y + 4.0),
            y = svg_number(y)
        ),
        &format!("fill=\"none\" stroke=\"{INK_COLOUR}\""),
    );
    let style = format!("fill=\"{TEXT_COLOUR}\" text-anchor=\"end\"");
    canvas.text([end - 6.0, FOOTER_TOP + 8.0], 9.0, Anchor::Start, &style, ruler);
}
