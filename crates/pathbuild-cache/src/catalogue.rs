//! Data structures for cached results and the inputs that they depend on, and their encoding in the `postcard` format.

use camino::Utf8PathBuf;
use pathbuild_files::Stamp;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Results with all their inputs. Files, directories and lookups that several results share are stored once.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Catalogue {
    /// Every file that was read to obtain the results, and every output.
    pub files: Vec<FileFact>,
    /// Every directory that was listed to obtain the results.
    pub directories: Vec<DirectoryFact>,
    /// Sets of directories that are searched together, as indices into `directories`. Thousands of lookups search the same set.
    pub directory_lists: Vec<Vec<usize>>,
    /// Every lookup that was made to obtain the results.
    pub lookups: Vec<Lookup>,
    /// The results, sorted by subject once they are stored.
    pub records: Vec<Record>,
}

/// A file that was read to obtain results, or an output of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileFact {
    /// Path of the file, spelled as in the run that read or wrote it.
    pub path: Utf8PathBuf,
    /// The file's metadata at a moment when it had the content of `hash`; [`Stamp::UNKNOWN`] if no stamp identifies that content reliably.
    pub stamp: Stamp,
    /// The blake3 hash of the bytes that were read; for an output, of the bytes that it should have, without the parts that users may edit. `None` if
    /// the file could not be read, or if its content changed and it is unclear which content led to the results.
    pub hash: Option<[u8; 32]>,
}

/// A directory as it was when it was listed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectoryFact {
    /// Path of the directory, spelled as in the run that listed it.
    pub path: Utf8PathBuf,
    /// The names of the drawings in the directory, sorted.
    pub names: Vec<Box<str>>,
    /// Canonical paths of the directory and of the target of each drawing in it that is a symbolic link, relative to the configuration's directory if
    /// inside it. They decide whether two files are the same.
    pub canonical: Box<str>,
    /// Whether lookups in this directory are always repeated: names may be missing, or the directory changed while it was read.
    pub is_doubtful: bool,
}

/// A cached result with its inputs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Subject of the result, mostly the path of a drawing. Unique among the records.
    pub subject: Box<str>,
    /// The files that were read, as indices into [`Catalogue::files`].
    pub files: Vec<usize>,
    /// The lookups that were made, as indices into [`Catalogue::lookups`].
    pub lookups: Vec<usize>,
    /// The files that were written, as indices into [`Catalogue::files`]. If one is missing, the result is still valid, but the file must be written
    /// again.
    pub outputs: Vec<usize>,
    /// The result itself; only the crate that stored it can decode it.
    #[serde(serialize_with = "serialize_bytes", deserialize_with = "deserialize_bytes")]
    pub payload: Vec<u8>,
}

/// A search in directories for the files that may contain a path with a given name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Lookup {
    /// Index into [`Catalogue::directory_lists`].
    pub directories: usize,
    /// Name of the path to be found.
    pub name: Box<str>,
}

impl Catalogue {
    /// Returns the index of the result about this subject, in a catalogue that was loaded. `hint` is an index that is tried first.
    pub fn find(&self, subject: &str, hint: usize) -> Option<usize> {
        match self.records.get(hint) {
            Some(record) if &*record.subject == subject => Some(hint),
            _ => self.records.binary_search_by(|record| (*record.subject).cmp(subject)).ok(),
        }
    }

    /// Whether records are sorted, and every index refers to an existing item.
    pub(crate) fn is_consistent(&self) -> bool {
        let are_below = |indices: &[usize], all: usize| indices.iter().all(|index| *index < all);
        let is_sound = |record: &Record| {
            are_below(&record.files, self.files.len())
                && are_below(&record.outputs, self.files.len())
                && are_below(&record.lookups, self.lookups.len())
        };
        self.records.is_sorted_by(|a, b| a.subject <= b.subject)
            && self.records.iter().all(is_sound)
            && self.lookups.iter().all(|lookup| lookup.directories < self.directory_lists.len())
            && self.directory_lists.iter().all(|list| are_below(list, self.directories.len()))
    }
}

