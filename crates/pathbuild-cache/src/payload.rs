//! Encoding of the results themselves, in `postcard`.

use serde::{Deserialize, Serialize};

/// The bytes do not decode to a value of the expected type. The cached result is then ignored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CorruptPayload;

/// Encodes a value; `None` if `postcard` cannot represent it.
pub fn encode<T: Serialize + ?Sized>(value: &T) -> Option<Vec<u8>> {
    postcard::to_allocvec(value).ok()
}

/// Decodes what [`encode`] wrote.
///
/// # Errors
/// If the bytes do not decode to this type, or if bytes remain.
pub fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, CorruptPayload> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Ok(value),
        _ => Err(CorruptPayload),
    }
}
