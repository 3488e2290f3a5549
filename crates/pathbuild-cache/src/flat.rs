//! The body of a results file: tables with rows of fixed size, then the payloads of the results, then all strings. Rows can be read in
//! place: a row is addressed by its index and refers to its strings by offset and length. All numbers are little-endian and four bytes
//! long.
//!
//! | table | row |
//! | --- | --- |
//! | [`FILES`], sorted by path | path, stamp, whether there is a hash, hash |
//! | [`DIRECTORIES`] | path, canonical path, doubtful flag, first name and number of names |
//! | [`NAMES`] | a name in a directory |
//! | [`RECORDS`], sorted by subject | subject, then offset and length of its files, lookups, payload and outputs |
//! | [`RECORD_FILES`] | index of a file |
//! | [`RECORD_LOOKUPS`] | index of a lookup |
//! | [`LOOKUPS`] | directory list, name |
//! | [`RECORD_OUTPUTS`] | index of a file |
//! | [`DIRECTORY_LISTS`] | first directory and number of directories |
//! | [`LISTED_DIRECTORIES`] | index of a directory |

use std::collections::HashMap;

use crate::facts::{Catalogue, DirectoryFact, FileFact, Record};
use pathbuild_files::Stamp;

/// Size in bytes of a number, and of an offset with its length.
pub(crate) const WORD: usize = 4;
const SPAN: usize = 2 * WORD;

/// Row size of each table in bytes.
pub(crate) const SIZES: [usize; TABLES] = [
    SPAN + Stamp::SIZE + WORD + HASH,
    3 * SPAN + WORD,
    SPAN,
    5 * SPAN,
    WORD,
    WORD,
    WORD + SPAN,
    WORD,
    SPAN,
    WORD,
];
pub(crate) const TABLES: usize = 10;
pub(crate) const HASH: usize = 32;

pub(crate) const FILES: usize = 0;
pub(crate) const DIRECTORIES: usize = 1;
pub(crate) const NAMES: usize = 2;
pub(crate) const RECORDS: usize = 3;
pub(crate) const RECORD_FILES: usize = 4;
pub(crate) const RECORD_LOOKUPS: usize = 5;
pub(crate) const LOOKUPS: usize = 6;
pub(crate) const RECORD_OUTPUTS: usize = 7;
pub(crate) const DIRECTORY_LISTS: usize = 8;
pub(crate) const LISTED_DIRECTORIES: usize = 9;

/// Length of the table of contents: the row count of each table, then the sizes of the payloads and the strings.
pub(crate) const COUNTS: usize = TABLES + 2;

/// The catalogue exceeds what a results file can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CatalogueTooLarge;

/// Appends a catalogue.
pub(crate) fn write(catalogue: &Catalogue, bytes: &mut Vec<u8>) -> Result<(), CatalogueTooLarge> {
    let names: usize = catalogue.directories.iter().map(|directory| directory.names.len()).sum();
    let texts = catalogue.files.len() + names + catalogue.lookups.len() + catalogue.records.len();
    let mut flat = FlatTables { interned: HashMap::with_capacity(texts), ..FlatTables::default() };
    let numbers = flat.files(&catalogue.files)?;
    for directory in &catalogue.directories {
        flat.directory(directory)?;
    }
    for list in &catalogue.directory_lists {
        let directories = flat.rows(LISTED_DIRECTORIES, list.iter().map(|directory| word(*directory)))?;
        flat.add(DIRECTORY_LISTS, &directories);
    }
    for lookup in &catalogue.lookups {
        let name = flat.text(&lookup.name)?;
        flat.add(LOOKUPS, &[word(lookup.directories)?]);
        flat.add(LOOKUPS, &name);
    }
    let mut records: Vec<&Record> = catalogue.records.iter().collect();
    records.sort_unstable_by(|a, b| a.subject.cmp(&b.subject));
    for record in records {
        flat.record(record, &numbers)?;
    }
    flat.finish(bytes)
}

/// Tables under construction.
#[derive(Default)]
struct FlatTables<'a> {
    tables: [Vec<u8>; TABLES],
    payloads: Vec<u8>,
    texts: String,
    /// Interned strings: the path of most files is also the subject of a record.
    interned: HashMap<&'a str, Span>,
}

