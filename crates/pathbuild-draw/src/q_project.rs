//! Draws Q-projects: rows of subpath segments, each with its text. (book: language/q-projects)

use dxf::entities::{
    Arc as CrateArc, Circle as CrateCircle, Entity, EntityType, Line as CrateLine, MText as CrateMText,
};
use dxf::enums::{AcadVersion, AttachmentPoint};
use dxf::{Drawing, Point as CratePoint};
use encoding_rs::WINDOWS_1252;

use crate::geometry::{Arc, Circle, Line, Point};
use crate::pairs::{
    CHUNK, Pair, Record, StringPlaceholders, ascii, chunks, identify, kind, records, reduce_mtext,
    remove_unwanted_pairs, value,
};
use crate::text_positions::{
    Candidate, ElementPart, LETTER_HEIGHT, TextPositions, TextSize, letter_heights, no_space_message,
};

/// Distance in mm between the end of a segment and the start of the next.
const SEGMENT_GAP: f64 = 20.0;

/// Distance in mm between the ends of a path below which the path is considered closed.
const CLOSED_TOLERANCE: f64 = 1e-3;

/// Radius in mm of the circle that represents a closed path, since a line without length could not have a text.
const CLOSED_PATH_RADIUS: f64 = 5.0;

/// Vertical distance in mm between the starts of consecutive paths.
const ROW_SPACING: f64 = 60.0;

/// A path to be drawn that embeds others.
#[derive(Clone, Debug)]
pub struct EmbeddingPath<'a> {
    /// Name of the layer, which is also the path's name.
    pub layer: &'a str,
    /// The parameter text at the start marker.
    pub parameters: &'a str,
    /// The subpath segments: length in mm, and parameter text.
    pub segments: Vec<(f64, &'a str)>,
}

/// Draws paths that embed others, as DXF. Each path is a row to the right; the first starts at (0, 0), and each further one below the previous one.
///
/// # Errors
/// The texts for which there is no room beside their elements.
pub fn q_project(paths: &[EmbeddingPath<'_>]) -> Result<Vec<u8>, Vec<String>> {
    let mut elements = Vec::new();
    let mut start = Point::new(0.0, 0.0);
    for path in paths {
        add_row(&mut elements, path, start);
        start = start - Point::new(0.0, ROW_SPACING);
    }
    let mut layers = vec!["0"];
    for path in paths {
        // Names of layers are not case-sensitive.
        if !layers.iter().any(|layer| layer.to_lowercase() == path.layer.to_lowercase()) {
            layers.push(path.layer);
        }
    }
    Ok(to_dxf(&layers, &elements, &place_texts(&elements)?))
}

struct Element<'a> {
    shape: ElementPart,
    layer: &'a str,
    line_type: &'static str,
    /// The element's parameter text, which may be empty; `None` if the element takes none.
    text: Option<&'a str>,
}

struct PlacedText<'a> {
    text: &'a str,
    /// The upper left corner of the text.
    corner: Point,
    /// The height of the letters in mm.
    height: f64,
}

fn add_row<'a>(elements: &mut Vec<Element<'a>>, path: &EmbeddingPath<'a>, start: Point) {
    let mut add =
        |shape, line_type, text| elements.push(Element { shape, layer: path.layer, line_type, text });
    let line = |from, to| ElementPart::Line(Line { from, to });
    add(ElementPart::Circle(Circle { centre: start, radius: 0.5 }), "PHANTOM", Some(path.parameters));
    let mut at = start;
    for (index, (length, text)) in path.segments.iter().enumerate() {
        if index > 0 {
            let next = at + Point::new(SEGMENT_GAP, 0.0);
            add(line(at, next), "HIDDEN", None);
            at = next;
        }
        let (segment, end) = segment(at, *length);
        add(segment, "DASHDOT", Some(*text));
        at = end;
    }
    add(ElementPart::Circle(Circle { centre: at, radius: 1.0 }), "PHANTOM", None);
}

