//! Tests guessing dialects.

use pathbuild_gcode::dialect::Dialect::{
    self, Fanuc, Grbl, Haas, LinuxCnc, Mach3, Marlin, Native, Rs274, Xpertmill,
};
use pathbuild_gcode::interpret::guess;

fn guessed(text: &str) -> (Dialect, Option<u32>) {
    let guess = guess(text.as_bytes());
    (guess.dialect, guess.evidence.line)
}

#[test]
fn signs_of_one_dialect_decide() {
    assert_eq!(guessed("%\nG00 Z1.000(=1.000+0.5*[#51-5.000])\n"), (Native, Some(2)));
    assert_eq!(guessed("%\nF150\nG17 G21 G40 G49 G54 G80 G90 G94\r\nG00 Z20.000\n"), (Native, Some(3)));
    assert_eq!(guessed("% //Programmstart\nG0 X1\n"), (Xpertmill, Some(1)));
    assert_eq!(guessed("%\nG0 X1\nM06 05\n"), (Xpertmill, Some(3)));
    assert_eq!(guessed("G21\n#<depth>=1\n"), (LinuxCnc, Some(2)));
    assert_eq!(guessed("o100 sub\no100 endsub\n"), (LinuxCnc, Some(1)));
    assert_eq!(guessed("( Grbl Post Processor )\nG0 X1\n"), (Grbl, Some(1)));
    assert_eq!(guessed("(tap)\n( for Mach2/3 from Vectric )\nG0 X1\n"), (Mach3, Some(2)));
    assert_eq!(guessed("G17 G21 G40 G49 G54 G80 G90 G94\n#<depth>=1\n"), (LinuxCnc, Some(2)));
}

#[test]
fn what_looks_like_a_sign_is_none() {
    assert_eq!(guessed("G0 X1 (see http://example)\nM30\n"), (Rs274, None));
    assert_eq!(guessed("T5 M6\nG0 X1\nM30\n"), (Rs274, None));
    assert_eq!(guessed("(=heading=)\nG0 X1\nM30\n"), (Rs274, None));
    // XpertMILL knows neither G20 nor G90.
    for word in ["G20", "G21", "G90", "G91"] {
        assert_ne!(guessed(&format!("// part 1\n{word}\nG0 X1\nM30\n")).0, Xpertmill, "{word}");
    }
    assert_eq!(guessed("// G90\nG71\nG0 X1\nM30\n").0, Xpertmill, "a comment");
    assert_eq!(guessed("O100 if [#1 EQ 1]\nG0 X1\nM30\n").0, LinuxCnc);
}

#[test]
fn program_numbers_and_headers_name_a_dialect() {
    assert_eq!(guessed("O1000\nG0 X1\nM30\n"), (Fanuc, Some(1)));
    assert_eq!(guessed("; a remark\nM117 Hello\nG0 X1\n"), (Marlin, Some(2)));
    assert_eq!(guessed("(pathbuild 0.1.0 3f2a-09c1 haas O2 T5)\n(=1)\nG0 X1\nM30\n"), (Haas, None));
    assert_eq!(guessed("(pathbuild 0.1.0 3f2a-09c1)\nO1000\nM30\n"), (Fanuc, Some(2)));
}

#[test]
fn else_the_first_dialect_that_knows_the_words() {
    assert_eq!(guessed("G21 G90\nG81 X1 Y1 Z-1 R1 F10\nM30\n"), (Rs274, None));
    assert_eq!(guessed("G21 G90\nG73 X1 Y1 Z-1 R1 Q1 F10\nM30\n"), (LinuxCnc, None));
    assert_eq!(guessed("G21 G90 ; remark\nG38.4 Z1 F10\nM30\n"), (LinuxCnc, None));
    assert_eq!(guessed(""), (Rs274, None));
}

#[test]
fn a_dialect_that_takes_every_line_wins() {
    let after_number = |line: &str| guessed(&format!("O1000\nG21 G90\nG0 X1. Y1. Z5.\n{line}\nM30\n")).0;
    assert_eq!(after_number("G187 P2"), Haas);
    assert_eq!(after_number("G5.1 Q1"), Fanuc);
    assert_eq!(after_number("G187 P2\nG5.1 Q1"), Fanuc, "no dialect has both");
    let without = |line: &str| guessed(&format!("G21 G90\nG0 X1. Y1. Z5.\n{line}\nM30\n")).0;
    assert_eq!(without("G54.1 P1"), Fanuc);
    assert_eq!(without("G154 P1"), Haas);
    assert_eq!(without("G81 X2. Y2. Z-1. R1. F10. K3"), Fanuc);
    assert_eq!(without("G81 X2. Y2. Z-1. R1. F10. L3"), Rs274);
    assert_eq!(without("G54.1 P1\nG154 P1"), Rs274, "no dialect has both");
    assert_eq!(without("G2 X2. Y1. I0.5 K0.000 F10."), Grbl, "which ignores K");
    assert_eq!(without("M3 M10"), Rs274, "Haas takes only one of them");
}

#[test]
fn fixtures_are_recognised() {
    for (text, dialect) in [
        (include_str!("programs/native/drill.gcode"), Native),
        (include_str!("programs/native/clean.gcode"), Native),
        (include_str!("programs/native/adjusted.gcode"), Native),
        (include_str!("programs/expressions.ngc"), LinuxCnc),
    ] {
        assert_eq!(guessed(text).0, dialect);
    }
}
