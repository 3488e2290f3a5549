//! The text form of drawings. The README.md of this crate describes it for authors.

mod cursor;
mod modifiers;
mod shapes;

use crate::draw::model::{
    Change, Entity, Layer, LayerState, LineEnds, Options, Pair, Part, Point, Shape, TextEncoding, Version,
};
use crate::draw::{Block, Draft, DrawError, Sheet};
use crate::surroundings::finish;
use cursor::{Cursor, Parsed, ParsedEntities, choice};
use modifiers::note_kind;
use shapes::{declare_line_type, required_line_type};

pub(crate) use cursor::tokens;

/// Parses a drawing in text form.
///
/// # Errors
/// All errors in the text, each with its line and column.
pub fn sheet(text: &str) -> Result<Sheet, Vec<DrawError>> {
    let mut parser = Parser::default();
    for (number, line) in (1..).zip(text.lines()) {
        parser.line(line, number);
    }
    let (draft, furniture) = parser.finish()?;
    finish(draft, furniture)
}

const STATES: [(&str, LayerState); 4] = [
    ("off", LayerState::Off),
    ("frozen", LayerState::Frozen),
    ("locked", LayerState::Locked),
    ("unlisted", LayerState::Unlisted),
];

#[derive(Debug, Default)]
struct Parser {
    draft: Draft,
    /// The seed of the surroundings of the path, if there are any.
    furniture: Option<u64>,
    errors: Vec<DrawError>,
    /// The block being defined, with its line.
    block: Option<(Block, u32)>,
    /// The raw entity being read, with its line.
    raw: Option<(Vec<Pair>, u32)>,
    /// The end of the previous entity.
    last: Option<Point>,
    /// Whether the previous line drew an entity that `set` can change.
    has_entity: bool,
}

impl Parser {
    /// Parses the line with this number, and collects its errors.
    pub(crate) fn line(&mut self, line: &str, number: u32) {
        let result = match self.raw.take() {
            Some((pairs, begun)) => self.raw_line(line, number, pairs, begun),
            None => {
                tokens(line, number).and_then(|tokens| self.statement(Cursor::new(tokens, number, self.last)))
            }
        };
        self.errors.extend(result.err());
    }

    /// Returns the whole drawing, and the seed of its surroundings, if there are any.
    pub(crate) fn finish(mut self) -> Result<(Draft, Option<u64>), Vec<DrawError>> {
        if let Some((_, line)) = self.raw {
            self.errors.push(DrawError::new(line, 1, "this `raw` has no `endraw`"));
        }
        if let Some((_, line)) = self.block {
            self.errors.push(DrawError::new(line, 1, "this `block` has no `endblock`"));
        }
        if self.errors.is_empty() { Ok((self.draft, self.furniture)) } else { Err(self.errors) }
    }

    fn statement(&mut self, mut cursor: Cursor) -> Parsed<()> {
        let Some(word) = cursor.peek().map(|token| token.text.clone()) else { return Ok(()) };
        match word.as_str() {
            "layer" => self.layer(&mut cursor)?,
            "block" => self.begin_block(&mut cursor)?,
            "endblock" => self.end_block(&mut cursor)?,
            "raw" => {
                cursor.next("raw")?;
                self.raw = Some((Vec::new(), cursor.line));
            }
            "set" | "unset" => self.change(&mut cursor)?,
            "linetype" => declare_line_type(&mut cursor, &mut self.draft)?,
            _ if is_option(&word) => {
                options_line(&mut cursor, &mut self.draft.options, &mut self.furniture)?;
            }
            _ => self.entity(&mut cursor)?,
        }
        cursor.end()
    }

    fn entity(&mut self, cursor: &mut Cursor) -> Parsed<()> {
        let drawn = match cursor.peek_word() {
            Some("text") => modifiers::text(cursor)?,
            Some("mtext") => modifiers::mtext(cursor)?,
            _ => shapes::shape(cursor, &mut self.draft)?,
        };
        let ParsedEntities { mut entities, end } = drawn;
        modifiers::modifiers(cursor, &mut entities)?;
        for entity in &mut entities {
            entity.line = cursor.line;
        }
        self.last = end.or(self.last);
        self.add(entities);
        Ok(())
    }

    fn add(&mut self, entities: Vec<Entity>) {
        let layer = self.draft.current_layer().to_owned();
        match &mut self.block {
            Some((block, _)) => block.entities.extend(entities.into_iter().map(|entity| Entity {
                layer: entity.layer.clone().or_else(|| Some(layer.clone())),
                ..entity
            })),
            None => _ = self.draft.extend(entities),
        }
        self.has_entity = true;
    }

    fn layer(&mut self, cursor: &mut Cursor) -> Parsed<()> {
        cursor.keyword("layer")?;
        let name = cursor.name("a layer's name")?;
        self.draft.layer(&name);
        let found = self.draft.layers.iter().position(|layer| layer.name == name);
        let mut layer = found.map_or_else(|| Layer::new(&name), |at| self.draft.layers[at].clone());
        while let Some(word) = cursor.peek_word().map(str::to_owned) {
            match word.as_str() {
                "colour" => {
                    cursor.next("colour")?;
                    layer.colour = cursor.integer("colour number from 0 to 255")?;
                }
                word => match STATES.iter().find(|(name, _)| *name == word) {
                    Some((name, state)) => {
                        cursor.keyword(name)?;
                        layer.states.push(*state);
                    }
                    None => layer.line_type = required_line_type(cursor, &mut self.draft)?,
                },
            }
        }
        if let Some(at) = found {
            self.draft.layers[at] = layer;
        }
        Ok(())
    }