/// Offset and length of a string, or index of the first row and number of rows.
type Span = [u32; 2];

impl<'a> FlatTables<'a> {
    fn finish(self, bytes: &mut Vec<u8>) -> Result<(), CatalogueTooLarge> {
        for (table, size) in self.tables.iter().zip(SIZES) {
            bytes.extend(word(table.len() / size)?.to_le_bytes());
        }
        bytes.extend(word(self.payloads.len())?.to_le_bytes());
        bytes.extend(word(self.texts.len())?.to_le_bytes());
        for table in &self.tables {
            bytes.extend_from_slice(table);
        }
        bytes.extend_from_slice(&self.payloads);
        bytes.extend_from_slice(self.texts.as_bytes());
        Ok(())
    }

    /// Adds all files, sorted by path, and returns the new index of each.
    fn files(&mut self, files: &'a [FileFact]) -> Result<Vec<u32>, CatalogueTooLarge> {
        let mut order: Vec<usize> = (0..files.len()).collect();
        order.sort_unstable_by(|a, b| files[*a].path.as_str().cmp(files[*b].path.as_str()));
        let mut numbers = vec![0; files.len()];
        for (new, old) in order.into_iter().enumerate() {
            numbers[old] = word(new)?;
            let FileFact { path, stamp, hash } = &files[old];
            let path = self.text(path.as_str())?;
            self.add(FILES, &path);
            self.tables[FILES].extend_from_slice(&stamp.to_bytes());
            self.add(FILES, &[u32::from(hash.is_some())]);
            self.tables[FILES].extend_from_slice(&hash.unwrap_or([0; HASH]));
        }
        Ok(numbers)
    }

    fn directory(&mut self, directory: &'a DirectoryFact) -> Result<(), CatalogueTooLarge> {
        let (path, canonical) = (self.text(directory.path.as_str())?, self.text(&directory.canonical)?);
        let first = self.tables[NAMES].len() / SIZES[NAMES];
        for name in directory.names.iter() {
            let name = self.text(name)?;
            self.add(NAMES, &name);
        }
        self.add(DIRECTORIES, &path);
        self.add(DIRECTORIES, &canonical);
        let doubt = u32::from(directory.is_doubtful);
        self.add(DIRECTORIES, &[doubt, word(first)?, word(directory.names.len())?]);
        Ok(())
    }

    fn record(&mut self, record: &'a Record, numbers: &[u32]) -> Result<(), CatalogueTooLarge> {
        let subject = self.text(&record.subject)?;
        let renumbered = |file: &usize| Ok(numbers[*file]);
        let files = self.rows(RECORD_FILES, record.files.iter().map(renumbered))?;
        let outputs = self.rows(RECORD_OUTPUTS, record.outputs.iter().map(renumbered))?;
        let lookups = self.rows(RECORD_LOOKUPS, record.lookups.iter().map(|lookup| word(*lookup)))?;
        let payload = [word(self.payloads.len())?, word(record.payload.len())?];
        self.payloads.extend_from_slice(&record.payload);
        for span in [subject, files, lookups, payload, outputs] {
            self.add(RECORDS, &span);
        }
        Ok(())
    }

    /// Adds rows that consist of one number.
    fn rows(
        &mut self,
        table: usize,
        numbers: impl ExactSizeIterator<Item = Result<u32, CatalogueTooLarge>>,
    ) -> Result<Span, CatalogueTooLarge> {
        let span = [word(self.tables[table].len() / SIZES[table])?, word(numbers.len())?];
        for number in numbers {
            self.add(table, &[number?]);
        }
        Ok(span)
    }

    fn text(&mut self, text: &'a str) -> Result<Span, CatalogueTooLarge> {
        if let Some(interned) = self.interned.get(text) {
            return Ok(*interned);
        }
        let span = [word(self.texts.len())?, word(text.len())?];
        self.texts.push_str(text);
        self.interned.insert(text, span);
        Ok(span)
    }

    fn add(&mut self, table: usize, words: &[u32]) {
        for word in words {
            self.tables[table].extend(word.to_le_bytes());
        }
    }
}

fn word(number: usize) -> Result<u32, CatalogueTooLarge> {
    u32::try_from(number).map_err(|_| CatalogueTooLarge)
}
