//! Each kind of change, from programs as text.

use pathbuild_diagnostic::Lang;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_motion::Step;

use super::{ChangeKind, compare, groups, phrase};
use crate::scene::Move;

fn moves(text: &str) -> Vec<Move> {
    let read = interpret(text.as_bytes(), Dialect::Rs274, &Options::default());
    read.steps.iter().filter_map(Step::as_move).map(|(line, way)| Move::new(way, Some(line))).collect()
}

const BEGIN: &str = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\n";
const LINE: &str = "G1 Z-1 F150\nG1 X10 Y0 F150\nG1 X10 Y10 F150\nG0 Z5\n";
const OTHER: &str = "G0 X20 Y0\nG1 Z-1 F150\nG1 X30 Y0 F150\nG0 Z5\n";

/// The phrases for the changes from one program to another, with number of moves and length.
fn said(old: &str, new: &str) -> Vec<String> {
    let (old, new) = (moves(&format!("{BEGIN}{old}")), moves(&format!("{BEGIN}{new}")));
    let groups = groups(&compare(&old, &new), &old, &new);
    groups
        .iter()
        .map(|group| format!("{} {} {}", phrase(group, Lang::En), group.moves, group.length))
        .collect()
}

#[test]
fn the_same_moves_are_no_change() {
    assert_eq!(said(LINE, LINE), Vec::<String>::new());
    // Half a micrometre is the precision of printed programs; two micrometres are a change.
    assert_eq!(said(LINE, &LINE.replace("X10 Y0", "X10.0004 Y0")), Vec::<String>::new());
    assert_eq!(said(LINE, &LINE.replace("X10 Y0", "X10.002 Y0")).len(), 2);
}

#[test]
fn depth_and_feed() {
    assert_eq!(said(LINE, &LINE.replace("Z-1", "Z-1.5")), ["0.5 mm deeper 3 26.5"]);
    assert_eq!(said(LINE, &LINE.replace("Z-1", "Z-0.5"))[0], "0.5 mm higher 3 25.5");
    assert_eq!(said(LINE, &LINE.replace("Y10 F150", "Y10 F300")), ["faster: F300 instead of F150 1 10"]);
    assert_eq!(said(LINE, &LINE.replace("Y10 F150", "Y10 F100")), ["slower: F100 instead of F150 1 10"]);
}

#[test]
fn added_and_removed() {
    let both = format!("{LINE}{OTHER}");
    assert_eq!(said(LINE, &both)[0], "added 2 16");
    assert_eq!(said(&both, LINE)[0], "removed 2 16");
}

#[test]
fn shifted_by_as_much_everywhere_and_not_otherwise() {
    let both = |other: &str| format!("{LINE}{other}G0 X0 Y0\n");
    let shifted = OTHER.replace("Y0", "Y2");
    assert_eq!(said(&both(OTHER), &both(&shifted))[0], "shifted by (0, 2) mm 2 16");
    // The line also gets longer.
    let longer = shifted.replace("X30", "X31");
    assert!(!said(&both(OTHER), &both(&longer))[0].contains("shifted"));
}

#[test]
fn another_order() {
    let third = OTHER.replace("X20", "X50").replace("X30", "X60");
    let (before, after) = (format!("{OTHER}{third}"), format!("{third}{OTHER}"));
    let said = said(&before, &after);
    assert!(
        said.iter()
            .any(|line| line.starts_with("the same in the end, in another order or by other passes 2")),
        "{said:?}"
    );
}

#[test]
fn passes_count_and_only_the_lowest_is_compared() {
    let groove = |levels: &[&str]| {
        let pass = |z: &&str| format!("G0 X20 Y0\nG1 Z{z} F150\nG1 X30 Y0 F150\nG0 Z5\n");
        levels.iter().map(pass).collect::<String>()
    };
    let passes = said(&groove(&["-1", "-2"]), &groove(&["-0.5", "-1", "-1.5", "-2"]));
    assert_eq!(passes.len(), 2, "{passes:?}");
    assert!(passes[0].starts_with("passes: 4 instead of 2"), "{passes:?}");
    let deeper = said(&groove(&["-1", "-2"]), &groove(&["-1", "-2.2"]));
    assert!(deeper[0].starts_with("0.2 mm deeper"), "{deeper:?}");
    // Other intermediate heights, but the same final depth.
    let other = said(&groove(&["-1", "-2"]), &groove(&["-0.5", "-2"]));
    assert!(other[0].starts_with("the same in the end"), "{other:?}");
}

#[test]
fn every_change_names_moves_that_are_there() {
    let (old, new) = (moves(&format!("{BEGIN}{LINE}{OTHER}")), moves(&format!("{BEGIN}{OTHER}{LINE}{LINE}")));
    for change in compare(&old, &new) {
        assert!(change.old.end <= old.len() && change.new.end <= new.len());
        let is_gone = change.kind == ChangeKind::Removed;
        assert!(if is_gone { change.new.is_empty() } else { !change.new.is_empty() }, "{change:?}");
    }
}
