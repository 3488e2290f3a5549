//! Maps the values of `$DWGCODEPAGE` to encodings. (book: reference/dxf)

use oem_cp::code_table::DECODING_TABLE_CP_MAP;
use oem_cp::code_table_type::TableType;
use pathbuild_encoding::{
    BIG5, EUC_KR, Encoding, GBK, IBM866, ISO_8859_2, ISO_8859_3, ISO_8859_4, ISO_8859_5, ISO_8859_6,
    ISO_8859_7, ISO_8859_8, MACINTOSH, SHIFT_JIS, UTF_8, WINDOWS_874, WINDOWS_1250, WINDOWS_1251,
    WINDOWS_1252, WINDOWS_1253, WINDOWS_1254, WINDOWS_1255, WINDOWS_1256, WINDOWS_1257, WINDOWS_1258,
};

/// Encoding declared for the texts of a file.
#[derive(Clone, Copy, Debug)]
pub(super) enum CodePage {
    /// None, or `ANSI_1252`, which many programs write regardless of the actual encoding.
    Usual,
    /// An encoding of the WHATWG standard.
    Standard(&'static Encoding),
    /// A DOS code page.
    Dos(&'static TableType),
    /// An unknown name.
    Unknown,
}

/// Parses the value of `$DWGCODEPAGE`.
pub(super) fn code_page(name: &[u8]) -> CodePage {
    if name == b"ANSI_1252" {
        return CodePage::Usual;
    }
    let name = String::from_utf8_lossy(name).trim().to_ascii_uppercase();
    match name.as_str() {
        "" | "ASCII" | "US_ASCII" | "UNDEFINED" => CodePage::Usual,
        "UTF-8" | "UTF8" => CodePage::Standard(UTF_8),
        "BIG5" => CodePage::Standard(BIG5),
        "GB2312" | "GBK" => CodePage::Standard(GBK),
        "KSC5601" => CodePage::Standard(EUC_KR),
        "SHIFT_JIS" => CodePage::Standard(SHIFT_JIS),
        name if name.starts_with("MAC") => CodePage::Standard(MACINTOSH),
        name => match (name.split_once("8859"), trailing_number(name)) {
            (Some(_), Some(part)) => iso_8859(part),
            (None, Some(page)) => numbered(page),
            (_, None) => CodePage::Unknown,
        },
    }
}

fn trailing_number(name: &str) -> Option<u32> {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name[letters.len()..].parse().ok()
}

fn numbered(page: u32) -> CodePage {
    let encoding = match page {
        1252 => return CodePage::Usual,
        866 => IBM866,
        874 => WINDOWS_874,
        932 => SHIFT_JIS,
        936 => GBK,
        949 => EUC_KR,
        950 => BIG5,
        1250 => WINDOWS_1250,
        1251 => WINDOWS_1251,
        1253 => WINDOWS_1253,
        1254 => WINDOWS_1254,
        1255 => WINDOWS_1255,
        1256 => WINDOWS_1256,
        1257 => WINDOWS_1257,
        1258 => WINDOWS_1258,
        65001 => UTF_8,
        _ => {
            let page = u16::try_from(page).ok().and_then(|page| DECODING_TABLE_CP_MAP.get(&page));
            return page.map_or(CodePage::Unknown, CodePage::Dos);
        }
    };
    CodePage::Standard(encoding)
}

fn iso_8859(part: u32) -> CodePage {
    CodePage::Standard(match part {
        1 => WINDOWS_1252,
        2 => ISO_8859_2,
        3 => ISO_8859_3,
        4 => ISO_8859_4,
        5 => ISO_8859_5,
        6 => ISO_8859_6,
        7 => ISO_8859_7,
        8 => ISO_8859_8,
        9 => WINDOWS_1254,
        _ => return CodePage::Unknown,
    })
}
