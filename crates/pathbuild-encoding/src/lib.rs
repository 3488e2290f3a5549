//! Decodes bytes of texts to characters, with the part of `encoding_rs` that pathbuild needs. (book: reference/dxf: "encoding")
//!
//! In a browser, the same interface uses the browser's own `TextDecoder`, which implements the same standard: the tables of `encoding_rs`
//! would make up a tenth of the page. Both give identical results, even for malformed texts; the test of the page (`pathbuild-view`,
//! `page/web-test.mjs`) compares all pairs of bytes in all code pages.

#[cfg(any(target_family = "wasm", test))]
mod big5;
#[cfg(target_family = "wasm")]
mod browser;

#[cfg(target_family = "wasm")]
pub use browser::*;

#[cfg(not(target_family = "wasm"))]
pub use encoding_rs::{
    BIG5, EUC_KR, Encoding, GBK, IBM866, ISO_8859_2, ISO_8859_3, ISO_8859_4, ISO_8859_5, ISO_8859_6,
    ISO_8859_7, ISO_8859_8, MACINTOSH, SHIFT_JIS, UTF_8, WINDOWS_874, WINDOWS_1250, WINDOWS_1251,
    WINDOWS_1252, WINDOWS_1253, WINDOWS_1254, WINDOWS_1255, WINDOWS_1256, WINDOWS_1257, WINDOWS_1258,
    mem::decode_latin1,
};
