//! Reads a file from its first byte to the end of ENTITIES, and checks its tail.

use pathbuild_diagnostic::messages::drawing::{
    NO_END_OF_FILE, NO_ENTITIES, SECTION_EXPECTED, SECTION_MISPLACED, SECTION_TWICE,
};
use pathbuild_diagnostic::messages::files::{EMPTY_FILE, LFS_POINTER, NOT_DXF};
use pathbuild_diagnostic::{Diagnostic, Text};

use crate::binary::to_ascii;
use crate::collect::Collector;
use crate::encoding::Decoder;
use crate::entities::EntityReader;
use crate::faults::{FatalError, missing_end_error, pair_error, stop_error, value_excerpt};
use crate::groups::Records;
use crate::header::{Header, millimetres};
use crate::model::Model;
use crate::pairs::{Pair, Pairs, SectionEnd, Stop, ends_with_eof};
use crate::placement::Placement;
use crate::{Drawing, Options};

/// Reads a file. An error concerns the file as a whole.
pub(crate) fn read_file(
    drawing: &mut Drawing,
    bytes: &[u8],
    options: &Options<'_>,
) -> Result<(), FatalError> {
    if bytes.is_empty() {
        return Err(Box::new(Diagnostic::new(&EMPTY_FILE)));
    }
    if let Some(text) = to_ascii(bytes) {
        return read_text(drawing, &text, false, options);
    }
    match bytes.strip_prefix(BYTE_ORDER_MARK) {
        Some(text) => read_text(drawing, text, true, options),
        None => read_text(drawing, bytes, false, options),
    }
}

fn read_text(
    drawing: &mut Drawing,
    text: &[u8],
    has_bom: bool,
    options: &Options<'_>,
) -> Result<(), FatalError> {
    let mut file = File::new(text, has_bom);
    match file.find_entities()? {
        PreambleEnd::Entities => file.read_entities(drawing, options),
        PreambleEnd::EndOfFile => Ok(()),
    }
}

const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// A file up to its entities.
struct File<'a> {
    bytes: &'a [u8],
    has_bom: bool,
    pairs: Pairs<'a>,
    header: Header<'a>,
    tables: Option<Pairs<'a>>,
    blocks: Option<Pairs<'a>>,
}

/// The end of the sections that precede the entities: either ENTITIES begins, or the file ends.
enum PreambleEnd {
    Entities,
    EndOfFile,
}

impl<'a> File<'a> {
    fn new(bytes: &'a [u8], has_bom: bool) -> Self {
        Self {
            bytes,
            has_bom,
            pairs: Pairs::new(bytes),
            header: Header::default(),
            tables: None,
            blocks: None,
        }
    }

    /// Skips to ENTITIES, and remembers the needed sections before it.
    fn find_entities(&mut self) -> Result<PreambleEnd, FatalError> {
        let mut head = self.next_head().map_err(|_| not_dxf(self.bytes))?;
        if !head.is("SECTION") && !head.is("EOF") {
            return Err(not_dxf(self.bytes));
        }
        loop {
            if head.code == 9 {
                head = self.variables_after_header(head)?;
            }
            if head.is("EOF") {
                return Ok(PreambleEnd::EndOfFile);
            }
            if !head.is("SECTION") {
                return Err(pair_error(&SECTION_EXPECTED, &head));
            }
            let name = self.next_head().map_err(missing_entities_error)?;
            if name.code == 2 && name.trimmed().eq_ignore_ascii_case(b"ENTITIES") {
                return Ok(PreambleEnd::Entities);
            }
            self.read_or_skip_section(&name)?;
            head = self.next_head().map_err(missing_entities_error)?;
        }
    }

