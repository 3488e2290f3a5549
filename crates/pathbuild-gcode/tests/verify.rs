//! Tests the rules of `verify`, each with a program that violates the rule and one that just does not.

mod common;

use std::path::{Path, PathBuf};

use common::{fault_text, spelled_out};
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::dialect::Dialect::{self, Estlcam, Fanuc, Grbl, Haas, LinuxCnc, Native, Xpertmill};
use pathbuild_gcode::interpret::{Heights, Interpretation, Options, interpret};
use pathbuild_gcode::read::quote;
use pathbuild_gcode::verify::{
    BentRapidRules, BlindRapidRules, Cutter, DepthRules, Machine, MachineRules, Stock, StockSpan, Travel,
    coarse_arc_finding,
};
use pathbuild_motion::Step;

const FINE: [&str; 0] = [];

fn run(program: &str) -> Interpretation {
    let text = format!("G17 G21 G90 G94 F100\n{program}\nM30\n");
    interpret(text.as_bytes(), Native, &Options::default())
}

fn verify(steps: &[Step], stock: Option<&Stock>) -> Vec<Diagnostic> {
    pathbuild_gcode::verify::verify(steps, Native, stock, &mut |_| {})
}

fn wrong(program: &str, stock: Option<&Stock>) -> Vec<String> {
    verify(&run(program).steps, stock).iter().map(fault_text).collect()
}

fn wrong_on(machine: &Machine, program: &str) -> Vec<String> {
    machine_rules(machine, &run(program).steps).finish().iter().map(fault_text).collect()
}

/// Returns the rules of a machine after these steps.
fn machine_rules<'m>(machine: &'m Machine, steps: &[Step]) -> MachineRules<'m> {
    let mut rules = MachineRules::new(machine);
    for step in steps {
        rules.step(step);
    }
    rules
}

/// Returns the problems on material up to Z 5 with a cutter of 2 mm.
fn on_stock(program: &str) -> Vec<String> {
    wrong(program, Some(&Stock::uniform(5.0, 2.0)))
}

/// Program that mills a slot from (0, 0) to (20, 0), down to Z 1, and leaves the cutter at the end of the slot.
const SLOT: &str = "G0 X0 Y0 Z10\nG0 Z5\nG1 Z1\nG1 X20";

fn behind_slot(program: &str) -> Vec<String> {
    on_stock(&format!("{SLOT}\n{program}"))
}

#[test]
fn a_rapid_move_through_material_is_an_error() {
    assert_eq!(
        behind_slot("G0 Y10\nG0 Z10\nG0 Y0\nG0 X10\nG0 Z5\nG1 Z1 Y10\nG0 Z10"),
        ["6 rapid-in-material", "11 end-not-raised"][..1]
    );
}

#[test]
fn a_rapid_move_where_all_is_cut_is_none() {
    assert_eq!(behind_slot("G0 X0\nG0 Z10"), FINE);
    assert_eq!(behind_slot("G0 X10\nG0 X5\nG0 Z10"), FINE);
    for [x, y] in [[10.0, 1.0], [10.0, -1.0], [20.0, 1.0], [20.0, -1.0]] {
        let beside = |width: f64| behind_slot(&format!("G0 X{x} Y{}\nG0 Z10", y * width));
        assert_eq!(beside(0.03), FINE, "{x} {y}: rounding");
        assert_eq!(beside(0.05), ["6 rapid-in-material"], "{x} {y}");
    }
}

#[test]
fn a_rapid_move_takes_no_more_than_some_hundredths_whatever_the_cutter() {
    for cutter in [1.0, 3.0, 12.0] {
        let plunge = |beside: &str| {
            let program = format!("G0 X0 Y0 Z10\nG1 Z-20\nG0 Z10\nG0 {beside}\nG0 Z-20\nG0 Z10");
            wrong(&program, Some(&Stock::uniform(5.0, cutter)))
        };
        for direction in ["X", "Y-"] {
            assert_eq!(plunge(&format!("{direction}0.03")), FINE, "{cutter} {direction}");
            assert_eq!(plunge(&format!("{direction}0.06")), ["6 rapid-plunge"], "{cutter} {direction}");
        }
    }
    // Around an arc as well, although its chords keep away from it.
    let circle = |x: &str| {
        let program = format!("G0 X10 Y0 Z10\nG1 Z1\nG2 I-10\nG0 Z10\nG0 X{x}\nG0 Z1\nG0 Z10");
        wrong(&program, Some(&Stock::uniform(5.0, 12.0)))
    };
    for [inside, outside] in [["10.03", "10.06"], ["9.97", "9.94"]] {
        assert_eq!(circle(inside), FINE);
        assert_eq!(circle(outside), ["7 rapid-plunge"]);
    }
}

#[test]
fn a_rapid_move_above_the_bottom_of_what_is_cut_is_none() {
    assert_eq!(behind_slot("G0 Z1.5\nG0 X0\nG0 Z10"), FINE);
    assert_eq!(behind_slot("G0 Z10\nG0 X10\nG0 Z1\nG0 Z10"), FINE);
    assert_eq!(behind_slot("G0 Z10\nG0 X10\nG0 Z0.9\nG0 Z10"), ["8 rapid-plunge"]);
}

#[test]
fn a_rapid_move_just_above_the_material_is_none() {
    let beside = |z: &str| behind_slot(&format!("G0 Z{z}\nG0 X10 Y2\nX0 Y-2\nG0 Z10"));
    assert_eq!(beside("5"), FINE);
    assert_eq!(beside("4.999"), FINE);
    assert_eq!(beside("4.99"), ["7 rapid-in-material", "8 rapid-in-material"]);
}

#[test]
fn elsewhere_nothing_is_known_and_nothing_said() {
    // At a distance of O from the centre line of the slot, the material is unknown.
    assert_eq!(behind_slot("G0 Z10\nG0 Y3.1\nG0 Z0\nG38.2 Z-1\nG0 Z10"), FINE);
    assert_eq!(behind_slot("G0 Z10\nG0 Y2.5\nG0 Z0\nG0 Z10"), ["8 rapid-plunge"]);
}

#[test]
fn rapid_moves_alone_mill_nothing_anywhere() {
    // Far from the slot, the material is unknown.
    let far = |program: &str| behind_slot(&format!("G0 Z10\nG0 X50 Y50\n{program}\nG0 Z10"));
    assert_eq!(far("G0 Z4.999\nG0 X60"), FINE);
    assert_eq!(far("G0 Z4.99\nG0 X60"), ["8 rapid-plunge"]);
    assert_eq!(far("G0 Z1\nG0 X60\nG0 Y60\nG0 X70 Y70 Z5"), ["8 rapid-plunge"]);
    assert_eq!(far("G0 Z1\nG0 X60\nG53 G0 Z0\nG0 Z10"), ["8 rapid-plunge"]);
    assert_eq!(far("G0 Z1\nG0 X60\nG0 Z4.9\nG0 X70"), ["8 rapid-plunge"]);
    // A cut or a probe follows the rapid moves, so they are not reported as a plunge.
    assert_eq!(far("G0 Z1\nG0 X60\nG1 X60.001\nG0 X70"), ["9 rapid-in-material", "11 rapid-in-material"]);
    assert_eq!(far("G0 Z1\nG0 Z2\nG0 X60\nG38.2 Z0"), FINE);
    // Within the slot, all material is removed.
    assert_eq!(behind_slot("G0 Z10\nG0 X15\nG0 Z1\nG0 X5\nG0 Z10"), FINE);
}

#[test]
fn the_intermediate_point_of_g28_may_lie_in_material() {
    let home = |words: &str| behind_slot(&format!("G0 Z10\nG0 X50 Y50\n{words}\nG0 X0 Y0 Z10"));
    for word in ["G28", "G30"] {
        assert_eq!(home(&format!("{word} Z5")), FINE);
        assert_eq!(home(&format!("{word} Z4.9")), ["8 rapid-plunge"]);
        assert_eq!(
            home(&format!("{word} X60 Z4.9")),
            ["8 diagonal-rapid", "8 rapid-in-material", "8 rapid-plunge"]
        );
    }
    assert_eq!(home("G91 G28 Z-5\nG90"), FINE);
    assert_eq!(home("G91 G28 Z-5.1\nG90"), ["8 rapid-plunge"]);
}

#[test]
fn the_spindle_stands_still_while_probing() {
    let probe = |words: &str| wrong(&format!("G0 X0 Y0 Z10\nM3 S1000\n{words}\nM5"), None);
    assert_eq!(probe("M5\nG38.2 Z0\nG0 Z10\nM3"), FINE);
    assert_eq!(probe("G38.2 Z0\nG38.2 Z-1\nG0 Z10"), ["4 probe-with-spindle-on"], "once");
    assert_eq!(probe("G38.4 Z11\nM4\nG38.3 Z0"), ["4 probe-with-spindle-on", "6 probe-with-spindle-on"]);
}

