//! Writes sheets as ASCII and binary DXF through the crate `dxf`, in the encoding of the version.
//!
//! Its output is corrected pair by pair (`pathbuild_draw::pairs`). Entities carry tags in place of handles.

use std::collections::BTreeSet;

use encoding_rs::{Encoding, UTF_8, WINDOWS_1252};
use pathbuild_draw::pairs::{
    self, Pair, Record, StringPlaceholders, drop_codes, identify, kind, records, reduce_mtext, value,
};

use super::convert;
use super::convert::TAG_BASE;
use super::draft::Sheet;
use super::model::{
    Change, Direction, Entity, Layer, LayerState, LineEnds, Options, Part, Shape, Template, TextEncoding,
    Version,
};

impl Sheet {
    /// Writes the drawing as DXF, ASCII or binary according to the options.
    pub fn to_dxf(&self) -> Vec<u8> {
        if self.options().binary {
            return self.to_binary_dxf();
        }
        with_pairs(self, |pairs| ascii(pairs, self.options()))
    }

    /// Writes the drawing as binary DXF.
    pub fn to_binary_dxf(&self) -> Vec<u8> {
        with_pairs(self, |pairs| binary(pairs, self.options()))
    }
}

fn with_pairs(sheet: &Sheet, write: impl FnOnce(&[Pair<'_>]) -> Vec<u8>) -> Vec<u8> {
    with_written(sheet, |written| write(&assemble(sheet, written)))
}

/// Writes a sheet without its template through the crate `dxf`, and passes the output to `next`.
fn with_written<T>(sheet: &Sheet, next: impl FnOnce(CrateOutput<'_>) -> T) -> T {
    let mut tickets = StringPlaceholders::default();
    let drawing = convert::drawing(sheet, &mut tickets);
    let mut text = Vec::new();
    // Saving to memory without a thumbnail cannot fail.
    _ = drawing.save(&mut text);
    let text = String::from_utf8_lossy(&text);
    let mut written = CrateOutput::of(&text, &tickets);
    written.correct_entities(&sheet.tagged(), sheet.options().version);
    next(written)
}

/// Joins the sections: assigns unique handles and owners, and omits the parts that the options exclude.
fn assemble<'a>(sheet: &'a Sheet, mut written: CrateOutput<'a>) -> Vec<Pair<'a>> {
    let options = sheet.options();
    let is_in = |part: Part| !options.left_out.contains(&part);
    if let Some((template, left_out)) = sheet.template() {
        template.add_to(&mut written, left_out);
    }
    let objects = Objects::from(sheet.next_handle());
    let mut counter = objects.end()..;
    let mut next = || counter.next().filter(|_| is_in(Part::Handles));
    let tables = Tables { sheet, plot_style: objects.plot_style(), layouts: objects.layouts() };
    let (table_pairs, owners) = tables.pairs(written.tables, &mut next);
    let entities = Entities::new(sheet, &owners, is_in(Part::Handles));
    let block_pairs = entities.blocks(written.blocks, &mut next);
    let entity_pairs = entities.entities(written.entities, None, &mut next);
    let has_objects = options.version >= Version::R13 && is_in(Part::Objects);
    let seed = next().unwrap_or(objects.end());
    let sections = [
        ("HEADER", is_in(Part::Header), header_pairs(sheet, written.header, seed)),
        ("TABLES", is_in(Part::Tables), table_pairs),
        ("BLOCKS", is_in(Part::Blocks), block_pairs),
        ("ENTITIES", true, entity_pairs),
        ("OBJECTS", has_objects, objects.pairs(options.version, entities.spaces)),
    ];
    let mut pairs: Vec<Pair<'a>> = Vec::new();
    for (name, _, content) in sections.into_iter().filter(|(_, is_wanted, _)| *is_wanted) {
        pairs.extend([Pair::new(0, "SECTION"), Pair::new(2, name)]);
        pairs.extend(content);
        pairs.push(Pair::new(0, "ENDSEC"));
    }
    pairs.extend(is_in(Part::Eof).then(|| Pair::new(0, "EOF")));
    pairs
}

/// The entities of a sheet, to which handles and owners are assigned.
struct Entities<'a, 'o> {
    /// The entities of the drawing, then those of its blocks. The tag that is written in place of a handle is `TAG_BASE` plus the index here.
    tagged: Vec<&'a Entity>,
    version: Version,
    has_handles: bool,
    owners: &'o Owners,
    /// The handles of the block records of model and paper space.
    spaces: [u64; 2],
}

impl<'a, 'o> Entities<'a, 'o> {
    fn new(sheet: &'a Sheet, owners: &'o Owners, has_handles: bool) -> Self {
        let space =
            |wanted: &str| owners.iter().find(|(name, _)| name == wanted).map_or(0, |(_, handle)| *handle);
        let spaces = [space("*Model_Space"), space("*Paper_Space")];
        Self { tagged: sheet.tagged(), version: sheet.options().version, has_handles, owners, spaces }
    }

    fn owner(&self, owner: Option<u64>) -> Option<u64> {
        owner.filter(|_| self.has_handles && self.version >= Version::R2000)
    }

    /// Returns the pairs of the blocks. BLOCK and ENDBLK get handles of their own, and everything between them is owned by the block.
    fn blocks(&self, records: Vec<Record<'a>>, next: &mut impl FnMut() -> Option<u64>) -> Vec<Pair<'a>> {
        let mut pairs = Vec::new();
        let mut owner = None;
        let mut inner = Vec::new();
        for mut record in records {
            let is_begin = kind(&record) == "BLOCK";
            if is_begin {
                let name = value(&record, 2).unwrap_or_default();
                owner = self.owners.iter().find(|(owner, _)| owner == name).map(|(_, handle)| *handle);
            } else if kind(&record) != "ENDBLK" {
                inner.push(record);
                continue;
            }
            pairs.extend(self.entities(std::mem::take(&mut inner), owner, next));
            identify(&mut record, 5, next(), self.owner(owner));
            pairs.extend(record);
        }
        pairs
    }

    /// Returns the pairs of the entities of a block, or of model and paper space.
    fn entities(
        &self,
        records: Vec<Record<'a>>,
        block: Option<u64>,
        next: &mut impl FnMut() -> Option<u64>,
    ) -> Vec<Pair<'a>> {
        let mut pairs = Vec::new();
        let mut whole = None;
        for mut record in records {
            if let Some(entity) = entity_of(&record, &self.tagged) {
                let space = self.spaces[usize::from(entity.paper)];
                whole = entity.handle.map(|handle| handle.0).filter(|_| self.has_handles);
                if let Shape::Raw(raw) = &entity.shape {
                    record = raw.iter().map(Pair::borrowed).collect();
                } else {
                    identify(&mut record, 5, whole, self.owner(block.or(Some(space))));
                }
                apply_changes(&mut record, &entity.changes);
            } else if matches!(kind(&record), "VERTEX" | "SEQEND") {
                identify(&mut record, 5, next(), self.owner(whole));
            } else {
                whole = next();
                identify(&mut record, 5, whole, self.owner(block.or(Some(self.spaces[0]))));
            }
            pairs.extend(record);
        }
        pairs
    }
}

/// The output of the crate `dxf`, section by section.
#[derive(Debug, Default)]
struct CrateOutput<'a> {
    /// Header variables: the pair with the name, and the pairs of its value.
    pub(crate) header: Vec<Record<'a>>,
    /// The records of all tables, without their heads.
    pub(crate) tables: Vec<Record<'a>>,
    pub(crate) blocks: Vec<Record<'a>>,
    pub(crate) entities: Vec<Record<'a>>,
}

impl<'a> CrateOutput<'a> {
    /// Splits the output of the crate and replaces the placeholders by their strings.
    pub(crate) fn of(text: &'a str, tickets: &'a StringPlaceholders) -> Self {
        let mut written = Self::default();
        let mut section = String::new();
        for mut record in records(text) {
            match kind(&record) {
                "SECTION" => {
                    value(&record, 2).unwrap_or_default().clone_into(&mut section);
                    if section == "HEADER" {
                        written.header = variables(&record[2..]);
                    }
                }
                "ENDSEC" | "EOF" | "TABLE" | "ENDTAB" => {}
                _ => {
                    tickets.restore_strings(&mut record);
                    match section.as_str() {
                        "TABLES" => written.tables.push(record),
                        "BLOCKS" => written.blocks.push(record),
                        "ENTITIES" => written.entities.push(record),
                        _ => {}
                    }
                }
            }
        }
        written
    }

    fn correct_entities(&mut self, tagged: &[&Entity], version: Version) {
        for record in self.entities.iter_mut().chain(&mut self.blocks) {
            pairs::remove_unwanted_pairs(record);
            if version < Version::R13 {
                drop_codes(record, &[100]);
            }
            if let Some(entity) = entity_of(record, tagged) {
                correct_entity(record, entity);
            }
        }
    }
}

fn variables<'a>(pairs: &[Pair<'a>]) -> Vec<Record<'a>> {
    pairs.chunk_by(|_, next| next.code != 9).map(<[Pair<'_>]>::to_vec).collect()
}

/// Returns the entity of a record, by the tag in place of its handle.
fn entity_of<'e>(record: &Record<'_>, tagged: &[&'e Entity]) -> Option<&'e Entity> {
    let tag = u64::from_str_radix(value(record, 5)?, 16).ok()?;
    let index = usize::try_from(tag.checked_sub(TAG_BASE)?).ok()?;
    tagged.get(index).copied()
}

/// A fixed date in 2025 as a Julian date, since the output must not depend on the time of writing.
const DATE: &str = "2460676.5";
const GUID: &str = "{00000000-0000-0000-0000-000000000000}";

/// Header variables that refer to objects that are not written.
const POINTERS: [&str; 4] = ["$DRAGVS", "$CMATERIAL", "$INTERFEREOBJVS", "$INTERFEREVPVS"];

/// Returns the pairs of the header section: the output of the crate, with fixed values for everything that would differ from run to run.
fn header_pairs<'a>(sheet: &'a Sheet, mut variables: Vec<Record<'a>>, hand_seed: u64) -> Vec<Pair<'a>> {
    let options = sheet.options();
    variables.retain(|variable| !POINTERS.contains(&kind(variable)));
    for variable in &mut variables {
        let Some(fixed) = fixed_value(kind(variable), hand_seed) else { continue };
        variable.truncate(2);
        if let Some(pair) = variable.last_mut() {
            *pair = Pair::new(pair.code, fixed);
        }
    }
    let units = options.units.filter(|units| options.version >= Version::R2000 || *units != 4);
    set_variable(&mut variables, "$INSUNITS", units.map(|units| Pair::integer(70, units.into())));
    let code_page = options.code_page.as_deref().filter(|_| options.version >= Version::R12);
    set_variable(&mut variables, "$DWGCODEPAGE", code_page.map(|name| Pair::new(3, name)));
    if options.left_out.contains(&Part::Handles) {
        set_variable(&mut variables, "$HANDLING", Some(Pair::integer(70, 0)));
    }
    for (name, pair) in &options.header {
        set_variable(&mut variables, name, Some(pair.borrowed()));
    }
    variables.into_iter().flatten().collect()
}

fn fixed_value(variable: &str, hand_seed: u64) -> Option<String> {
    Some(match variable {
        "$TDCREATE" | "$TDUCREATE" | "$TDUPDATE" | "$TDUUPDATE" => DATE.to_owned(),
        "$FINGERPRINTGUID" | "$VERSIONGUID" => GUID.to_owned(),
        "$HANDSEED" => format!("{hand_seed:X}"),
        "$MEASUREMENT" | "$HANDLING" => "     1".to_owned(),
        _ => return None,
    })
}

/// Sets a variable, which is added at the end if it is missing. Without a value, removes it.
fn set_variable<'a>(variables: &mut Vec<Record<'a>>, wanted: &'a str, value: Option<Pair<'a>>) {
    let at = variables.iter().position(|variable| kind(variable) == wanted);
    match (at, value) {
        (Some(at), Some(value)) => variables[at] = vec![Pair::new(9, wanted), value],
        (None, Some(value)) => variables.push(vec![Pair::new(9, wanted), value]),
        (Some(at), None) => _ = variables.remove(at),
        (None, None) => {}
    }
}

fn correct_entity(record: &mut Record<'_>, entity: &Entity) {
    match &entity.shape {
        Shape::Text(_) => correct_text(record),
        Shape::MText(mtext) => match mtext.direction {
            Direction::Rotation(_) => reduce_mtext(record, &[50]),
            Direction::Vector(_) => reduce_mtext(record, &[11, 21, 31]),
        },
        Shape::Spline(spline) if spline.fit.is_empty() => drop_codes(record, &[12, 22, 32, 13, 23, 33]),
        _ => {}
    }
}

/// Restores an alignment point at the origin, and moves the vertical alignment to its place.
fn correct_text(record: &mut Record<'_>) {
    let is_aligned = value(record, 72).or(value(record, 73)).is_some();
    if is_aligned && value(record, 11).is_none() {
        let behind = record.iter().position(|pair| pair.code == 72).map_or(record.len(), |at| at + 1);
        record.splice(behind..behind, [11, 21, 31].map(|code| Pair::new(code, "0.0")));
    }
    if let Some(at) = record.iter().position(|pair| pair.code == 73) {
        let vertical = record.remove(at);
        record.push(vertical);
    }
}

fn apply_changes<'a>(record: &mut Record<'a>, changes: &'a [Change]) {
    for change in changes {
        match change {
            Change::Set(pair) => set(record, pair.borrowed()),
            Change::Unset(code) => drop_codes(record, &[*code]),
        }
    }
}

