//! Reads the entities of a section or block. Numbers are parsed only for entities on wanted layers.

#![expect(
    clippy::inline_always,
    reason = "an entity is made where it ends up, without copies from function to function"
)]

use pathbuild_diagnostic::messages::drawing::{FOREIGN, NOT_APPROXIMATED};
use pathbuild_diagnostic::{EntityKind, Point};
use smol_str::SmolStr;

use crate::block_prefilter::has_noted_text_in;
use crate::encoding::Decoder;
use crate::faults::{EntityError, first_point};
use crate::fields::{Fields, FillDecision, Value};
use crate::groups::Records;
use crate::layers::{LayerId, LayerTable, Layers, LineType, LineTypes};
use crate::pairs::{Pair, Pairs, Stop};
use crate::shapes::{self, Ellipse, Insert, Polyline, PolylineBuilder, Spline};
use crate::{Circle, Geometry, Options, Origin};

/// A reader of entities, with a cache of the layer and line-type names that it has resolved.
pub(crate) struct EntityReader<'a, 'o> {
    pub(crate) options: &'o Options<'o>,
    pub(crate) decoder: Decoder<'a>,
    pub(crate) layers: Layers<'a, 'o>,
    pub(crate) line_types: LineTypes<'a>,
    pub(crate) fields: Fields<'a>,
    /// The BLOCKS section, until it has been searched for texts to note.
    unnoted_blocks: Option<Pairs<'a>>,
    /// Layer of the last insertion. The attributes that follow belong to that insertion.
    last_insertion: Option<LayerId>,
    /// Whether a text on an unwanted layer has been noted. After the first one, no others are tested.
    pub(crate) has_noted_text: bool,
}

/// The space in which entities are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Space {
    Model,
    Block,
}

/// Returns the largest number of repeated groups that is kept per entity.
fn max_repeated_groups(options: &Options<'_>) -> usize {
    options.max_entities.saturating_mul(GROUPS_PER_ENTITY).max(options.max_text)
}

/// Number of groups of a polyline or spline that count as one entity: x, y, two widths, bulge; or x, y, z, weight, knot.
const GROUPS_PER_ENTITY: usize = 5;

impl<'a, 'o> EntityReader<'a, 'o> {
    /// Creates a reader without cached names. `tables` and `blocks` are the sections of these names.
    pub(crate) fn new(
        options: &'o Options<'o>,
        decoder: Decoder<'a>,
        tables: Option<Pairs<'a>>,
        blocks: Option<Pairs<'a>>,
    ) -> Self {
        Self {
            options,
            decoder,
            layers: Layers::new(options.keep_layer, LayerTable::new(tables)),
            line_types: LineTypes::default(),
            fields: Fields::new(max_repeated_groups(options)),
            unnoted_blocks: blocks.filter(|_| !options.compatible),
            last_insertion: None,
            has_noted_text: false,
        }
    }

    /// Returns the next entity that may be drawn on a wanted layer; `None` at the record that ends the section or block, which remains the head.
    #[inline(always)]
    pub(crate) fn next_item(
        &mut self,
        records: &mut Records<'a>,
        space: Space,
    ) -> Result<Option<Item<'a>>, Stop<'a>> {
        loop {
            let head = records.head;
            match RecordKind::of(head.value) {
                None if is_end(&head) => return Ok(None),
                Some(kind) if !kind.is_part() && (space == Space::Model || !kind.is_label()) => {
                    if let Some(item) = self.item(records, kind, space)? {
                        return Ok(Some(item));
                    }
                }
                _ => records.skip()?,
            }
        }
    }

