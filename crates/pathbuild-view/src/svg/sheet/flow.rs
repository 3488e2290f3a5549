//! Arranges blocks of text in columns and on pages.

use crate::scene::Point;
use crate::svg::canvas::{Anchor, Canvas, INK_COLOUR, OTHER_COLOUR, wrap_text};

/// Letter size and line height in units of the page.
pub(super) const LETTER_SIZE: f64 = 10.0;
pub(super) const LINE_HEIGHT: f64 = 13.5;

/// Maximum height, in units of the page, of the picture on the first page. The rest is for checklist and facts.
pub(super) const MAX_PICTURE_HEIGHT: f64 = 440.0;

/// Space above a heading and below a block, in units of the page.
const SPACE_ABOVE_HEADING: f64 = 8.0;
const SPACE_BELOW_BLOCK: f64 = 2.5;

/// Indentation of a checklist's text, which is to the right of the boxes, in units of the page.
const INDENT: f64 = 17.0;

/// Share of a column's width for the name in a [`Block::Fact`].
const NAME_SHARE: f64 = 0.45;

/// Space between two cells of a row, in units of the page.
const CELL_GAP: f64 = 6.0;

/// A block of text, which is never split between columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Block {
    /// A heading for the blocks that follow.
    Heading(String),
    /// A step of the checklist, with a box to tick.
    Check(String),
    /// A name and a value.
    Fact(String, String),
    /// A row of a table. `shares` are the fractions of the width for its cells. On each new page, the table begins with the title
    /// `continued` and the row `head`.
    Row { cells: Vec<String>, shares: &'static [f64], head: Vec<String>, continued: String },
}

/// An area of a page that blocks fill from top to bottom, in units of the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub(super) left: f64,
    pub(super) width: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

/// Lays out as many blocks as a column holds. Returns the remaining blocks, and the lower edge of the last block laid out. At least one
/// block is laid out, so that the layout terminates.
pub(super) fn lay_out<'b>(blocks: &'b [Block], column: Column, items: &mut Vec<Item>) -> (&'b [Block], f64) {
    let mut y = column.top;
    let mut head: Option<&[String]> = None;
    for (index, block) in blocks.iter().enumerate() {
        let mut laid = Vec::new();
        let below = block.lay_out_with_head(head, column, y, index == 0, &mut laid);
        if let Block::Row { head: own, .. } = block {
            head = Some(own);
        }
        // A heading must not be separated from the block that follows.
        let room = match (block, blocks.get(index + 1)) {
            (Block::Heading(_), Some(next)) => next
                .lay_out_with_head(head, column, below, false, &mut Vec::new())
                .max(below + 3.0 * LINE_HEIGHT),
            _ => below,
        };
        if room > column.bottom && index > 0 {
            return (&blocks[index..], y);
        }
        items.append(&mut laid);
        y = below;
    }
    (&[], y)
}

impl Block {
    /// Lays out this block below `top`. A row of a table whose head is not `head` comes below its own head, and at the top of a column also below the
    /// title of the table. Returns the lower edge.
    fn lay_out_with_head(
        &self,
        head: Option<&[String]>,
        column: Column,
        top: f64,
        is_first: bool,
        items: &mut Vec<Item>,
    ) -> f64 {
        let mut below = top;
        if let Self::Row { shares, head: own, continued, .. } = self
            && head != Some(own)
        {
            if is_first {
                below = heading(continued, column, below, true, items);
            }
            below = row(own, shares, column, below, true, items);
        }
        self.lay_out_below(column, below, is_first, items)
    }

