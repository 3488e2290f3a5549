//! Tests where each letter is permitted: every cell of the table of book: language/letters.

use pathbuild_path::Letter;

use crate::support::{path, wrong};

/// All letters, each with a value of the path and another value, both of which are valid wherever the letter is permitted. The value of the path is empty
/// if no element inherits it.
pub(crate) const LETTERS: [(char, [&str; 2]); 23] = [
    ('A', ["20", "25"]),
    ('B', ["1", "0.5"]),
    ('C', ["1", "2"]),
    ('D', ["3", "2.5"]),
    ('E', ["", "x"]),
    ('F', ["200", "100"]),
    ('H', ["", "1"]),
    ('I', ["1", "0.5"]),
    ('L', ["", "x"]),
    ('M', ["x", "y"]),
    ('N', ["", "1"]),
    ('O', ["3", "2.5"]),
    ('P', ["1", "0.9"]),
    ('Q', ["", "x"]),
    ('R', ["", "x"]),
    ('S', ["20", "10"]),
    ('T', ["5", "4.5"]),
    ('U', ["4", "4.1"]),
    ('W', ["4", "4.2"]),
    ('Z', ["50", "60"]),
    ('>', ["", "1111.1P"]),
    ('@', ["", "1111.1P"]),
    (':', ["", "a1~2"]),
];

/// The letters that must be greater than 0.
pub(crate) const POSITIVE: &str = "ACFIOPTUWZ";

/// The letters that have a value even if no text gives one.
pub(crate) const WITH_DEFAULT: &str = "AFHSZ";

#[test]
fn every_letter_is_tested() {
    let tested: Vec<char> = LETTERS.iter().map(|(letter, _)| *letter).collect();
    assert_eq!(Letter::all().map(Letter::as_char).collect::<Vec<_>>(), tested);
}

/// Text of the start that gives every value that any element needs.
const PATH: &str = "T5 O3 Mx F200 B1 D3 I1 P1 U4";

/// The meaning of a cell of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cell {
    /// `!`: the element or the path must give the letter.
    Needed,
    /// `o`: the element may give the letter.
    Allowed,
    /// `c!` and `c`: the first segment of the chain must or may give the letter.
    ChainNeeded,
    Chain,
    /// `-`: the letter has no effect.
    Ignored,
    /// `p` and empty: the letter is unknown in the element's own text.
    Unknown,
}

/// Returns the cell of a letter in a row. Rows are written as `LETTER:CELL`, without the unknown letters. `p` is left out, because it does not
/// concern the element's text.
fn cell(row: &str, letter: char) -> Cell {
    let cell = row.split(' ').find(|cell| cell.starts_with(letter)).map(|cell| &cell[2..]);
    match cell {
        Some("!") => Cell::Needed,
        Some("o") => Cell::Allowed,
        Some("c!") => Cell::ChainNeeded,
        Some("c") => Cell::Chain,
        Some("-") => Cell::Ignored,
        None => Cell::Unknown,
        Some(other) => panic!("{other}"),
    }
}

/// Checks a row. `element` draws the element with a text, and everything else that the path needs.
fn check_row(row: &str, element: impl Fn(&str) -> String) {
    for (letter, [_, value]) in LETTERS {
        let (cell, own) = (cell(row, letter), format!("{letter}{value}"));
        // W with support bars is a doubt of its own (PB211).
        let found = |parameters: &str, text: &str| {
            let mut found = wrong(&path(parameters, &element(text)));
            found.retain(|code| !(letter == 'W' && code == "PB211"));
            found
        };
        let expected = match cell {
            Cell::Ignored => vec![format!("PB210 {letter}")],
            Cell::Unknown => vec![format!("PB202 {letter}")],
            _ => vec![],
        };
        assert_eq!(found(PATH, &own), expected, "{cell:?}: {own} on the element");
        if matches!(cell, Cell::Needed | Cell::ChainNeeded) {
            let without = without(PATH, letter);
            assert_eq!(found(&without, ""), [format!("PB201 {letter}")], "neither gives {letter}");
            assert_eq!(found(&without, &own), [""; 0], "only the element gives {letter}");
            assert_eq!(found(PATH, ""), [""; 0], "only the path gives {letter}");
        }
    }
}

/// Checks a row, and that the letters of a chain have no effect on segments other than the first.
fn check_chain_row(row: &str, statement: &str) {
    check_row(row, |text| format!("{statement} 0,0 40,0{}\nend 40,0", note(text)));
    for (letter, [_, value]) in LETTERS {
        let text = format!("{letter}{value}");
        let second =
            path(PATH, &format!("{statement} 0,0 40,0\n{statement} 40,0 80,0{}\nend 80,0", note(&text)));
        let expected = match cell(row, letter) {
            Cell::Needed | Cell::Allowed => vec![],
            Cell::ChainNeeded | Cell::Chain | Cell::Ignored => vec![format!("PB210 {letter}")],
            Cell::Unknown => vec![format!("PB202 {letter}")],
        };
        assert_eq!(wrong(&second), expected, "{text} on the second segment");
    }
}

