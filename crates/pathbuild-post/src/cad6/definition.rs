//! Reads a definition consisting of control texts and settings, which is a TOML file. (book: program/posts)

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Text, nearest};
use toml::Spanned;
use toml::de::{DeFloat, DeInteger, DeTable, DeValue};

use super::control_text::{ControlText, ControlTextKind, locate};
use super::expand::split_at_next_variable;
use super::variables::{Variable, is_parameter, is_private};
use crate::Units;
use crate::arcs::MAX_CHORD_DISTANCE;
use crate::findings::{Findings, LineStarts, MAX_FINDINGS};
use crate::line_words::CommentMarks;
use crate::number::StatedOption;

/// A definition as parsed from its file, before any text is expanded.
#[derive(Clone, Debug)]
pub(crate) struct Definition {
    pub(super) settings: Settings,
    /// The control texts, indexed by their kind; `None` for those that the definition lacks.
    texts: Vec<Option<ControlText>>,
    /// Pairs of an alias used in the texts and the variable that it stands for.
    pub(super) aliases: Vec<(Box<str>, Box<str>)>,
}

impl Definition {
    /// Parses a definition. Doubtful entries are returned as warnings.
    pub(crate) fn parse(text: &str, file: &Utf8Path) -> Result<(Self, Vec<Diagnostic>), Vec<Diagnostic>> {
        let mut reader = ControlTextReader {
            source: text,
            lines: LineStarts::of(text),
            file,
            findings: Findings::default(),
        };
        let table = match DeTable::parse(text) {
            Ok(table) => table,
            Err(error) => {
                reader.report(
                    Diagnostic::new(&posts::POST_TOML_SYNTAX)
                        .with("reason", pathbuild_diagnostic::Value::foreign(error.message())),
                    error.span().unwrap_or(0..0),
                );
                return Err(reader.findings.into_result().unwrap_or_else(|errors| errors));
            }
        };
        let definition = reader.definition(table.get_ref());
        let mut findings = reader.findings;
        if !findings.has_error {
            for doubt in likely_mistakes(&definition, file) {
                findings.add(doubt);
            }
        }
        findings.into_result().map(|warnings| (definition, warnings))
    }

    pub(crate) fn extension(&self) -> &str {
        &self.settings.extension
    }

    pub(crate) fn dialect(&self) -> Option<&str> {
        self.settings.dialect.as_deref()
    }

    /// Whether any text uses a variable, by its own name or an alias.
    pub(crate) fn uses(&self, variable: &str) -> bool {
        self.uses_in(ControlTextKind::ALL, variable)
    }

    /// Like [`uses`](Self::uses), but only for texts of these kinds.
    pub(super) fn uses_in(&self, kinds: &[ControlTextKind], variable: &str) -> bool {
        let others = self.aliases.iter().filter(|(_, ours)| **ours == *variable).map(|(theirs, _)| &**theirs);
        let names: Vec<&str> = others.chain([variable]).collect();
        let texts = kinds.iter().filter_map(|kind| self.text(*kind));
        texts.into_iter().any(|text| names.iter().any(|name| text.text.contains(name)))
    }

    /// Whether the definition writes the spindle speed, but only at tool changes or at the start of the program, so that each tool must have a single
    /// speed throughout a job.
    pub(crate) fn has_one_speed_per_tool(&self) -> bool {
        let mut with_speed =
            self.texts().filter(|(kind, _)| self.uses_any(*kind, &["MillingSpindleRate"])).peekable();
        with_speed.peek().is_some()
            && with_speed
                .all(|(kind, _)| matches!(kind, ControlTextKind::ToolChange | ControlTextKind::ProgramStart))
    }

    pub(crate) fn decimals(&self) -> u8 {
        u8::try_from(self.settings.decimals).unwrap_or(u8::MAX)
    }

    /// Returns the option that determines how numbers are written, for messages.
    pub(crate) fn format_option(&self) -> StatedOption {
        self.option("decimals", self.settings.decimals.to_string())
    }

    /// Returns the option that determines how far lines may be from the arc that they replace, for messages.
    pub(crate) fn chord_option(&self) -> StatedOption {
        self.option("arc-tolerance", self.settings.arc_tolerance.to_string())
    }