/// Sets the first pair of a code, or appends it.
fn set<'a>(record: &mut Record<'a>, pair: Pair<'a>) {
    match record.iter_mut().find(|old| old.code == pair.code) {
        Some(old) => *old = pair,
        None => record.push(pair),
    }
}

impl Template {
    /// Creates a template from a sheet, which must have no parameter texts. In a drawing that uses it, its first `early` entities come before the
    /// drawing's own entities, and its other entities after them.
    pub fn new(sheet: &Sheet, early: usize) -> Self {
        with_written(sheet, |written| {
            let is_block = |record: &&Record<'_>| kind(record) == "BLOCK_RECORD" && !is_space(record);
            let tables = written.tables.iter().filter(is_block).map(owned_without_handle).collect();
            let mut space = false;
            let is_inside = |record: &&Record<'_>| {
                if kind(record) == "BLOCK" {
                    space = is_space(record);
                }
                !space
            };
            let blocks = written.blocks.iter().filter(is_inside).map(owned_without_handle).collect();
            let mut entities: Vec<_> = written.entities.iter().map(owned_without_handle).collect();
            let is_entity = |record: &Record<'_>| !matches!(kind(record), "VERTEX" | "SEQEND");
            let mut starts = (0..entities.len()).filter(|at| is_entity(&entities[*at]));
            let begin = starts.nth(early).unwrap_or(entities.len());
            let late = entities.split_off(begin);
            Self { tables, blocks, early: entities, late }
        })
    }

    /// Adds the template, without its last `left_out` records, to the records of a sheet.
    fn add_to<'a>(&'a self, written: &mut CrateOutput<'a>, left_out: usize) {
        written.tables.extend(borrowed(&self.tables));
        written.blocks.extend(borrowed(&self.blocks));
        written.entities.splice(0..0, borrowed(&self.early));
        written.entities.extend(borrowed(&self.late[..self.late.len().saturating_sub(left_out)]));
    }
}