    /// Reads to the end of the block and returns the layers of all entities that may be drawn on a wanted layer. Returns `None` if layers alone do
    /// not suffice: for insertions, and for texts, which may contain undecodable characters.
    pub(crate) fn layers_ahead(
        &mut self,
        records: &mut Records<'a>,
    ) -> Result<Option<Vec<LayerId>>, Stop<'a>> {
        let mut layers = Vec::new();
        loop {
            let head = records.head;
            match RecordKind::of(head.value) {
                None if is_end(&head) => return Ok(Some(layers)),
                None => records.skip()?,
                Some(kind) if kind.is_part() || kind.is_label() => records.skip()?,
                Some(RecordKind::Insert | RecordKind::Text | RecordKind::MText) => return Ok(None),
                Some(kind) => {
                    let layer =
                        self.read_common_properties(records, kind, Space::Block)?.map(|traits| traits.layer);
                    layers.extend(layer.filter(|layer| layers.last() != Some(layer)));
                }
            }
        }
    }

    /// Reads to the next record in the block, wanted or not, that is more than a text, hatch or annotation. Returns its layer and, if it is an
    /// INSERT, the block's name.
    pub(crate) fn next_element(
        &mut self,
        records: &mut Records<'a>,
    ) -> Result<Option<(LayerId, Option<SmolStr>)>, Stop<'a>> {
        loop {
            let head = records.head;
            match RecordKind::of(head.value) {
                None if is_end(&head) => return Ok(None),
                Some(kind) if kind.is_element() => {
                    let Self { layers, decoder, fields, .. } = self;
                    let mut found = None;
                    let keep = |layer: Value<'a>| {
                        found = Some(layer);
                        FillDecision::Keep
                    };
                    (records.head, _) = fields.fill(&mut records.groups, head.line, 0, keep)?;
                    let layer = found.map_or(&b"0"[..], |layer| layer.bytes);
                    let layer = layers.id(layer, || head.line, decoder);
                    let inserted = fields.get(2).filter(|_| kind == RecordKind::Insert);
                    let inserted = inserted.map(|name| decoder.decode(name.bytes, name.line).trim().into());
                    return Ok(Some((layer, inserted)));
                }
                _ => records.skip()?,
            }
        }
    }

    #[inline(always)]
    fn item(
        &mut self,
        records: &mut Records<'a>,
        kind: RecordKind,
        space: Space,
    ) -> Result<Option<Item<'a>>, Stop<'a>> {
        let Some(traits) = self.read_common_properties(records, kind, space)? else { return Ok(None) };
        let visibility = self.fields.check_visibility();
        let shape = match (kind, visibility) {
            // Labels draw nothing themselves. An insertion keeps the error of a bad visibility in its `array`, because the error matters only if the
            // block draws on a wanted layer.
            (RecordKind::Insert | RecordKind::Label(_), _) => self.shape(kind),
            (_, Err(bad)) => Err(bad.into()),
            (RecordKind::Polyline, _) => self.polyline(records)?,
            _ => self.shape(kind),
        };
        Ok(Some(Item { traits, shape }))
    }

    /// Reads the groups of the head record. Returns its common properties if it may be drawn on a wanted layer.
    fn read_common_properties(
        &mut self,
        records: &mut Records<'a>,
        kind: RecordKind,
        space: Space,
    ) -> Result<Option<CommonProperties>, Stop<'a>> {
        let Pair { line, value: name, .. } = records.head;
        let (want, layer) = self.fill(records, kind, space)?;
        if want == FillDecision::Skip {
            records.skip_similar_records(name, self.layers.last_spelling())?;
            return Ok(None);
        }
        if self.is_in_paper_space() || !self.is_drawn(kind, space) {
            return Ok(None);
        }
        if want == FillDecision::Note {
            self.note_text();
            return Ok(None);
        }
        let layer = layer.unwrap_or_else(|| self.layers.id(b"0", || line, &mut self.decoder));
        if fill_decision(&self.layers, layer, kind, space) == FillDecision::Skip {
            // The record has no layer, so [`Self::fill`] has read all of it.
            if self.notes_texts(kind) {
                self.note_text();
            }
            return Ok(None);
        }
        if kind == RecordKind::Insert {
            self.note_text_in_blocks();
        }
        if kind.is_label() && self.notes_texts(kind) {
            self.note_text();
        }
        Ok(Some(CommonProperties {
            layer,
            line_type: self.line_types.get(self.fields.get(6), &mut self.decoder),
            kind: kind.entity_kind(),
            origin: Origin { line, handle: self.fields.handle() },
            is_invisible: self.fields.whole_number(60).is_ok_and(|flag| flag == Some(1)),
        }))
    }

    /// Reads the groups of the head record, but only up to its layer if that is unwanted. Returns the layer, if there is one.
    #[inline]
    fn fill(
        &mut self,
        records: &mut Records<'a>,
        kind: RecordKind,
        space: Space,
    ) -> Result<(FillDecision, Option<LayerId>), Stop<'a>> {
        let notes_texts = self.notes_texts(kind);
        let Self { layers, decoder, fields, .. } = self;
        let insertion = self.last_insertion.filter(|_| kind == RecordKind::Foreign(EntityKind::Attrib));
        let mut found = None;
        let want = |layer: Value<'a>| {
            let id = layers.id(layer.bytes, || layer.line, decoder);
            let id = insertion.map_or(id, |insertion| layers.effective_layer(id, insertion));
            found = Some(id);
            match fill_decision(layers, id, kind, space) {
                FillDecision::Skip if notes_texts => FillDecision::Note,
                want => want,
            }
        };
        let (next, want) =
            fields.fill(&mut records.groups, records.head.line, kind.repeated_codes(), want)?;
        records.head = next;
        if kind == RecordKind::Insert {
            self.last_insertion = found;
        }
        Ok((want, found))
    }

    /// Applies [`Options::note_text`] to the texts of all blocks. Only the first insertion does this.
    fn note_text_in_blocks(&mut self) {
        if let (Some(blocks), Some(is_noted)) = (self.unnoted_blocks.take(), self.options.note_text) {
            let Self { layers, decoder, .. } = self;
            self.has_noted_text =
                self.has_noted_text || has_noted_text_in(&blocks, is_noted, layers, decoder);
        }
    }

    /// Applies [`Options::note_text`] to the text on an unwanted layer, or the label, that was just read.
    fn note_text(&mut self) {
        if let (Some(text), Some(is_noted)) = (self.fields.get(1), self.options.note_text) {
            self.has_noted_text = is_noted(text.bytes);
        }
    }

    fn notes_texts(&self, kind: RecordKind) -> bool {
        matches!(kind, RecordKind::Text | RecordKind::MText | RecordKind::Label(_))
            && !self.has_noted_text
            && self.options.note_text.is_some()
    }

    fn is_in_paper_space(&self) -> bool {
        self.fields.whole_number(67).is_ok_and(|flag| flag == Some(1))
    }

    /// Whether the record that was just read draws anything. A visible attribute does; its definition in a block only if it is constant, because each
    /// insertion has an ATTRIB for every other one.
    fn is_drawn(&self, kind: RecordKind, space: Space) -> bool {
        let RecordKind::Foreign(kind @ (EntityKind::AttDef | EntityKind::Attrib)) = kind else { return true };
        let flags = self.fields.whole_number(70).ok().flatten().unwrap_or(0);
        let is_constant = flags & CONSTANT_ATTRIBUTE != 0;
        flags & INVISIBLE_ATTRIBUTE == 0
            && (kind == EntityKind::Attrib || space == Space::Model || is_constant)
    }

    #[inline(always)]
    fn shape(&mut self, kind: RecordKind) -> Result<Shape<'a>, EntityError<'a>> {
        let Self { fields, decoder, options, .. } = self;
        let may_be_cut_off = matches!(kind, RecordKind::MText | RecordKind::Hatch | RecordKind::Label(_));
        if !may_be_cut_off && kind.repeated_codes() != 0 && fields.is_full() {
            return Err(EntityError::TooManyParts);
        }
        Ok(match kind {
            RecordKind::Line => Shape::Plain(shapes::line(fields)?),
            RecordKind::Arc => Shape::Plain(shapes::arc(fields)?),
            RecordKind::Circle => Shape::Plain(shapes::circle(fields)?),
            RecordKind::Text => Shape::Plain(shapes::text(fields, decoder, options)?),
            RecordKind::MText => Shape::Plain(shapes::mtext(fields, decoder, options)?),
            RecordKind::Ellipse | RecordKind::Spline
                if options.approximate_curves.is_nan() || options.approximate_curves <= 0.0 =>
            {
                return Err(EntityError::omitted(&NOT_APPROXIMATED, fields));
            }
            RecordKind::Ellipse => Shape::Ellipse(Box::new(Ellipse::read(fields)?)),
            RecordKind::Spline => Shape::Spline(Box::new(Spline::read(fields)?)),
            RecordKind::Hatch => Shape::Hatch(shapes::hatch_point(fields)),
            RecordKind::Label(_) => Shape::Label(shapes::label(fields, options.max_text).map(Box::new)),
            RecordKind::Insert => Shape::Insert(Box::new(Insert::read(fields, decoder)?)),
            RecordKind::Foreign(_) => return Err(EntityError::omitted(&FOREIGN, fields)),
            _ => Shape::Polyline(shapes::lwpolyline(fields)?),
        })
    }

    /// Reads the current POLYLINE with its VERTEX records, all of which are consumed even if one is broken.
    fn polyline(
        &mut self,
        records: &mut Records<'a>,
    ) -> Result<Result<Shape<'a>, EntityError<'a>>, Stop<'a>> {
        let mut polyline = PolylineBuilder::begin(&self.fields);
        let mut is_first = true;
        while RecordKind::of(records.head.value) == Some(RecordKind::Vertex) {
            let always = |_| FillDecision::Keep;
            let (next, _) = self.fields.fill(&mut records.groups, records.head.line, 0, always)?;
            records.head = next;
            let vertex = polyline.as_mut().map(|polyline| polyline.vertex(&self.fields));
            if let Ok(Err(trouble)) = vertex {
                polyline = Err(trouble);
            }
            // The POLYLINE's own point is a dummy.
            if let Err(EntityError::LeftOut { point, .. }) = &mut polyline
                && is_first
            {
                *point = first_point(&self.fields);
            }
            is_first = false;
        }
        Ok(polyline.map(|polyline| Shape::Polyline(polyline.end())))
    }
}

