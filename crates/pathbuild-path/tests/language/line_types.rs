//! Tests line types: their names, and their meanings on lines, arcs and circles. (book: language/line-types)

use pathbuild_path::{Cut, LineType, LineTypeAliases, Role, SegmentKind};

use crate::support::{codes, compile, language, path, raw, read_as};

fn named(name: &str) -> Option<LineType> {
    LineType::of(name, &LineTypeAliases::default())
}

#[test]
fn every_line_type_is_known_exactly_and_with_its_suffixes() {
    for (name, line_type) in LineType::NAMES {
        for suffix in ["", "2", "X2", "TINY"] {
            assert_eq!(named(&format!("{name}{suffix}")), Some(line_type), "{name}{suffix}");
        }
        for suffix in ["3", "X", "22", "TINY2", "2TINY", "X22"] {
            assert_eq!(named(&format!("{name}{suffix}")), None, "{name}{suffix}");
        }
    }
}

/// DASHED2 and HIDDEN have the same dashes but different meanings.
#[test]
fn names_decide_not_dashes() {
    assert_eq!(named("DASHED2"), Some(LineType::Dashed));
    assert_eq!(named("HIDDEN"), Some(LineType::Hidden));
    assert_eq!(named("TRACKS"), None);
    assert_eq!(named(""), None);
}

#[test]
fn names_of_other_programs_are_known() {
    let known = [
        ("ACAD_ISO02W100", LineType::Dashed),
        ("ACAD_ISO07W100", LineType::Dot),
        ("ACAD_ISO09W100", LineType::Phantom),
        ("ACAD_ISO10W100", LineType::Dashdot),
        ("AM_ISO08W050", LineType::Center),
        ("GESTRICHELT", LineType::Dashed),
        ("VERDECKT", LineType::Hidden),
        ("MITTE", LineType::Center),
        ("MITTE2", LineType::Center),
        ("ОСЕВАЯX2", LineType::Center),
    ];
    for (name, line_type) in known {
        assert_eq!(named(name), Some(line_type), "{name}");
    }
    assert_eq!(named("ACAD_ISO06W100"), None);
}

/// A line type is suggested for an unknown name that begins like it, from three letters on.
#[test]
fn abbreviations_are_recognised() {
    assert_eq!(LineType::guess("PHA"), Some(LineType::Phantom));
    assert_eq!(LineType::guess("PH"), None);
}

#[test]
fn the_configuration_adds_names_and_wins() {
    let mut aliases = LineTypeAliases::default();
    aliases.insert("Schnitt", LineType::Continuous);
    aliases.insert("HIDDEN", LineType::Dashed);
    assert_eq!(LineType::of("SCHNITT", &aliases), Some(LineType::Continuous));
    assert_eq!(LineType::of("HIDDEN", &aliases), Some(LineType::Dashed));
    assert_eq!(LineType::of("DOT", &aliases), Some(LineType::Dot));
    assert_eq!(named("SCHNITT"), None);
}

#[test]
fn an_alias_holds_in_a_drawing() {
    let drawing = path("T5 O3 I1 B0", "linetype Schnitt 1 -1\nline Schnitt 0,0 20,0\nend 20,0");
    assert_eq!(codes(&raw(&drawing).diagnostics), ["PB106"]);
    let mut language = language();
    language.line_types.insert("Schnitt", LineType::Continuous);
    let (raw, _) = &read_as(&drawing, &language).paths[0];
    assert_eq!((codes(&raw.diagnostics), raw.drawn.elements[0].role), (vec![], Role::Cut(Cut::Mill)));
}

