//! A catalogue as a file: a head by which it is known whose it is, a checksum, then everything in a row.

use camino::Utf8PathBuf;

use crate::codec::{Corrupt, Decoder, Encoder};
use crate::facts::{Catalogue, DirectoryFact, FileFact, ListingKind, Lookup, Record};
use crate::stamp::Stamp;

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

const MAGIC: &[u8; 16] = b"pathbuild cache\x01";

/// The magic, the two halves of the key, the checksum.
const HEAD: usize = 16 + 32 + 32 + 32;

impl Key {
    /// A key of texts.
    pub fn new(build: &str, question: &str) -> Self {
        let hash = |text: &str| *blake3::hash(text.as_bytes()).as_bytes();
        Self { build: hash(build), question: hash(question) }
    }

    /// The name of the file that results are kept in.
    pub fn file_name(&self) -> String {
        let digits = blake3::Hash::from_bytes(self.question).to_hex();
        format!("{}{SUFFIX}", &digits[..24])
    }
}

/// What names of kept results end in.
pub(crate) const SUFFIX: &str = ".results";

/// A catalogue as the bytes of a file.
pub(crate) fn encode(key: &Key, catalogue: &Catalogue) -> Vec<u8> {
    let mut body = Encoder::default();
    body.list(catalogue.files.iter(), |body, file| {
        body.raw(&file.stamp.to_bytes());
        body.option(file.hash.as_ref(), |body, hash| body.raw(hash));
        body.text(file.path.as_str());
    });
    body.list(catalogue.directories.iter(), |body, directory| {
        body.text(directory.path.as_str());
        body.u8(u8::from(directory.kind == ListingKind::Programs));
        body.list(directory.names.iter(), |body, name| body.text(name));
        body.text(&directory.canonical);
        body.u8(u8::from(directory.is_doubtful));
    });
    body.list(catalogue.records.iter(), |body, record| {
        body.text(&record.of);
        body.list(record.files.iter(), |body, file| body.u32(*file));
        body.list(record.lookups.iter(), |body, lookup| {
            body.u32(lookup.directory);
            body.text(&lookup.name);
        });
        body.bytes(&record.payload);
    });
    let body = body.finish();
    let mut file = Vec::with_capacity(HEAD + body.len());
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&key.build);
    file.extend_from_slice(&key.question);
    file.extend_from_slice(blake3::hash(&body).as_bytes());
    file.extend(body);
    file
}

/// A file's catalogue, if it is whole and under this key.
pub(crate) fn decode(key: &Key, file: &[u8]) -> Result<Catalogue, Unusable> {
    let found = key_of(file).ok_or(Unusable::Damaged)?;
    if found != *key {
        return Err(Unusable::Foreign);
    }
    let body = whole_body(file).ok_or(Unusable::Damaged)?;
    catalogue(&mut Decoder::new(body)).map_err(|Corrupt| Unusable::Damaged)
}

/// The key in a file's head.
pub(crate) fn key_of(file: &[u8]) -> Option<Key> {
    let rest = file.strip_prefix(MAGIC)?;
    let (build, rest) = rest.split_first_chunk()?;
    let (question, _) = rest.split_first_chunk()?;
    Some(Key { build: *build, question: *question })
}

/// What stands behind a file's head, if it is what was written.
pub(crate) fn whole_body(file: &[u8]) -> Option<&[u8]> {
    let (head, body) = file.split_at_checked(HEAD)?;
    (head.ends_with(blake3::hash(body).as_bytes())).then_some(body)
}

fn catalogue(body: &mut Decoder<'_>) -> Result<Catalogue, Corrupt> {
    let files = body.list(|body| {
        let stamp = Stamp::from_bytes(body.array()?);
        let hash = body.option(Decoder::array)?;
        Ok(FileFact { stamp, hash, path: Utf8PathBuf::from(body.text()?) })
    })?;
    let directories = body.list(|body| {
        Ok(DirectoryFact {
            path: Utf8PathBuf::from(body.text()?),
            kind: if body.u8()? == 0 { ListingKind::Drawings } else { ListingKind::Programs },
            names: body.list(|body| Ok(body.text()?.into()))?,
            canonical: body.text()?.into(),
            is_doubtful: body.u8()? != 0,
        })
    })?;
    let below = |number: u32, length: usize| {
        if (number as usize) < length { Ok(number) } else { Err(Corrupt) }
    };
    let records = body.list(|body| {
        Ok(Record {
            of: body.text()?.into(),
            files: body.list(|body| below(body.u32()?, files.len()))?,
            lookups: body.list(|body| {
                Ok(Lookup { directory: below(body.u32()?, directories.len())?, name: body.text()?.into() })
            })?,
            payload: body.bytes()?.to_vec(),
        })
    })?;
    if body.is_at_end() { Ok(Catalogue { files, directories, records }) } else { Err(Corrupt) }
}