/// Keeps entities on wanted layers, entities on layer 0 of a block, because their layer depends on the insertion, and insertions, because their block
/// may draw on a wanted layer.
#[inline]
fn fill_decision(layers: &Layers<'_, '_>, layer: LayerId, kind: RecordKind, space: Space) -> FillDecision {
    let may_be_wanted = layers.is_kept(layer)
        || kind == RecordKind::Insert
        || (space == Space::Block && layers.is_layer_zero(layer));
    if may_be_wanted { FillDecision::Keep } else { FillDecision::Skip }
}

const INVISIBLE_ATTRIBUTE: i64 = 1;
const CONSTANT_ATTRIBUTE: i64 = 2;

fn is_end(head: &Pair<'_>) -> bool {
    END_RECORDS.iter().any(|keyword| head.is(keyword))
}

/// Records that end a section or block.
const END_RECORDS: [&str; 5] = ["ENDSEC", "ENDBLK", "EOF", "SECTION", "BLOCK"];

/// The type of a record in ENTITIES or in a block. VERTEX and SEQEND are records of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RecordKind {
    Line,
    Arc,
    Circle,
    Text,
    MText,
    LwPolyline,
    Polyline,
    Vertex,
    SequenceEnd,
    Ellipse,
    Spline,
    Insert,
    Hatch,
    /// A multileader or dimension.
    Label(EntityKind),
    /// A type that cannot be part of a path.
    Foreign(EntityKind),
}