    fn begin_block(&mut self, cursor: &mut Cursor) -> Parsed<()> {
        cursor.keyword("block")?;
        let name = cursor.name("a block's name")?;
        if let Some((open, line)) = &self.block {
            return Err(cursor.error(format!("block {:?} of line {line} is still open", open.name)));
        }
        if self.draft.blocks.iter().any(|block| block.name.eq_ignore_ascii_case(&name)) {
            return Err(cursor.error(format!("there is a block {name:?} already")));
        }
        let base = if cursor.take("base") { cursor.point("the base point")? } else { Point::default() };
        self.block = Some((Block { name, base, entities: Vec::new() }, cursor.line));
        Ok(())
    }

    fn end_block(&mut self, cursor: &mut Cursor) -> Parsed<()> {
        cursor.keyword("endblock")?;
        let Some((block, _)) = self.block.take() else {
            return Err(cursor.error("there is no `block` to end"));
        };
        self.draft.blocks.push(block);
        self.has_entity = false;
        Ok(())
    }

    fn change(&mut self, cursor: &mut Cursor) -> Parsed<()> {
        let word = cursor.name("set or unset")?;
        let entities = match &mut self.block {
            Some((block, _)) => &mut block.entities,
            None => &mut self.draft.entities,
        };
        let Some(entity) = entities.last_mut().filter(|_| self.has_entity) else {
            return Err(cursor.error(format!("`{word}` changes the entity before it, and there is none")));
        };
        let code = cursor.integer("group code")?;
        let change = if word == "set" {
            Change::Set(Pair::new(code, cursor.name("a value; in quotation marks if it holds blanks")?))
        } else {
            Change::Unset(code)
        };
        entity.changes.push(change);
        Ok(())
    }

    /// Parses a line of a raw entity: a group code, a space, and the verbatim value.
    fn raw_line(&mut self, line: &str, number: u32, mut pairs: Vec<Pair>, begun: u32) -> Parsed<()> {
        let line = line.trim_start();
        if line.trim_end() == "endraw" {
            let entity = Entity { line: begun, ..Entity::new(Shape::Raw(pairs)) };
            self.add(vec![entity]);
            return Ok(());
        }
        let (code, value) = line.split_once(' ').unwrap_or((line, ""));
        let parsed = code.parse();
        if let Ok(code) = parsed {
            pairs.push(Pair::new(code, value.to_owned()));
        }
        self.raw = Some((pairs, begun));
        parsed.map(|_| ()).map_err(|_| {
            DrawError::new(number, 1, format!("{code:?} is no group code; expected `code value` or `endraw`"))
        })
    }
}

const WORDS: [&str; 11] = [
    "version",
    "codepage",
    "encoding",
    "units",
    "lineends",
    "binary",
    "bom",
    "no",
    "header",
    "notes",
    "furniture",
];

/// Whether this word begins a line with an option for writing the drawing.
fn is_option(word: &str) -> bool {
    WORDS.contains(&word)
}

/// Parses a line with an option for writing the drawing.
fn options_line(cursor: &mut Cursor, options: &mut Options, furniture: &mut Option<u64>) -> Parsed<()> {
    let word = cursor.name("an option")?;
    match word.as_str() {
        "version" => {
            options.version =
                choice(cursor, "a version", &Version::ALL.map(|version| (version.name(), version)))?;
        }
        "codepage" => {
            let name = cursor.name("a code page such as ANSI_1252, or none")?;
            options.code_page = Some(name).filter(|name| name != "none");
        }
        "encoding" => {
            let all = [
                ("proper", TextEncoding::Proper),
                ("utf-8", TextEncoding::Utf8),
                ("escaped", TextEncoding::Escaped),
            ];
            options.encoding = choice(cursor, "an encoding", &all)?;
        }
        "units" => options.units = units(cursor)?,
        "lineends" => {
            let all = [("crlf", LineEnds::CrLf), ("lf", LineEnds::Lf), ("cr", LineEnds::Cr)];
            options.line_ends = choice(cursor, "line ends", &all)?;
        }
        "binary" => options.binary = true,
        "bom" => options.byte_order_mark = true,
        "no" => options.left_out.push(part(cursor)?),
        "header" => {
            let name = cursor.name("a variable such as $LTSCALE")?;
            let code = cursor.integer("group code")?;
            options.header.push((name, Pair::new(code, cursor.name("a value")?)));
        }
        "notes" => notes(cursor, options)?,
        _ => {
            let has_seed = cursor.is_at_number();
            *furniture = Some(if has_seed { cursor.integer("seed, a whole number")? } else { 0 });
        }
    }
    Ok(())
}

/// Parses $INSUNITS, given by name or number.
fn units(cursor: &mut Cursor) -> Parsed<Option<i16>> {
    if cursor.is_at_number() {
        return cursor.integer("number of $INSUNITS").map(Some);
    }
    let all = [
        ("none", Some(0)),
        ("inch", Some(1)),
        ("mm", Some(4)),
        ("cm", Some(5)),
        ("m", Some(6)),
        ("missing", None),
    ];
    choice(cursor, "a unit", &all)
}

fn part(cursor: &mut Cursor) -> Parsed<Part> {
    let all = [
        ("header", Part::Header),
        ("tables", Part::Tables),
        ("blocks", Part::Blocks),
        ("objects", Part::Objects),
        ("handles", Part::Handles),
        ("eof", Part::Eof),
    ];
    choice(cursor, "a part of the file", &all)
}

/// Parses `notes [as text|mtext] [height H]`.
fn notes(cursor: &mut Cursor, options: &mut Options) -> Parsed<()> {
    if cursor.take("as") {
        options.note_kind = note_kind(cursor)?;
    }
    if cursor.take("height") {
        options.note_height = cursor.length("the height of letters")?;
    }
    Ok(())
}
