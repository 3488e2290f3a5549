//! Reads the values of a TOML file, each with its position, and says where a misplaced or misspelled key belongs.

use std::borrow::Cow;
use std::cell::LazyCell;
use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{ConfinedSystem, with_forward_slashes};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Text, TextFault, Value, nearest};
use serde_json::{Map, Value as Json};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::origin::{Origin, SourcedValue};

/// A reader of the values in a parsed TOML file, which collects all diagnostics.
pub(super) struct TomlReader<'a> {
    source: Source<'a>,
    directory: &'a Utf8Path,
    /// System that is confined to the directories of an untrusted configuration; `None` if the configuration is trusted.
    confined: Option<&'a ConfinedSystem>,
    /// Index for finding the table that a misplaced key belongs to; `None` for files other than `pathbuild.toml`.
    key_index: Option<LazyKeyIndex>,
    key: String,
    diagnostics: Vec<Diagnostic>,
    /// Number of regular expressions and number of globs read so far.
    counts: [u64; 2],
}

/// An index of keys that is built when the first misplaced key is found.
type LazyKeyIndex = LazyCell<KeyIndex, Box<dyn FnOnce() -> KeyIndex>>;

/// A kind of value that is limited in number, because each such value takes far more memory than its text.
#[derive(Clone, Copy, Debug)]
pub(super) enum LimitedKind {
    Regex,
    Glob,
}

impl LimitedKind {
    fn maximum(self) -> (u64, &'static Text) {
        match self {
            Self::Regex => (400, &messages::REGEXES),
            Self::Glob => (10_000, &messages::GLOBS),
        }
    }
}

impl<'a> TomlReader<'a> {
    /// Creates a reader for a file. Relative paths in the file start at `directory`.
    pub(super) fn new(
        source: Source<'a>,
        directory: &'a Utf8Path,
        confined: Option<&'a ConfinedSystem>,
    ) -> Self {
        Self {
            source,
            directory,
            confined,
            key_index: None,
            key: String::new(),
            diagnostics: Vec::new(),
            counts: [0; 2],
        }
    }

    /// Makes the reader report, from now on, to which table of a `pathbuild.toml` of this schema a misplaced key belongs.
    pub(super) fn suggest_tables(&mut self, schema: fn() -> Json) {
        self.key_index = Some(LazyCell::new(Box::new(move || KeyIndex::new(&schema()))));
    }