/// Records that only annotate a drawing and have no text that is read. They may lie on the layer of a path, since they are clearly not to be milled.
const ANNOTATIONS: [&str; 14] = [
    "ACAD_TABLE",
    "DGNUNDERLAY",
    "DWFUNDERLAY",
    "IMAGE",
    "LEADER",
    "LIGHT",
    "OLE2FRAME",
    "OLEFRAME",
    "PDFUNDERLAY",
    "POINT",
    "SECTIONOBJECT",
    "TOLERANCE",
    "VIEWPORT",
    "WIPEOUT",
];

impl RecordKind {
    /// Returns the kind with this name, ignoring case; `None` for annotations and for records that end a section or block. (`3DLINE` is the
    /// three-dimensional LINE of R10.)
    #[inline]
    pub(crate) fn of(name: &[u8]) -> Option<Self> {
        Self::by_upper_case_name(name)
            .or_else(|| Self::by_unusual_name(&name.trim_ascii().to_ascii_uppercase()))
    }

    #[cold]
    fn by_unusual_name(name: &[u8]) -> Option<Self> {
        let is_known = ANNOTATIONS.iter().chain(&END_RECORDS).any(|known| known.as_bytes() == name);
        Self::by_upper_case_name(name)
            .or_else(|| (!is_known).then(|| Self::Foreign(EntityKind::foreign(name))))
    }

