//! Reduces written files to the parts that are compared: moves, formulas, Q comments, subpath marks and statistics.

use std::sync::LazyLock;

use regex::Regex;

/// Returns the relevant lines of a written file; for a file of measured values, all of them.
pub(crate) fn reduced(name: &str, text: &str) -> Vec<String> {
    if name.ends_with("_Z.txt") {
        return text.lines().map(str::to_owned).collect();
    }
    text.lines().filter_map(|line| reduced_line(line.trim())).collect()
}

fn reduced_line(line: &str) -> Option<String> {
    static SUBPATH: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"^\((START|END) Subpath (\S+?)(\[.*)?[ )]").unwrap());
    const KEPT: [&str; 6] =
        ["(Q:", "(Milling length:", "(Drill length:", "(Sweeps:", "(Sum:", "(Command count:"];
    if let Some(mark) = SUBPATH.captures(line) {
        return Some(format!("({} Subpath {})", &mark[1], &mark[2]));
    }
    let is_kept = if line.starts_with('(') {
        KEPT.iter().any(|kept| line.starts_with(kept))
    } else {
        !line.is_empty() && !line.starts_with(';')
    };
    is_kept.then(|| line.to_owned())
}

/// Whether two lines are equal: numbers with three decimals may differ by one unit of the last decimal, and whole millimetres and minutes of the
/// statistics by one; -0.000 is always wrong.
pub(crate) fn is_same_line(expected: &str, written: &str) -> bool {
    if written.contains("-0.000") {
        return false;
    }
    if expected == written {
        return true;
    }
    match (length(expected), length(written)) {
        (Some(a), Some(b)) => {
            let is_near = |a: i64, b: i64| (a - b).abs() <= 1;
            a.0 == b.0 && expected.len() == written.len() && is_near(a.1, b.1) && is_near(a.2, b.2)
        }
        _ => !expected.starts_with('(') && is_same_move(expected, written),
    }
}

/// Returns the parts that are compared without `--compatible`: no statistics, which are compared with the program's own moves instead; either code
/// for a probing move; lines of a file of measured values without the position of the probe, ` @ [x|y]`.
pub(crate) fn of_default(lines: Vec<String>) -> Vec<String> {
    static PROBING: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"^G38\.[23]").unwrap());
    static PLACE: LazyLock<Regex> = LazyLock::new(|| Regex::new(r" @ \[[^\]]*\]").unwrap());
    let is_kept = |line: &String| length(line).is_none() && !line.starts_with("(Command count");
    let plain = |line: String| PROBING.replace(&PLACE.replace_all(&line, ""), "G38").into_owned();
    lines.into_iter().filter(is_kept).map(plain).collect()
}

/// Returns label, millimetres and minutes in a line of the statistics.
pub(crate) fn length(line: &str) -> Option<(String, i64, i64)> {
    static LENGTH: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"^(\([A-Z][a-z ]+): +([0-9]+) mm   ca\. *([0-9]+) min\)$").unwrap());
    let found = LENGTH.captures(line)?;
    Some((found[1].to_owned(), found[2].parse().ok()?, found[3].parse().ok()?))
}

fn is_same_move(expected: &str, written: &str) -> bool {
    let ((words, numbers), (other_words, other_numbers)) = (parts(expected), parts(written));
    words == other_words && numbers.iter().zip(&other_numbers).all(|(a, b)| (a - b).abs() <= 0.001 + 1e-7)
}

/// Returns a line without its numbers of three decimals, and these numbers.
fn parts(line: &str) -> (String, Vec<f64>) {
    static NUMBER: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"-?[0-9]+\.([0-9]+)").unwrap());
    let mut numbers = Vec::new();
    let words = NUMBER.replace_all(line, |found: &regex::Captures<'_>| {
        if found[1].len() != 3 {
            return found[0].to_owned();
        }
        numbers.push(found[0].parse().unwrap());
        "#".to_owned()
    });
    (words.into_owned(), numbers)
}

#[test]
fn numbers_may_differ_by_one_unit_of_their_last_digit() {
    assert!(is_same_line("G00 X1.000 Y2.000", "G00 X1.001 Y2.000"));
    assert!(!is_same_line("G00 X1.000 Y2.000", "G00 X1.002 Y2.000"));
    assert!(!is_same_line("G00 X1.000", "G00 X1.0001"));
    assert!(!is_same_line("G00 X1.000", "G01 X1.000"));
    assert!(!is_same_line("G00 X0.000", "G00 X-0.000"));
}

#[test]
fn without_compatible_statistics_probing_codes_and_places_may_be_others() {
    let plain = |line: &str| of_default(vec![line.to_owned()]);
    assert_eq!(plain("(Sweeps:         68 mm   ca.  1 min)"), [""; 0]);
    assert_eq!(plain("(Command count: 14)"), [""; 0]);
    assert_eq!(plain("G38.2 F50.000 Z0.000"), plain("G38.3 F50.000 Z0.000"));
    assert_ne!(plain("G38.2 F50.000 Z0.000"), plain("G38.4 F50.000 Z0.000"));
    assert_eq!(
        plain("(1.1P [3.000|4.000] @ [138.000|299.000]) #51=T:5.000"),
        plain("(1.1P [3.000|4.000]) #51=T:5.000")
    );
    assert_ne!(plain("(1.1P [3.000|4.000]) #51=T:5.000"), plain("(1.1P [3.000|4.001]) #51=T:5.000"));
}

#[test]
fn statistics_may_differ_by_one() {
    let line =
        |millimetres: u32, minutes: u32| format!("(Sweeps:     {millimetres:5} mm   ca.{minutes:3} min)");
    assert!(is_same_line(&line(68, 1), &line(69, 2)));
    assert!(!is_same_line(&line(68, 1), &line(70, 1)));
    assert!(!is_same_line(&line(68, 1), &line(68, 3)));
    assert!(!is_same_line("(Command count: 14)", "(Command count: 15)"));
}
