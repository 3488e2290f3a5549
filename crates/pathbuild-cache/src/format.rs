//! The header of a results file: it identifies the results by their [`Key`] and protects them by a checksum. The body that follows is laid
//! out in [`flat`].
//!
//! [`flat`]: crate::flat

use crate::facts::Catalogue;
use crate::flat::{CatalogueTooLarge, write};
use crate::snapshot::Snapshot;

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
    /// Not a results file, or incomplete.
    Damaged,
    /// Written by another build of the program, or for another query.
    Foreign,
}

const MAGIC: &[u8; 16] = b"pathbuild cache\x04";

/// Length of the header: magic, both halves of the key, checksum.
const HEAD: usize = 16 + 32 + 32 + CHECKSUM;
const CHECKSUM: usize = 32;

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

/// Encodes a catalogue as a complete results file.
///
/// # Errors
/// If the catalogue is larger than a results file can be.
pub(crate) fn encode(key: &Key, catalogue: &Catalogue) -> Result<Vec<u8>, CatalogueTooLarge> {
    let mut file = Vec::new();
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&key.build);
    file.extend_from_slice(&key.question);
    file.extend_from_slice(&[0; CHECKSUM]);
    write(catalogue, &mut file)?;
    let checksum = *blake3::hash(&file[HEAD..]).as_bytes();
    file[HEAD - CHECKSUM..HEAD].copy_from_slice(&checksum);
    Ok(file)
}

/// Decodes a results file that is complete and belongs to this key.
pub(crate) fn decode(key: &Key, file: Vec<u8>) -> Result<Snapshot, CacheFault> {
    let found = key_of(&file).ok_or(CacheFault::Damaged)?;
    if found != *key {
        return Err(CacheFault::Foreign);
    }
    if !is_whole(&file) {
        return Err(CacheFault::Damaged);
    }
    Snapshot::new(file, HEAD).ok_or(CacheFault::Damaged)
}

/// The key in a file's header.
pub(crate) fn key_of(file: &[u8]) -> Option<Key> {
    let rest = file.strip_prefix(MAGIC)?;
    let (build, rest) = rest.split_first_chunk()?;
    let (question, _) = rest.split_first_chunk()?;
    Some(Key { build: *build, question: *question })
}

/// Whether the checksum in the header matches the body.
fn is_whole(file: &[u8]) -> bool {
    let split = file.split_at_checked(HEAD);
    split.is_some_and(|(head, body)| head.ends_with(blake3::hash(body).as_bytes()))
}