/// Creates a segment that begins at a point, and returns it with its end point. For a closed path the segment is a full circle.
fn segment(from: Point, length: f64) -> (ElementPart, Point) {
    if length < CLOSED_TOLERANCE {
        let centre = from + Point::new(0.0, CLOSED_PATH_RADIUS);
        return (
            ElementPart::Arc(Arc { centre, radius: CLOSED_PATH_RADIUS, start: 270.0, end: 270.0 }),
            from,
        );
    }
    let to = from + Point::new(length, 0.0);
    (ElementPart::Line(Line { from, to }), to)
}

/// Determines the positions of the texts, one entry for each element.
fn place_texts<'a>(elements: &[Element<'a>]) -> Result<Vec<Option<PlacedText<'a>>>, Vec<String>> {
    let candidate = |(index, element): (usize, &Element<'_>)| Candidate {
        entity: Some(index),
        layer: element.layer.trim().to_lowercase(),
        takes_text: element.text.is_some(),
        pieces: vec![element.shape],
    };
    let candidates: Vec<Candidate> = elements.iter().enumerate().map(candidate).collect();
    let mut positions = TextPositions::new(&candidates);
    let mut errors = Vec::new();
    let mut placed = Vec::new();
    for (index, element) in elements.iter().enumerate() {
        let text = element.text.filter(|text| !text.is_empty());
        placed.push(text.and_then(|text| {
            let lines: Vec<&str> = text.split('\n').collect();
            let extent = |height| TextSize::of_mtext(&lines, height);
            let position = positions.find_position(
                index,
                &candidates[index].layer,
                &letter_heights(LETTER_HEIGHT),
                extent,
            );
            if position.is_none() {
                errors.push(no_space_message(&escaped(text)));
            }
            let (centre, extent, height) = position?;
            let corner = Point::new(centre.x - extent.width / 2.0, centre.y + extent.height / 2.0);
            Some(PlacedText { text, corner, height })
        }));
    }
    if errors.is_empty() { Ok(placed) } else { Err(errors) }
}

/// The drawing around the layers and entities, as the crate `dxf` writes it for R2000 after corrections. `#n` is the nth handle after those
/// of the entities, `#+n` the nth after those of entities and layers.
const DXF_TEMPLATE: &str = include_str!("frame.txt");

/// Handle of the first entity.
const FIRST_HANDLE: u64 = 0x100;

/// The numbers in [`DXF_TEMPLATE`] of the handles of the first layer, of the plot style of layers, of the table of layers, and of model space, which
/// is numbered after the layers.
const FIRST_LAYER_HANDLE: u64 = 31;
const PLOT_STYLE_HANDLE: u64 = 10;
const LAYER_TABLE_HANDLE: u64 = 30;
const MODEL_SPACE_HANDLE: u64 = 40;

fn to_dxf(layers: &[&str], elements: &[Element<'_>], texts: &[Option<PlacedText<'_>>]) -> Vec<u8> {
    let mut placeholders = StringPlaceholders::default();
    let written = entities(elements, texts, &mut placeholders);
    let after_entities = FIRST_HANDLE + (elements.len() + texts.iter().flatten().count()) as u64;
    let after_layers = after_entities + layers.len() as u64;
    let number = |text: &str| text.parse::<u64>().unwrap_or_default();
    let mut pairs = Vec::new();
    for pair in records(DXF_TEMPLATE).into_iter().flatten() {
        match pair.value.strip_prefix('#') {
            None => pairs.push(pair),
            Some("count") => pairs.push(Pair::integer(70, i64::try_from(layers.len()).unwrap_or_default())),
            Some("layers") => {
                let handles = after_entities + FIRST_LAYER_HANDLE..;
                pairs.extend(
                    layers.iter().zip(handles).flat_map(|(name, handle)| layer(name, handle, after_entities)),
                );
            }
            Some("entities") => {
                let owner = after_layers + MODEL_SPACE_HANDLE;
                pairs.extend(entity_pairs(&written, &placeholders, owner));
            }
            Some(handle) => {
                let handle = match handle.strip_prefix('+') {
                    Some(handle) => after_layers + number(handle),
                    None => after_entities + number(handle),
                };
                pairs.push(Pair::handle(pair.code, handle));
            }
        }
    }
    ascii(&pairs, Some(WINDOWS_1252), b"\r\n")
}