#[test]
fn what_is_milled_later_is_material_now() {
    assert_eq!(on_stock("G0 X0 Y0 Z10\nG0 Z1\nG1 X20\nG0 Z10"), ["3 rapid-plunge"]);
    assert_eq!(on_stock("G0 X0 Y0 Z10\nG0 Z5\nG1 Z1\nG0 X20\nG1 X0\nG0 Z10"), ["5 rapid-in-material"]);
}

#[test]
fn slopes_are_cut_as_deep_as_they_are() {
    let slope = "G0 X0 Y0 Z10\nG0 Z5\nG1 X20 Z1\nG0 Z10\n";
    assert_eq!(on_stock(&format!("{slope}G0 X15\nG0 Z2.4\nG0 Z10")), FINE);
    assert_eq!(on_stock(&format!("{slope}G0 X15\nG0 Z1.8\nG0 Z10")), ["7 rapid-plunge"]);
    assert_eq!(on_stock(&format!("{slope}G0 X5\nG0 Z2.4\nG0 Z10")), ["7 rapid-plunge"]);
}

/// An arc in G18 or G19 may dip into the material between two ends above it.
#[test]
fn arcs_across_the_plane_cut_as_deep_as_their_lowest_point() {
    for (arc, axis) in [("G18 G2 X20 I10 K0", "X"), ("G19 G3 Y20 J10 K0", "Y")] {
        let groove =
            |then: &str| on_stock(&format!("G0 X0 Y0 Z5\n{arc}\nG17\nG0 Z10\nG0 {axis}10\n{then}\nG0 Z10"));
        assert_eq!(groove("G0 Z-4.9"), FINE, "{arc}");
        assert_eq!(groove("G0 Z-5.1"), ["7 rapid-plunge"], "{arc}");
    }
    let dip = |k: &str| on_stock(&format!("M3 S9000\nG0 X0 Y0 Z6\nM5\nG18 G2 X20 I10 K{k}\nG17\nG0 Z10"));
    // The centre is 10 mm from either end, so the lowest point is at Z 4.99, and then at 5.01.
    assert_eq!(dip("49"), ["5 spindle-off"]);
    assert_eq!(dip("50"), FINE);
}

#[test]
fn circles_are_cut_all_round() {
    let circle = "G0 X10 Y0 Z10\nG0 Z5\nG1 Z1\nG2 X10 Y0 I-10\nG0 Z10\n";
    assert_eq!(on_stock(&format!("{circle}G0 X0 Y-10\nG0 Z1\nG0 Z10")), FINE);
    assert_eq!(on_stock(&format!("{circle}G0 X0 Y-10.5\nG0 Z1\nG0 Z10")), ["8 rapid-plunge"]);
    // The tool moves from inside to the middle of a circle whose core has not been milled.
    assert_eq!(on_stock(&format!("{circle}G0 X8.5 Y0\nG0 Z1\nG0 Z10")), ["8 rapid-plunge"]);
}

#[test]
fn the_centre_of_a_small_helix_may_be_reached_by_rapid() {
    // The native helical circle of diameter 3.8 with a cutter of 2 mm ends with G00 to its centre at depth.
    let helix = |radius: &str| {
        format!(
            "G0 X0 Y0 Z7\nG0 Y-{radius}\nG2 Y{radius} J{radius} Z3\nG2 Y-{radius} J-{radius} Z1\nG2 Y{radius} J{radius} Z1\nG2 Y-{radius} J-{radius} Z1\nG0 Y0\nG0 Z10"
        )
    };
    assert_eq!(on_stock(&helix("0.900")), FINE);
    // A larger circle leaves a core in the middle.
    assert_eq!(on_stock(&helix("1.500")), ["8 rapid-in-material"]);
}

#[test]
fn the_surface_is_that_of_the_line() {
    let piece = |order, surface| StockSpan { order, surface, cutter: Cutter::flat(2.0) };
    let program = "G0 X0 Y0 Z10\nG0 Z5\nG1 Z1\nG0 Z10\nG0 X50\nG0 Z5\nG1 Z1\nG0 Z10";
    let verified = |pieces: Vec<StockSpan>| wrong(program, Some(&Stock::of_pieces(pieces)));
    assert_eq!(verified(vec![piece(1, 5.0)]), FINE);
    assert_eq!(verified(vec![piece(1, 5.0), piece(6, 8.0)]), ["7 rapid-plunge"]);
    assert_eq!(verified(vec![piece(7, 5.0)]), FINE);
}

#[test]
fn the_surface_of_native_text_is_where_plunges_hand_over() {
    let program = "G0 X0 Y0 Z10\nG0 Z5\nG1 Z1\nG0 Z10\n(START Subpath 1)\nG0 X50\nG0 Z2\nG1 Z1\nG0 Z10\n(END Subpath 1)\nG0 X0";
    let stock = Stock::of_native_text(&run(program).steps, Cutter::flat(2.0)).expect("plunges");
    let piece = |order, surface| StockSpan { order, surface, cutter: Cutter::flat(2.0) };
    assert_eq!(stock, Stock::of_pieces(vec![piece(0, 5.0), piece(6, 2.0)]));
    assert_eq!(Stock::of_native_text(&run("G0 Z5\nG0 X1 Y1").steps, Cutter::flat(2.0)), None);
}

#[test]
fn a_large_program_is_checked_more_coarsely_not_never() {
    let row = |row: i32| format!("G0 Y{row}0\nG0 Z5\nG1 Z1\nX1000\nG0 Z10\nX0\n");
    let rows: String = (0..5).map(row).collect();
    let steps = run(&format!("G0 X0 Y0 Z10\n{rows}G0 X500 Y20.5\nG0 Z0")).steps;
    let stock = Stock::uniform(5.0, 2.0).with_resolution(0.02);
    let problems = verify(&steps, Some(&stock));
    let plunge = problems.iter().find(|problem| problem.code().name() == "rapid-plunge").expect("a plunge");
    // The side of a cell is that of 20240 mm² divided into 16 million cells, 0.036 mm.
    let help = plunge.help(Lang::En).expect("help");
    assert!(help.contains("stock is simulated to within 0.073"), "{help}");
}

#[test]
fn rapid_moves_of_any_length_are_checked_in_no_time() {
    let far = "G0 Z1\nG0 X999999999 Y999999999\nG0 X-999999999\nG0 Y-999999999\nG0 X0 Y0\n".repeat(20);
    assert!(behind_slot(&format!("G0 Z10\n{far}G0 Z10")).contains(&"8 rapid-in-material".to_owned()));
}

#[test]
fn a_slope_over_a_large_map_costs_what_it_covers() {
    // A slope of 4096 pieces crosses a slot whose tiles are in the same rows: each piece meets two of 3000 tiles.
    let slot = "G0 X0 Y0 Z10\nG1 Z1\nX32000\nG0 Z10\nG0 X0\nG1 Z205\nX30 Y1 Z0\nG0 Z10\n";
    let began = std::time::Instant::now();
    assert_eq!(on_stock(slot), FINE);
    assert!(began.elapsed().as_secs() < 10, "{:?}", began.elapsed());
}

#[test]
fn no_more_cells_are_visited_than_the_limit_says() {
    // Slopes within the material at one position have almost no area, but many parts.
    let slopes = "G1 X20 Z-204\nX0 Z1\n".repeat(2);
    let steps = run(&format!("G0 X0 Y0 Z10\n{slopes}G0 Z10")).steps;
    let with = |cells| {
        let stock = Stock::uniform(5.0, 2.0).with_cells(cells);
        verify(&steps, Some(&stock)).iter().map(fault_text).collect::<Vec<_>>()
    };
    assert_eq!(with(1_000_000_000), FINE);
    assert_eq!(with(1_000_000), ["6 limit-reached"]);
}

#[test]
fn a_program_that_cannot_be_followed_says_so() {
    let rows = |length: u32| {
        (0..100).map(|row| format!("G0 Y{row}\nG1 Z1\nX{length}\nG0 Z10\nX0\n")).collect::<Vec<_>>().concat()
    };
    let said = |length| {
        let steps = run(&format!("G0 X0 Y0 Z10\n{}", rows(length))).steps;
        let problems = verify(&steps, Some(&Stock::uniform(5.0, 2.0)));
        problems.iter().map(|problem| (fault_text(problem), problem.severity)).collect::<Vec<_>>()
    };
    assert_eq!(said(1_000), []);
    assert_eq!(said(1_000_000), [("500 limit-reached".to_owned(), pathbuild_diagnostic::Severity::Error)]);
}