    /// Reads a table. Keys that `read` does not take are reported.
    pub(super) fn table<T>(
        &mut self,
        table: &DeTable<'_>,
        prefix: &str,
        read: impl FnOnce(&mut Table<'_, '_, 'a>) -> T,
    ) -> T {
        let key = self.key.clone();
        let mut table = Table { content: table, prefix: prefix.to_owned(), known: Vec::new(), reader: self };
        let value = read(&mut table);
        table.report_unknown();
        self.key = key;
        value
    }

    /// Returns the file or directory that a value names, relative to the configuration's directory.
    pub(super) fn path(&mut self, name: &str, value: &Spanned<DeValue<'_>>) -> Option<Utf8PathBuf> {
        // In double quotes, the \t of C:\temp is a tab.
        if name.contains(char::is_control) {
            self.report(self.fault(&messages::CONTROL_CHARACTER, value.span()));
            return None;
        }
        if let Some(found) = shell_abbreviation(name) {
            self.report(self.fault(&messages::SHELL_ABBREVIATION, value.span()).quoting("found", found));
            return None;
        }
        if !cfg!(windows) && name.contains('\\') {
            self.report(self.fault(&messages::BACKSLASH_IN_PATH, value.span()));
            return None;
        }
        let path: Utf8PathBuf = with_forward_slashes(self.directory.join(name).components().collect());
        match self.confined.filter(|confined| !confined.is_in_configured_root(&path)) {
            None => Some(path),
            Some(confined) => {
                let fault = self.fault(&messages::OUTSIDE, value.span());
                self.report(fault.quoting("root", confined.root().as_str()));
                None
            }
        }
    }

    pub(super) fn is_untrusted(&self) -> bool {
        self.confined.is_some()
    }

    /// Returns the full name of the key that is being read, for messages.
    pub(super) fn key(&self) -> &str {
        &self.key
    }

    /// Reads a value with `read`, while `name` is appended to the full name of the key.
    pub(super) fn read_within<T>(&mut self, name: &str, read: impl FnOnce(&mut Self) -> T) -> T {
        let table = std::mem::take(&mut self.key);
        self.key = format!("{table}.{}", shortened(name));
        let value = read(self);
        self.key = table;
        value
    }

    /// Reports that the table being read lacks a key.
    pub(super) fn report_missing(&mut self, name: &'static str, span: Range<usize>) {
        self.report(self.fault(&messages::MISSING_KEY, span).quoting("missing", name));
    }

    /// Returns the line of a span, counted from 1.
    pub(super) fn line(&self, span: Range<usize>) -> u32 {
        self.source.line_number(span.start)
    }

    /// Creates a diagnostic for a span, with the current key filled in.
    pub(super) fn fault(&self, message: &'static Message, span: Range<usize>) -> Diagnostic {
        self.source.fault(message, span).quoting("key", self.key.as_str())
    }

    /// Counts a value of a limited kind. Returns whether the limit allows this value. Exceeding the limit is reported only once.
    pub(super) fn count_limited(&mut self, what: LimitedKind, span: Range<usize>) -> bool {
        let (most, word) = what.maximum();
        let count = &mut self.counts[what as usize];
        *count += 1;
        let beyond = count.saturating_sub(most);
        if beyond == 1 {
            self.report(self.fault(&messages::TOO_MANY_PATTERNS, span).with("what", word).with("most", most));
        }
        beyond == 0
    }

    /// Reports a name in a table with user-defined keys if it is that of a key that belongs before all tables. This happens when a key is appended to
    /// a file that ends with such a table. Returns whether the name was reported.
    pub(super) fn report_key_of_top(&mut self, name: &Spanned<DeString<'_>>) -> bool {
        let home = self.key_index.as_ref().and_then(|index| index.find(name.get_ref()));
        let is_of_top = home.is_some_and(|home| home.is_exact && home.header.is_none());
        if is_of_top {
            self.read_within(name.get_ref(), |reader| {
                let fault = reader.fault(&messages::KEY_OF_TOP, name.span());
                reader.report(fault.quoting("near", &**name.get_ref()));
            });
        }
        is_of_top
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Returns the content of `found`; if there is none, reports that the TOML value is not of the expected kind.
    pub(super) fn require<T>(
        &mut self,
        found: Option<T>,
        expected: &'static Text,
        value: &Spanned<DeValue<'_>>,
    ) -> Option<T> {
        found.or_else(|| self.report_unexpected(expected, value))
    }

    /// Reports that a value is not of the expected kind, and returns `None`.
    pub(super) fn report_unexpected<T>(
        &mut self,
        expected: &'static Text,
        value: &Spanned<DeValue<'_>>,
    ) -> Option<T> {
        let found = self.source.slice(value.span()).lines().next().unwrap_or_default();
        let fault = self
            .fault(&messages::INVALID_VALUE, value.span())
            .with("expected", expected)
            .quoting("found", found);
        self.report(fault);
        None
    }

    /// Returns the value as a string; reports a value of another type.
    pub(super) fn text<'v>(&mut self, value: &'v Spanned<DeValue<'_>>) -> Option<&'v str> {
        self.require(value.get_ref().as_str(), &messages::TEXT, value)
    }

    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.diagnostics
    }
}

fn shortened(name: &str) -> Cow<'_, str> {
    const MAX_NAME_BYTES: usize = 100;
    if name.len() <= MAX_NAME_BYTES {
        return name.into();
    }
    format!("{}…", &name[..name.floor_char_boundary(MAX_NAME_BYTES)]).into()
}

/// Keys of earlier versions, each with the key that replaces it.
const REPLACED_KEYS: [(&str, &str); 1] = [("support-bars", "compatible")];

pub(super) struct Table<'t, 'r, 'a> {
    content: &'t DeTable<'t>,
    prefix: String,
    known: Vec<&'static str>,
    reader: &'r mut TomlReader<'a>,
}

