//! The browser's `TextDecoder` behind the interface of `encoding_rs`. The page's worker provides `decode` (`page/src/worker.ts`).

use std::borrow::Cow;

use crate::big5;

/// A text encoding that the browser decodes.
#[derive(Debug)]
pub struct Encoding {
    /// Name of the encoding in the encoding standard.
    label: &'static str,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Single,
    Multiple,
    Big5,
    Utf8,
}

macro_rules! encodings {
    ($($name:ident: $label:literal, $kind:ident;)*) => {
        $(
            #[doc = concat!("`", $label, "`")]
            pub static $name: &Encoding = &Encoding { label: $label, kind: Kind::$kind };
        )*
    };
}

encodings! {
    BIG5: "big5", Big5;
    EUC_KR: "euc-kr", Multiple;
    GBK: "gbk", Multiple;
    IBM866: "ibm866", Single;
    ISO_8859_2: "iso-8859-2", Single;
    ISO_8859_3: "iso-8859-3", Single;
    ISO_8859_4: "iso-8859-4", Single;
    ISO_8859_5: "iso-8859-5", Single;
    ISO_8859_6: "iso-8859-6", Single;
    ISO_8859_7: "iso-8859-7", Single;
    ISO_8859_8: "iso-8859-8", Single;
    MACINTOSH: "macintosh", Single;
    SHIFT_JIS: "shift_jis", Multiple;
    UTF_8: "utf-8", Utf8;
    WINDOWS_874: "windows-874", Single;
    WINDOWS_1250: "windows-1250", Single;
    WINDOWS_1251: "windows-1251", Single;
    WINDOWS_1252: "windows-1252", Single;
    WINDOWS_1253: "windows-1253", Single;
    WINDOWS_1254: "windows-1254", Single;
    WINDOWS_1255: "windows-1255", Single;
    WINDOWS_1256: "windows-1256", Single;
    WINDOWS_1257: "windows-1257", Single;
    WINDOWS_1258: "windows-1258", Single;
}

impl Encoding {
    /// Whether each byte is one character.
    pub fn is_single_byte(&self) -> bool {
        self.kind == Kind::Single
    }

    /// Decodes a text and replaces malformed input by U+FFFD. Also returns whether any input was malformed.
    pub fn decode_without_bom_handling<'b>(&self, bytes: &'b [u8]) -> (Cow<'b, str>, bool) {
        let (text, all_known) = match self.kind {
            Kind::Utf8 => return (String::from_utf8_lossy(bytes), std::str::from_utf8(bytes).is_err()),
            Kind::Big5 => big5::decode(bytes, |pair| whole(decode_in_browser(self.label, &pair))),
            Kind::Single | Kind::Multiple => decode_in_browser(self.label, bytes),
        };
        (Cow::Owned(text), !all_known)
    }

    /// Decodes a text; `None` if it is malformed.
    pub fn decode_without_bom_handling_and_without_replacement<'b>(
        &self,
        bytes: &'b [u8],
    ) -> Option<Cow<'b, str>> {
        let (text, had_errors) = self.decode_without_bom_handling(bytes);
        (!had_errors).then_some(text)
    }
}

fn whole((text, all_known): (String, bool)) -> Option<String> {
    all_known.then_some(text)
}

/// Decodes bytes that are known to be ASCII.
pub fn decode_latin1(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes)
}

/// Decodes through the browser. Also returns whether the input was well-formed.
#[expect(unsafe_code, reason = "the browser is handed addresses")]
fn decode_in_browser(label: &str, bytes: &[u8]) -> (String, bool) {
    #[link(wasm_import_module = "browser")]
    unsafe extern "C" {
        /// Writes at most `room` bytes of UTF-8 to `text` and returns their number, or its complement if the input is malformed.
        fn decode(
            label: *const u8,
            label_length: usize,
            bytes: *const u8,
            length: usize,
            text: *mut u8,
            room: usize,
        ) -> isize;
    }
    // A single byte becomes at most the three bytes of U+FFFD, and a pair at most four bytes.
    let mut text = vec![0; 3 * bytes.len()];
    // SAFETY: the browser stays within the given lengths, and all three buffers are borrowed during the call.
    let written = unsafe {
        decode(label.as_ptr(), label.len(), bytes.as_ptr(), bytes.len(), text.as_mut_ptr(), text.len())
    };
    let all_known = written >= 0;
    let length = if all_known { written } else { !written };
    text.truncate(length.unsigned_abs());
    (String::from_utf8(text).unwrap_or_default(), all_known)
}
