//! Finds output lines that contradict themselves or that controls execute differently. This matters for definitions without a dialect: for the others,
//! the reader of the dialect reports most of these lines as errors. (book: program/posts, "Before a program is written")

use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Diagnostic, Value};

/// Returns, as errors, those problems of a translation that would make a control misread the line. The others are dropped: they only arise
/// because the translation is read as RS274.
pub(super) fn errors(problems: &[Diagnostic], translation: &[u8]) -> Vec<Diagnostic> {
    problems.iter().filter_map(|problem| misreading_error(problem, translation)).collect()
}

fn misreading_error(problem: &Diagnostic, translation: &[u8]) -> Option<Diagnostic> {
    let line = problem.place.line?;
    let message = problem.message;
    let found = if message == &gcode::SAME_GROUP {
        let [first, second] = [problem.quoted("first")?, problem.quoted("second")?];
        if !is_exclusive(first, second) {
            return None;
        }
        Diagnostic::new(&posts::WORDS_EXCLUDE).quoting("first", first).quoting("second", second)
    } else if message == &gcode::LETTER_TWICE {
        Diagnostic::new(&posts::LETTER_REPEATED).with("letter", problem.argument("letter")?.clone())
    } else if message == &gcode::UNUSED {
        let index = usize::try_from(line).ok()?.checked_sub(1)?;
        let words = translation.split(|byte| *byte == b'\n').nth(index)?;
        let system = words.split(|byte| *byte == b' ').find(|word| is_system(word))?;
        let is_p = problem.argument("word") == Some(&Value::from('P'));
        let system = String::from_utf8_lossy(system);
        is_p.then(|| Diagnostic::new(&posts::SYSTEM_WITH_P).quoting("word", system))?
    } else {
        return None;
    };
    Some(found.at_line(line, None))
}

/// Whether two words of a group contradict each other on every control. Some pairs do not: G80 may accompany a motion, some controls
/// take M7 and M8 in one line, and a repeated word adds nothing.
fn is_exclusive(first: &str, second: &str) -> bool {
    let words = [first, second];
    let is_switch = words.iter().all(|word| matches!(*word, "M3" | "M4" | "M5"));
    first != second && !words.contains(&"G80") && (first.starts_with('G') || is_switch)
}

/// Whether a word selects a work offset, G54 to G59. Together with P, it selects another offset on Fanuc and is an error on other
/// controls.
fn is_system(word: &[u8]) -> bool {
    matches!(word, [b'G', b'5', b'4'..=b'9'] | [b'G', b'5', b'4'..=b'9', b'.', ..])
}