    fn option(&self, name: &'static str, value: String) -> StatedOption {
        let (line, column) = self.settings.places.get(name).copied().unzip();
        StatedOption { name, value, line, column }
    }

    /// Maximum distance in mm between an arc and the lines that replace it.
    pub(crate) fn chord(&self) -> f64 {
        self.stated_chord().min(MAX_CHORD_DISTANCE)
    }

    /// Distance that the file states, which [`chord`](Self::chord) limits.
    pub(crate) fn stated_chord(&self) -> f64 {
        self.settings.arc_tolerance
    }

    /// Unit of the output; `None` means the unit of the job.
    pub(crate) fn units(&self) -> Option<Units> {
        self.settings.units
    }

    /// Returns a control text; `None` if it is absent or empty.
    pub(super) fn text(&self, kind: ControlTextKind) -> Option<&ControlText> {
        self.texts[kind as usize].as_ref().filter(|text| !text.text.is_empty())
    }

    /// Returns the signs that begin and end a comment in the output; none if the text `comment` does not consist of signs around the comment.
    pub(crate) fn comment_marks(&self) -> CommentMarks {
        let text = self.text(ControlTextKind::Comment).map_or("", |text| text.text.trim());
        let Some((open, close)) = text.split_once("~CommentText~") else { return CommentMarks::default() };
        if [open, close].iter().any(|part| part.contains(['~', '{', '}', '\n'])) {
            return CommentMarks::default();
        }
        CommentMarks { open: open.trim().into(), close: close.trim().into() }
    }

    /// Whether a text uses one of these variables, by its own name or an alias.
    pub(super) fn uses_any(&self, kind: ControlTextKind, variables: &[&str]) -> bool {
        let others =
            self.aliases.iter().filter(|(_, own)| variables.contains(&&**own)).map(|(other, _)| &**other);
        let mut names = variables.iter().copied().chain(others).map(|name| format!("~{name}~"));
        self.text(kind).is_some_and(|text| names.any(|name| text.text.contains(&name)))
    }

    pub(crate) fn writes_absolute_centres(&self) -> bool {
        self.uses_any(ControlTextKind::Arc, &["XC", "YC"])
    }

    /// Returns a warning if no program ever calls a text: nothing in a program needs it, or another text of the definition is called instead.
    fn warning_if_uncalled(&self, kind: ControlTextKind) -> Option<Diagnostic> {
        let instead = |other: ControlTextKind| {
            self.text(other).map(|_| Diagnostic::new(&posts::TEXT_NOT_CALLED).quoting("other", other.name()))
        };
        match kind {
            ControlTextKind::Bezier | ControlTextKind::SubprogramStart | ControlTextKind::SubprogramEnd => {
                Some(Diagnostic::new(&posts::TEXT_NEVER_CALLED))
            }
            ControlTextKind::ContourStart | ControlTextKind::ContourEnd => instead(ControlTextKind::Rapid),
            ControlTextKind::Point => instead(ControlTextKind::Cycle),
            _ => None,
        }
    }

    pub(super) fn texts(&self) -> impl Iterator<Item = (ControlTextKind, &ControlText)> {
        ControlTextKind::ALL.iter().filter_map(|&kind| Some((kind, self.text(kind)?)))
    }
}

type Value<'a> = Spanned<DeValue<'a>>;

struct ControlTextReader<'a> {
    source: &'a str,
    lines: LineStarts,
    file: &'a Utf8Path,
    findings: Findings,
}