fn borrowed<'a>(records: &'a [Record<'static>]) -> impl Iterator<Item = Record<'a>> {
    records.iter().map(|record| record.iter().map(Pair::borrowed).collect())
}

fn is_space(record: &Record<'_>) -> bool {
    matches!(value(record, 2), Some("*Model_Space" | "*Paper_Space"))
}

fn owned_without_handle(record: &Record<'_>) -> Record<'static> {
    let mut record: Record<'static> = record.iter().map(Pair::to_owned_pair).collect();
    drop_codes(&mut record, &[5]);
    record
}

pub(crate) fn ascii(pairs: &[Pair<'_>], options: &Options) -> Vec<u8> {
    let line_end: &[u8] = match options.line_ends {
        LineEnds::CrLf => b"\r\n",
        LineEnds::Lf => b"\n",
        LineEnds::Cr => b"\r",
    };
    let mut bytes = if options.byte_order_mark { b"\xef\xbb\xbf".to_vec() } else { Vec::new() };
    bytes.extend(pairs::ascii(pairs, encoding(options), line_end));
    bytes
}

/// Writes binary DXF. A malformed number is written as 0, since the format cannot represent it.
pub(crate) fn binary(pairs: &[Pair<'_>], options: &Options) -> Vec<u8> {
    let encoding = encoding(options);
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    for pair in pairs {
        let code = u16::try_from(pair.code).unwrap_or_default();
        match u8::try_from(code) {
            _ if options.version >= Version::R13 => bytes.extend(code.to_le_bytes()),
            Ok(short) if short < 255 => bytes.push(short),
            _ => {
                bytes.push(255);
                bytes.extend(code.to_le_bytes());
            }
        }
        append_value(pair, encoding, options.version, &mut bytes);
    }
    bytes
}

/// Appends a value in the type that the DXF reference gives for its group code.
fn append_value(pair: &Pair<'_>, encoding: Option<&'static Encoding>, version: Version, bytes: &mut Vec<u8>) {
    let value = pair.value.trim();
    match pair.code {
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
            bytes.extend(value.parse::<f64>().unwrap_or_default().to_le_bytes());
        }
        290..=299 if version >= Version::R13 => bytes.push(value.parse().unwrap_or_default()),
        60..=79 | 170..=179 | 270..=299 | 370..=389 | 400..=409 | 1060..=1070 => {
            bytes.extend(value.parse::<i16>().unwrap_or_default().to_le_bytes());
        }
        90..=99 | 420..=429 | 440..=459 | 1071 => {
            bytes.extend(value.parse::<i32>().unwrap_or_default().to_le_bytes());
        }
        160..=169 => bytes.extend(value.parse::<i64>().unwrap_or_default().to_le_bytes()),
        310..=319 | 1004 => append_chunk(value, bytes),
        _ => {
            pairs::encode(&pair.value, encoding, bytes);
            bytes.push(0);
        }
    }
}

fn append_chunk(hex: &str, bytes: &mut Vec<u8>) {
    let digits: Vec<u32> = hex.chars().filter_map(|c| c.to_digit(16)).collect();
    let chunk: Vec<u8> =
        digits.chunks_exact(2).filter_map(|two| u8::try_from(two[0] * 16 + two[1]).ok()).take(255).collect();
    bytes.extend(u8::try_from(chunk.len()));
    bytes.extend(chunk);
}

/// Returns the encoding of a sheet's strings; `None` for ASCII only.
pub(crate) fn encoding(options: &Options) -> Option<&'static Encoding> {
    match options.encoding {
        // A byte order mark implies UTF-8 for the whole file.
        TextEncoding::Proper if options.version >= Version::R2007 || options.byte_order_mark => Some(UTF_8),
        TextEncoding::Proper => code_page(options.code_page.as_deref().unwrap_or("ANSI_1252")),
        TextEncoding::Utf8 => Some(UTF_8),
        TextEncoding::Escaped => None,
    }
}

/// Returns the encoding for a value of $DWGCODEPAGE. `None` if it is unknown: ASCII with escapes is correct in any encoding.
fn code_page(name: &str) -> Option<&'static Encoding> {
    let lower = name.to_ascii_lowercase();
    let number = lower.strip_prefix("ansi_").or_else(|| lower.strip_prefix("dos"));
    let label = match number {
        Some("932") => "shift_jis".to_owned(),
        Some("936") => "gbk".to_owned(),
        Some("949") => "euc-kr".to_owned(),
        Some("950") => "big5".to_owned(),
        Some("874") => "windows-874".to_owned(),
        Some("866") => "ibm866".to_owned(),
        Some(number) if lower.starts_with("ansi_") => format!("windows-{number}"),
        _ => return (lower == "ascii" || lower == "undefined").then_some(WINDOWS_1252),
    };
    Encoding::for_label(label.as_bytes())
}

/// The tables in the order in which CAD programs write them.
const TABLES: [&str; 9] =
    ["VPORT", "LTYPE", "LAYER", "STYLE", "VIEW", "UCS", "APPID", "DIMSTYLE", "BLOCK_RECORD"];

/// The handles of the block records, by block name.
pub(crate) type Owners = Vec<(String, u64)>;

/// Input for the tables section.
pub(crate) struct Tables<'a> {
    pub(crate) sheet: &'a Sheet,
    /// The handle of the plot style that layers refer to.
    pub(crate) plot_style: u64,
    /// The layouts of model and paper space.
    pub(crate) layouts: [u64; 2],
}