/// Error for bytes that do not decode to a value of the expected type. The cached result is then ignored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CorruptPayload;

/// Encodes a value; `None` if `postcard` cannot represent it.
pub fn encode<T: Serialize + ?Sized>(value: &T) -> Option<Vec<u8>> {
    postcard::to_allocvec(value).ok()
}

/// Decodes a value that [`encode`] encoded.
///
/// # Errors
/// If the bytes do not decode to this type, or if bytes remain.
pub fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, CorruptPayload> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Ok(value),
        _ => Err(CorruptPayload),
    }
}

fn serialize_bytes<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytes)
}

fn deserialize_bytes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<u8>, D::Error> {
    <&[u8]>::deserialize(deserializer).map(<[u8]>::to_vec)
}

/// The identity of a set of cached results: program build, settings, and query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Hash of the program's build.
    pub build: [u8; 32],
    /// Hash of the query, the settings, and all other inputs of a result that are in no file.
    pub question: [u8; 32],
}

/// The reason why a results file is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CacheFault {
    /// The file is incomplete, altered, or not a results file.
    Damaged,
    /// The file was written by another build of the program, or for another query or other settings.
    Foreign,
}

const MAGIC: &[u8; 16] = b"pathbuild cache\x05";

/// Length of the header: magic, both halves of the key, checksum.
const HEADER_BYTES: usize = 16 + 32 + 32 + 32;

impl Key {
    /// Creates the key by hashing the build, and the question: query, settings and further inputs.
    pub fn new(build: &str, question: &str) -> Self {
        let hash = |text: &str| *blake3::hash(text.as_bytes()).as_bytes();
        Self { build: hash(build), question: hash(question) }
    }

    /// Returns the name of the file that holds the results of this key.
    pub fn file_name(&self) -> String {
        let digits = blake3::Hash::from_bytes(self.question).to_hex();
        format!("{}{EXTENSION}", &digits[..NAME_DIGITS])
    }
}

/// Whether [`Key::file_name`] could have returned this name.
pub(crate) fn is_file_name(name: &str) -> bool {
    let digits = name.strip_suffix(EXTENSION);
    digits.is_some_and(|digits| {
        digits.len() == NAME_DIGITS
            && digits.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte))
    })
}

const EXTENSION: &str = ".results";
/// Number of hexadecimal digits of the query's hash in a file name.
const NAME_DIGITS: usize = 24;

/// Encodes a catalogue as a complete results file; `None` if that is impossible.
pub(crate) fn encode_file(key: &Key, catalogue: &Catalogue) -> Option<Vec<u8>> {
    let body = encode(catalogue)?;
    let checksum = blake3::hash(&body);
    Some([MAGIC, &key.build[..], &key.question[..], checksum.as_bytes(), &body].concat())
}

/// Decodes a results file that is complete and belongs to this key.
pub(crate) fn decode_file(key: &Key, file: &[u8]) -> Result<Catalogue, CacheFault> {
    if key_of(file).ok_or(CacheFault::Damaged)? != *key {
        return Err(CacheFault::Foreign);
    }
    let (head, body) = file.split_at_checked(HEADER_BYTES).ok_or(CacheFault::Damaged)?;
    if !head.ends_with(blake3::hash(body).as_bytes()) {
        return Err(CacheFault::Damaged);
    }
    let catalogue: Catalogue = decode(body).map_err(|_| CacheFault::Damaged)?;
    if catalogue.is_consistent() { Ok(catalogue) } else { Err(CacheFault::Damaged) }
}

/// Returns the key in a file's header; `None` if there is no such header.
pub(crate) fn key_of(file: &[u8]) -> Option<Key> {
    let rest = file.strip_prefix(MAGIC)?;
    let (build, rest) = rest.split_first_chunk()?;
    let (question, _) = rest.split_first_chunk()?;
    Some(Key { build: *build, question: *question })
}