impl ControlTextReader<'_> {
    fn report(&mut self, diagnostic: Diagnostic, span: Range<usize>) {
        // Stop before computing the column, which requires scanning the line up to it.
        if self.findings.is_full(diagnostic.is_error()) {
            return;
        }
        let (line, column) = self.place(span.start);
        self.findings.add(diagnostic.in_file(self.file).at_line(line, Some(column)));
    }

    /// Returns the line and column of an offset in the file, counted from 1.
    fn place(&self, byte: usize) -> (u32, u32) {
        let byte = self.source.floor_char_boundary(byte);
        let column = self.source[self.lines.line_start(byte)..byte].chars().count();
        (self.lines.line(byte), u32::try_from(column + 1).unwrap_or(u32::MAX))
    }

    fn definition(&mut self, root: &DeTable<'_>) -> Definition {
        let mut definition = Definition {
            settings: Settings::default(),
            texts: vec![None; ControlTextKind::ALL.len()],
            aliases: Vec::new(),
        };
        self.each(root, "", &["post", "text", "alias"], |reader, key, value| {
            let Some(table) = value.get_ref().as_table() else {
                return reader.refuse(key, value, &Text { en: "a table", de: "eine Tabelle" });
            };
            match key {
                "post" => reader.settings(table, &mut definition.settings),
                "text" => reader.texts(table, &mut definition.texts),
                _ => reader.aliases(table, &mut definition.aliases),
            }
        });
        definition
    }

    /// Calls a function for each entry of a table that has a known key, and reports the others.
    fn each(
        &mut self,
        table: &DeTable<'_>,
        prefix: &str,
        known: &[&'static str],
        mut read: impl FnMut(&mut Self, &'static str, &Value<'_>),
    ) {
        for (key, value) in table {
            if let Some(known) = known.iter().find(|known| **known == key.get_ref().as_ref()) {
                read(self, known, value);
            } else {
                self.unknown_key(key, prefix, known);
            }
        }
    }

    fn unknown_key(&mut self, key: &Spanned<Cow<'_, str>>, prefix: &str, known: &[&'static str]) {
        let nearest = nearest(key.get_ref(), known.iter().copied());
        let diagnostic = Diagnostic::new(&posts::POST_UNKNOWN_KEY)
            .suggest_nearest(&posts::POST_UNKNOWN_KEY_NEAREST, nearest);
        let diagnostic = diagnostic.with("known", known.iter().collect::<pathbuild_diagnostic::Value>());
        self.report(diagnostic.quoting("key", format!("{prefix}{}", key.get_ref())), key.span());
    }

    fn refuse(&mut self, key: &str, value: &Value<'_>, expected: &'static Text) {
        let found =
            self.source.get(value.span()).unwrap_or("").lines().next().unwrap_or("").trim_matches('"');
        let diagnostic = Diagnostic::new(&posts::POST_OPTION).quoting("option", key).quoting("value", found);
        self.report(diagnostic.with("expected", expected), value.span());
    }

    fn settings(&mut self, table: &DeTable<'_>, settings: &mut Settings) {
        let names: Vec<&'static str> = SETTINGS.iter().map(|setting| setting.name).collect();
        self.each(table, "post.", &names, |reader, key, value| {
            let Some(setting) = SETTINGS.iter().find(|setting| setting.name == key) else { return };
            if (setting.set)(settings, value.get_ref()).is_none() {
                reader.refuse(key, value, setting.expected);
            }
            settings.places.insert(setting.name, reader.place(value.span().start));
        });
    }

    fn texts(&mut self, table: &DeTable<'_>, texts: &mut [Option<ControlText>]) {
        let names: Vec<&'static str> = ControlTextKind::ALL.iter().map(|kind| kind.name()).collect();
        self.each(table, "text.", &names, |reader, key, value| {
            let Some(kind) = ControlTextKind::ALL.iter().find(|kind| kind.name() == key) else { return };
            match value.get_ref().as_str() {
                Some(text) if text.contains(is_private) => {
                    reader.refuse(
                        key,
                        value,
                        &Text {
                            en: "a text of ordinary characters",
                            de: "ein Text aus gewöhnlichen Zeichen",
                        },
                    );
                }
                Some(text) => texts[*kind as usize] = Some(reader.control_text(text, value.span())),
                None => reader.refuse(key, value, &Text { en: "a text", de: "ein Text" }),
            }
        });
    }

    fn control_text(&self, text: &str, span: Range<usize>) -> ControlText {
        let text = text.replace("\r\n", "\n");
        let text = text.strip_suffix('\n').unwrap_or(&text).to_owned();
        ControlText { begins: Some(self.place(span.start + self.opening_length(&span))), text }
    }

    /// Returns the length of the opening quotes of a text in bytes, including the line break that TOML skips after them.
    fn opening_length(&self, span: &Range<usize>) -> usize {
        let quoted = self.source.get(span.clone()).unwrap_or("");
        let quotes = if quoted.starts_with("'''") || quoted.starts_with("\"\"\"") { 3 } else { 1 };
        let rest = &quoted[quotes.min(quoted.len())..];
        let line_end = if rest.starts_with("\r\n") { 2 } else { usize::from(rest.starts_with('\n')) };
        quotes + if quotes == 3 { line_end } else { 0 }
    }

    fn aliases(&mut self, table: &DeTable<'_>, aliases: &mut Vec<(Box<str>, Box<str>)>) {
        for (own, other) in table {
            match other.get_ref().as_str() {
                Some(name) if super::expand::is_name(name) => {
                    self.lint_alias(own);
                    aliases.push((name.into(), own.get_ref().as_ref().into()));
                }
                _ => self.refuse(
                    own.get_ref(),
                    other,
                    &Text { en: "the name of a variable", de: "der Name einer Variablen" },
                ),
            }
        }
    }

    fn lint_alias(&mut self, own: &Spanned<Cow<'_, str>>) {
        let name = own.get_ref().as_ref();
        if Variable::by_name(name).is_none() && !is_parameter(name) {
            self.report(Diagnostic::new(&posts::ALIAS_UNKNOWN).quoting("name", name), own.span());
        }
    }
}

