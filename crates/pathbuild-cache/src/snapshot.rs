//! Read access to cached results in the form in which they lie in their file. All offsets and lengths are checked once, when the file is
//! loaded; later accesses out of bounds, which cannot happen, yield empty values.

use std::ops::Range;

use camino::Utf8Path;

use crate::flat::{
    COUNTS, DIRECTORIES, DIRECTORY_LISTS, FILES, HASH, LISTED_DIRECTORIES, LOOKUPS, NAMES, RECORD_FILES,
    RECORD_LOOKUPS, RECORD_OUTPUTS, RECORDS, SIZES, TABLES, WORD,
};
use pathbuild_files::Stamp;

/// Cached results with all their inputs. The default is an empty snapshot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// The file up to the strings.
    bytes: Vec<u8>,
    tables: [Range<usize>; TABLES],
    payloads: Range<usize>,
    texts: String,
}

/// A file as it was read.
#[derive(Clone, Copy, Debug)]
pub struct CachedFile<'a> {
    snapshot: &'a Snapshot,
    row: Row<'a>,
}

/// A directory as it was listed.
#[derive(Clone, Copy, Debug)]
pub struct CachedDirectory<'a> {
    snapshot: &'a Snapshot,
    row: Row<'a>,
}

/// A result.
#[derive(Clone, Copy, Debug)]
pub struct CachedRecord<'a> {
    snapshot: &'a Snapshot,
    row: Row<'a>,
}

/// A row of a table.
#[derive(Clone, Copy, Debug)]
struct Row<'a>(&'a [u8]);

impl Snapshot {
    /// Parses the file from the end of its header on; `None` if an offset or an index is out of bounds.
    pub(crate) fn new(mut file: Vec<u8>, head: usize) -> Option<Self> {
        let counts = Row(file.get(head..head + COUNTS * WORD)?);
        let mut end = head + COUNTS * WORD;
        let mut next = |size: usize| {
            let begin = end;
            end = begin.checked_add(size)?;
            Some(begin..end)
        };
        let mut tables: [Range<usize>; TABLES] = Default::default();
        for (index, table) in tables.iter_mut().enumerate() {
            *table = next(counts.number(index).checked_mul(SIZES[index])?)?;
        }
        let payloads = next(counts.number(TABLES))?;
        let texts = next(counts.number(TABLES + 1))?;
        if texts.end != file.len() {
            return None;
        }
        let texts = String::from_utf8(file.split_off(texts.start)).ok()?;
        let snapshot = Self { bytes: file, tables, payloads, texts };
        snapshot.is_in_bounds().then_some(snapshot)
    }

    /// Number of files.
    pub fn files(&self) -> usize {
        self.rows(FILES)
    }