impl Tables<'_> {
    /// Returns the pairs of the tables section, and the handles of the block records.
    pub(crate) fn pairs<'r>(
        &self,
        records: Vec<Record<'r>>,
        next: &mut impl FnMut() -> Option<u64>,
    ) -> (Vec<Pair<'r>>, Owners) {
        let version = self.sheet.options().version;
        let mut of_table: Vec<Vec<Record<'r>>> = TABLES.iter().map(|_| Vec::new()).collect();
        for record in records {
            if let Some(table) = TABLES.iter().position(|name| *name == kind(&record)) {
                of_table[table].push(record);
            }
        }
        let mut pairs = Vec::new();
        let mut owners = Owners::new();
        let tables = TABLES.into_iter().zip(of_table);
        for (name, records) in tables.filter(|(name, _)| version >= Version::R13 || *name != "BLOCK_RECORD") {
            let listed = self.listed_records(name, records);
            let head = next();
            pairs.extend(self.head(name, head, listed.len()));
            let owner = head.filter(|_| version >= Version::R2000);
            for mut record in listed {
                let handle = next();
                self.correct_table_record(name, &mut record);
                identify(&mut record, if name == "DIMSTYLE" { 105 } else { 5 }, handle, owner);
                if let (Some(handle), "BLOCK_RECORD") = (handle, name) {
                    owners.push((value(&record, 2).unwrap_or_default().to_owned(), handle));
                }
                pairs.extend(record);
            }
            pairs.push(Pair::new(0, "ENDTAB"));
        }
        (pairs, owners)
    }

    /// Returns the records of a table, without unlisted layers and without names that the crate added because an entity spells them differently.
    fn listed_records<'r>(&self, table: &str, mut records: Vec<Record<'r>>) -> Vec<Record<'r>> {
        let mut names = BTreeSet::new();
        records.retain(|record| {
            let is_new = names.insert(value(record, 2).unwrap_or_default().to_lowercase());
            is_new && !self.is_unlisted(table, record)
        });
        records
    }

    fn head(&self, name: &'static str, handle: Option<u64>, count: usize) -> Record<'static> {
        let version = self.sheet.options().version;
        let mut head = vec![Pair::new(0, "TABLE"), Pair::new(2, name)];
        if version >= Version::R13 {
            head.extend(handle.map(|handle| Pair::handle(5, handle)));
            head.extend((version >= Version::R2000).then(|| Pair::new(330, "0")));
            head.push(Pair::new(100, "AcDbSymbolTable"));
        }
        head.push(Pair::integer(70, i64::try_from(count).unwrap_or_default()));
        if name == "DIMSTYLE" && version >= Version::R2000 {
            head.push(Pair::new(100, "AcDbDimStyleTable"));
        }
        head
    }

    fn layer(&self, record: &Record<'_>) -> Option<&Layer> {
        let name = value(record, 2)?;
        self.sheet.layers().iter().find(|layer| layer.name.eq_ignore_ascii_case(name))
    }

    fn is_unlisted(&self, table: &str, record: &Record<'_>) -> bool {
        table == "LAYER" && self.layer(record).is_some_and(|layer| layer.is(LayerState::Unlisted))
    }

    fn correct_table_record(&self, table: &str, record: &mut Record<'_>) {
        let version = self.sheet.options().version;
        if version < Version::R13 {
            drop_codes(record, &[100, 290, 370, 390, 347, 348]);
        }
        match table {
            "LAYER" => self.correct_layer(record),
            "LTYPE" if version >= Version::R13 => correct_line_type(record),
            // Handles of styles and blocks, which the crate leaves empty.
            "DIMSTYLE" => drop_codes(record, &[340, 341, 342, 343, 344, 345, 346, 347]),
            "BLOCK_RECORD" => self.correct_block_record(record),
            _ => {}
        }
    }

    /// Adds layer flags, which the crate does not know, and removes the crate's pointer to a plot style that does not exist.
    fn correct_layer(&self, record: &mut Record<'_>) {
        let Some(layer) = self.layer(record) else { return };
        let flags = i64::from(layer.is(LayerState::Frozen)) + 4 * i64::from(layer.is(LayerState::Locked));
        drop_codes(record, &[347, 348, 370]);
        for pair in record {
            match pair.code {
                70 => *pair = Pair::integer(70, flags),
                390 => *pair = Pair::handle(390, self.plot_style),
                _ => {}
            }
        }
    }

    fn correct_block_record(&self, record: &mut Record<'_>) {
        let layout = match value(record, 2) {
            Some("*Model_Space") => self.layouts[0],
            Some("*Paper_Space") => self.layouts[1],
            _ => 0,
        };
        for pair in record.iter_mut().filter(|pair| pair.code == 340) {
            *pair = Pair::handle(340, layout);
        }
    }
}

