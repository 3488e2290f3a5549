use super::cursor::{Cursor, Parsed};
use pathbuild_draw::model::{LineEnds, NoteKind, Options, Pair, Part, TextEncoding, Version};

const WORDS: [&str; 11] = [
    "version",
    "codepage",
    "encoding",
    "units",
    "lineends",
    "binary",
    "bom",
    "no",
    "header",
    "notes",
    "furniture",
];

/// Whether this word begins a line with an option for writing the drawing.
pub(crate) fn is_option(word: &str) -> bool {
    WORDS.contains(&word)
}

/// Parses an option.
pub(crate) fn option(cursor: &mut Cursor, options: &mut Options, furniture: &mut Option<u64>) -> Parsed<()> {
    let word = cursor.name("an option")?;
    match word.as_str() {
        "version" => {
            options.version =
                choice(cursor, "a version", &Version::ALL.map(|version| (version.name(), version)))?;
        }
        "codepage" => {
            let name = cursor.name("a code page such as ANSI_1252, or none")?;
            options.code_page = Some(name).filter(|name| name != "none");
        }
        "encoding" => {
            let all = [
                ("proper", TextEncoding::Proper),
                ("utf-8", TextEncoding::Utf8),
                ("escaped", TextEncoding::Escaped),
            ];
            options.encoding = choice(cursor, "an encoding", &all)?;
        }
        "units" => options.units = units(cursor)?,
        "lineends" => {
            let all = [("crlf", LineEnds::CrLf), ("lf", LineEnds::Lf), ("cr", LineEnds::Cr)];
            options.line_ends = choice(cursor, "line ends", &all)?;
        }
        "binary" => options.binary = true,
        "bom" => options.byte_order_mark = true,
        "no" => options.left_out.push(part(cursor)?),
        "header" => {
            let name = cursor.name("a variable such as $LTSCALE")?;
            let code = cursor.integer("group code")?;
            options.header.push((name, Pair::new(code, cursor.name("a value")?)));
        }
        "notes" => notes(cursor, options)?,
        _ => {
            let has_seed = cursor.is_at_number();
            *furniture = Some(if has_seed { cursor.integer("seed, a whole number")? } else { 0 });
        }
    }
    Ok(())
}

fn choice<T: Copy>(cursor: &mut Cursor, what: &str, all: &[(&str, T)]) -> Parsed<T> {
    let word = cursor.name(what)?;
    let found = all.iter().find(|(name, _)| name.eq_ignore_ascii_case(&word));
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|(name, _)| *name).collect();
        cursor.error(format!("{word:?} is none of {}", names.join(", ")))
    })
}

/// $INSUNITS by name or number.
fn units(cursor: &mut Cursor) -> Parsed<Option<i16>> {
    if cursor.is_at_number() {
        return cursor.integer("number of $INSUNITS").map(Some);
    }
    let all = [
        ("none", Some(0)),
        ("inch", Some(1)),
        ("mm", Some(4)),
        ("cm", Some(5)),
        ("m", Some(6)),
        ("missing", None),
    ];
    choice(cursor, "a unit", &all)
}

fn part(cursor: &mut Cursor) -> Parsed<Part> {
    let all = [
        ("header", Part::Header),
        ("tables", Part::Tables),
        ("blocks", Part::Blocks),
        ("objects", Part::Objects),
        ("handles", Part::Handles),
        ("eof", Part::Eof),
    ];
    choice(cursor, "a part of the file", &all)
}

/// `notes [as text|mtext] [height H]`
fn notes(cursor: &mut Cursor, options: &mut Options) -> Parsed<()> {
    if cursor.take("as") {
        options.note_kind = note_kind(cursor)?;
    }
    if cursor.take("height") {
        options.note_height = cursor.length("the height of letters")?;
    }
    Ok(())
}

pub(crate) fn note_kind(cursor: &mut Cursor) -> Parsed<NoteKind> {
    choice(cursor, "a kind of text", &[("text", NoteKind::Text), ("mtext", NoteKind::MText)])
}
