//! Draws pages with positioned items as SVG.

use pathbuild_diagnostic::Lang;

use super::blocks;
use super::data::{PAPER, Sheet, UNITS, Words};
use super::flow::{Block, Column, Item, LETTERS, PICTURE, lay};
use super::picture::{self, PlacedPicture};
use crate::scene::Point;
use crate::svg::canvas::{Anchor, Canvas, INK, TEXT, n};
use crate::svg::canvas::{breadth, wrapped};

/// Size of a page and its margins, in units.
pub(super) const SIZE: Point = [PAPER[0] * UNITS, PAPER[1] * UNITS];
pub(super) const LEFT: f64 = 39.0;
pub(super) const RIGHT: f64 = SIZE[0] - 33.0;
const TOP_MARGIN: f64 = 36.0;
const FOOT: f64 = SIZE[1] - 30.0;
const BOTTOM: f64 = FOOT - 16.0;

/// Top of the text below the title, in units.
const BELOW_TITLE: f64 = TOP_MARGIN + 32.0;

/// Space between the columns of the first page, in units.
const GUTTER: f64 = 18.0;

/// Minimum space for starting a table on the first page, in units.
const ROOM_FOR_TABLE: f64 = 90.0;

/// Share of the first page's width for the checklist.
const CHECKLIST: f64 = 0.54;

/// A page with the items on it.
#[derive(Debug, Default)]
pub(super) struct Page {
    pub(super) items: Vec<Item>,
    pub(super) picture: Option<PlacedPicture>,
}

/// Returns the pages of a sheet as SVG files.
pub(super) fn drawn(sheet: &Sheet, lang: Lang) -> Vec<String> {
    let pages = pages(sheet, Words(lang));
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

/// Arranges the content of a sheet on pages.
pub(super) fn pages(sheet: &Sheet, words: Words) -> Vec<Page> {
    let mut first = Page::default();
    let placed = picture::first(sheet, Column::new([LEFT, BELOW_TITLE], [RIGHT, BELOW_TITLE + PICTURE]));
    let top = placed.bottom() + 6.0;
    let is_whole = placed.is_whole();
    first.picture = Some(placed);
    let middle = LEFT + (RIGHT - LEFT) * CHECKLIST;
    let left = Column::new([LEFT, top], [middle, BOTTOM]);
    let right = Column::new([middle + GUTTER, top], [RIGHT, BOTTOM]);
    let (checks, facts) = (blocks::checklist(sheet, words), blocks::facts(sheet, words));
    let mut rest: Vec<Block> = Vec::new();
    let mut below = top;
    for (blocks, column) in [(&checks, left), (&facts, right)] {
        let (open, bottom) = lay(blocks, column, &mut first.items);
        rest.extend_from_slice(open);
        below = below.max(bottom);
    }
    let has_room = rest.is_empty() && below + ROOM_FOR_TABLE < BOTTOM;
    rest.extend(blocks::tables(sheet, words));
    let mut rest: &[Block] = &rest;
    if has_room {
        let column = Column::new([LEFT, below + 12.0], [RIGHT, BOTTOM]);
        rest = lay(rest, column, &mut first.items).0;
    }
    let mut pages = vec![first];
    while !rest.is_empty() {
        let mut page = Page::default();
        let column = Column::new([LEFT, BELOW_TITLE], [RIGHT, BOTTOM]);
        rest = lay(rest, column, &mut page.items).0;
        pages.push(page);
    }
    if !is_whole {
        let area = Column::new([LEFT, BELOW_TITLE], [RIGHT, BOTTOM]);
        pages.extend(
            picture::larger(sheet, area).map(|placed| Page { picture: Some(placed), ..Page::default() }),
        );
    }
    let area = Column::new([LEFT, BELOW_TITLE], [RIGHT, BOTTOM]);
    pages.extend(picture::stock(sheet, area).map(|placed| Page { picture: Some(placed), ..Page::default() }));
    pages
}

impl Page {
    fn draw(&self, sheet: &Sheet, lang: Lang, index: usize, count: usize) -> String {
        let mut canvas = Canvas::paper(PAPER, SIZE);
        let words = Words(lang);
        if let Some(picture) = &self.picture {
            picture.draw(&mut canvas, sheet, lang);
        }
        for item in title(sheet, words) {
            item.draw(&mut canvas);
        }
        for item in &self.items {
            item.draw(&mut canvas);
        }
        foot(&mut canvas, sheet, words, index + 1, count);
        canvas.finish()
    }
}

/// Returns the name of the program and its drawings.
fn title(sheet: &Sheet, words: Words) -> Vec<Item> {
    let (size, width) = (20.0, (RIGHT - LEFT) * 0.62);
    let name = wrapped(&sheet.title, width, size);
    let name = if name.len() > 1 { format!("{}…", name[0]) } else { name[0].clone() };
    let drawings = sheet.drawings.join(", ");
    let beside = LEFT + breadth(&name, size) + 14.0;
    let drawings = words.either(format!("drawing {drawings}"), format!("Zeichnung {drawings}"));
    let lines = wrapped(&drawings, RIGHT - beside, LETTERS);
    let first = if lines.len() > 1 { format!("{}…", lines[0]) } else { lines[0].clone() };
    vec![
        Item::text([LEFT, TOP_MARGIN + 14.0], size, &name).bold(),
        Item::text([beside, TOP_MARGIN + 14.0], LETTERS, &first),
        Item::rule([LEFT, TOP_MARGIN + 21.0], [RIGHT, TOP_MARGIN + 21.0]),
    ]
}

/// Draws the page footer: identification in case the pages get separated, and a ruler for checking the scale of the print.
fn foot(canvas: &mut Canvas, sheet: &Sheet, words: Words, number: usize, count: usize) {
    let page = words.either(format!("page {number} of {count}"), format!("Seite {number} von {count}"));
    let text = format!("{} · {page}", sheet.hashes);
    canvas.text([LEFT, FOOT + 8.0], 9.0, Anchor::Start, &format!("fill=\"{TEXT}\""), &text);
    let ruler = words.either("50 mm, when printed at 100 %", "50 mm, wenn mit 100 % gedruckt");
    let end = RIGHT - 50.0 * UNITS;
    let y = FOOT + 4.0;
    canvas.path(
        &format!(
            "M{l} {t}V{b}M{l} {y}H{r}M{r} {t}V{b}",
            l = n(end),
            r = n(RIGHT),
            t = n(y - 4.0),
            b = n(y + 4.0),
            y = n(y)
        ),
        &format!("fill=\"none\" stroke=\"{INK}\""),
    );
    let style = format!("fill=\"{TEXT}\" text-anchor=\"end\"");
    canvas.text([end - 6.0, FOOT + 8.0], 9.0, Anchor::Start, &style, ruler);
}
