//! Tests our interpreter against LinuxCNC's `rs274`: both must give the same moves and reject the same lines.

mod common;
#[path = "common/oracle.rs"]
mod oracle;

use std::path::Path;

use oracle::{ask, difference, rs274};
use pathbuild_gcode::dialect::Dialect::LinuxCnc;
use pathbuild_gcode::interpret::{Options, interpret};

fn assert_same(program: &Path, name: &str, text: &str) {
    assert_eq!(difference(program, text, text, LinuxCnc), None, "{name}");
}

#[test]
fn programs_move_as_linuxcnc_moves_them() {
    let Some(rs274) = rs274() else { return };
    for (name, text) in [
        ("arcs", include_str!("programs/arcs.ngc")),
        ("branches", include_str!("programs/branches.ngc")),
        ("cycles", include_str!("programs/cycles.ngc")),
        ("expressions", include_str!("programs/expressions.ngc")),
        ("offsets", include_str!("programs/offsets.ngc")),
        ("units", include_str!("programs/units.ngc")),
    ] {
        assert_same(&rs274, name, text);
        assert_eq!(
            interpret(text.as_bytes(), LinuxCnc, &Options::default())
                .problems
                .iter()
                .filter(|d| d.is_error())
                .count(),
            0,
            "{name}"
        );
    }
}

/// Lines that LinuxCNC rejects, each after a valid beginning, with the names of our codes.
const REFUSED: &[(&str, &str)] = &[
    ("G1 X1", "missing-feed"),
    ("F100\nG94\nG1 X1", "missing-feed"),
    ("G93 G1 X1 F2\nX2", "missing-feed"),
    ("G38.2 Z-1", "missing-feed"),
    ("G80\nX1", "missing-word"),
    ("G0 G1 X1 F10", "conflicting-words"),
    ("G20 G21", "conflicting-words"),
    ("M3 M5", "conflicting-words"),
    ("M7 M8", "conflicting-words"),
    ("G81 X1 Z-2 R1 F10\nG82 X2 P1", "missing-word"),
    ("G83 X1 Z-2 R1 Q1 F10\nG73 X2 R1 Z-2", "missing-word"),
    ("G0 X1 X2", "conflicting-words"),
    ("G0 G92 X1", "conflicting-words"),
    ("G91 G53 G0 X1", "conflicting-words"),
    ("G53 G2 X1 I.5 F10", "conflicting-words"),
    ("G0 X1 I3", "unused-word"),
    ("G0 X1 R3", "unused-word"),
    ("G0 X1 Q3", "unused-word"),
    ("G61 P1", "unused-word"),
    ("G61.1 Q1", "unused-word"),
    ("G54 P2", "unused-word"),
    ("G49 H1", "unused-word"),
    ("G43 H1 D1", "unused-word"),
    ("G43.1 Z1 H1", "unused-word"),
    ("G38.2 F10", "missing-word"),
    ("G2 X2 Y0 R0.9987 F10", "invalid-arc"),
    ("G2 X0 Y0 R1 F10", "invalid-arc"),
    ("G2 X2 Y0 F10", "invalid-arc"),
    ("G2 X2 Y0 I1 R1 F10", "invalid-arc"),
    ("G90.1 G2 X2 Y0 I1 F10", "missing-word"),
    ("G2 X2 Y0 I1 P0 F10", "value-out-of-range"),
    ("G0 X10 Y0\nG3 X0 Y10.029 I-10 F10", "arc-radii-differ"),
    ("G0 X10000 Y0\nG3 X0 Y10002.84 I-10000 F10", "arc-radii-differ"),
    ("G4", "missing-word"),
    ("G4 P-1", "value-out-of-range"),
    ("F-5", "value-out-of-range"),
    ("S-5", "value-out-of-range"),
    ("T1.5", "value-out-of-range"),
    ("G10 L2 P10 X1", "value-out-of-range"),
    ("G81 X1 Z-2 F10", "missing-word"),
    ("G81 X1 R1 F10", "missing-word"),
    ("G83 X1 Z-2 R1 F10", "missing-word"),
    ("G82 X1 Z-2 R1 F10", "missing-word"),
    ("G83 X1 Z-2 R1 Q0 F10", "value-out-of-range"),
    ("G81 X1 Z-2 R1 L0 F10", "value-out-of-range"),
    ("G81 X1 Z2 R1 F10", "value-out-of-range"),
    ("G92", "missing-word"),
    ("G53", "conflicting-words"),
    ("G80 G53", "conflicting-words"),
    ("M62", "missing-word"),
    ("M65", "missing-word"),
    ("M66", "missing-word"),
    ("M68 Q1", "missing-word"),
    ("G0 G30", "conflicting-words"),
    ("G1 G28", "conflicting-words"),
    ("G0 G52", "conflicting-words"),
    ("G81 X1 Z-2 R1 F10\nG21 X-1 P5. Q100", "unused-word"),
    ("G82 X1 Z-2 R1 P1 F10\nX2 Q5", "unused-word"),
    ("G83 X1 Z-2 R1 Q1 P1 F10", "unused-word"),
    ("G12 X1", "unknown-word"),
    ("G38.6 X1", "unknown-word"),
    ("M12", "unknown-word"),
    ("X[1/0]", "cannot-evaluate"),
    ("X[SQRT[0-1]]", "cannot-evaluate"),
    ("X[ACOS[2]]", "cannot-evaluate"),
    ("X[LN[0]]", "cannot-evaluate"),
    ("X#<never>", "cannot-evaluate"),
    ("X#0", "cannot-evaluate"),
    ("#5603=1", "cannot-evaluate"),
    ("X[1+]", "invalid-expression"),
    ("X[1", "invalid-expression"),
    ("X[SIN 1]", "invalid-expression"),
    ("X[ATAN[1]]", "invalid-expression"),
    ("#1", "invalid-expression"),
    ("X1.2.3", "invalid-word"),
    ("XY1", "invalid-word"),
    ("X1 (a (b)", "invalid-comment"),
    ("X1 (a", "invalid-comment"),
    ("?", "unknown-character"),
];

