//! A file from its first byte to the end of ENTITIES, and a look at its tail.

use pathbuild_diagnostic::messages::files::{EMPTY_FILE, NOT_DXF};
use pathbuild_diagnostic::messages::reading::{
    NO_END_OF_FILE, NO_ENTITIES, SECTION_EXPECTED, SECTION_NOT_ENDED,
};
use pathbuild_diagnostic::{Diagnostic, Message, Word};

use crate::collect::{Collector, Limits, Names};
use crate::encoding::Decoder;
use crate::entities::{EntityReader, Records};
use crate::faults::{shown, stopped};
use crate::header::Header;
use crate::layers::{LayerTable, Layers};
use crate::pairs::{Pair, Pairs, Stop};
use crate::placement::Placement;
use crate::sections::{SectionEnd, ends_with_eof};
use crate::tables::read_layers;
use crate::units::millimetres;
use crate::{Drawing, Options};

/// What stops the reading of a file.
type Fatal = Box<Diagnostic>;

/// Reads a file; an error is one that concerns it as a whole.
pub(crate) fn read_file(bytes: &[u8], options: &Options<'_>) -> Result<Drawing, Fatal> {
    if bytes.is_empty() {
        return Err(Box::new(Diagnostic::new(&EMPTY_FILE)));
    }
    let (text, has_bom) = match bytes.strip_prefix(BYTE_ORDER_MARK) {
        Some(text) => (text, true),
        None => (bytes, false),
    };
    let mut file = File::new(text, has_bom);
    match file.find_entities()? {
        Found::Entities => file.read_entities(options),
        Found::EndOfFile => Ok(Drawing::default()),
    }
}

const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// A file up to its entities.
struct File<'a> {
    bytes: &'a [u8],
    has_bom: bool,
    pairs: Pairs<'a>,
    header: Header<'a>,
    /// Where the tables begin, if there are any.
    tables: Option<Pairs<'a>>,
}

/// What the sections before the entities are followed by.
enum Found {
    Entities,
    EndOfFile,
}

impl<'a> File<'a> {
    fn new(bytes: &'a [u8], has_bom: bool) -> Self {
        Self { bytes, has_bom, pairs: Pairs::new(bytes), header: Header::default(), tables: None }
    }

    /// Goes through the sections up to the beginning of ENTITIES, and notes where those are that it needs.
    fn find_entities(&mut self) -> Result<Found, Fatal> {
        let mut head = self.next_head().map_err(|_| not_dxf(self.bytes))?;
        if !head.is("SECTION") && !head.is("EOF") {
            return Err(not_dxf(self.bytes));
        }
        loop {
            if head.is("EOF") {
                return Ok(Found::EndOfFile);
            }
            if !head.is("SECTION") {
                return Err(at_pair(&SECTION_EXPECTED, &head));
            }
            let name = self.next_head().map_err(|stop| before_entities(stop))?;
            if name.code == 2 && name.trimmed().eq_ignore_ascii_case(b"ENTITIES") {
                return Ok(Found::Entities);
            }
            self.pass(&name)?;
            head = self.next_head().map_err(|stop| before_entities(stop))?;
        }
    }

    /// The next pair that is no remark.
    fn next_head(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        loop {
            let pair = self.pairs.next()?;
            if pair.code != 999 {
                return Ok(pair);
            }
        }
    }

    /// Reads or passes over a section before the entities.
    fn pass(&mut self, name: &Pair<'a>) -> Result<(), Fatal> {
        let section = shown(name.value);
        match name.trimmed() {
            b"HEADER" => {
                let (header, end) = Header::read(&mut self.pairs).map_err(|stop| stopped(stop, &section))?;
                self.header = header;
                return if end.is("ENDSEC") { Ok(()) } else { Err(not_ended(&section, &end)) };
            }
            b"TABLES" => self.tables = Some(self.pairs.clone()),
            _ => {}
        }
        match self.pairs.skip_section() {
            SectionEnd::Ended => Ok(()),
            SectionEnd::Missing(next) => Err(not_ended(&section, &next)),
            SectionEnd::CutOff { line } => Err(stopped(Stop::End { line }, &section)),
        }
    }

    fn read_entities(self, options: &Options<'_>) -> Result<Drawing, Fatal> {
        let scale = millimetres(&self.header, options.units)?;
        let mut decoder = Decoder::new(self.bytes, &self.header, self.has_bom);
        let table = match self.tables {
            Some(tables) => read_layers(tables, &mut decoder)?,
            None => LayerTable::default(),
        };
        let layers = Layers::new(table, options.keep_layer);
        let mut reader = EntityReader::new(options, decoder, layers);
        let mut collector = Collector::new(Limits { entities: options.max_entities, text: options.max_text });
        let placement = (scale != 1.0).then(|| Placement::scaled(scale));
        let cut_off = |stop| stopped(stop, "ENTITIES");
        let mut records = Records::new(self.pairs).map_err(cut_off)?;
        while let Some(item) = reader.next_item(&mut records).map_err(cut_off)? {
            let names = Names { layers: &reader.layers, line_types: &reader.line_types };
            collector.add(item, placement.as_ref(), &names)?;
        }
        if !records.head.is("ENDSEC") {
            return Err(not_ended("ENTITIES", &records.head));
        }
        let mut drawing = collector.finish();
        drawing.diagnostics.extend(reader.decoder.into_doubt());
        drawing
            .diagnostics
            .extend((!ends_with_eof(&records.pairs)).then(|| Diagnostic::new(&NO_END_OF_FILE)));
        Ok(drawing)
    }
}

fn not_dxf(bytes: &[u8]) -> Fatal {
    Box::new(Diagnostic::new(&NOT_DXF).with("found", kind_of_file(bytes)).at_line(1, None))
}

/// What a file is that is no DXF file, by its beginning.
fn kind_of_file(bytes: &[u8]) -> &'static Word {
    static DWG: Word = Word { en: "a DWG drawing", de: "eine DWG-Zeichnung" };
    static BLANK: Word = Word { en: "nothing but blanks", de: "nur Leerraum" };
    static BINARY: Word = Word { en: "binary data", de: "binäre Daten" };
    static TEXT: Word = Word { en: "a text without sections", de: "ein Text ohne Abschnitte" };
    const BEGINNING: usize = 1024;
    let beginning = &bytes[..bytes.len().min(BEGINNING)];
    match beginning {
        [b'A', b'C', b'1', rest @ ..] if rest.iter().take(3).all(u8::is_ascii_digit) => &DWG,
        _ if beginning.trim_ascii().is_empty() => &BLANK,
        _ if beginning.iter().any(|byte| *byte < b'\t') => &BINARY,
        _ => &TEXT,
    }
}

fn before_entities(stop: Stop<'_>) -> Fatal {
    match stop {
        Stop::End { line } => Box::new(Diagnostic::new(&NO_ENTITIES).at_line(line, None)),
        Stop::BadCode { .. } => stopped(stop, ""),
    }
}

fn at_pair(message: &'static Message, pair: &Pair<'_>) -> Fatal {
    Box::new(Diagnostic::new(message).with("found", shown(pair.value)).at_line(pair.line, None))
}

fn not_ended(section: &str, found: &Pair<'_>) -> Fatal {
    let mut diagnostic = at_pair(&SECTION_NOT_ENDED, found);
    diagnostic.arguments.push(("section", section.into()));
    diagnostic
}