    /// A file by its index. Files are sorted by path.
    pub fn file(&self, number: usize) -> CachedFile<'_> {
        CachedFile { snapshot: self, row: self.row(FILES, number) }
    }

    /// Index of the file with this path.
    pub fn find_file(&self, path: &Utf8Path) -> Option<usize> {
        self.search(FILES, path.as_str())
    }

    /// Number of directories.
    pub fn directories(&self) -> usize {
        self.rows(DIRECTORIES)
    }

    /// A directory by its index.
    pub fn directory(&self, number: usize) -> CachedDirectory<'_> {
        CachedDirectory { snapshot: self, row: self.row(DIRECTORIES, number) }
    }

    /// Number of results.
    pub fn records(&self) -> usize {
        self.rows(RECORDS)
    }

    /// A result by its index. Results are sorted by subject.
    pub fn record(&self, number: usize) -> CachedRecord<'_> {
        CachedRecord { snapshot: self, row: self.row(RECORDS, number) }
    }

    /// Index of the result about this subject. `hint` is tried first.
    pub fn find_record(&self, subject: &str, hint: usize) -> Option<usize> {
        let is_likely = hint < self.records() && self.record(hint).subject() == subject;
        if is_likely { Some(hint) } else { self.search(RECORDS, subject) }
    }

    /// Number of distinct lookups.
    pub fn lookups(&self) -> usize {
        self.rows(LOOKUPS)
    }

    /// A lookup by its index: the index of its directory list, and the name.
    pub fn lookup(&self, number: usize) -> (usize, &str) {
        let row = self.row(LOOKUPS, number);
        (row.number(0), self.text(row, 1))
    }

    /// Number of directory lists.
    pub fn directory_lists(&self) -> usize {
        self.rows(DIRECTORY_LISTS)
    }

    /// Indices of the directories in a list.
    pub fn directory_list(&self, number: usize) -> impl ExactSizeIterator<Item = usize> {
        self.numbers(LISTED_DIRECTORIES, self.row(DIRECTORY_LISTS, number).range(0))
    }

    fn rows(&self, table: usize) -> usize {
        self.tables[table].len() / SIZES[table]
    }

    fn row(&self, table: usize, number: usize) -> Row<'_> {
        let begin = self.tables[table].start + number * SIZES[table];
        Row(self.bytes.get(begin..begin + SIZES[table]).unwrap_or_default())
    }

    /// The string whose offset and length begin at this column.
    fn text(&self, row: Row<'_>, at: usize) -> &str {
        self.texts.get(row.range(at)).unwrap_or_default()
    }

    /// The numbers in a range of single-column rows.
    fn numbers(&self, table: usize, rows: Range<usize>) -> impl ExactSizeIterator<Item = usize> {
        rows.map(move |number| self.row(table, number).number(0))
    }

    /// Binary search for the row whose first column is this string.
    fn search(&self, table: usize, text: &str) -> Option<usize> {
        let (mut low, mut high) = (0, self.rows(table));
        while low < high {
            let middle = low.midpoint(high);
            if self.text(self.row(table, middle), 0) < text {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        (low < self.rows(table) && self.text(self.row(table, low), 0) == text).then_some(low)
    }

    /// Whether every offset and index refers to something that exists.
    fn is_in_bounds(&self) -> bool {
        let all = |table: usize, is_sound: &dyn Fn(Row<'_>) -> bool| {
            (0..self.rows(table)).all(|number| is_sound(self.row(table, number)))
        };
        let is_text = |row: Row<'_>, at| self.texts.get(row.range(at)).is_some();
        let are_rows = |row: Row<'_>, at, table| row.range(at).end <= self.rows(table);
        let is_row = |row: Row<'_>, at, table| row.number(at) < self.rows(table);
        all(FILES, &|row| is_text(row, 0))
            && all(DIRECTORIES, &|row| is_text(row, 0) && is_text(row, 2) && are_rows(row, 5, NAMES))
            && all(NAMES, &|row| is_text(row, 0))
            && all(RECORDS, &|row| {
                is_text(row, 0)
                    && are_rows(row, 2, RECORD_FILES)
                    && are_rows(row, 4, RECORD_LOOKUPS)
                    && row.range(6).end <= self.payloads.len()
                    && are_rows(row, 8, RECORD_OUTPUTS)
            })
            && all(RECORD_OUTPUTS, &|row| is_row(row, 0, FILES))
            && all(RECORD_FILES, &|row| is_row(row, 0, FILES))
            && all(RECORD_LOOKUPS, &|row| is_row(row, 0, LOOKUPS))
            && all(LOOKUPS, &|row| is_row(row, 0, DIRECTORY_LISTS) && is_text(row, 1))
            && all(DIRECTORY_LISTS, &|row| are_rows(row, 0, LISTED_DIRECTORIES))
            && all(LISTED_DIRECTORIES, &|row| is_row(row, 0, DIRECTORIES))
    }
}

impl<'a> CachedFile<'a> {
    /// Its path, spelled as in the run that read it.
    pub fn path(self) -> &'a Utf8Path {
        Utf8Path::new(self.snapshot.text(self.row, 0))
    }

    /// The file's metadata when it was read.
    pub fn stamp(self) -> Stamp {
        Stamp::from_bytes(self.row.bytes(2))
    }

    /// The blake3 hash of its bytes; `None` if it was not, or could not be, read.
    pub fn hash(self) -> Option<[u8; HASH]> {
        const AT: usize = 2 + Stamp::SIZE / WORD;
        (self.row.number(AT) == 1).then(|| self.row.bytes(AT + 1))
    }
}

impl<'a> CachedDirectory<'a> {
    /// Its path, spelled as in the run that read it.
    pub fn path(self) -> &'a Utf8Path {
        Utf8Path::new(self.snapshot.text(self.row, 0))
    }

    /// Canonical path when it was listed.
    pub fn canonical(self) -> &'a str {
        self.snapshot.text(self.row, 2)
    }

    /// Whether lookups in this directory are always repeated.
    pub fn is_doubtful(self) -> bool {
        self.row.word(4) != 0
    }

    /// Its file names, sorted.
    pub fn names(self) -> impl ExactSizeIterator<Item = &'a str> {
        self.row.range(5).map(move |number| self.snapshot.text(self.snapshot.row(NAMES, number), 0))
    }
}

impl<'a> CachedRecord<'a> {
    /// What the result is about.
    pub fn subject(self) -> &'a str {
        self.snapshot.text(self.row, 0)
    }

    /// Indices of the files that were read.
    pub fn files(self) -> impl ExactSizeIterator<Item = usize> + use<'a> {
        self.snapshot.numbers(RECORD_FILES, self.row.range(2))
    }

    /// Indices of the lookups that were made.
    pub fn lookups(self) -> impl ExactSizeIterator<Item = usize> + use<'a> {
        self.snapshot.numbers(RECORD_LOOKUPS, self.row.range(4))
    }

    /// Indices of the files that were written.
    pub fn outputs(self) -> impl ExactSizeIterator<Item = usize> + use<'a> {
        self.snapshot.numbers(RECORD_OUTPUTS, self.row.range(8))
    }

    /// The result itself; only the crate that stored it can decode it.
    pub fn payload(self) -> &'a [u8] {
        let Range { start, end } = self.row.range(6);
        let payloads = self.snapshot.payloads.start;
        self.snapshot.bytes.get(payloads + start..payloads + end).unwrap_or_default()
    }
}

impl Row<'_> {
    fn word(self, at: usize) -> u32 {
        u32::from_le_bytes(self.bytes(at))
    }

    fn number(self, at: usize) -> usize {
        self.word(at) as usize
    }

    /// The offset at this column with the length in the next one.
    fn range(self, at: usize) -> Range<usize> {
        let begin = self.number(at);
        begin..begin.saturating_add(self.number(at + 1))
    }

    fn bytes<const N: usize>(self, at: usize) -> [u8; N] {
        self.0.get(at * WORD..).and_then(|rest| rest.first_chunk()).copied().unwrap_or([0; N])
    }
}