#[test]
fn what_linuxcnc_refuses_is_an_error_here() {
    let rs274 = rs274();
    for (lines, name) in REFUSED {
        let text = format!("G17 G21 G90 G94 G54\nG0 X0 Y0 Z5\n{lines}\nM2\n");
        let faults = common::faults(LinuxCnc, &text);
        assert!(faults.iter().any(|fault| fault.ends_with(name)), "{lines:?} gives {faults:?}");
        if let Some(rs274) = &rs274 {
            let oracle = ask(rs274, &text);
            assert!(oracle.refusal.is_some(), "rs274 takes {lines:?}");
        }
    }
}

/// Unusual lines that LinuxCNC accepts.
const TAKEN: &[&str] = &[
    "g0 x 1 0 y +0.5",
    "G2 X2 Y0 R0.9988 F10",
    "G0 X10 Y0\nG3 X0 Y10.028 I-10 F10",
    "G2 I1 F10",
    "G90.1 G2 X2 Y0 I1 J0 F10",
    "#1=2\nG0 X-[1+2] Y-#1 Z[-SIN[30]]",
    "#1=3\n#1=2 #2=#1\nG0 X#2",
    "N10 G0 X1",
    "N56.78 G0 X1",
    "G0 G92.1 X1",
    "G0 X1 ; (not closed",
    "M6",
    "G10 L20 P1 X5\nG0 X1",
    "G81 X1 Z-2 R1 F10\nX2\nG80",
    "G82 X1 Z-2 R1 P1 F10\nX2 P2\nG80",
    "G83 X1 Z-2 R1 Q1 F10\nX2 Q2\nG80",
    "G53 G0",
    "M62 P1",
    "M66 E0 L0",
    "M68 E0 Q1",
    "G0 X[1 EQ 1.0000005] Y[2 GE 3]",
    "G1 F100 X1 M5",
];

#[test]
fn what_linuxcnc_takes_is_no_error_here() {
    let rs274 = rs274();
    for lines in TAKEN {
        let text = format!("G17 G21 G90 G94 G54\nG0 X0 Y0 Z5\n{lines}\nM2\n");
        let result = interpret(text.as_bytes(), LinuxCnc, &Options::default());
        assert!(
            !result.problems.iter().any(pathbuild_diagnostic::Diagnostic::is_error),
            "{lines:?}: {:?}",
            common::faults(LinuxCnc, &text)
        );
        if let Some(rs274) = &rs274 {
            assert_same(rs274, lines, &text);
        }
    }
}

