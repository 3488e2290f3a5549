//! What stands before everything in a file of kept results: by which it is known whose it is, and that it is whole. What follows is in [`flat`].
//!
//! [`flat`]: crate::flat

use crate::facts::Catalogue;
use crate::flat::{TooMuch, write};
use crate::snapshot::Snapshot;

/// What results are of: which program made them, with which settings, asked what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// The program's build.
    pub build: [u8; 32],
    /// Everything else that a result depends on and that is in no file.
    pub question: [u8; 32],
}

/// Why a file of the cache is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unusable {
    /// It is none, or not whole.
    Damaged,
    /// Another build of the program wrote it, or this one asked something else.
    Foreign,
}

const MAGIC: &[u8; 16] = b"pathbuild cache\x04";

/// The magic, the two halves of the key, the checksum.
const HEAD: usize = 16 + 32 + 32 + CHECKSUM;
const CHECKSUM: usize = 32;

impl Key {
    /// A key of texts.
    pub fn new(build: &str, question: &str) -> Self {
        let hash = |text: &str| *blake3::hash(text.as_bytes()).as_bytes();
        Self { build: hash(build), question: hash(question) }
    }

    /// The name of the file that results are kept in.
    pub fn file_name(&self) -> String {
        let digits = blake3::Hash::from_bytes(self.question).to_hex();
        format!("{}{SUFFIX}", &digits[..DIGITS])
    }
}

/// Whether a name is one that [`Key::file_name`] gives.
pub(crate) fn is_file_name(name: &str) -> bool {
    let digits = name.strip_suffix(SUFFIX);
    digits.is_some_and(|it| {
        it.len() == DIGITS && it.bytes().all(|it| it.is_ascii_digit() || (b'a'..=b'f').contains(&it))
    })
}

/// What names of kept results end in.
const SUFFIX: &str = ".results";
/// How many digits of the question's hash stand before that.
const DIGITS: usize = 24;

/// A catalogue as the bytes of a file.
///
/// # Errors
/// When it is larger than a file of kept results can be.
pub(crate) fn encode(key: &Key, catalogue: &Catalogue) -> Result<Vec<u8>, TooMuch> {
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

/// What a file keeps, if it is whole and under this key.
pub(crate) fn decode(key: &Key, file: Vec<u8>) -> Result<Snapshot, Unusable> {
    let found = key_of(&file).ok_or(Unusable::Damaged)?;
    if found != *key {
        return Err(Unusable::Foreign);
    }
    if !is_whole(&file) {
        return Err(Unusable::Damaged);
    }
    Snapshot::new(file, HEAD).ok_or(Unusable::Damaged)
}

/// The key in a file's head.
pub(crate) fn key_of(file: &[u8]) -> Option<Key> {
    let rest = file.strip_prefix(MAGIC)?;
    let (build, rest) = rest.split_first_chunk()?;
    let (question, _) = rest.split_first_chunk()?;
    Some(Key { build: *build, question: *question })
}

/// Whether what stands behind a file's head is what was written.
fn is_whole(file: &[u8]) -> bool {
    let split = file.split_at_checked(HEAD);
    split.is_some_and(|(head, body)| head.ends_with(blake3::hash(body).as_bytes()))
}
