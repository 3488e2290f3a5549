//! Compares the statistics of a program written without `--compatible` with the program's own moves. The recorded statistics come from the
//! reference, which counts planned lengths.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::LazyLock;

use regex::Regex;

use super::reduced::length;

const LABELS: [&str; 3] = ["(Milling length", "(Drill length", "(Sweeps"];

/// Returns a length of milling, drilling or sweeps that differs from the moves by more than 1 mm and 1 %.
pub(crate) fn statistics_difference(name: &str, text: &str) -> Option<String> {
    let travelled = travelled(text);
    text.lines().find_map(|line| {
        let (label, said, _) = length(line.trim())?;
        let own = travelled[LABELS.iter().position(|known| *known == label)?];
        let is_near = (said as f64 - own).abs() <= 1.0 + 0.01 * own;
        (!is_near).then(|| format!("{name}: its statistics say {line}, its moves come to {own:.1} mm"))
    })
}

/// Returns the lengths in mm of milling, drilling and sweeps in a native program, from the first fully known position.
fn travelled(text: &str) -> [f64; 3] {
    static MOVE: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"^G0?([0-3])([^0-9.]|$)").unwrap());
    static WORD: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"([XYZIJ])(-?[0-9.]+)").unwrap());
    static COMMENT: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"\([^)]*\)").unwrap());
    let mut lengths = [0.0; 3];
    let mut at: BTreeMap<char, f64> = BTreeMap::new();
    for line in text.lines() {
        let Some(code) = MOVE.captures(line) else { continue };
        let line = COMMENT.replace_all(line, "");
        let number =
            |found: &regex::Captures<'_>| (found[1].chars().next().unwrap(), found[2].parse().unwrap());
        let words: BTreeMap<char, f64> = WORD.captures_iter(&line).map(|found| number(&found)).collect();
        let mut to = at.clone();
        to.extend(words.iter().filter(|(letter, _)| "XYZ".contains(**letter)));
        if at.len() == 3 {
            let [x, y, z] = ['X', 'Y', 'Z'].map(|axis| to[&axis] - at[&axis]);
            let is_arc = matches!(&code[1], "2" | "3");
            let flat = if is_arc { arc_length(&words, &code[1] == "2", [x, y]) } else { x.hypot(y) };
            let kind = match &code[1] {
                "0" => 2,
                "1" if flat < 0.0005 => 1,
                _ => 0,
            };
            lengths[kind] += flat.hypot(z);
        }
        at = to;
    }
    lengths
}

/// Returns the length in the plane of an arc, given by the offset from its start to its end.
fn arc_length(words: &BTreeMap<char, f64>, clockwise: bool, [x, y]: [f64; 2]) -> f64 {
    let [i, j] = ['I', 'J'].map(|letter| words.get(&letter).copied().unwrap_or_default());
    let turned = (y - j).atan2(x - i) - (-j).atan2(-i);
    let turned = (if clockwise { -turned } else { turned }).rem_euclid(TAU);
    i.hypot(j) * if turned > 1e-9 { turned } else { TAU }
}

#[test]
fn statistics_are_held_against_the_moves() {
    let program = |milling: u32, drilling: u32, sweeps: u32| {
        format!(
            "G00 Z5.000\nG00 X0.000 Y0.000\nG00 X30.000 Y40.000\nG01 F100.000 Z-5.000(=-5.000+[#51-5.000])\n\
             G02 F100.000 I5.000 J0.000 X30.000 Y40.000 Z-5.000\nG00 Z5.000\n\
             (Milling length: {milling:5} mm   ca.  1 min)\n(Drill length: {drilling:5} mm   ca.  1 min)\n\
             (Sweeps:      {sweeps:5} mm   ca.  1 min)\n(Sum:         {:5} mm   ca.  1 min)\n",
            milling + drilling + sweeps
        )
    };
    let is_equal =
        |milling, drilling, sweeps| statistics_difference("x", &program(milling, drilling, sweeps)).is_none();
    assert!(is_equal(31, 10, 60) && is_equal(32, 11, 61));
    assert!(!is_equal(33, 10, 60) && !is_equal(31, 12, 60) && !is_equal(31, 10, 62));
}