/// Returns the meaning of a drawn entity: its role, or the code of the finding.
fn meaning(statement: &str) -> String {
    let raw = raw(&path("T5 O3", &format!("{statement}\nend 40,0")));
    match (raw.diagnostics.first(), raw.drawn.elements.first(), raw.probes.len()) {
        (Some(found), ..) => found.code().to_string(),
        (None, Some(element), 0) => format!("{:?}", element.role),
        (None, None, 1) => "probe".to_owned(),
        (None, None, 0) => "nothing".to_owned(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn lines_and_arcs_mean_what_the_table_says() {
    let table = [
        ("CONTINUOUS", "Cut(Mill)"),
        ("DIVIDE", "Cut(Mark)"),
        ("BORDER", "Cut(Support)"),
        ("CENTER", "Cut(Support)"),
        ("DASHED", "Sweep"),
        ("HIDDEN", "SilentSweep"),
        ("DASHDOT", "Subpath"),
        ("DOT", "SkippedSubpath"),
        ("PHANTOM", "PB106"),
        ("\"ZIGZAG\"", "PB106"),
    ];
    for (line_type, expected) in table {
        assert_eq!(meaning(&format!("line {line_type} 0,0 40,0")), expected, "{line_type}");
        assert_eq!(meaning(&format!("arc {line_type} 0,0 40,0 r 30")), expected, "{line_type}");
    }
}

#[test]
fn circles_mean_what_the_table_says() {
    let table = [
        ("CONTINUOUS", "Cut(Mill)", "Cut(Mill)"),
        ("DIVIDE", "Cut(Mark)", "Cut(Mark)"),
        ("BORDER", "Cut(Support)", "Cut(Support)"),
        ("CENTER", "Cut(Support)", "Cut(Support)"),
        ("DASHED", "PB106", "PB106"),
        ("HIDDEN", "PB106", "PB106"),
        ("DASHDOT", "probe", "PB105"),
        ("DOT", "nothing", "PB105"),
        ("PHANTOM", "probe", "PB105"),
        ("\"ZIGZAG\"", "PB106", "PB106"),
    ];
    for (line_type, of_six, of_seven) in table {
        assert_eq!(meaning(&format!("circle {line_type} 20,20 d 6")), of_six, "{line_type}");
        assert_eq!(meaning(&format!("circle {line_type} 20,20 d 7")), of_seven, "{line_type}");
    }
}

#[test]
fn a_line_takes_its_layers_line_type() {
    let drawing = "layer 1234.1P DIVIDE\nstart 0,0 \"T5 O3 I1 D2\"\nline BYLAYER 0,0 20,0\nend 20,0";
    assert_eq!(raw(drawing).drawn.elements[0].role, Role::Cut(Cut::Mark));
}

/// The text of a skipped subpath is for humans: its name, its letters and its sweep height are ignored.
#[test]
fn the_text_of_a_skipped_subpath_is_not_read() {
    let skipped = "line DOT 0,0 20,0 \">9999.9P S4 N9 XY\"\nmill 20,0 40,0\nend 40,0";
    let compiled = compile(&path("T5 O3 I1 B0 S8", skipped));
    let path = compiled.path.expect("nothing is wrong");
    assert_eq!(codes(&compiled.found), [""; 0]);
    assert!(matches!(path.segments[0].kind, SegmentKind::Sweep { height: None }), "{path:?}");
}

/// Parameters of a cut on a DOT line were meant for a line that is milled. A remark, a height of sweeps and a name mean nothing of the kind.
#[test]
fn parameters_of_a_cut_on_a_skipped_subpath_are_told() {
    let found = |text: &str| {
        let skipped = format!("line DOT 0,0 20,0 \"{text}\"\nmill 20,0 40,0\nend 40,0");
        codes(&compile(&path("T5 O3 I1 B0 S8", &skipped)).found)
    };
    for told in ["B1", "F500 N2"] {
        assert_eq!(found(told), ["PB210"], "{told}");
    }
    for silent in ["Hello", "S20", ">1111.1P F50"] {
        assert_eq!(found(silent), [""; 0], "{silent}");
    }
}

#[test]
fn unknown_names_suggest_a_line_type() {
    let likely = [
        ("PHANTOMLINIE", Some(LineType::Phantom)),
        ("BEGRENZUNG", Some(LineType::Border)),
        ("CONTINOUS", Some(LineType::Continuous)),
        ("PHANT", Some(LineType::Phantom)),
        ("STRICHPUNKTLINIE", Some(LineType::Dashdot)),
        // Numbered line types are distinguished by their digits.
        ("ACAD_ISO06W100", None),
        ("ZIGZAG", None),
    ];
    for (name, meant) in likely {
        assert_eq!(LineType::guess(name), meant, "{name}");
    }
}