/// The abilities of a definition, which depend on the control texts that it has and the variables that these use.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is about a text of its own")]
pub(super) struct Abilities {
    /// Whether there is a text for rapid moves. If so, every rapid move is written as its own call; otherwise the texts for contours and holes imply
    /// them.
    pub(super) rapid: bool,
    /// Whether there is a text for holes.
    pub(super) hole: bool,
    /// Whether the text for holes uses the peck depth.
    pub(super) peck: bool,
    /// Whether the text for holes uses the dwell time at the bottom.
    pub(super) dwell: bool,
    /// Whether there is a text for arcs.
    pub(super) arc: bool,
    /// Whether the text for arcs uses centres relative to the start of the arc.
    pub(super) has_relative_centres: bool,
    /// Whether the text for arcs uses absolute centres.
    pub(super) has_absolute_centres: bool,
    pub(super) decimals: usize,
    /// Whether a straight cut may change Z.
    pub(super) line_z: bool,
    /// Whether an arc may change Z, as in a helix.
    pub(super) arc_z: bool,
    pub(super) lift_between_passes: bool,
    /// Maximum angle swept by an arc, in radians. Arcs that sweep more are split.
    pub(super) arc_sweep: f64,
    /// Maximum distance in mm between an arc and the lines that replace it.
    pub(super) arc_tolerance: f64,
}

impl Abilities {
    pub(super) fn of(definition: &Definition) -> Self {
        let has = |kind| definition.text(kind).is_some();
        let hole = if has(ControlTextKind::Cycle) { ControlTextKind::Cycle } else { ControlTextKind::Point };
        Self {
            rapid: has(ControlTextKind::Rapid),
            hole: has(hole),
            peck: definition.uses_any(hole, &["PeckDepth"]),
            dwell: definition.uses_any(hole, &["DwellTime"]),
            has_absolute_centres: definition.writes_absolute_centres(),
            has_relative_centres: definition.uses_any(ControlTextKind::Arc, &["IRel", "JRel"]),
            decimals: definition.settings.decimals,
            arc: has(ControlTextKind::Arc),
            line_z: definition.uses_any(ControlTextKind::Line, &["Z1", "ZIncr"]),
            arc_z: definition.uses_any(ControlTextKind::Arc, &["Z1", "ZIncr"]),
            lift_between_passes: definition.settings.lift_between_passes,
            arc_sweep: definition.settings.arc_sweep.to_radians(),
            arc_tolerance: definition.chord(),
        }
    }
}

/// Reports likely mistakes in a definition, including texts that no program calls, whose words would be missing from every program.
fn likely_mistakes(definition: &Definition, file: &Utf8Path) -> Vec<Diagnostic> {
    let uncalled = definition.texts().filter_map(|(kind, text)| {
        let warning = definition.warning_if_uncalled(kind)?;
        Some(locate(warning, kind, text, 0..text.line_around(0).1.len(), file))
    });
    uncalled.chain(definition.texts().flat_map(|(kind, text)| mistakes_in_text(kind, text, file))).collect()
}