#[test]
fn the_cutter_is_raised_before_it_moves_in_the_plane() {
    let wrong = |program| wrong(program, None);
    assert_eq!(wrong("G0 X1 Y1\nG0 Z5"), ["2 start-not-raised"]);
    assert_eq!(wrong("G0 Z5\nG0 X1 Y1"), FINE);
    assert_eq!(wrong("G0 X1 Y1 Z5\nG1 X2"), FINE);
    // A tool changer raises the tool; an operator may leave it where it is.
    let changed = |dialect: Dialect| {
        let program = "G17 G21 G90\nT1 M6\nG0 X1. Y1.\nG0 Z5.\nM30\n";
        let steps = interpret(program.as_bytes(), dialect, &Options::default()).steps;
        let found = pathbuild_gcode::verify::verify(&steps, dialect, None, &mut |_| {});
        found.iter().map(fault_text).collect::<Vec<_>>()
    };
    assert_eq!([Fanuc, Haas].map(changed), [FINE, FINE]);
    assert_eq!(changed(LinuxCnc), ["3 start-not-raised"]);
    // Named positions of the machine raise the tool.
    assert_eq!(wrong("G53 G0 Z0\nG0 X1 Y1"), FINE);
    assert_eq!(wrong("G28 G91 Z0\nG90\nG0 X1 Y1"), FINE);
    // A named position in the plane alone does not raise the tool.
    assert_eq!(wrong("G53 G0 X5 Y5\nG0 X1 Y1"), ["2 start-not-raised"]);
    assert_eq!(wrong("G53 G0 X0\nG0 Z5\nG0 X1 Y1"), ["2 start-not-raised"]);
    assert_eq!(wrong("G28 X0\nG0 Z5\nG0 X1 Y1"), ["2 start-not-raised"]);
    assert_eq!(wrong("G28 Z0\nG53 G0 X5 Y5"), FINE);
}

#[test]
fn the_program_ends_above_the_material() {
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99"), ["3 end-not-raised"]);
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nG0 Z5"), FINE);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG1 Z4.99", None), FINE, "where the surface is, is not known");
}

#[test]
fn rapid_moves_down_are_not_diagonal() {
    assert_eq!(on_stock("G0 X0 Y0 Z10\nG0 X50 Z4\nG38.2 Z3\nG0 Z10"), ["3 diagonal-rapid"]);
    assert_eq!(on_stock("G0 X0 Y0 Z10\nG0 X50 Z5\nG0 Z10"), FINE);
    assert_eq!(on_stock("G0 X0 Y0 Z10\nG0 X50\nG0 Z4\nG0 X60 Z5\nG0 Z10"), ["4 rapid-plunge"]);
}

#[test]
fn the_spindle_turns_while_cutting() {
    let wrong = |program| wrong(program, None);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG1 Z1\nM3 S1000\nG1 Z0"), ["3 spindle-off"]);
    assert_eq!(
        wrong("M3 S1000\nG0 X0 Y0 Z5\nG1 Z1\nM5\nG1 Z2\nZ3\nM4\nG1 Z1\nG0 Z5\nM5\nG0 X1"),
        ["6 spindle-off"]
    );
    assert_eq!(wrong("M3 S1000\nG0 X0 Y0 Z5\nG1 Z1\nG0 Z5\nT2 M6\nG1 Z1"), ["7 spindle-off"]);
    assert_eq!(wrong("M3 S1000\nG0 X0 Y0 Z5\nG1 Z1\nG0 Z5\nM5"), FINE);
    let oriented = |word: &str| {
        let program = format!("M3 S9\nG0 X0 Y0 Z5\nG1 Z1 F9\n{word}\nX5\nM3\nX6\nG0 Z5\nM5\nM30\n");
        let steps = interpret(program.as_bytes(), LinuxCnc, &Options::default()).steps;
        verify(&steps, None).iter().map(fault_text).collect::<Vec<_>>()
    };
    assert_eq!(oriented("M19"), ["5 spindle-off"], "M19 stops the spindle");
    assert_eq!(oriented("M8"), FINE);
    // The first height may be reached at feed.
    assert_eq!(wrong("G1 Z5\nG0 X0 Y0\nM3 S1000\nG1 Z1\nG0 Z5\nM5"), FINE);
    assert_eq!(wrong("G1 Z5\nG0 X0 Y0\nG1 Z1\nM3 S1000\nG0 Z5\nM5"), ["4 spindle-off"]);
}

#[test]
fn cuts_are_made_where_the_program_has_stated_x_and_y() {
    let wrong = |program| wrong(program, None);
    assert_eq!(wrong("G91\nG0 Z5\nG0 X9 Y9\nG1 Z-6\nX20\nX9"), ["5 unknown-position"]);
    assert_eq!(wrong("G0 Z5\nX9\nG1 Z-6"), FINE, "a rotary axis may have taken the place of the other");
    assert_eq!(wrong("G0 Z5\nX0 Y0\nG91\nX9 Y9\nG1 Z-6\nX20"), FINE);
    assert_eq!(wrong("G1 Z5\nG0 X0 Y0\nG1 Z-6"), FINE);
}

#[test]
fn cuts_are_not_made_at_a_height_counted_from_a_machine_position() {
    let wrong = |program: &str| wrong(&format!("G0 X0 Y0 Z5\n{program}\nG90 G0 Z5"), None);
    for home in ["G91 G28 Z0", "G28 Z5\nG91", "G53 G0 Z0\nG91", "G30 Z5\nG91"] {
        let last = home.lines().count() + 3;
        assert_eq!(wrong(&format!("{home}\nG1 Z-6\nG1 X10")), [format!("{last} unknown-position")], "{home}");
        assert_eq!(wrong(&format!("{home}\nG90\nG0 Z1\nG91\nG1 Z-6\nG1 X10")), FINE, "{home}");
    }
}

#[test]
fn an_arc_does_not_turn_back_from_both_its_neighbours() {
    let corner = |arc: &str, out: &str| {
        wrong(&format!("G0 X0 Y0 Z1\nG1 X10\n{arc} X15 Y5 I0 J5\nG1 {out}\nG0 Z9"), None)
    };
    assert_eq!(corner("G3", "Y20"), FINE);
    assert_eq!(corner("G2", "Y20"), ["4 doubtful-arc"]);
    assert_eq!(corner("G2", "X30"), FINE, "it turns back from one of them only");
    assert_eq!(corner("G2", "X15.8 Y20"), ["4 doubtful-arc"]);
    assert_eq!(corner("G2", "X18 Y20"), FINE);
    assert_eq!(corner("G2", "Z0\nY20"), FINE, "another depth");
}

#[test]
fn a_program_without_spindle_words_is_not_asked_for_them() {
    assert_eq!(wrong("S1000\nG0 X0 Y0 Z5\nG1 Z1\nG0 Z5", None), FINE);
}

#[test]
fn tools_are_changed_above_the_material() {
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nT2 M6\nG0 Z5"), ["4 tool-change-at-depth"]);
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nT2\nM0\nG0 Z5"), ["5 tool-change-at-depth"]);
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nM0\nT2\nG0 Z5"), ["5 tool-change-at-depth"]);
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nT2\nG0 Z5\nM0"), FINE, "raised before the stop");
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nM0\nG0 Z5"), ["4 stop-at-depth"], "no tool is named");
    assert_eq!(on_stock("G0 X0 Y0 Z5\nG1 Z4.99\nG0 Z5\nT2 M6"), FINE);
    assert_eq!(on_stock("T2 M6\nG0 X0 Y0 Z5"), FINE);
}

#[test]
fn the_spindle_stands_where_the_operator_changes_the_tool() {
    let program =
        |words: &str| wrong(&format!("T1\nM3 S9000\nG0 Z9\nG0 X0 Y0\nG1 Z1\nG0 Z9\n{words}\nM5"), None);
    assert_eq!(program("M5\nM0\nT2\nM3 S1000"), FINE);
    assert_eq!(program("M0\nT2\nM3 S1000"), ["8 spinning-at-change"]);
    assert_eq!(program("T2\nM0"), ["9 spinning-at-change"]);
    assert_eq!(program("T2\nM5 M0\nM3 S1000"), FINE);
    // A message names the tool, as in programs for Marlin.
    assert_eq!(program("M0 (Insert T2, set Z zero)"), ["8 spinning-at-change"]);
    assert_eq!(program("M5\nM0 (Insert T2, set Z zero)"), FINE);
    assert_eq!(program("M0 (Insert)"), FINE);
    // The program pauses without a tool change, or a changer stops the spindle itself.
    assert_eq!(program("M0"), FINE);
    let haas = "T1\nM3 S9000\nG0 Z9.\nM0\nT2\nM30\n";
    let read = interpret(haas.as_bytes(), Haas, &Options::default());
    assert_eq!(verify(&read.steps, None).iter().map(fault_text).collect::<Vec<_>>(), FINE);
    // The operator changes the tool at M6 of Estlcam.
    let change = |dialect, words: &str| -> Vec<String> {
        let steps = run(&format!("M3 S9000\nG0 X0 Y0 Z9\nG1 Z1\nG0 Z9\n{words}\nT2 M6\nG0 Z9\nM5")).steps;
        let found = pathbuild_gcode::verify::verify(&steps, dialect, None, &mut |_| {});
        found.iter().map(fault_text).collect()
    };
    assert_eq!(change(Estlcam, ""), ["7 spinning-at-change"]);
    assert_eq!(change(Estlcam, "M5"), FINE);
    assert_eq!(change(LinuxCnc, ""), FINE);
}