fn without(parameters: &str, letter: char) -> String {
    parameters.split(' ').filter(|piece| !piece.starts_with(letter)).collect::<Vec<_>>().join(" ")
}

fn note(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!(" \"{text}\"") }
}

/// Returns a circle at the end of a sweep.
fn circle(circle: &'static str) -> impl Fn(&str) -> String {
    move |text| format!("sweep 0,0 40,0\ncircle {}{}\nend 40,0", circle, note(text))
}

#[test]
fn path_start() {
    let row = "F:o B:o D:o I:o C:o W:o P:o U:o S:o T:! O:! M:o A:o Z:o ::o E:o R:o";
    for (letter, [_, value]) in LETTERS {
        let own = format!("{letter}{value}");
        let found = |parameters: &str| wrong(&path(parameters, "mill 0,0 40,0\nend 40,0"));
        let expected = match cell(row, letter) {
            Cell::Unknown if letter == '@' => vec!["PB208".to_owned()],
            Cell::Unknown => vec![format!("PB202 {letter}")],
            // No text refers to the variable.
            _ if letter == ':' => vec!["PB210".to_owned()],
            _ => vec![],
        };
        let others = without(PATH, letter);
        assert_eq!(found(&format!("{others} {own}")), expected, "{own} at the start");
        if cell(row, letter) == Cell::Needed {
            assert_eq!(found(&others), [format!("PB201 {letter}")]);
        }
    }
}

#[test]
fn milling_segment() {
    check_chain_row("F:o B:! D:- I:c! C:- W:c S:- N:o Q:o", "mill");
}

#[test]
fn marking_segment() {
    check_chain_row("F:o B:- D:! I:c! C:- W:c S:- N:o Q:o", "mark");
}

#[test]
fn support_segment() {
    check_chain_row("F:o B:! D:! I:c! C:- W:c P:! U:! S:- N:o Q:o", "bars");
}

#[test]
fn sweep() {
    check_row("S:o N:o", |text| format!("line DASHED 0,0 40,0{}\nend 40,0", note(text)));
}

#[test]
fn drilled_hole() {
    check_row("F:o B:! D:- C:o Q:o", circle("40,0 d 3"));
}

/// Nothing can be left standing in a drilled hole.
#[test]
fn a_drilled_hole_has_no_bars() {
    for line_type in ["BORDER", "CENTER"] {
        let drawn =
            |diameter: &str| format!("sweep 0,0 40,0\ncircle {line_type} 40,0 d {diameter}\nend 40,0");
        assert_eq!(wrong(&path(PATH, &drawn("3"))), ["PB106"]);
        assert_eq!(wrong(&path(PATH, &drawn("3.001"))), ["PB106"]);
        assert_eq!(wrong(&path(PATH, &drawn("10"))), [""; 0]);
    }
}

#[test]
fn drilled_mark() {
    check_row("F:o B:- D:! C:o Q:o", circle("DIVIDE 40,0 d 3"));
}

#[test]
fn helical_circle() {
    check_row("F:o B:! D:- I:! Q:o", circle("40,0 d 8"));
}

#[test]
fn helical_mark() {
    check_row("F:o B:- D:! I:! Q:o", circle("DIVIDE 40,0 d 8"));
}

#[test]
fn helical_circle_with_bars() {
    check_row("F:o B:! D:! I:! P:! U:! Q:o", circle("BORDER 40,0 d 10"));
}

/// T and O are needed but never missing, because the path gives them.
#[test]
fn subpath() {
    check_row("N:o T:o O:o M:o H:o >:o ::o", |text| {
        let name = if text.starts_with('>') { "" } else { ">1111.1P " };
        format!("subpath 0,0 40,0 \"{name}{text}\"\nmill 40,0 80,0\nend 80,0")
    });
}

#[test]
fn probe() {
    check_row("T:o H:o Z:o L:o", |text| format!("mill 0,0 40,0\nprobe 20,40{}\nend 40,0", note(text)));
}

/// The text of a DOT line is ignored, and a HIDDEN line takes none.
#[test]
fn silent_sweeps() {
    for (letter, [_, value]) in LETTERS {
        let drawing = format!("skip 0,0 40,0 \"{letter}{value} {letter}{value} ?\"\nend 40,0");
        assert_eq!(wrong(&path(PATH, &drawing)), [""; 0]);
    }
}