    /// Reads header variables that follow the end of HEADER and have an ENDSEC of their own, as written by dxflib 2.0.
    fn variables_after_header(&mut self, first: Pair<'a>) -> Result<Pair<'a>, FatalError> {
        let end = self.header.read_on(first, &mut self.pairs).map_err(|stop| stop_error(stop, "HEADER"))?;
        if !end.is("ENDSEC") {
            return Err(pair_error(&SECTION_EXPECTED, &end));
        }
        self.next_head().map_err(missing_entities_error)
    }

    /// Reads the next pair that is not a comment.
    fn next_head(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        loop {
            let pair = self.pairs.next()?;
            if pair.code != 999 {
                return Ok(pair);
            }
        }
    }

    /// Reads or skips a section before the entities.
    fn read_or_skip_section(&mut self, name: &Pair<'a>) -> Result<(), FatalError> {
        let section = || value_excerpt(name.value);
        let begin = self.pairs;
        match self.pairs.skip_section() {
            SectionEnd::Ended => {}
            SectionEnd::Missing(next) => return Err(missing_end_error(&section(), &next)),
            SectionEnd::CutOff { line } => return Err(stop_error(Stop::End { line }, &section())),
        }
        let pairs = begin.until(&self.pairs);
        let known = match name.trimmed() {
            b"HEADER" => {
                self.header.find(&pairs);
                None
            }
            b"TABLES" => self.tables.replace(pairs),
            b"BLOCKS" => self.blocks.replace(pairs),
            _ => None,
        };
        if known.is_some() { Err(pair_error(&SECTION_TWICE, name)) } else { Ok(()) }
    }

    fn read_entities(self, drawing: &mut Drawing, options: &Options<'_>) -> Result<(), FatalError> {
        let scale = millimetres(&self.header, options.units)?;
        let decoder = Decoder::new(self.bytes, &self.header, self.has_bom);
        let mut reader = EntityReader::new(options, decoder, self.tables, self.blocks);
        let mut model = Model::new(&mut reader, Collector::new(drawing, options), self.blocks, self.pairs);
        let mut records = Records::new(self.pairs).map_err(|stop| stop_error(stop, "ENTITIES"))?;
        model.add_all(&mut records, (scale != 1.0).then(|| Placement::scaled(scale)))?;
        if !records.head.is("ENDSEC") {
            return Err(missing_end_error("ENTITIES", &records.head));
        }
        if let Some((section, _)) = records.groups.pairs().next_section(&READ_SECTIONS) {
            return Err(pair_error(&SECTION_MISPLACED, &section));
        }
        drawing.has_noted_text = reader.has_noted_text;
        drawing.diagnostics.extend(reader.decoder.into_decoding_warning());
        drawing
            .diagnostics
            .extend((!ends_with_eof(&records.groups.pairs())).then(|| Diagnostic::new(&NO_END_OF_FILE)));
        Ok(())
    }
}

/// The sections that are read. None of them may follow ENTITIES.
const READ_SECTIONS: [&str; 4] = ["HEADER", "TABLES", "BLOCKS", "ENTITIES"];

fn not_dxf(bytes: &[u8]) -> FatalError {
    if bytes.starts_with(b"version https://git-lfs.github.com/spec/") {
        return Box::new(Diagnostic::new(&LFS_POINTER).at_line(1, None));
    }
    Box::new(Diagnostic::new(&NOT_DXF).with("found", kind_of_file(bytes)).at_line(1, None))
}

/// Guesses the kind of a file that is not DXF from its first bytes.
fn kind_of_file(bytes: &[u8]) -> &'static Text {
    static DWG: Text = Text { en: "a DWG drawing", de: "eine DWG-Zeichnung" };
    static BLANK: Text = Text { en: "nothing but blanks", de: "nur Leerraum" };
    static BINARY: Text = Text { en: "binary data", de: "binäre Daten" };
    static TEXT: Text = Text { en: "a text without sections", de: "ein Text ohne Abschnitte" };
    const INSPECTED_BYTES: usize = 1024;
    let beginning = &bytes[..bytes.len().min(INSPECTED_BYTES)];
    match beginning {
        [b'A', b'C', b'1', rest @ ..] if rest.iter().take(3).all(u8::is_ascii_digit) => &DWG,
        _ if beginning.trim_ascii().is_empty() => &BLANK,
        _ if beginning.iter().any(|byte| *byte < b'\t') => &BINARY,
        _ => &TEXT,
    }
}

fn missing_entities_error(stop: Stop<'_>) -> FatalError {
    match stop {
        Stop::End { line } => Box::new(Diagnostic::new(&NO_ENTITIES).at_line(line, None)),
        Stop::BadCode { .. } => stop_error(stop, ""),
    }
}