#[test]
fn a_stop_is_above_the_material() {
    for stop in ["M0", "M1"] {
        let stop_at = |z: &str| behind_slot(&format!("G0 Z{z}\n{stop}\n{stop}\nG0 Z10"));
        assert_eq!(stop_at("5"), FINE);
        assert_eq!(stop_at("4.999"), FINE);
        assert_eq!(stop_at("4.99"), ["7 stop-at-depth"]);
        // A stop after the last move is reported as the end of the program, and a stop beside T as a tool change.
        assert_eq!(behind_slot(stop), ["5 end-not-raised"]);
    }
    assert_eq!(behind_slot("T2\nM0\nG0 Z10"), ["7 tool-change-at-depth"]);
    assert_eq!(behind_slot("M0\nT2\nG0 Z10"), ["7 tool-change-at-depth"]);
}

/// Returns the findings, without those of other rules, about moves at unknown heights after `words`, which follow a cut with T1.
fn after_cut(dialect: Dialect, words: &str) -> Vec<String> {
    let text = format!(
        "G17 G21 G90 G94\nT1\nG0 Z10\nG0 X0 Y0\nM3 S9000\nG1 Z-1 F100\nG0 Z10\nM5\n{words}\nG1 X9 F100\nG0 Z10\nM30\n"
    );
    let steps = interpret(text.as_bytes(), dialect, &Options::default()).steps;
    let found = pathbuild_gcode::verify::verify(&steps, dialect, None, &mut |_| {});
    found.iter().map(fault_text).filter(|found| found.ends_with("start-not-raised")).collect()
}

#[test]
fn the_height_is_stated_after_a_tool_change_by_hand() {
    let after = |words: &str| after_cut(Grbl, words);
    let found = ["11 start-not-raised"];
    assert_eq!(after("M0\nT2\nG0 X5 Y5\nG0 Z5"), found);
    assert_eq!(after("M0\nT2\nG0 X0 Y0"), found, "the operator may have moved the axes");
    assert_eq!(after("M0\nT2\nG0 Z10\nG0 X5 Y5"), FINE, "even a height that has not changed is stated");
    assert_eq!(after("M0\nT2\nG91 G0 Z10\nG90\nG0 X5 Y5"), FINE);
    assert_eq!(after("T2\nM0\nG0 X5 Y5"), found);
    assert_eq!(after("M0\nG0 X5 Y5\nT2"), ["10 start-not-raised"], "T after the move");
    assert_eq!(after("T2\nG0 Z20\nM0\nG0 X5"), ["12 start-not-raised"], "T before the retract");
    assert_eq!(after("M0\nT2\nM3 S9000"), ["12 start-not-raised"], "a move at feed");
    assert_eq!(after("M0\nT2\nG53 G0 X-5"), found);
    assert_eq!(after("M0\nT2\nG53 G0 Z0\nG0 X5"), FINE);
}

/// A move in X, Y and Z begins at the height of the change, which may be that of the stock.
#[test]
fn a_move_that_also_states_z_begins_at_the_height_of_the_change() {
    let after = |words: &str| after_cut(Grbl, words);
    let found = ["11 start-not-raised"];
    assert_eq!(after("M0\nT2\nG0 X5 Y5 Z20"), found);
    assert_eq!(after("M0\nT2\nG0 X0 Y0 Z20"), found, "the operator may have moved the axes");
    assert_eq!(after("M0\nT2\nG0 X5 Z20\nG0 Y5"), found);
    assert_eq!(after("M0\nT2\nG0 Z20\nG0 X5 Y5 Z10"), FINE);
    assert_eq!(after("M0\nT2\nG91 G0 Z20\nG90\nG0 X5 Y5 Z10"), FINE);
    assert_eq!(after("M0\nG0 X5 Y5 Z20"), FINE, "a stop without a change");
    assert_eq!(after("M0\nG0 X5 Y5 Z20\nT2"), FINE, "T for the next stop");
    assert_eq!(after_cut(LinuxCnc, "M0\nG92 Z0\nG0 X5 Y5 Z20"), found);
}

#[test]
fn a_stop_without_a_tool_change_leaves_the_height_known() {
    let after = |words: &str| after_cut(Grbl, words);
    assert_eq!(after("M0\nG0 X5 Y5"), FINE);
    assert_eq!(after("M0\nT1\nG0 X5 Y5"), FINE, "the tool of the last cut");
    assert_eq!(after("M1\nT2\nG0 X5 Y5"), FINE, "a switch at the machine decides whether it stops");
    assert_eq!(after("M0\nG0 X5 Y5\nG0 Z-1\nG1 X7 F100\nT2"), FINE, "the tool has cut since the stop");
}

#[test]
fn a_stop_before_a_new_zero_or_length_is_a_tool_change() {
    let after = |words: &str| after_cut(LinuxCnc, words);
    assert_eq!(after("M0\nG92 X0 Y0\nG0 X5 Y5"), ["11 start-not-raised"]);
    for zero in ["G92 Z0", "G10 L20 P1 Z0"] {
        let moved = |words: &str| after(&format!("M0\n{zero}\n{words}"));
        assert_eq!(moved("G0 X5 Y5"), ["11 start-not-raised"], "the tip stands on the stock");
        assert_eq!(moved("G0 Z5\nG0 X5 Y5"), FINE);
    }
    assert_eq!(after("G92 Z0\nG0 X5 Y5"), FINE, "without a stop the height is known");
    assert_eq!(after("G43 H1\nM0\nG43 H1\nG0 X5 Y5"), FINE, "the same length");
    assert_eq!(after("G43 H1\nM0\nG43 H2\nG0 X5 Y5"), ["12 start-not-raised"]);
    assert_eq!(after("G43 H1\nM0\nG49\nG0 X5 Y5"), FINE);
}

#[test]
fn m6_beside_a_stop_is_a_tool_change_by_hand() {
    let after = after_cut;
    for words in ["M0\nT2 M6\nG0 X5. Y5.", "T2 M6\nM0\nG0 X5. Y5."] {
        assert_eq!(after(LinuxCnc, words), ["11 start-not-raised"]);
        assert_eq!(after(Fanuc, words), FINE, "a changer raises the tool");
        assert_eq!(after(LinuxCnc, &format!("G53 G0 Z0\n{words}")), FINE, "raised to a machine position");
    }
    assert_eq!(after(LinuxCnc, "T2 M6\nG43 H2\nM0\nG0 X5 Y5"), FINE, "the tool has its length");
    assert_eq!(after(LinuxCnc, "T2 M6\nG0 X5 Y5"), FINE);
    assert_eq!(after(Estlcam, "T2 M6\nG0 X5 Y5"), ["10 start-not-raised"], "the operator changes the tool");
    assert_eq!(after(LinuxCnc, "T2 M6\nG0 Z5\nM0\nG0 X5 Y5"), FINE, "a stop to look at the new tool");
    assert_eq!(after(LinuxCnc, "T1 M6\nG0 Z10\nG1 X1 F100\nT2\nM0\nG0 X5"), FINE, "T prepares the next M6");
}

/// Returns the findings about a program in LinuxCNC's dialect, on material up to Z 0 with a cutter of 2 mm, and the number of rapid moves from
/// unknown positions, with the line of the first.
fn from_unknown(program: &str) -> (Vec<String>, Option<(usize, u32)>) {
    let text = format!("G17 G21 G90 G94 F100\n{program}\nM30\n");
    let read = interpret(text.as_bytes(), LinuxCnc, &Options::default());
    let stock = Stock::uniform(0.0, 2.0);
    let mut blind = BlindRapidRules::new(&stock).expect("the surface is known");
    read.steps.iter().for_each(|step| blind.step(step));
    let found = verify(&read.steps, Some(&stock)).iter().map(fault_text).collect();
    (found, blind.finish().map(|blind| (blind.count, blind.line)))
}

#[test]
fn a_low_height_of_the_machine_raises_no_tool() {
    let blind = |z: &str| from_unknown(&format!("G0 Z5\nG0 X0 Y0\nG53 G0 Z{z}\nG0 X9\nG0 Z5\nG0 X0")).1;
    assert_eq!(blind("-10"), None);
    assert_eq!(blind("-10.1"), Some((2, 4)));
    // The tool goes down at a machine position, where there may be a tool setter, and is raised again.
    let setter = "G0 Z5\nG0 X0 Y0\nG53 G0 Z0\nG53 G0 X0 Y0\nG53 G0 Z-50\nG53 G0 Z0\nG0 X9 Y0\nG0 Z5";
    assert_eq!(from_unknown(setter).1, None);
}