impl<'a> Table<'_, '_, 'a> {
    /// Reads the value of a key, if it is present and valid.
    pub(super) fn take<T>(&mut self, name: &'static str, kind: &ValueType<T>) -> Option<SourcedValue<T>> {
        self.known.push(name);
        let value = self.content.get(name)?;
        self.reader.key = format!("{}{name}", self.prefix);
        let line = self.reader.source.line_number(value.span().start);
        (kind.read)(value, self.reader).map(|value| SourcedValue { value, origin: Origin::File(line) })
    }

    pub(super) fn is_untrusted(&self) -> bool {
        self.reader.is_untrusted()
    }

    /// Reports that a limit of an untrusted configuration exceeds its default. `default` is formatted as TOML.
    pub(super) fn report_raised(&mut self, name: &'static str, default: &str) {
        let Some(value) = self.content.get(name) else { return };
        self.reader.key = format!("{}{name}", self.prefix);
        let fault = self.reader.fault(&messages::RAISED_LIMIT, value.span()).quoting("default", default);
        self.reader.report(fault);
    }

    /// Reports that the value of a key is incompatible with another key of the table.
    pub(super) fn report_incompatible(&mut self, name: &'static str, expected: &'static Text) {
        let Some(value) = self.content.get(name) else { return };
        self.reader.key = format!("{}{name}", self.prefix);
        _ = self.reader.report_unexpected::<()>(expected, value);
    }

    /// Reads a nested table; a missing one is treated as empty. If `name` is empty, its keys are in this table itself.
    pub(super) fn section<T: Default>(
        &mut self,
        name: &'static str,
        read: impl FnOnce(&mut Table<'_, '_, 'a>) -> T,
    ) -> T {
        if name.is_empty() {
            return read(self);
        }
        self.known.push(name);
        let Some(value) = self.content.get(name) else { return T::default() };
        self.reader.key = format!("{}{name}", self.prefix);
        match value.get_ref().as_table() {
            Some(table) => self.reader.table(table, &format!("{}{name}.", self.prefix), read),
            None => self.reader.report_unexpected(&messages::TABLE, value).unwrap_or_default(),
        }
    }

    /// Refuses a table that is reserved for a later version.
    pub(super) fn refuse_reserved(&mut self, name: &'static str) {
        if let Some((key, _)) = self.content.get_key_value(name) {
            // If the key were known without being present, it would be suggested for misspelled keys.
            self.known.push(name);
            self.reader.key = format!("{}{name}", self.prefix);
            self.reader.report(self.reader.fault(&messages::NOT_BUILT, key.span()));
        }
    }

    fn report_unknown(&mut self) {
        for key in self.content.keys().filter(|key| !self.known.contains(&&**key.get_ref())) {
            self.reader.key = format!("{}{}", self.prefix, shortened(key.get_ref()));
            let replaced = REPLACED_KEYS.iter().find(|(old, _)| old == key.get_ref());
            let fault = match replaced.filter(|(_, new)| self.known.contains(new)) {
                Some((_, new)) => self.reader.fault(&messages::REPLACED_KEY, key.span()).quoting("new", *new),
                None => self.unknown_key(key.get_ref(), key.span()),
            };
            self.reader.report(fault);
        }
    }

    /// Returns the diagnostic for an unknown key. It suggests the table that has such a key, or a similar key.
    fn unknown_key(&self, name: &str, span: Range<usize>) -> Diagnostic {
        let fault = |message| self.reader.fault(message, span.clone());
        let home = self.reader.key_index.as_ref().and_then(|index| index.find(name));
        if let Some(home) = home.filter(|home| home.is_exact) {
            return misplaced_key(fault, &home, &messages::KEY_OF_TABLE, &messages::KEY_OF_TOP);
        }
        if let Some(near) = nearest(name, self.known.iter().copied()) {
            return fault(&messages::UNKNOWN_KEY).quoting("near", near);
        }
        match home {
            Some(home) => {
                misplaced_key(fault, &home, &messages::NEAR_KEY_OF_TABLE, &messages::NEAR_KEY_OF_TOP)
            }
            None => fault(&messages::UNLIKE_KEY).with("known", self.known.iter().collect::<Value>()),
        }
    }
}

/// Returns a diagnostic that says where a key belongs: in a table, or before all tables.
fn misplaced_key(
    fault: impl Fn(&'static Message) -> Diagnostic,
    home: &KeyPlace<'_>,
    of_table: &'static Message,
    of_top: &'static Message,
) -> Diagnostic {
    match home.header {
        Some(header) => fault(of_table).quoting("near", home.key).quoting("table", header),
        None => fault(of_top).quoting("near", home.key),
    }
}

/// All keys of `pathbuild.toml`, taken from the schema, each with the header of its table as written in the file, such as `[machine]` or
/// `[tool.NAME]`; `None` for the keys before all tables.
#[derive(Debug)]
pub(super) struct KeyIndex(Vec<(Option<String>, String)>);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct KeyPlace<'a> {
    /// Header of the table; `None` for the keys before all tables.
    pub(super) header: Option<&'a str>,
    pub(super) key: &'a str,
    /// Whether the name is spelled exactly like the one that was searched for.
    pub(super) is_exact: bool,
}

impl KeyIndex {
    pub(super) fn new(schema: &Json) -> Self {
        let none = Map::new();
        let root = properties(schema).unwrap_or(&none);
        let mut all: Vec<_> = root.keys().map(|key| (None, key.clone())).collect();
        for (name, value) in root {
            let headers = [
                (format!("[{name}]"), properties(value)),
                (format!("[{name}.NAME]"), properties(&value["additionalProperties"])),
                (format!("[{name}]"), properties(&value["oneOf"][1])),
                (format!("[[{name}]]"), properties(&value["items"])),
            ];
            for (header, keys) in headers {
                all.extend(
                    keys.into_iter().flat_map(Map::keys).map(|key| (Some(header.clone()), key.clone())),
                );
            }
        }
        Self(all)
    }