#[test]
fn recorded_programs_move_as_linuxcnc_moves_them() {
    let Some(rs274) = rs274() else { return };
    for name in ["drill", "helix", "bars", "probing"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/programs/native/{name}.gcode"));
        #[expect(clippy::disallowed_methods, reason = "a fixture")]
        let text = std::fs::read_to_string(path).expect("the fixture");
        // LinuxCNC clears the feed at G94, so the feed is repeated after G94.
        assert_same(&rs274, name, &text.replace(" G94\n", " G94\nF150\n"));
    }
}

/// Loops after `break` and `continue`, and whether LinuxCNC ends one of them too early or too late.
const LOOPS: &[(&str, bool)] = &[
    ("o1 do\n#5=[#5+1]\no2 if [#5 eq 2]\no1 continue\no2 endif\nG0 X#5\no1 while [#5 lt 4]", false),
    (
        "o1 do\n#5=[#5+1]\nG0 X#5\no1 continue\no1 while [#5 lt 2]\no2 repeat [3]\n#5=[#5+1]\nG0 X#5\no2 endrepeat",
        true,
    ),
    (
        "o1 do\n#5=[#5+1]\nG0 X#5\no1 continue\no1 while [#5 lt 2]\no2 while [#5 lt 9]\n#5=[#5+1]\nG0 X#5\no2 break\no2 endwhile",
        true,
    ),
    (
        "o1 do\n#5=[#5+1]\nG0 X#5\no1 continue\no1 while [#5 lt 2]\no3 while [#5 lt 3]\n#5=[#5+1]\no3 endwhile\no2 repeat [3]\n#5=[#5+1]\nG0 X#5\no2 endrepeat",
        false,
    ),
    (
        "o1 do\n#5=[#5+1]\nG0 X#5\no1 continue\no1 while [#5 lt 2]\no3 while [#5 lt 3]\n#5=[#5+1]\no3 continue\no3 endwhile\no2 repeat [3]\n#5=[#5+1]\nG0 X#5\no2 endrepeat",
        false,
    ),
    (
        "o1 do\n#5=[#5+1]\nG0 X#5\no1 continue\no1 while [#5 lt 2]\no2 repeat [0]\no2 endrepeat\no3 repeat [2]\n#5=[#5+1]\nG0 X#5\no3 endrepeat",
        false,
    ),
    ("o1 while [1]\nG0 X1\no1 break\no1 endwhile\no2 do\n#5=[#5+1]\nG0 X[#5+1]\no2 while [#5 lt 3]", true),
    ("o1 while [1]\nG0 X1\no1 break\no1 endwhile\no2 do\n#5=[#5+1]\nG0 X[#5+1]\no2 while [#5 lt 1]", false),
    (
        "o1 while [1]\nG0 X1\no1 break\no1 endwhile\no3 do\nG0 X2\no3 break\no3 while [1]\no2 do\n#5=[#5+1]\nG0 X[#5+3]\no2 while [#5 lt 3]",
        false,
    ),
    ("o2 do\n#5=[#5+1]\no1 while [1]\nG0 X#5\no1 break\no1 endwhile\no2 while [#5 lt 3]", true),
    (
        "o1 sub\no3 while [1]\no3 break\no3 endwhile\no1 endsub\no2 do\n#5=[#5+1]\nG0 X#5\no1 call\no2 while [#5 lt 3]",
        true,
    ),
];

#[test]
fn a_loop_that_linuxcnc_ends_too_early_or_too_late_is_reported() {
    let rs274 = rs274();
    for (lines, is_other) in LOOPS {
        let text = format!("G17 G21 G90 G94 G54\nG0 X0 Y0 Z5\n#5=0\n{lines}\nG0 X99\nM2\n");
        let result = interpret(text.as_bytes(), LinuxCnc, &Options::default());
        let reported = result.problems.iter().filter(|problem| problem.is_error()).count();
        assert_eq!(reported > 0, *is_other, "{lines}: {:?}", common::faults(LinuxCnc, &text));
        if let Some(rs274) = &rs274 {
            assert_eq!(difference(rs274, &text, &text, LinuxCnc).is_some(), *is_other, "{lines}");
        }
    }
}