/// The tool cuts a slot from (0, 0) and returns by a rapid move, which on Fanuc and Haas first goes at 45 degrees.
#[test]
fn a_slanting_rapid_move_of_a_fanuc_leaves_the_slot() {
    use pathbuild_gcode::dialect::Dialect::{Fanuc, Haas, LinuxCnc};
    let back = |dialect, end: &str, lift: &str| {
        let text = format!(
            "G17 G21 G90 G94 F100\nG0 Z5.\nG0 X0. Y0.\nG1 Z-1.\n{end}\n{lift}\nG0 X0. Y0.\nG0 Z5.\nM30\n"
        );
        let steps = interpret(text.as_bytes(), dialect, &Options::default()).steps;
        let stock = Stock::uniform(0.0, 2.0);
        let Some(mut rules) = BentRapidRules::new(dialect, &stock) else { return Vec::new() };
        for step in &steps {
            rules.step(step);
        }
        rules.finish(&steps).iter().map(fault_text).collect::<Vec<_>>()
    };
    for dialect in [Fanuc, Haas] {
        assert_eq!(back(dialect, "G1 X20. Y50.", "G0 Z-.5"), ["7 diagonal-rapid"]);
        assert_eq!(back(dialect, "G1 X20. Y50.", "G0 Z0."), FINE);
        assert_eq!(back(dialect, "G1 X20. Y20.", "G0 Z-.5"), FINE);
        assert_eq!(back(dialect, "G1 Y50.", "G0 Z-.5"), FINE);
    }
    assert_eq!(back(LinuxCnc, "G1 X20. Y50.", "G0 Z-.5"), FINE);
}

/// Two vises, G54 and G55, have one part each.
#[test]
fn what_is_cut_in_one_coordinate_system_is_not_cut_in_another() {
    let slot = "G0 Z5\nG0 X0 Y0\nG1 Z-1\nG1 X20\nG0 Z5";
    let again = |before: &str, system: &str| {
        from_unknown(&format!("{before}\n{slot}\n{system}\nG0 X0 Y0\nG0 Z-1\nG1 X20\nG0 Z5")).0
    };
    assert_eq!(again("G54", "G54"), FINE);
    assert_eq!(again("G54", "G55"), ["10 rapid-plunge"]);
    assert_eq!(again("G55", "G54"), ["10 rapid-plunge"]);
    assert_eq!(again("G54", "G55\nG54"), FINE);
    // The program places both systems at the same point.
    assert_eq!(again("G10 L2 P1 X0 Y0 Z0\nG10 L2 P2 X0 Y0 Z0", "G55"), FINE);
}

/// The operator lowers the new tool onto the stock, so that the new zero is where the old one was, although the program has left the tool at Z 20.
#[test]
fn where_the_operator_touches_off_the_zero_is_on_the_stock() {
    let second = |change: &str, end: &str| {
        let first = "M3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1\nG1 X10\nG0 Z20";
        from_unknown(&format!("{first}\n{change}\nG0 Z5\nG0 X20\nG1 Z-3\nG1 X40\n{end}\nM5")).0
    };
    for zero in ["G92 Z0", "G10 L20 P1 Z0"] {
        let clear = if zero == "G92 Z0" { "G92.1" } else { "" };
        let stopped = |end: &str| second(&format!("M0\n{zero}"), &format!("{end}\nG0 Z5\n{clear}"));
        assert_eq!(stopped("G0 Y50"), ["14 rapid-in-material"], "{zero}");
        assert_eq!(stopped("G0 X20"), FINE, "{zero}");
    }
    let off = |words: &str| second(&format!("M5\nM0\nG10 L20 P1 Z0\n{words}"), "G0 Z5");
    assert_eq!(off(""), ["14 spindle-off"]);
    assert_eq!(off("M3 S9000"), FINE);
    assert_eq!(
        second("G10 L20 P1 Z0", "G0 Y50\nG0 Z5"),
        FINE,
        "without a stop, the new zero is 20 mm above the stock"
    );
}

#[test]
fn what_is_cut_before_the_operator_sets_a_zero_in_the_plane_is_not_cut_after_it() {
    let again = |zero: &str| {
        let slot = "G0 Z5\nG0 X0 Y0\nG1 Z-3\nG1 X40\nG0 Z5\nG0 X0 Y0";
        from_unknown(&format!("{slot}\n{zero}\nG0 Z-3\nG0 X40\nG0 Z5")).0
    };
    assert_eq!(again("M0\nG10 L20 P1 X0 Y0 Z5"), ["10 rapid-plunge"], "the next part");
    assert_eq!(again("M0\nG10 L20 P1 Z5"), FINE, "the next tool");
    assert_eq!(again("G10 L20 P1 X0 Y0 Z5"), FINE, "the same place");
    assert_eq!(again("M0\nG10 L20 P2 X0 Y0 Z5\nG55"), ["11 rapid-plunge"], "another system");
    assert_eq!(again("G10 L20 P2 X0 Y0 Z5\nG55"), FINE, "another system at the same place");
}

#[test]
fn the_tool_is_raised_before_it_goes_to_another_coordinate_system() {
    let leave = |words: &str| {
        from_unknown(&format!("G0 Z5\nG0 X0 Y0\nG1 Z-1\nG1 X20\n{words}\nG55\nG0 X0 Y50\nG0 Z5")).0
    };
    assert_eq!(leave("G0 Z0"), FINE);
    assert_eq!(leave("G0 Z-0.1")[0], "8 rapid-in-material");
}

#[test]
fn cuts_at_depth_are_compared_within_a_coordinate_system() {
    let between = |words: &str| {
        at_depth(&format!("G0 X0 Y0 Z5\nG1 Z-2 F100\nX20\n{words}\nG0 Y20\nG1 Z-2\nX0\nG0 Z5\nX9"))
    };
    assert_eq!(between("G54"), ["6 rapid-at-depth"]);
    assert_eq!(between("G55"), FINE);
}

/// Lines that cut a slot at Z-5 from the current position to X20.
const SLOT_AT_5: &str = "G1 Z-5\nG1 X20\nG0 Z5";

#[test]
fn a_rapid_move_from_an_unknown_height_ends_above_the_material() {
    for start in ["G53 G0 Z0\nG0 X0 Y0", "G28 Z5\nG0 X0 Y0", "G30 Z5\nG0 X0 Y0", "T1 M6\nG0 X0 Y0"] {
        let begin = u32::try_from(start.lines().count()).expect("a few lines") + 2;
        let down = |z: &str| from_unknown(&format!("{start}\nG0 Z{z}\n{SLOT_AT_5}"));
        assert_eq!(down("0").1, None, "{start}");
        assert!(down("0").0.iter().all(|found| !found.ends_with("rapid-plunge")), "{start}: {:?}", down("0"));
        let (found, blind) = down("-1");
        assert!(found.contains(&format!("{begin} rapid-plunge")), "{start}: {found:?}");
        assert_eq!(blind, None, "{start}");
    }
}

#[test]
fn a_first_move_down_into_the_material_is_found() {
    let (found, blind) = from_unknown(&format!("G0 X0 Y0 Z-2\n{SLOT_AT_5}"));
    assert_eq!(found, ["2 rapid-plunge"]);
    assert_eq!(blind, Some((1, 2)));
    assert_eq!(from_unknown(&format!("G0 X0 Y0 Z5\n{SLOT_AT_5}")), (Vec::new(), None));
    // Far from all cuts, the tool moves down and up again by rapid moves alone.
    let (found, blind) = from_unknown(&format!("G0 X90 Y90 Z-2\nG0 X95\nG0 Z5\nG0 X0 Y0\n{SLOT_AT_5}"));
    assert_eq!(found, ["2 rapid-plunge"]);
    assert_eq!(blind, Some((1, 2)));
}

#[test]
fn a_rapid_move_into_what_has_been_cut_may_come_from_anywhere() {
    let again =
        |z: &str| from_unknown(&format!("G0 Z5\nG0 X0 Y0\n{SLOT_AT_5}\nG53 G0 Z0\nG0 X10\nG0 Z{z}\nG0 Z5"));
    assert_eq!(again("-5"), (Vec::new(), None));
    assert_eq!(again("-5.1"), (vec!["9 rapid-plunge".to_owned()], None));
}

#[test]
fn after_a_probe_the_height_is_not_above_everything() {
    let program =
        |then: &str| from_unknown(&format!("G0 Z5\nG0 X0 Y0\nG38.2 Z-1 F50\n{then}\nG0 X0 Y0\nG0 Z5"));
    assert_eq!(program("G0 Z5").1, None);
    assert_eq!(program("G0 X50").1, Some((2, 5)));
    assert_eq!(program("G53 G0 X50\nG0 X50").1, Some((2, 6)), "G53 raises nothing without Z");
    assert_eq!(program("G53 G0 Z0\nG0 X50").1, None);
}

#[test]
fn probes_go_down() {
    let wrong = |program| wrong(program, None);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 Z6"), ["3 useless-probe"]);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.2 Z5"), ["3 useless-probe"]);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 Z4.999"), FINE);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 X9"), FINE, "sideways to an edge");
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.5 Z6"), FINE, "away from it");
}

#[test]
fn a_probe_is_raised_before_it_moves_on() {
    let wrong = |program| wrong(program, None);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 Z0\nG4 P4\nG0 X9"), ["5 probe-not-raised"]);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 Z0\nG4 P4\nG0 Z5\nG0 X9"), FINE);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 X9\nG0 X8"), FINE, "back from an edge");
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 Z0\nG53 G0 X0"), ["4 probe-not-raised"]);
    assert_eq!(wrong("G0 X0 Y0 Z5\nG38.3 Z0\nG53 G0 Z0"), FINE);
}