/// Creates the record of a visible layer, CONTINUOUS and white. `after_entities` is the first handle after those of the entities.
fn layer(name: &str, handle: u64, after_entities: u64) -> Record<'_> {
    vec![
        Pair::new(0, "LAYER"),
        Pair::handle(5, handle),
        Pair::handle(330, after_entities + LAYER_TABLE_HANDLE),
        Pair::new(100, "AcDbSymbolTableRecord"),
        Pair::new(100, "AcDbLayerTableRecord"),
        Pair::new(2, name),
        Pair::integer(70, 0),
        Pair::integer(62, 7),
        Pair::new(6, "CONTINUOUS"),
        Pair::new(290, "1"),
        Pair::handle(390, after_entities + PLOT_STYLE_HANDLE),
    ]
}

/// Writes the entities by means of the crate `dxf`: each element is followed by its text.
fn entities(
    elements: &[Element<'_>],
    texts: &[Option<PlacedText<'_>>],
    placeholders: &mut StringPlaceholders,
) -> String {
    let mut drawing = Drawing::new();
    drawing.clear();
    drawing.header.version = AcadVersion::R2000;
    for (element, text) in elements.iter().zip(texts) {
        let mut entity = Entity::new(shape(&element.shape));
        element.line_type.clone_into(&mut entity.common.line_type_name);
        let text = text.as_ref().map(|text| Entity::new(mtext(text, placeholders)));
        for mut entity in std::iter::once(entity).chain(text) {
            entity.common.layer = placeholders.placeholder_for(element.layer);
            entity.common.lineweight_enum_value = -1;
            drawing.add_entity(entity);
        }
    }
    let mut text = Vec::new();
    // Saving to memory without a thumbnail cannot fail.
    _ = drawing.save(&mut text);
    String::from_utf8_lossy(&text).into_owned()
}

fn shape(shape: &ElementPart) -> EntityType {
    let point = |point: Point| CratePoint::new(point.x, point.y, point.z);
    match shape {
        ElementPart::Line(line) => EntityType::Line(CrateLine::new(point(line.from), point(line.to))),
        ElementPart::Arc(arc) => {
            EntityType::Arc(CrateArc::new(point(arc.centre), arc.radius, arc.start, arc.end))
        }
        ElementPart::Circle(circle) => {
            EntityType::Circle(CrateCircle::new(point(circle.centre), circle.radius))
        }
    }
}

fn mtext(placed: &PlacedText<'_>, placeholders: &mut StringPlaceholders) -> EntityType {
    let mut chunks = chunks(&escaped(placed.text), CHUNK);
    let last = chunks.pop().unwrap_or_default();
    EntityType::MText(CrateMText {
        insertion_point: CratePoint::new(placed.corner.x, placed.corner.y, 0.0),
        initial_text_height: placed.height,
        reference_rectangle_width: 0.0,
        attachment_point: AttachmentPoint::TopLeft,
        extended_text: chunks.iter().map(|chunk| placeholders.placeholder_for(chunk)).collect(),
        text: placeholders.placeholder_for(&last),
        ..Default::default()
    })
}

/// Returns the entities in the crate's output, corrected, with handles and owner.
fn entity_pairs<'a>(written: &'a str, placeholders: &'a StringPlaceholders, owner: u64) -> Vec<Pair<'a>> {
    let records = records(written).into_iter();
    let entities = records
        .skip_while(|record| kind(record) != "SECTION" || value(record, 2) != Some("ENTITIES"))
        .skip(1)
        .take_while(|record| kind(record) != "ENDSEC");
    let corrected = entities.zip(FIRST_HANDLE..).flat_map(|(mut record, handle)| {
        placeholders.restore_strings(&mut record);
        remove_unwanted_pairs(&mut record);
        if kind(&record) == "MTEXT" {
            reduce_mtext(&mut record, &[50]);
        }
        identify(&mut record, 5, Some(handle), Some(owner));
        record
    });
    corrected.collect()
}

/// Escapes a text for MTEXT.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' | '{' | '}' => escaped.extend(['\\', character]),
            '\u{a0}' => escaped.push_str("\\~"),
            // Without the blank, a caret would turn the next character into a control character.
            '^' => escaped.push_str("^ "),
            character => escaped.push(character),
        }
    }
    escaped
}
