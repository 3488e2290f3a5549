//! Tests that bad input never causes panics, hangs or unbounded growth.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::estimate::{Kinematics, seconds};
use pathbuild_gcode::interpret::{Heights, Options, guess, interpret};
use pathbuild_gcode::read::BlockReader;
use pathbuild_gcode::statistics::Summary;
use pathbuild_gcode::verify::{Machine, MachineRules, Tolerance, compare, verify};
use proptest::prelude::*;

fn dialects() -> impl Strategy<Value = Dialect> {
    proptest::sample::select(Dialect::ALL)
}

/// Parts of G-code, to which line ends are added.
const PIECES: &str = "G0 G1 G2 G3 G4 G10 G17 G18 G19 G20 G21 G28 G28.1 G30 G38.2 G38.5 G40 G43 G52 G53 G54 G55 G59.3 G73 G80 G81 G82 \
    G83 G85 G89 G90 G90.1 G91 G92 G92.1 G92.2 G92.3 G93 G94 G95 G98 G99 M0 M2 M3 M5 M6 M7 M9 M30 X Y Z I J K R P Q L F S T N O H # \
    #<a>= #1= [ ] ** MOD ATAN SIN EXISTS ( ) (= (== ; // ! % / 1 1 -2.5 0 . 1e9 99999999999999999999 0.0000001 ä \u{84} ,";

/// Generates parts of G-code in any order, which reach deeper into the interpreter than random bytes.
fn programs() -> impl Strategy<Value = String> {
    let ends = ["\n", "\n", "\n", "\n", "\r\n", " ", " "];
    let pieces: Vec<&str> = PIECES.split_whitespace().chain(ends).collect();
    proptest::collection::vec(proptest::sample::select(pieces), 0..60).prop_map(|pieces| pieces.concat())
}

const MACHINE: Kinematics =
    Kinematics { rates: [3000.0; 3], accelerations: [200.0; 3], junction_deviation: 0.01 };

fn run(text: &[u8], dialect: Dialect) {
    let nominal = Options { heights: Heights::Nominal, ..Options::default() };
    let result = interpret(text, dialect, &nominal);
    let moves = result.moves();
    assert!(moves.iter().all(|(_, it)| it.to.at.iter().all(|at| at.is_finite())), "{moves:?}");
    assert_eq!(compare(&moves, &moves, &Tolerance::of_decimals(3)), None);
    let time = seconds(&result.steps, &MACHINE);
    assert!(time.is_finite() && time >= 0.0, "{time}");
    let summary = Summary::of(&result.steps, dialect == Dialect::Xpertmill);
    assert!(summary.total.cutting().length.is_finite() && summary.total.sum(1.0).time >= 0.0, "{summary:?}");
    let machine = Machine { feed: Some(1.0), ..Machine::default() };
    let mut limits = MachineRules::new(&machine);
    verify(&result.steps[..], dialect, None, &mut |step| limits.step(step));
    limits.finish();
    let lines =
        u32::try_from(text.split(|byte| *byte == b'\n' || *byte == b'\r').count()).expect("few lines");
    for problem in &result.problems {
        // A program without any text has no line.
        let is_placed = problem.place.line.is_some_and(|line| line <= lines) || text.trim_ascii().is_empty();
        assert!(is_placed, "{problem:?}");
        assert_eq!(missing_values(problem), [""; 0], "{problem:?}");
    }
}