#[test]
fn no_rapid_move_goes_further_down_after_a_probe() {
    let then = |words: &str| wrong(&format!("G0 X0 Y0 Z5\nG38.2 Z-10 F50\n{words}\nG90 G0 Z5"), None);
    assert_eq!(then("G91 G0 Z-2"), ["4 probe-not-raised"]);
    assert_eq!(then("G91 G0 Z2"), FINE);
    assert_eq!(then("G91 G0 Z2\nG0 Z-2"), FINE, "back to where it touched");
    assert_eq!(then("G91 G0 Z2\nG0 Z-2.001"), ["5 probe-not-raised"]);
    assert_eq!(then("G91 G0 Z2\nG38.2 Z-3\nG0 Z-0.1"), ["6 probe-not-raised"], "the second, slower probe");
    assert_eq!(then("G91 G1 Z-2"), FINE, "at feed");
    assert_eq!(then("G0 Z-10"), FINE);
    assert_eq!(then("G0 Z-10.001"), ["4 probe-not-raised"]);
    assert_eq!(then("G92 Z0\nG0 Z5\nG91 G0 Z-3\nG92.1"), FINE, "the height is known");
}

#[test]
fn the_spindle_stands_at_the_end() {
    let ends = |end: &str| {
        let program = format!("%\nG21\nM3 S1000\nG0 X0 Y0 Z5\n{end}%\n");
        let steps = interpret(program.as_bytes(), Native, &Options::default()).steps;
        verify(&steps, None).iter().map(fault_text).collect::<Vec<_>>()
    };
    assert_eq!(ends(""), ["3 spindle-left-on"]);
    for end in ["M5\n", "M30\n", "M2\n"] {
        assert_eq!(ends(end), FINE, "{end}");
    }
}

#[test]
fn arcs_have_three_decimals() {
    let coarse = |program: &str| coarse_arc_finding(program.as_bytes(), Native).is_some();
    assert!(!coarse("G21\nG2 X1.5 Y1.5 I1.5"), "numbers that fit each other exactly");
    assert!(coarse("G21\nG2 X1.5 Y1.51 I1.5"));
    assert!(coarse("G21\nG2 X1.25 Y1.5 I1.5"));
    assert!(!coarse("G21\nG0 X0.000\nG2 X1.5 Y1.51 I1.5"), "three where they are needed");
    assert!(!coarse("G21\nG2 X2 Y2 I2"), "written by hand");
    assert!(!coarse("G20\nG2 X1.5 Y1.5 I1.5"), "inches");
    assert!(!coarse("G21\nG1 X1.5 Y1.5"), "no arc");
}

#[test]
fn moves_stay_within_the_machines_travel() {
    let travel = Travel::Placed([(-10.0, 100.0), (0.0, 50.0), (-5.0, 30.0)]);
    let machine = Machine { travel: Some(travel), ..Machine::default() };
    let wrong = |program| wrong_on(&machine, program);
    assert_eq!(wrong("G0 X-10 Y50 Z30\nG0 X100 Y0 Z-5"), FINE);
    assert_eq!(
        wrong("G0 X0 Y0 Z0\nX-10.1\nX-10.2\nX100.1\nY-0.1\nZ30.1"),
        ["3 outside-machine", "5 outside-machine", "6 outside-machine", "7 outside-machine"]
    );
    // Programs have three decimals, which `emit` takes into account.
    assert_eq!(wrong("G0 X-10.0005 Y50.0005 Z30"), FINE);
    assert_eq!(wrong("G0 X-10.0006 Y50 Z30"), ["2 outside-machine"]);
    // The arc leaves the travel between its ends.
    assert_eq!(wrong("G0 X0 Y0 Z0\nG2 X2 Y0 I1"), FINE);
    assert_eq!(wrong("G0 X0 Y0 Z0\nG3 X2 Y0 I1"), ["3 outside-machine"]);
}

#[test]
fn a_program_is_not_larger_than_the_machine() {
    let machine = Machine { travel: Some(Travel::Size([100.0, 50.0, 30.0])), ..Machine::default() };
    let wrong = |program| wrong_on(&machine, program);
    assert_eq!(wrong("G0 X-1000 Y0 Z0\nX-900 Y50 Z-30"), FINE);
    assert_eq!(wrong("G0 X-1000 Y0 Z0\nX-899.9 Y50 Z-30\nX-1001"), ["3 outside-machine"]);
    assert_eq!(wrong("G0 X-1000.0005 Y0 Z0\nX-899.9995"), FINE);
    assert_eq!(wrong("G0 X-1000.001 Y0 Z0\nX-899.9995"), ["3 outside-machine"]);
}

#[test]
fn feeds_are_those_that_the_axes_can_do() {
    let machine = Machine { rates: [Some(1000.0), Some(1000.0), Some(200.0)], ..Machine::default() };
    let wrong = |program| wrong_on(&machine, program);
    assert_eq!(
        wrong("G0 X0 Y0 Z0\nG1 X10 F1000\nX20 F1001\nX30\nZ1 F201\nZ2 F200"),
        ["4 feed-too-high", "6 feed-too-high"]
    );
    // A rounding error in a component is harmless.
    assert_eq!(wrong("G0 X0 Y0 Z0\nG1 X10 F1000.0000009"), FINE);
    assert_eq!(wrong("G0 X0 Y0 Z0\nG1 X10 F1000.0000011"), ["3 feed-too-high"]);
    // At 45 degrees, each axis has a share of the feed.
    assert_eq!(wrong("G0 X0 Y0 Z0\nG1 X10 Y10 F1414\nX20 Y20 F1415"), ["4 feed-too-high"]);
    assert_eq!(wrong("G0 X0 Y0 Z0\nG2 X10 Y0 I5 F1000\nX20 I5 F1001"), ["4 feed-too-high"]);
}

#[test]
fn a_feed_is_at_most_the_machines() {
    let machine = Machine { feed: Some(1000.0), ..Machine::default() };
    let wrong = |program| wrong_on(&machine, program);
    assert_eq!(wrong("G0 X0 Y0 Z0\nG1 X10 Y10 F1000\nX20 F1001\nX30\nX40 F999"), ["4 feed-too-high"]);
}

#[test]
fn positions_of_the_machine_fit_into_its_travel() {
    let machine = Machine { travel: Some(Travel::Size([400.0, 300.0, 80.0])), ..Machine::default() };
    let wrong = |program: &str| wrong_on(&machine, &format!("G0 X0 Y0 Z1\n{program}"));
    assert_eq!(wrong("G53 G0 X-200\nG53 G0 X200"), FINE);
    assert_eq!(wrong("G53 G0 X-200\nG53 G0 X200.01"), ["4 outside-machine"]);
    assert_eq!(wrong("G53 G0 Z-80"), FINE);
    assert_eq!(wrong("G53 G0 Z-80.01"), ["3 outside-machine"], "machine zero is within the travel");
    // Machine coordinates say nothing about the place of the program's zero.
    assert_eq!(wrong("G53 G0 X-400\nG0 X400"), FINE);
    let placed = Travel::Placed([(-100.0, 300.0), (0.0, 300.0), (-80.0, 0.0)]);
    let machine = Machine { travel: Some(placed), ..Machine::default() };
    assert_eq!(wrong_on(&machine, "G0 Z0\nG53 G0 X-400"), FINE);
    assert_eq!(wrong_on(&machine, "G0 Z0\nG53 G0 X-400.01"), ["3 outside-machine"]);
}

#[test]
fn each_work_offset_of_unknown_place_fits_into_the_travel() {
    let machine = Machine { travel: Some(Travel::Size([400.0, 300.0, 80.0])), ..Machine::default() };
    let run_after = |head: &str, program: &str| {
        let text = format!("G21 G90 G54 {head}\nG0 Z5\nG0 X0 Y0\n{program}\nM30\n");
        let steps = interpret(text.as_bytes(), LinuxCnc, &Options::default()).steps;
        let rules = machine_rules(&machine, &steps);
        (rules.has_several_frames(), rules.finish().iter().map(fault_text).collect::<Vec<_>>())
    };
    let run = |program: &str| run_after("", program);
    assert_eq!(run("G55\nG0 X390\nG54\nG0 X-200"), (true, vec![]));
    assert_eq!(run("G55\nG0 X390\nG0 X-11"), (true, vec!["6 outside-machine".to_owned()]));
    assert_eq!(run("G0 X390\nG0 X-11"), (false, vec!["5 outside-machine".to_owned()]));
    // G10 sets both origins, so the moves are in the same coordinates.
    let stated = |program: &str| run_after("\nG10 L2 P1 X0 Y0 Z0\nG10 L2 P2 X350 Y0 Z0", program);
    assert_eq!(stated("G55\nG0 X50"), (false, vec![]));
    assert_eq!(stated("G55\nG0 X51"), (false, vec!["7 outside-machine".to_owned()]));
}