    /// Lays out this block below `top`. Returns its lower edge.
    fn lay_out_below(&self, column: Column, top: f64, is_first: bool, items: &mut Vec<Item>) -> f64 {
        match self {
            Self::Heading(text) => heading(text, column, top, is_first, items),
            Self::Check(text) => {
                items.push(Item::Tick([column.left, top + 1.0]));
                lines(text, column.left + INDENT, column.width - INDENT, top, items) + SPACE_BELOW_BLOCK
            }
            Self::Fact(name, value) => {
                let names = column.width * NAME_SHARE;
                let left = lines(name, column.left, names - CELL_GAP, top, items);
                let right = lines(value, column.left + names, column.width - names, top, items);
                left.max(right)
            }
            Self::Row { cells, shares, .. } => row(cells, shares, column, top, false, items),
        }
    }
}

/// Lays out a heading below `top`. Returns its lower edge.
fn heading(text: &str, column: Column, top: f64, is_first: bool, items: &mut Vec<Item>) -> f64 {
    let y = top + if is_first { 0.0 } else { SPACE_ABOVE_HEADING } + LETTER_SIZE;
    items.push(Item::text([column.left, y], LETTER_SIZE + 1.0, text).bold());
    let line = y + 3.5;
    items.push(Item::rule([column.left, line], [column.left + column.width, line]));
    line + 4.0
}

/// Lays out a row of a table. Returns its lower edge.
fn row(
    cells: &[String],
    shares: &[f64],
    column: Column,
    top: f64,
    is_head: bool,
    items: &mut Vec<Item>,
) -> f64 {
    let mut left = column.left;
    let mut bottom = top + LINE_HEIGHT;
    let first = items.len();
    for (cell, share) in cells.iter().zip(shares) {
        let width = share * column.width;
        bottom = bottom.max(lines(cell, left, width - CELL_GAP, top + 3.0, items));
        left += width;
    }
    if is_head {
        items[first..].iter_mut().for_each(Item::make_bold);
    }
    bottom += 3.5;
    items.push(Item::rule([column.left, bottom], [column.left + column.width, bottom]));
    bottom
}

/// Lays out the lines of a text below `top`. Returns the lower edge of the last line.
fn lines(text: &str, left: f64, width: f64, top: f64, items: &mut Vec<Item>) -> f64 {
    let mut y = top;
    for line in wrap_text(text, width, LETTER_SIZE) {
        items.push(Item::text([left, y + LETTER_SIZE], LETTER_SIZE, &line));
        y += LINE_HEIGHT;
    }
    y
}

impl Column {
    pub(super) fn new([left, top]: Point, [right, bottom]: Point) -> Self {
        Self { left, width: right - left, top, bottom }
    }
}

/// An item with a fixed position on a page.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Item {
    Text {
        at: Point,
        size: f64,
        text: String,
        is_bold: bool,
    },
    Rule {
        from: Point,
        to: Point,
    },
    /// A box to tick, given by its upper left corner.
    Tick(Point),
}

impl Item {
    pub(super) fn text(at: Point, size: f64, text: &str) -> Self {
        Self::Text { at, size, text: text.to_owned(), is_bold: false }
    }

    pub(super) fn rule(from: Point, to: Point) -> Self {
        Self::Rule { from, to }
    }

    pub(super) fn bold(mut self) -> Self {
        self.make_bold();
        self
    }

    fn make_bold(&mut self) {
        if let Self::Text { is_bold, .. } = self {
            *is_bold = true;
        }
    }

    pub(super) fn draw(&self, canvas: &mut Canvas) {
        match self {
            Self::Text { at, size, text, is_bold } => {
                let weight = if *is_bold { " font-weight=\"bold\"" } else { "" };
                canvas.text(*at, *size, Anchor::Start, &format!("fill=\"{INK_COLOUR}\"{weight}"), text);
            }
            Self::Rule { from, to } => {
                canvas.line(*from, *to, &format!("stroke=\"{OTHER_COLOUR}\" stroke-width=\"0.8\""));
            }
            Self::Tick(at) => {
                canvas.rect(*at, [10.0, 10.0], &format!("fill=\"none\" stroke=\"{INK_COLOUR}\""));
            }
        }
    }
}
