//! Archives in which Fusion 360 stores tool libraries (`.tools`): zip files with a single entry, `tools.json`.

use std::io::{self, Read};

use flate2::bufread::DeflateDecoder;
use pathbuild_diagnostic::{Text, Value};
use rawzip::{CompressionMethod, ZipArchive};

/// Whether a file is a zip archive, judging by its first bytes.
pub(super) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

/// Returns the content of the only entry.
///
/// # Errors
/// If the archive is broken or has several entries, or if the content has more than `limit` bytes.
pub(super) fn unpack(bytes: &[u8], limit: u64) -> Result<Vec<u8>, Value> {
    let archive = ZipArchive::from_slice(bytes).map_err(Value::foreign)?;
    let mut entries = archive.entries();
    let first = entries.next_entry().map_err(Value::foreign)?;
    let second = entries.next_entry().map_err(Value::foreign)?;
    let (Some(entry), None) = (first, second) else { return Err(Value::Prose(&SEVERAL_FILES)) };
    let local = archive.get_entry(entry.wayfinder()).map_err(Value::foreign)?;
    match entry.compression_method() {
        CompressionMethod::STORE => read(local.verifying_reader(local.data()), limit),
        CompressionMethod::DEFLATE => read(local.verifying_reader(DeflateDecoder::new(local.data())), limit),
        _ => Err(Value::Prose(&OTHER_METHOD)),
    }
}

fn read(content: impl Read, limit: u64) -> Result<Vec<u8>, Value> {
    let mut bytes = Vec::new();
    let length =
        content.take(limit + 1).read_to_end(&mut bytes).map_err(|error: io::Error| Value::foreign(error))?;
    if u64::try_from(length).is_ok_and(|length| length > limit) {
        return Err(Value::Prose(&TOO_LARGE));
    }
    Ok(bytes)
}

static SEVERAL_FILES: Text = Text {
    en: "the archive does not contain exactly one file",
    de: "das Archiv enthält nicht genau eine Datei",
};
static OTHER_METHOD: Text = Text {
    en: "the archive is compressed by a method other than Deflate",
    de: "das Archiv ist mit einem anderen Verfahren als Deflate komprimiert",
};
static TOO_LARGE: Text =
    Text { en: "its unpacked content is too large", de: "sein entpackter Inhalt ist zu groß" };