/// Only the length of a move by a distance from an unknown position is known.
#[test]
fn moves_from_unknown_positions_fit_into_the_travel() {
    let run = |travel: Travel, program: &str| {
        let machine = Machine { travel: Some(travel), ..Machine::default() };
        let text = format!("G17 G21 G90 G94 F100\n{program}\nM30\n");
        let steps = interpret(text.as_bytes(), LinuxCnc, &Options::default()).steps;
        let rules = machine_rules(&machine, &steps);
        (rules.has_unknown_axis(), rules.finish().iter().map(fault_text).collect::<Vec<_>>())
    };
    let size = |program: &str| run(Travel::Size([400.0, 300.0, 80.0]), program);
    let found = |line: u32| vec![format!("{line} outside-machine")];
    assert_eq!(size("G0 Z20\nG91\nG0 X10\nG90\nG0 X0 Y0"), (true, vec![]));
    assert_eq!(size("G0 Z20\nG0 X0 Y0\nG91\nG0 X10"), (false, vec![]));
    // The usual lift at the beginning, and after a move to a machine position.
    assert_eq!(size("G91 G0 Z5\nG90\nG0 X0 Y0\nG0 Z5"), (false, vec![]));
    assert_eq!(size("G53 G0 Z-10\nG0 X0 Y0\nG91 G0 Z5"), (false, vec![]));
    assert_eq!(size("G28\nG0 Z5\nG0 X0 Y0"), (false, vec![]));
    assert_eq!(size("G91 G0 Z-5\nG90\nG0 Z5\nG0 X0 Y0"), (true, vec![]), "down");
    assert_eq!(size("G91 G1 Z5\nG90\nG0 Z5\nG0 X0 Y0"), (true, vec![]), "not a rapid move");
    assert_eq!(size("G91 G0 X5 Z5\nG90\nG0 Z5\nG0 X0 Y0"), (true, vec![]), "not straight up");
    assert_eq!(size("G0 Z5\nG0 X0 Y0\nG53 G0 X-10\nG91\nG0 X5"), (true, vec![]));
    // Several moves, in one direction or the other.
    assert_eq!(size("G91\nG0 X250\nG0 X150\nG0 X-400\nG90 G0 X0"), (true, vec![]));
    assert_eq!(size("G91\nG0 X250\nG0 X151\nG90 G0 X0"), (true, found(4)));
    assert_eq!(size("G91\nG0 X250\nG0 X-401\nG90 G0 X0"), (true, found(4)));
    assert_eq!(size("G91\nG0 X250\nG90 G0 X0\nG53 G0 X-10\nG91 G0 X300"), (true, vec![]), "apart");
    assert_eq!(size("G91 G0 Z81"), (false, found(2)));
    let placed = |program: &str| run(Travel::Placed([(0.0, 400.0), (0.0, 300.0), (-80.0, 0.0)]), program);
    assert_eq!(placed("G91\nG0 X400"), (true, vec![]));
    assert_eq!(placed("G91\nG0 X401"), (true, found(3)));
}

#[test]
fn an_axis_without_ends_goes_anywhere() {
    let free = (f64::NEG_INFINITY, f64::INFINITY);
    let machine = Machine { travel: Some(Travel::Placed([free, (0.0, 10.0), free])), ..Machine::default() };
    let wrong = |program| wrong_on(&machine, program);
    assert_eq!(wrong("G0 Z1\nG0 X999999 Y10"), FINE);
    assert_eq!(wrong("G0 Z1\nG0 X999999 Y10.001"), ["3 outside-machine"]);
}

#[test]
fn speeds_are_the_spindles() {
    let machine = Machine { spindle: Some((1000.0, 24000.0)), ..Machine::default() };
    let wrong = |program| wrong_on(&machine, program);
    assert_eq!(wrong("M3 S1000\nS24000\nM5 S0"), FINE);
    assert_eq!(wrong("M3 S999\nS24001"), ["2 spindle-speed", "3 spindle-speed"]);
    assert_eq!(wrong("M3 S999\nM5"), ["2 spindle-speed"], "a spindle that stops has no speed");
}

#[test]
fn the_vendors_xpertmill_example_breaks_no_rule() {
    let example = "% //Programmstart\nG71\nG0 X-1.8 Y-1.8 Z0\nG1 Z-2.851 F500 S30000\nM6 5\nS20000\nG0X2 Z-5.25\nG1X8.5 Y2.5 Z-6 F1200\nM30\n";
    let steps = interpret(example.as_bytes(), Xpertmill, &Options::default()).steps;
    assert!(verify(&steps, None).is_empty());
}

#[test]
fn a_report_says_where_and_how_high() {
    let text = format!("G17 G21 G90 G94 F100\n{SLOT}\nG0 X10 Y1\nG0 Z10\nM30\n");
    let result = interpret(text.as_bytes(), Native, &Options::default());
    let mut problems = verify(&result.steps, Some(&Stock::uniform(5.0, 2.0)));
    quote(&mut problems, text.as_bytes());
    let [problem] = &problems[..] else { panic!("{}", spelled_out(&problems)) };
    assert!(
        problem
            .text(Lang::En)
            .starts_with("a rapid move at Z 1 goes through material that still reaches up to Z 5, near (")
    );
    assert_eq!(problem.text.as_ref().map(|fault| &*fault.text), Some("G0 X10 Y1"));
    assert!(problem.is_error());
}

fn recordings() -> Vec<PathBuf> {
    let conformance = pathbuild_testkit::project().join("fixtures/conformance");
    let entries = |dir: &Path| {
        let mut entries: Vec<PathBuf> = dir
            .read_dir()
            .map_or(Vec::new(), |entries| entries.flatten().map(|entry| entry.path()).collect());
        entries.sort();
        entries
    };
    let cases = ["cases", "turns"].into_iter().flat_map(|kind| entries(&conformance.join(kind)));
    let runs = cases.flat_map(|case| entries(&case.join("expected")));
    runs.flat_map(|run| entries(&run))
        .filter(|file| file.extension().is_some_and(|extension| extension == "gcode"))
        .collect()
}

/// Returns the problems that reading and `verify` find in a native program with this cutter diameter, and whether its material was known.
fn all_wrong(text: &[u8], cutter: f64) -> (Vec<Diagnostic>, bool) {
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let result = interpret(text, Native, &options);
    let stock = Stock::of_native_text(&result.steps, Cutter::flat(cutter));
    let mut problems = result.problems;
    problems.extend(verify(&result.steps, stock.as_ref()));
    (problems, stock.is_some())
}

