//! What a result says, as bytes of `postcard`, and back.

use serde::{Deserialize, Serialize};

/// Bytes that do not say what they should. The cache is not used then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corrupt;

/// A value as bytes; `None` where it has no form in them.
pub fn encode<T: Serialize + ?Sized>(value: &T) -> Option<Vec<u8>> {
    postcard::to_allocvec(value).ok()
}

/// What [`encode`] wrote.
///
/// # Errors
/// When the bytes are of something else, or go on behind it.
pub fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, Corrupt> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Ok(value),
        _ => Err(Corrupt),
    }
}