/// Returns the placeholders in a message or its help for which the diagnostic has no value.
fn missing_values(problem: &Diagnostic) -> Vec<&'static str> {
    let (text, help) = (&problem.message.text, &problem.message.help);
    let names = [text.en, text.de, help.en, help.de].into_iter().flat_map(|template| {
        template.split('{').skip(1).filter_map(|rest| rest.split_once('}').map(|(name, _)| name))
    });
    names.filter(|name| !problem.arguments.iter().any(|(given, _)| given == name)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_read(text in proptest::collection::vec(any::<u8>(), 0..400), dialect in dialects()) {
        run(&text, dialect);
        guess(&text);
    }

    #[test]
    fn any_words_are_interpreted(text in programs(), dialect in dialects()) {
        run(text.as_bytes(), dialect);
        guess(text.as_bytes());
    }

    #[test]
    fn any_number_reads_as_its_text(whole in any::<i64>(), decimals in 0_usize..12) {
        let text = format!("{:.decimals$}", whole as f64 / 1e6);
        let line = format!("X{text}");
        let mut reader = BlockReader::new(line.as_bytes(), Dialect::Rs274.rules());
        let block = reader.next_block().expect("a block");
        let pathbuild_gcode::read::Value::Number(number) = block.words[0].value else { panic!("a number") };
        prop_assert_eq!(number.value, text.parse::<f64>().expect("a number"));
        prop_assert_eq!(usize::from(number.decimals), decimals);
    }

    /// The fast path and the general path of the reader give the same result.
    #[test]
    fn blanks_between_words_change_nothing(words in proptest::collection::vec(("[A-Z]", -999_999_i32..999_999), 1..8)) {
        let join = |blank: &str| {
            let words = words.iter().map(|(letter, number)| format!("{letter}{}", f64::from(*number) / 1000.0));
            format!("{blank}{}", words.collect::<Vec<_>>().join(blank))
        };
        let read = |line: String| {
            let text = format!("G0\n{line}\n");
            let mut reader = BlockReader::new(text.as_bytes(), Dialect::Grbl.rules());
            reader.next_block().expect("the first block");
            reader.next_block().map(|block| block.words.iter().map(|word| (word.letter, word.value)).collect::<Vec<_>>())
        };
        prop_assert_eq!(read(join("")), read(join(" \t ")));
        prop_assert_eq!(read(join(" ")), read(join("()")));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// The fast path and the general path give the same result for formulas as well.
    #[test]
    fn blanks_in_formulas_change_nothing(
        pieces in proptest::collection::vec(
            proptest::sample::select(vec!["1.000", "-2.5", "+", "-", "*", "/", "[", "]", "#51", "(", ")", "=", "0.441*[#51-2.000]", "+0.395*[#52-2.000]", "a"]),
            0..12,
        ),
        is_whole in any::<bool>(),
    ) {
        let formula = if is_whole { "1.000+0.441*[#51-2.000]".to_owned() } else { pieces.concat() };
        let rest = if is_whole { pieces.concat() } else { ")".to_owned() };
        let read = |blank: &str| {
            let text = format!("G1\nX1 Z1.023{blank}(={formula}{rest}) Y2\nX3\n");
            let mut reader = BlockReader::new(text.as_bytes(), Dialect::Native.rules());
            let mut blocks = Vec::new();
            while let Some(block) = reader.next_block() {
                let words: Vec<_> = block.words.iter().map(|word| (word.letter, word.value)).collect();
                let formulas: Vec<_> = block
                    .formulas
                    .iter()
                    .map(|it| (it.word, it.applied, block.code(it.code).to_vec()))
                    .collect();
                blocks.push((block.line, words, formulas));
            }
            let codes: Vec<_> = reader.into_problems().into_diagnostics().iter().map(Diagnostic::code).collect();
            (blocks, codes)
        };
        // After a blank, the formula is read like any other expression.
        prop_assert_eq!(read(""), read(" "));
    }
}

#[test]
fn one_line_cannot_fill_the_memory() {
    let huge = format!(
        "G21 G90\nG0 X0 Y0 Z5\nG83 X1 Z-5 R1 Q0.000001 L4000000000 F10\n{}\n{}\nM30\n",
        "(".repeat(50_000),
        "X[".repeat(30_000)
    );
    for dialect in Dialect::ALL {
        let result = interpret(huge.as_bytes(), *dialect, &Options::default());
        assert!(result.steps.len() < 10);
        assert!(
            result
                .problems
                .iter()
                .all(|problem| problem.text.as_ref().is_none_or(|fault| fault.text.len() < 1000))
        );
    }
}

#[test]
fn a_large_file_without_sense_is_read_in_no_time() {
    let text = "\u{0}".repeat(20_000_000);
    let result = interpret(text.as_bytes(), Dialect::Native, &Options::default());
    assert_eq!(result.steps.len(), 0);
    let lines = format!("G21 G90\n{}", "?\n".repeat(1_000_000));
    assert_eq!(interpret(lines.as_bytes(), Dialect::Native, &Options::default()).problems.len(), 21);
}