/// Returns O of the drawings next to a recording; all drawings of a case have the same O.
#[expect(clippy::disallowed_methods, reason = "recordings are files of the project")]
fn cutter_of(recording: &Path) -> f64 {
    let case = recording.ancestors().nth(3).expect("CASE/expected/RUN/FILE");
    let drawings = case.read_dir().expect("a case").flatten().map(|entry| entry.path());
    let drawings = drawings
        .filter(|path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf")));
    let widest = drawings.flat_map(|path| {
        let text = String::from_utf8_lossy(&std::fs::read(path).expect("a drawing")).replace("\\P", " ");
        let values = text
            .split_whitespace()
            .filter_map(|word| word.strip_prefix('O')?.replace(',', ".").parse::<f64>().ok());
        values.collect::<Vec<_>>()
    });
    widest.fold(0.0, f64::max)
}

#[test]
fn no_recorded_program_has_an_error() {
    let mut checked_on_stock = 0;
    for file in recordings() {
        #[expect(clippy::disallowed_methods, reason = "recordings are files of the project")]
        let text = std::fs::read(&file).expect("a recording");
        let cutter = cutter_of(&file);
        assert!(cutter > 0.0, "{} has no O", file.display());
        let (problems, has_stock) = all_wrong(&text, cutter);
        assert!(!problems.iter().any(Diagnostic::is_error), "{}: {}", file.display(), spelled_out(&problems));
        checked_on_stock += u32::from(has_stock);
    }
    // The surface is unknown only for programs that mill nothing, or never plunge at feed after a rapid move down.
    assert!(checked_on_stock > 150, "{checked_on_stock}");
}

#[test]
fn no_fixture_has_anything_wrong() {
    for (name, text) in [
        ("adjusted", include_str!("programs/native/adjusted.gcode")),
        ("bars", include_str!("programs/native/bars.gcode")),
        ("clean", include_str!("programs/native/clean.gcode")),
        ("drill", include_str!("programs/native/drill.gcode")),
        ("helix", include_str!("programs/native/helix.gcode")),
        ("probing", include_str!("programs/native/probing.gcode")),
        ("sweepless", include_str!("programs/native/sweepless.gcode")),
    ] {
        let (problems, _) = all_wrong(text.as_bytes(), 2.0);
        assert!(problems.is_empty(), "{name}: {}", spelled_out(&problems));
    }
}

#[test]
fn a_hole_is_not_drilled_by_rapid_moves() {
    assert_eq!(behind_slot("G0 Z10\nG0 Y20\nG0 Z5\nG0 Z-3\nG0 Z10"), ["9 rapid-plunge"]);
    assert_eq!(behind_slot("G0 Z10\nG0 Y20\nG0 Z5\nG0 Z4.999\nG0 Z10"), FINE, "not below the surface");
}

#[test]
fn the_spindle_has_a_speed_while_cutting() {
    let with = |spindle: &str| wrong(&format!("{spindle}\nG0 X0 Y0 Z5\nG1 Z1\nX5\nG0 Z5\nM5"), None);
    assert_eq!(with("M3 S12000"), FINE);
    assert_eq!(with("S100 M3"), FINE);
    assert_eq!(with("M3 S0"), ["4 spindle-off"]);
    assert_eq!(with("M3"), ["4 spindle-off"]);
    assert_eq!(with("M3\nS1"), FINE);
    assert_eq!(with("M3 S5\nS0"), ["5 spindle-off"]);
}

#[test]
fn moves_above_the_material_need_no_spindle() {
    assert_eq!(on_stock("M3 S9\nG0 X0 Y0 Z9\nG1 Z4\nZ5\nM5\nX9\nZ9"), FINE);
    assert_eq!(on_stock("M3 S9\nG0 X0 Y0 Z9\nG1 Z4\nZ4.9\nM5\nX9\nZ9"), ["7 spindle-off"]);
}

#[test]
fn it_is_said_once_until_the_spindle_is_switched_again() {
    let cuts = "G1 Z1\nX5\nX6";
    assert_eq!(
        wrong(&format!("G0 X0 Y0 Z5\n{cuts}\nM5\n{cuts}\nM5\nM3 S0\n{cuts}\nM5"), None),
        ["3 spindle-off", "8 spindle-off", "13 spindle-off"]
    );
    let again = format!("M3 S5\nM5\nG0 X0 Y0 Z5\n{cuts}\nM5\n{cuts}");
    assert_eq!(wrong(&again, None), ["5 spindle-off"], "it was off before");
}

#[test]
fn the_machines_places_are_not_approached_from_depth() {
    assert_eq!(behind_slot("G28\nG0 Z10"), ["6 rapid-in-material"]);
    assert_eq!(behind_slot("G0 Z10\nG28"), FINE);
    assert_eq!(behind_slot("G53 G0 Z0\nG28"), FINE, "straight up first");
    assert_eq!(behind_slot("G53 G0 X0\nG0 Z10"), ["6 rapid-in-material"]);
}

#[test]
fn offsets_do_not_outlast_the_program() {
    let with = |program: &str| verify(&run(program).steps, None);
    let left =
        |program: &str| with(program).iter().map(|it| (fault_text(it), it.is_error())).collect::<Vec<_>>();
    assert_eq!(left("G92 X0 Y0 Z5\nG1 X5"), [("2 offset-left-on".to_owned(), false)]);
    assert_eq!(left("G0 X0 Y0 Z5\nG1 X5\nG92 X0"), [("4 offset-left-on".to_owned(), true)]);
    assert_eq!(left("G92 X0 Y0 Z5\nG1 X5\nG92.1"), []);
    assert_eq!(left("G92 X0 Y0 Z5\nG1 X5\nG92.2"), []);
    assert_eq!(left("G92 X0 Y0 Z5\nG92.2\nG92.3\nG1 X5"), [("4 offset-left-on".to_owned(), false)]);
}

#[test]
fn numbers_beyond_all_measure_take_no_time() {
    let text = "G21 G90 G17\nG0 X0 Y2000000000\nG1 F500 Z-1\nG3 X0 Y0 I0 J-1.5\nM30\n";
    let steps = interpret(text.as_bytes(), Native, &Options::default()).steps;
    let found = verify(&steps, Some(&Stock::uniform(5.0, 2.0)));
    assert!(found.iter().any(|it| it.code().name() == "limit-reached"), "{}", spelled_out(&found));
}

fn rapids_at_depth(steps: &[Step], stock: &Stock) -> Vec<String> {
    let mut rules = DepthRules::default();
    for step in steps {
        rules.step(step);
    }
    rules.finish(steps, stock).iter().map(fault_text).collect()
}

/// Returns the rapid moves at cutting depth, with a cutter of 6 mm and an unknown surface.
fn at_depth(program: &str) -> Vec<String> {
    let stock = Stock::with_unknown_surface(&[(0, Cutter::flat(6.0))]);
    rapids_at_depth(&run(program).steps, &stock)
}

#[test]
fn a_rapid_move_between_cuts_of_the_same_depth_is_doubtful() {
    let between =
        |z: &str| at_depth(&format!("G0 X0 Y0 Z5\nG1 Z-2 F100\nX20\nG0 Z{z}\nG0 Y20\nG1 Z-2\nX0\nG0 Z5\nX9"));
    assert_eq!(between("-2"), ["6 rapid-at-depth"]);
    assert_eq!(between("-1.99"), FINE);
    // The move is as deep as the following cut, but not as deep as the previous one.
    let next =
        |z: &str| at_depth(&format!("G0 X0 Y0 Z5\nG1 Z-4 F100\nX20\nG0 Z-2\nG0 Y20\nG1 Z{z}\nX0\nG0 Z5"));
    assert_eq!(next("-2.1"), FINE);
    assert_eq!(next("-2"), ["6 rapid-at-depth"]);
}

#[test]
fn a_rapid_move_where_the_program_has_cut_is_not_doubtful() {
    let back = |y: &str| at_depth(&format!("G0 X0 Y0 Z5\nG1 Z-2 F100\nX20\nG0 X0 Y{y}\nG0 Z5"));
    assert_eq!(back("0"), FINE);
    assert_eq!(back("3"), FINE);
    assert_eq!(back("4.5"), ["5 rapid-at-depth"]);
    // There is a cut at that position, but it is not as deep.
    let shallow = "G0 X0 Y0 Z5\nG1 Z-1 F100\nX20\nG1 Z-2\nG0 X0\nG0 Z5";
    assert_eq!(at_depth(shallow), ["6 rapid-at-depth"]);
}

#[test]
fn a_thin_cutter_leaves_no_rapid_move_at_depth_undoubted() {
    let at_depth = |diameter: f64, between: &str| {
        let stock = Stock::with_unknown_surface(&[(0, Cutter::flat(diameter))]);
        let program = format!("G0 X0 Y0 Z5\nG1 Z-0.1 F100\nX20\n{between}\nG1 Z-0.1\nX0\nG0 Z5");
        rapids_at_depth(&run(&program).steps, &stock)
    };
    for diameter in [0.01, 0.1, 3.0, 50.0] {
        assert_eq!(at_depth(diameter, "G0 Y60"), ["5 rapid-at-depth"], "{diameter}");
        assert_eq!(at_depth(diameter, "G0 Z1\nG0 Y60\nG0 Z0"), FINE, "{diameter}");
        assert_eq!(at_depth(diameter, "G0 X0\nG0 X20"), FINE, "{diameter}");
    }
}

#[test]
fn moves_in_the_air_have_no_cutting_depth() {
    // The program retracts and links at feed.
    assert_eq!(at_depth("G0 X0 Y0 Z5\nG1 Z-2 F100\nX20\nG1 Z5\nG1 X40\nG0 Y20\nG1 Z-2\nX0\nG1 Z5"), FINE);
    // The program is for a laser, or for a pen that is put down by rapid moves.
    assert_eq!(at_depth("G0 X0 Y0 Z0\nG1 X20 F100\nG0 Y20\nG1 X0\nG0 X9 Y9"), FINE);
    assert_eq!(at_depth("G0 X0 Y0 Z5\nG0 Z0\nG1 X20 F100\nG0 Z5\nG0 Y20\nG0 Z0\nG1 X0\nG0 Z5\nG0 X9"), FINE);
    // The program drills holes.
    assert_eq!(
        at_depth("G0 X0 Y0 Z5\nG1 Z-9 F100\nG0 Z5\nG0 X20\nG0 Z1\nG1 Z-4\nG0 Z0\nG0 Z-3\nG1 Z-9\nG0 Z5"),
        FINE
    );
}

#[test]
fn a_stop_as_deep_as_the_cut_before_it_is_doubtful() {
    let stop = |words: &str| at_depth(&format!("G0 X0 Y0 Z5\nG1 Z-2 F100\nX20\n{words}\nG0 Z5\nX9"));
    assert_eq!(stop("M0"), ["5 stop-at-depth"]);
    assert_eq!(stop("M0\nM1"), ["5 stop-at-depth"]);
    assert_eq!(stop("T2 M6"), ["5 tool-change-at-depth"]);
    assert_eq!(stop("G0 Z-1.99\nM0"), FINE);
    assert_eq!(stop("G53 G0 Z0\nM0"), FINE);
    // The program is for a laser.
    assert_eq!(at_depth("G0 X0 Y0 Z0\nG1 X20 F100\nM0\nG1 X0"), FINE);
}