    /// Finds the table to which a misplaced key belongs: one that has a key of this name, or else one that has a key of a similar name.
    pub(super) fn find(&self, name: &str) -> Option<KeyPlace<'_>> {
        let exact = self.keys().find(|home| home.key == name);
        exact.or_else(|| {
            let near = nearest(name, self.keys().map(|home| home.key))
                .filter(|_| name.len() >= MIN_SUGGESTED_LENGTH)?;
            let home = self.keys().find(|home| home.key == near)?;
            Some(KeyPlace { is_exact: false, ..home })
        })
    }

    fn keys(&self) -> impl Iterator<Item = KeyPlace<'_>> {
        self.0.iter().map(|(header, key)| KeyPlace { header: header.as_deref(), key, is_exact: true })
    }
}

/// Minimum length of a name for which similar names in other tables are suggested: shorter names resemble too many others.
const MIN_SUGGESTED_LENGTH: usize = 5;

fn properties(table: &Json) -> Option<&Map<String, Json>> {
    table["properties"].as_object()
}

/// A text file that maps byte offsets to lines and columns. Finding an offset does not scan the text before it.
#[derive(Clone, Debug)]
pub(super) struct Source<'a> {
    file: &'a Utf8Path,
    text: &'a str,
    /// Byte offset of the beginning of each line.
    lines: Vec<usize>,
    /// Number of characters before each block of [`BLOCK_BYTES`] bytes.
    characters: Vec<usize>,
}

/// Size in bytes of the blocks for which characters are counted.
const BLOCK_BYTES: usize = 1 << 10;

/// Number of bytes of a line that are shown on each side of a fault.
const MAX_CONTEXT_BYTES: usize = 200;