/// Inserts the type (group 74) after the length of each dash (group 49).
fn correct_line_type(record: &mut Record<'_>) {
    let kind = |pair: &Pair<'_>| (pair.code == 49).then(|| Pair::new(74, "     0"));
    let pairs = std::mem::take(record).into_iter();
    record.extend(pairs.flat_map(|pair| {
        let kind = kind(&pair);
        std::iter::once(pair).chain(kind)
    }));
}

/// The objects section, with handles that other sections refer to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Objects {
    first: u64,
}

/// The objects of every CAD drawing. `#n` is the handle of object n; `#m` and `#p` are the block records of model and paper space.
const R2000: &str = include_str!("objects_r2000.txt");
const R13: &str = include_str!("objects_r13.txt");

/// Number of handles that the objects occupy.
const COUNT: u64 = 16;
const LAYOUTS: [u64; 2] = [4, 5];
const PLOT_STYLE: u64 = 10;

impl Objects {
    /// Creates the objects with handles from `first` on.
    pub(crate) fn from(first: u64) -> Self {
        Self { first }
    }

    /// Returns the first handle after those of the objects.
    pub(crate) fn end(self) -> u64 {
        self.first + COUNT
    }

    pub(crate) fn layouts(self) -> [u64; 2] {
        LAYOUTS.map(|number| self.first + number)
    }

    pub(crate) fn plot_style(self) -> u64 {
        self.first + PLOT_STYLE
    }

    pub(crate) fn pairs(self, version: Version, spaces: [u64; 2]) -> Vec<Pair<'static>> {
        let text = if version >= Version::R2000 { R2000 } else { R13 };
        let mut lines = text.lines();
        let mut pairs = Vec::new();
        while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
            let code = code.trim().parse().unwrap_or_default();
            pairs.push(self.resolve(code, value, spaces));
        }
        pairs
    }

    fn resolve(self, code: i32, value: &'static str, spaces: [u64; 2]) -> Pair<'static> {
        match value.strip_prefix('#') {
            Some("m") => Pair::handle(code, spaces[0]),
            Some("p") => Pair::handle(code, spaces[1]),
            Some(number) => Pair::handle(code, self.first + number.parse::<u64>().unwrap_or_default()),
            None => Pair::new(code, value),
        }
    }
}