fn mistakes_in_text(kind: ControlTextKind, text: &ControlText, file: &Utf8Path) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let mut statements = Statements::default();
    let mut rest = text.text.as_str();
    // An invalid text ends the loop silently: it is reported when it is run.
    while let Ok(Some((before, name, after))) = split_at_next_variable(rest)
        && diagnostics.len() < MAX_FINDINGS
    {
        let at = text.text.len() - rest.len() + before.len();
        statements.pass(before);
        let message = if statements.assigned.contains(name) {
            Some(&posts::READ_AFTER_ASSIGNMENT)
        } else {
            (is_number(name) && statements.open.is_empty()).then_some(&posts::NUMBER_UNFORMATTED)
        };
        if let Some(message) = message {
            let diagnostic = Diagnostic::new(message).quoting("name", name);
            diagnostics.push(locate(diagnostic, kind, text, at..at + name.len() + 2, file));
        }
        rest = after;
    }
    diagnostics
}

fn is_number(name: &str) -> bool {
    Variable::by_name(name).is_some_and(|variable| !variable.is_text)
}

/// The statements that are open at a position of a text, and the variables assigned before that position.
#[derive(Default)]
struct Statements<'a> {
    /// For each open statement, the variable that it assigns, if any.
    open: Vec<Option<&'a str>>,
    assigned: BTreeSet<&'a str>,
}

impl<'a> Statements<'a> {
    fn pass(&mut self, text: &'a str) {
        for (at, brace) in text.match_indices(['{', '}']) {
            if brace == "{" {
                self.open.push(text[at + 1..].strip_prefix('=').map(leading_name));
            } else if let Some(Some(name)) = self.open.pop() {
                self.assigned.insert(name);
            }
        }
    }
}

fn leading_name(text: &str) -> &str {
    let length = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..length]
}

/// The values of the table `[post]` in a definition.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "the file's keys are independent switches")]
pub(super) struct Settings {
    pub(super) name: Box<str>,
    pub(super) extension: Box<str>,
    pub(super) end_of_line: &'static str,
    pub(super) decimals: usize,
    /// Line and column of each setting in the file.
    places: HashMap<&'static str, (u32, u32)>,
    /// Unit of the output; `None` means the unit of the job.
    pub(super) units: Option<Units>,
    pub(super) number_lines: bool,
    /// Whether trailing blanks of lines are removed.
    pub(super) trim: bool,
    pub(super) dialect: Option<Box<str>>,
    /// Whether lines that are no G-code are intended.
    pub(super) suppress_parser_errors: bool,
    /// Maximum distance in mm between an arc and the lines that replace it.
    pub(super) arc_tolerance: f64,
    /// Maximum angle swept by an arc, in degrees. Arcs that sweep more are split.
    pub(super) arc_sweep: f64,
    /// Whether the descent from one pass to the next may be replaced by retracting the tool and plunging again.
    pub(super) lift_between_passes: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            name: "".into(),
            extension: "nc".into(),
            end_of_line: "\n",
            decimals: 3,
            places: HashMap::new(),
            units: None,
            number_lines: true,
            trim: true,
            dialect: None,
            suppress_parser_errors: false,
            arc_tolerance: 0.01,
            arc_sweep: 360.0,
            lift_between_passes: false,
        }
    }
}