    #[inline]
    fn by_upper_case_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"ARC" => Self::Arc,
            b"LINE" | b"3DLINE" => Self::Line,
            b"TEXT" => Self::Text,
            b"MTEXT" => Self::MText,
            b"CIRCLE" => Self::Circle,
            b"INSERT" => Self::Insert,
            b"HATCH" => Self::Hatch,
            b"DIMENSION" | b"ARC_DIMENSION" | b"LARGE_RADIAL_DIMENSION" => Self::Label(EntityKind::Dimension),
            b"MULTILEADER" => Self::Label(EntityKind::MultiLeader),
            b"VERTEX" => Self::Vertex,
            b"SEQEND" => Self::SequenceEnd,
            b"SPLINE" => Self::Spline,
            b"ELLIPSE" => Self::Ellipse,
            b"POLYLINE" => Self::Polyline,
            b"LWPOLYLINE" => Self::LwPolyline,
            _ => return None,
        })
    }

    /// Whether a record of this kind belongs to a POLYLINE.
    fn is_part(self) -> bool {
        matches!(self, Self::Vertex | Self::SequenceEnd)
    }

    /// Whether a record of this kind draws something other than a text or a hatch. Most annotations have no kind.
    fn is_element(self) -> bool {
        !(self.is_part() || self.is_text() || self.is_label() || self == Self::Hatch)
    }

    fn is_label(self) -> bool {
        matches!(self, Self::Label(_))
    }

    /// Whether a record of this kind is a text.
    fn is_text(self) -> bool {
        matches!(self, Self::Text | Self::MText | Self::Foreign(EntityKind::AttDef | EntityKind::Attrib))
    }

    /// Returns a bit mask of the codes below 64 that this kind repeats.
    #[inline]
    fn repeated_codes(self) -> u64 {
        const fn bits(codes: &[u32]) -> u64 {
            let mut bits = 0;
            let mut index = 0;
            while index < codes.len() {
                bits |= 1 << codes[index];
                index += 1;
            }
            bits
        }
        const CHUNKS: u64 = bits(&[1, 3]);
        const VERTICES: u64 = bits(&[10, 20, 40, 41, 42]);
        const BOUNDARY: u64 = bits(&[10, 20]);
        const CONTROL: u64 = bits(&[10, 20, 30, 40, 41]);
        const TIP: u64 = bits(&[10, 20, 41]);
        match self {
            Self::MText => CHUNKS,
            Self::Label(EntityKind::MultiLeader) => TIP,
            Self::LwPolyline => VERTICES,
            Self::Spline => CONTROL,
            Self::Hatch => BOUNDARY,
            _ => 0,
        }
    }

    /// Returns the kind as it is named in diagnostics.
    fn entity_kind(self) -> EntityKind {
        match self {
            Self::Line => EntityKind::Line,
            Self::Arc => EntityKind::Arc,
            Self::Circle => EntityKind::Circle,
            Self::Text => EntityKind::Text,
            Self::MText => EntityKind::MText,
            Self::LwPolyline => EntityKind::LwPolyline,
            Self::Polyline | Self::Vertex | Self::SequenceEnd => EntityKind::Polyline,
            Self::Ellipse => EntityKind::Ellipse,
            Self::Spline => EntityKind::Spline,
            Self::Insert => EntityKind::Insert,
            Self::Hatch => EntityKind::Hatch,
            Self::Label(kind) | Self::Foreign(kind) => kind,
        }
    }
}

/// An entity that is on a wanted layer, or may turn out to be on one when its block is inserted.
#[derive(Clone, Debug)]
pub(crate) struct Item<'a> {
    pub(crate) traits: CommonProperties,
    pub(crate) shape: Result<Shape<'a>, EntityError<'a>>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct CommonProperties {
    pub(crate) layer: LayerId,
    pub(crate) line_type: LineType,
    pub(crate) kind: EntityKind,
    pub(crate) origin: Origin,
    /// Whether group 60 hides the entity.
    pub(crate) is_invisible: bool,
}

/// The shape of an entity in the coordinates of its space.
#[derive(Clone, Debug)]
pub(crate) enum Shape<'a> {
    /// A shape of the drawing language.
    Plain(Geometry),
    /// A polyline, as lines and arcs.
    Polyline(Polyline),
    /// An ellipse, approximated when it is placed.
    Ellipse(Box<Ellipse>),
    /// A spline, approximated when it is placed.
    Spline(Box<Spline>),
    /// A hatch, with a point of its boundary.
    Hatch(Option<Point>),
    /// A multileader or dimension, with its text and tip, if it has a text of its own.
    Label(Option<Box<(SmolStr, Circle)>>),
    /// An insertion, which draws the contents of a block.
    Insert(Box<Insert<'a>>),
}
