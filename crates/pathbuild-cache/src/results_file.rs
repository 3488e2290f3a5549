//! A results file: a header that identifies the results by their [`Key`] and protects them by a checksum, and the encoded catalogue.

use crate::catalogue::{self, Catalogue};

/// Identifies a set of cached results: program build, settings, and query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Hash of the program's build.
    pub build: [u8; 32],
    /// Hash of everything else that a result depends on and that is in no file.
    pub question: [u8; 32],
}

/// Why a results file is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CacheFault {
    /// The file is incomplete or something else.
    Damaged,
    /// Written by another build of the program, or for another query.
    Foreign,
}

const MAGIC: &[u8; 16] = b"pathbuild cache\x05";

/// Length of the header: magic, both halves of the key, checksum.
const HEAD: usize = 16 + 32 + 32 + 32;

impl Key {
    /// Hashes the build and the query.
    pub fn new(build: &str, question: &str) -> Self {
        let hash = |text: &str| *blake3::hash(text.as_bytes()).as_bytes();
        Self { build: hash(build), question: hash(question) }
    }

    /// Name of the file that holds the results of this key.
    pub fn file_name(&self) -> String {
        let digits = blake3::Hash::from_bytes(self.question).to_hex();
        format!("{}{SUFFIX}", &digits[..DIGITS])
    }
}

/// Whether [`Key::file_name`] could have returned this name.
pub(crate) fn is_file_name(name: &str) -> bool {
    let digits = name.strip_suffix(SUFFIX);
    digits.is_some_and(|digits| {
        digits.len() == DIGITS
            && digits.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte))
    })
}

/// Extension of results files.
const SUFFIX: &str = ".results";
/// Number of hexadecimal digits of the query's hash in a file name.
const DIGITS: usize = 24;

/// Encodes a catalogue as a complete results file; `None` if that is impossible.
pub(crate) fn encode(key: &Key, catalogue: &Catalogue) -> Option<Vec<u8>> {
    let body = catalogue::encode(catalogue)?;
    let checksum = blake3::hash(&body);
    Some([MAGIC, &key.build[..], &key.question[..], checksum.as_bytes(), &body].concat())
}

/// Decodes a results file that is complete and belongs to this key.
pub(crate) fn decode(key: &Key, file: &[u8]) -> Result<Catalogue, CacheFault> {
    if key_of(file).ok_or(CacheFault::Damaged)? != *key {
        return Err(CacheFault::Foreign);
    }
    let (head, body) = file.split_at_checked(HEAD).ok_or(CacheFault::Damaged)?;
    if !head.ends_with(blake3::hash(body).as_bytes()) {
        return Err(CacheFault::Damaged);
    }
    let catalogue: Catalogue = catalogue::decode(body).map_err(|_| CacheFault::Damaged)?;
    if catalogue.is_consistent() { Ok(catalogue) } else { Err(CacheFault::Damaged) }
}

/// The key in a file's header.
pub(crate) fn key_of(file: &[u8]) -> Option<Key> {
    let rest = file.strip_prefix(MAGIC)?;
    let (build, rest) = rest.split_first_chunk()?;
    let (question, _) = rest.split_first_chunk()?;
    Some(Key { build: *build, question: *question })
}