/// A key of the table `[post]` in a definition.
pub(super) struct KeyDeclaration {
    pub(super) name: &'static str,
    /// Permitted values, for messages and the book.
    pub(super) expected: &'static Text,
    /// Applies a value; returns `None` if the value is not permitted.
    pub(super) set: fn(&mut Settings, &DeValue<'_>) -> Option<()>,
    /// Meaning and default, for the book.
    pub(super) about: Text,
}

/// Declares the keys of `[post]`. Each entry has the function that reads its value, the permitted values, and for the book its meaning and
/// default.
macro_rules! settings {
    ($($name:literal $set:expr, $expected_en:literal, $expected_de:literal, $en:literal, $de:literal;)*) => {
        pub(super) static SETTINGS: &[KeyDeclaration] = &[$(KeyDeclaration {
            name: $name,
            expected: &Text { en: $expected_en, de: $expected_de },
            set: $set,
            about: Text { en: $en, de: $de },
        },)*];
    };
}

settings! {
    "name" |s, v| put(&mut s.name, text(v)), "a text", "ein Text",
        "name of the post", "Name des Postprozessors";
    "description" |_, v| v.as_str().map(drop), "a text", "ein Text",
        "a comment on the definition", "ein Kommentar zur Definition";
    "extension" |s, v| put(&mut s.extension, extension(v)), "a file name's extension", "die Endung eines Dateinamens",
        "extension of the files that are written; default `nc`",
        "Endung der geschriebenen Dateien; sonst `nc`";
    "end-of-line" |s, v| put(&mut s.end_of_line, end_of_line(v)), "lf or crlf", "lf oder crlf",
        "line ends; default `lf`", "Zeilenenden; sonst `lf`";
    "decimals" |s, v| put(&mut s.decimals, decimals(v)), "a whole number up to 9", "eine ganze Zahl bis 9",
        "decimals of rounded numbers; default 3", "Nachkommastellen gerundeter Zahlen; sonst 3";
    "units" |s, v| put(&mut s.units, units(v).map(Some)), "mm or inch", "mm oder inch",
        "unit of all lengths; default: that of the program",
        "Einheit aller Längen; sonst die des Programms";
    "number-lines" |s, v| put(&mut s.number_lines, v.as_bool()), "true or false", "true oder false",
        "whether `line-number` is called; default `true`", "ob `line-number` aufgerufen wird; sonst `true`";
    "trim" |s, v| put(&mut s.trim, v.as_bool()), "true or false", "true oder false",
        "whether blanks at line ends are removed; default `true`",
        "ob Leerzeichen am Zeilenende entfallen; sonst `true`";
    "dialect" |s, v| put(&mut s.dialect, text(v).map(Some)), "a text", "ein Text",
        "the dialect in which the output is read back", "der Dialekt, in dem die Ausgabe zurückgelesen wird";
    "suppress-parser-errors" |s, v| put(&mut s.suppress_parser_errors, v.as_bool()), "true or false", "true oder false",
        "whether lines that are no G-code pass without a warning; default `false`",
        "ob Zeilen, die kein G-Code sind, ohne Warnung bleiben; sonst `false`";
    "arc-tolerance" |s, v| put(&mut s.arc_tolerance, positive(v)), "mm above 0", "mm über 0",
        "greatest distance of a line from the arc that it stands for, at most 0.05; default 0.01",
        "größter Abstand einer Strecke vom Bogen, für den sie steht, höchstens 0.05; sonst 0.01";
    "arc-sweep" |s, v| put(&mut s.arc_sweep, sweep(v)), "degrees from 10 to 360", "Grad von 10 bis 360",
        "largest angle of an arc (larger arcs are divided); default 360",
        "größter Winkel eines Bogens (größere werden geteilt); sonst 360";
    "lift-between-passes" |s, v| put(&mut s.lift_between_passes, v.as_bool()), "true or false", "true oder false",
        "whether the tool may be lifted out between two passes instead of going down in the cut; default `false`",
        "ob das Werkzeug zwischen zwei Durchgängen herausgehoben werden darf, statt im Schnitt abwärts zu fahren; sonst `false`";
}

fn put<T>(setting: &mut T, value: Option<T>) -> Option<()> {
    *setting = value?;
    Some(())
}

fn text(value: &DeValue<'_>) -> Option<Box<str>> {
    value.as_str().map(Into::into)
}

fn extension(value: &DeValue<'_>) -> Option<Box<str>> {
    crate::extension(value.as_str()?)
}

fn end_of_line(value: &DeValue<'_>) -> Option<&'static str> {
    match value.as_str()?.to_ascii_lowercase().as_str() {
        "lf" | "\n" => Some("\n"),
        "crlf" | "\r\n" => Some("\r\n"),
        _ => None,
    }
}

fn units(value: &DeValue<'_>) -> Option<Units> {
    match value.as_str()? {
        "mm" => Some(Units::Millimetres),
        "inch" => Some(Units::Inches),
        _ => None,
    }
}

fn decimals(value: &DeValue<'_>) -> Option<usize> {
    value.as_integer()?.as_str().parse().ok().filter(|decimals| *decimals <= 9)
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    let text = value.as_float().map(DeFloat::as_str).or_else(|| value.as_integer().map(DeInteger::as_str))?;
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

fn positive(value: &DeValue<'_>) -> Option<f64> {
    number(value).filter(|number| *number > 0.0)
}

fn sweep(value: &DeValue<'_>) -> Option<f64> {
    number(value).filter(|number| (10.0..=360.0).contains(number))
}