impl<'a> Source<'a> {
    pub(super) fn new(file: &'a Utf8Path, text: &'a str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(end, _)| end + 1)).collect();
        let counts = text.as_bytes().chunks(BLOCK_BYTES).scan(0, |before, block| {
            let count = *before;
            *before += count_character_starts(block);
            Some(count)
        });
        Self { file, text, lines, characters: counts.collect() }
    }

    /// Returns a diagnostic that underlines a byte range; of a range of several lines, only the part in its first line.
    pub(super) fn fault(&self, message: &'static Message, span: Range<usize>) -> Diagnostic {
        let start = self.text.floor_char_boundary(span.start);
        let number = self.line_index(start);
        let begin = self.lines[number];
        let column = self.character(start) - self.character(begin) + 1;
        let (from, end) = (self.shown_from(begin, start), self.shown_to(start, span.end));
        Diagnostic::new(message)
            .in_file(self.file)
            .at_line(self.line_number(start), u32::try_from(column).ok())
            .with_text(TextFault::new(
                &self.text[from..end],
                start - from..span.end.min(end).saturating_sub(from),
            ))
    }

    /// Returns the number of the line that contains a byte, counted from 1.
    pub(super) fn line_number(&self, byte: usize) -> u32 {
        u32::try_from(self.line_index(byte) + 1).unwrap_or(u32::MAX)
    }

    pub(super) fn slice(&self, span: Range<usize>) -> &'a str {
        self.text.get(span).unwrap_or_default()
    }

    fn line_index(&self, byte: usize) -> usize {
        self.lines.partition_point(|line| *line <= byte).saturating_sub(1)
    }

    /// Returns the number of characters that begin before a byte.
    fn character(&self, byte: usize) -> usize {
        let block = (byte / BLOCK_BYTES).min(self.characters.len().saturating_sub(1));
        let rest = &self.text.as_bytes()[block * BLOCK_BYTES..byte];
        self.characters.get(block).copied().unwrap_or_default() + count_character_starts(rest)
    }

    /// Returns the byte from which a line is shown, given the start of the line (`begin`) and of the fault in it.
    fn shown_from(&self, begin: usize, start: usize) -> usize {
        begin.max(self.text.floor_char_boundary(start.saturating_sub(MAX_CONTEXT_BYTES)))
    }

    /// Returns the byte up to which a line is shown, given the start and end of the fault in it.
    fn shown_to(&self, start: usize, end: usize) -> usize {
        let most = self
            .text
            .ceil_char_boundary((end.clamp(start, start + MAX_CONTEXT_BYTES)) + MAX_CONTEXT_BYTES)
            .min(self.text.len());
        self.text[start..most].find(['\n', '\r']).map_or(most, |length| start + length)
    }
}

fn count_character_starts(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| byte.cast_signed() >= -0x40).count()
}

/// Type of a configuration value: functions that read it from TOML, format it as TOML, and describe it in the JSON schema.
pub(super) struct ValueType<T> {
    /// Reads a value, or reports why it is invalid.
    pub(super) read: fn(&Spanned<DeValue<'_>>, &mut TomlReader<'_>) -> Option<T>,
    /// Formats the value as TOML; `None` if there is nothing to show.
    pub(super) show: fn(&T) -> Option<String>,
    pub(super) schema: fn() -> Json,
}

/// Returns the first part of a path if a shell would replace it: `~`, `$HOME` or `%USERPROFILE%`.
fn shell_abbreviation(path: &str) -> Option<&str> {
    let first = path.split(['/', '\\']).next()?;
    let is_of_windows = first.len() > 2 && first.starts_with('%') && first.ends_with('%');
    (first == "~" || first.starts_with('$') || is_of_windows).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_has_its_keys() {
        let key_index = KeyIndex::new(&super::super::describe::schema());
        for (key, header) in [
            ("library", None),
            ("travel", Some("[machine]")),
            ("targets", Some("[emit]")),
            ("coolant", Some("[tool.NAME]")),
            ("unchecked", Some("[post]")),
            ("files", Some("[[severity-in]]")),
        ] {
            assert_eq!(key_index.find(key), Some(KeyPlace { header, key, is_exact: true }));
        }
    }

    #[test]
    fn nearly_right_names_of_five_letters_are_found() {
        let key_index = KeyIndex::new(&super::super::describe::schema());
        let near = KeyPlace { header: Some("[machine]"), key: "rates", is_exact: false };
        assert_eq!(key_index.find("ratse"), Some(near));
        assert_eq!(key_index.find("rate"), None);
        assert_eq!(key_index.find("colour-of-the-bit"), None);
    }
}
