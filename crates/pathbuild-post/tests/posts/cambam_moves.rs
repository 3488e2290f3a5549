//! Tests moves through a CamBam definition: registers, arcs, cycles, start and end of cutting.

use pathbuild_diagnostic::Lang;
use pathbuild_motion::{Arc, Move, MoveShape, Pace, Plane, Turning};
use pathbuild_post::{Entry, Hole, HoleKind, Job, JobStep, PostOptions, Units};

use crate::support::{
    self, bare, errors, feed, job, lines, lines_with, operation, output, rapid, read, texts,
};

/// Returns the lines after the moves to (0, 0, 5).
#[track_caller]
fn moves(elements: &str, steps: Vec<JobStep>) -> Vec<String> {
    lines(&bare(elements), &job(steps)).split_off(2)
}

fn arc(from: [f64; 3], centre: [f64; 2], to: [f64; 3]) -> JobStep {
    support::arc(false, from, centre, to, Some(100.0))
}

fn quarter() -> JobStep {
    arc([10.0, 0.0, 5.0], [0.0, 0.0], [0.0, 10.0, 5.0])
}

#[test]
fn only_numbers_that_would_be_written_differently_are_written() {
    let steps = vec![feed(1.234, 0.0, 5.0), feed(1.233, 0.0, 5.0), feed(1.233, 1.0, 5.0)];
    assert_eq!(moves("<NumberFormat>0.0#</NumberFormat>", steps), ["G1 F100.0 X1.23", "G1 Y1.0"]);
}

#[test]
fn a_move_that_comes_to_nothing_but_its_word_is_not_written() {
    assert_eq!(moves("", vec![rapid(0.0, 0.0, 5.0), rapid(0.0, 0.0, 4.0)]), ["G0 Z4.0"]);
    let flat = "<Rapid>G00 {$_x} {$_y}</Rapid>";
    assert_eq!(
        lines(&bare(flat), &job(vec![rapid(0.0, 0.0, 4.0), rapid(1.0, 0.0, 4.0)])),
        ["G00 X0.0 Y0.0", "G00 X1.0"]
    );
}

#[test]
fn codes_are_modal_where_the_template_says_so() {
    let modal = "<FeedMove>{$_g1} {$_x}</FeedMove>";
    let steps = vec![feed(1.0, 0.0, 5.0), feed(2.0, 0.0, 5.0), rapid(3.0, 0.0, 5.0), feed(4.0, 0.0, 5.0)];
    assert_eq!(moves(modal, steps.clone()), ["G1 X1.0", "X2.0", "G0 X3.0", "G1 X4.0"]);
    let named = format!("{modal}<G1>FEED</G1><SuppressParserErrors>true</SuppressParserErrors>");
    assert_eq!(
        moves(&named, steps.clone()),
        ["FEED X1.0", "X2.0", "G0 X3.0", "FEED X4.0"],
        "however the word is spelt"
    );
    // The text that is read back contains G words in place of the definition's own words.
    let whole = named.replace("{$_x}", "{$f} {$_x}");
    let written = read(&bare(&whole)).unwrap().write(&job(steps), &PostOptions::default());
    assert!(written.is_ok(), "{:?}", written.map_err(|errors| texts(&errors)));
}

#[test]
fn registers_have_other_signs_on_demand() {
    let signs = "<FeedMove>{$g1} {$x} {$-x} {$+x} {$move.x}</FeedMove><SuppressParserErrors>true</SuppressParserErrors>";
    assert_eq!(moves(signs, vec![feed(-1.5, 0.0, 5.0)]), ["G1 X-1.5 X1.5 X1.5 -1.5"]);
}

/// A reversed axis is reversed in every line, even where a move does not state it, after a tool change and at the clearance height.
#[test]
fn a_reversed_axis_has_one_sign() {
    let round = |axis: &str| {
        let register =
            |name: &str| if name == axis { format!("{{$-{name}}}") } else { format!("{{$_{name}}}") };
        let all = ["x", "y", "z"].map(register).join(" ");
        bare(&format!(
            "<Rapid>{{$g0}} {all}</Rapid><FeedMove>{{$g1}} {{$f}} {all}</FeedMove><MOP>{{$toolchange}}\n{{$blocks}}\n{{$clearance}}</MOP>"
        ))
        .replacen("<MOP>{$blocks}</MOP>", "", 1)
    };
    let steps = |x: f64| {
        let way = |z| JobStep::rapid([None, None, Some(z)]);
        let across = JobStep::rapid([Some(x), Some(3.0), None]);
        vec![across, way(2.0), feed(x, 3.0, -1.0), feed(x + 10.0, 4.0, -1.0), way(5.0)]
    };
    let operations = vec![operation("a", 1, steps(10.0)), operation("b", 2, steps(40.0))];
    let job = Job { operations, ..job(vec![]) };
    for (axis, sign) in [("x", "X-"), ("y", "Y-"), ("z", "Z")] {
        let options = PostOptions::default();
        let written = read(&round(axis)).unwrap().write(&job, &options);
        let output = written.unwrap_or_else(|it| panic!("{axis}: {:?}", texts(&it)));
        let reversed = format!("PB752 the post writes {} with the opposite sign", axis.to_uppercase());
        assert!(texts(&output.warnings).iter().any(|text| text.starts_with(&reversed)), "{axis}");
        let text = String::from_utf8(output.text).unwrap();
        let letter = &sign[..1];
        let words: Vec<&str> = text.split_whitespace().filter(|word| word.starts_with(letter)).collect();
        let wrong = |word: &&&str| match axis {
            "z" => word.starts_with("Z-") == word.ends_with("1.0"),
            _ => !word.starts_with(sign) && !word.ends_with("0.0"),
        };
        assert!(words.len() > 8 && !words.iter().any(|word| wrong(&word)), "{axis}: {text}");
    }
    let mixed = bare("<Rapid>{$g0} {$_x} {$_y} {$-z}</Rapid>");
    assert!(read(&mixed).unwrap().write(&job, &PostOptions::default()).is_err(), "to both sides of 0");
}

/// A hole without its moves is found at the line of the cycle, not at the rapid moves to it.
#[test]
fn a_wrong_cycle_is_named() {
    let hole = Hole {
        at: [3.0, 4.0],
        level: 5.0,
        retract: 1.0,
        exit: 5.0,
        bottom: -2.0,
        feed: Some(60.0),
        kind: HoleKind::Peck { depth: 1.0 },
    };
    let options = PostOptions { cycles: true, ..PostOptions::default() };
    let named = |peck: &str, dialect: &str| {
        let text = format!(
            "<PostFile>{{$units}} G90 G17 G94\n{{$mops}}\nM30</PostFile><MOP>{{$blocks}}</MOP>
            <CannedCycleStart>G98</CannedCycleStart><CannedCycleEnd>G80</CannedCycleEnd>
            <DrillPeck>{peck}</DrillPeck>{dialect}"
        );
        let found =
            read(&support::definition(&text)).unwrap().write(&job(vec![JobStep::Hole(hole)]), &options);
        let errors = found.err().unwrap_or_default();
        errors
            .first()
            .map(|error| error.notes.iter().map(|note| note.text(Lang::En)).collect::<Vec<_>>().join("; "))
    };
    for dialect in ["", "<Dialect>mach3</Dialect>"] {
        assert_eq!(named("{$g83} {$x} {$y} {$z} {$q} {$r} {$f}", dialect), None);
        for peck in ["{$g83} {$x} {$y} {$z} {$q} R9 {$f}", "{$g83} {$x} {$y} {$z} {$r} {$f}"] {
            let notes = named(peck, dialect).unwrap();
            assert!(notes.contains("comes from DrillPeck"), "{peck} {dialect}: {notes}");
        }
    }
}

/// Feeds have one sign on every machine, and the centres of arcs that of their axis.
#[test]
fn only_axes_may_be_reversed() {
    let [from, to] = [[0.0, 0.0, -1.0], [4.0, 0.0, -1.0]];
    let steps = vec![
        feed(0.0, 0.0, -1.0),
        support::arc(true, from, [2.0, 0.0], to, Some(100.0)),
        rapid(4.0, 0.0, 5.0),
    ];
    let written = |x: &str, i: &str, f: &str, dialect: &str| {
        let arc = |code: &str| format!("{{${code}}} {{${x}}} {{$y}} {{$z}} {{${i}}} {{$j}} {{${f}}}");
        let [cw, ccw] = if x == "-x" { ["g3", "g2"] } else { ["g2", "g3"] }.map(arc);
        let text = format!(
            "<PostFile>G21 G90 G17 G94\nG91.1\n{{$mops}}\nM30</PostFile><MOP>{{$blocks}}</MOP>{dialect}
            <Rapid>{{$g0}} {{${x}}} {{$y}} {{$z}}</Rapid><FeedMove>{{$g1}} {{${x}}} {{$y}} {{$z}} {{${f}}}</FeedMove>
            <ArcCW>{cw}</ArcCW><ArcCCW>{ccw}</ArcCCW>"
        );
        read(&support::definition(&text)).unwrap().write(&job(steps.clone()), &PostOptions::default())
    };
    for dialect in ["", "<Dialect>linuxcnc</Dialect>"] {
        for (x, i, f, is_right) in [
            ("x", "i", "f", true),
            ("-x", "-i", "f", true),
            ("x", "-i", "f", false),
            ("-x", "i", "f", false),
            ("x", "i", "-f", false),
        ] {
            let found = written(x, i, f, dialect);
            assert_eq!(found.is_ok(), is_right, "{x} {i} {f} {dialect}: {:?}", found.err());
        }
    }
}

#[test]
fn axes_that_are_not_known_are_not_written() {
    let mut job = job(vec![JobStep::rapid([None, None, Some(2.0)])]);
    job.operations[0].entry = Entry::Clearance;
    assert_eq!(lines(&bare("<Rapid>{$g0} {$x} {$y} {$z}</Rapid>"), &job), ["G0 Z5.0", "G0 Z2.0"]);
}

#[test]
fn an_operation_that_begins_in_the_material_is_not_lifted() {
    let mut second = operation("b", 1, vec![feed(1.0, 0.0, -1.0)]);
    second.entry = Entry::At([0.0, 0.0, -1.0]);
    let operations = vec![operation("a", 1, vec![feed(0.0, 0.0, -1.0)]), second];
    let job = Job { operations, ..job(vec![]) };
    assert_eq!(lines(&bare(""), &job)[2..], ["G1 F100.0 Z-1.0", "G1 X1.0"]);
    let away = bare("<MOP>{$blocks}\nG0 Z9 X9</MOP>").replace("<MOP>{$blocks}</MOP>", "");
    let expected = ["G0 Z9 X9", "G0 Z5.0", "G0 X0.0", "G1 Z-1.0", "G1 X1.0", "G0 Z9 X9"];
    assert_eq!(lines(&away, &job)[3..], expected, "unless the post moved it");
}

#[test]
fn arcs_have_incremental_centres_unless_absolute_ones_are_asked_for() {
    let steps = vec![feed(10.0, 0.0, 5.0), quarter()];
    assert_eq!(moves("", steps.clone())[1], "G3 X0.0 Y10.0 I-10.0 J0.0");
    assert_eq!(moves("<ArcCenterMode>Absolute</ArcCenterMode>", steps)[1], "G3 X0.0 Y10.0 I0.0 J0.0");
}

#[test]
fn arc_macros_give_radius_and_angles() {
    let elements = "<ArcCCW>(r{$arc.radius} {$arc.start} {$arc.end} {$arc.sweep} {$arc.i} {$arc.j})</ArcCCW>\
                    <ArcCW>({$arc.sweep} {$arc.i})</ArcCW>";
    let back = support::arc(true, [0.0, 10.0, 5.0], [0.0, 0.0], [10.0, 0.0, 5.0], Some(100.0));
    let steps = vec![feed(10.0, 0.0, 5.0), quarter(), back];
    assert_eq!(moves(elements, steps)[1..], ["(r10.0 0.0 90.0 -90.0 -10.0 0.0)", "(90.0 0.0)"]);
}

#[test]
fn arcs_written_by_radius_are_cut_below_half_a_turn() {
    let elements = "<ArcCCW>{$g3} {$_x} {$_y} R{$arc.radius}</ArcCCW>";
    let circle = arc([10.0, 0.0, 5.0], [0.0, 0.0], [10.0, 0.0, 5.0]);
    let expected = ["G3 X-5.0 Y8.6603 R10.0", "G3 Y-8.6603 R10.0", "G3 X10.0 Y0.0 R10.0"];
    assert_eq!(moves(elements, vec![feed(10.0, 0.0, 5.0), circle])[1..], expected);
    assert_eq!(moves(elements, vec![feed(10.0, 0.0, 5.0), quarter()])[1..], ["G3 X0.0 Y10.0 R10.0"]);
    // If the line also contains a centre, the direction is unambiguous.
    let both = elements.replace("R{$arc.radius}", "(R{$arc.radius}) {$i} {$j}");
    let whole = arc([10.0, 0.0, 5.0], [0.0, 0.0], [0.0, -10.0, 5.0]);
    assert_eq!(moves(&both, vec![feed(10.0, 0.0, 5.0), whole])[1..], ["G3 X0.0 Y-10.0 (R10.0) I-10.0 J0.0"]);
}

#[test]
fn arcs_become_lines_within_the_tolerance() {
    let count = |tolerance: &str, units: Units| {
        let elements = format!(
            "<ArcOutput>Convert To Lines</ArcOutput><ArcToLinesTolerance>{tolerance}</ArcToLinesTolerance>"
        );
        let job = Job { units, ..job(vec![feed(10.0, 0.0, 5.0), quarter()]) };
        let written = lines(&bare(&elements), &job);
        written.iter().filter(|line| line.starts_with("G1")).count() - 1
    };
    assert_eq!([count("0.04", Units::default()), count("0.05", Units::default())], [9, 8]);
    assert_eq!(count("5", Units::default()), 8, "never further than 0.05 mm");
    assert_eq!(count("0.01", Units::Inches), 8, "a tolerance of 0.254 mm");
    let fine = bare(
        "<ArcOutput>Convert To Lines</ArcOutput><ArcToLinesTolerance>0.000000000001</ArcToLinesTolerance>",
    );
    assert_eq!(
        errors(&fine, &job(vec![quarter()])),
        ["PB753 an arc of radius 10 requires more than 100000 lines (raise the post's tolerance for arcs)"]
    );
}

#[test]
fn short_arcs_and_flat_arcs_become_lines() {
    let steps = vec![feed(10.0, 0.0, 5.0), quarter()];
    assert_eq!(moves("<MinimumArcLength>15.71</MinimumArcLength>", steps.clone())[1], "G1 X0.0 Y10.0");
    assert_eq!(
        moves("<MinimumArcLength>15.70</MinimumArcLength>", steps.clone())[1],
        "G3 X0.0 Y10.0 I-10.0 J0.0"
    );
    assert_eq!(moves("<MaximumArcRadius>9.9</MaximumArcRadius>", steps.clone())[1], "G1 X0.0 Y10.0");
    assert_eq!(
        moves("<MaximumArcRadius>10</MaximumArcRadius>", steps.clone())[1],
        "G3 X0.0 Y10.0 I-10.0 J0.0"
    );
    let flat = output(&bare("<MaximumArcRadius>9</MaximumArcRadius>"), &job(steps), &PostOptions::default())
        .unwrap();
    assert_eq!(texts(&flat.warnings).len(), 1);
    assert!(texts(&flat.warnings)[0].starts_with(
        "PB757 the arc to (0, 10) has the radius 10; the post writes a line that deviates from it by up to 2.929 mm"
    ));
}

#[test]
fn an_arc_whose_ends_are_written_alike_is_no_full_circle() {
    let tiny = arc([10.0, 0.0, 5.0], [0.0, 0.0], [10.0, 0.004, 5.0]);
    let two_decimals = "<NumberFormat>0.0#</NumberFormat>";
    assert_eq!(moves(two_decimals, vec![feed(10.0, 0.0, 5.0), tiny]), ["G1 F100.0 X10.0"]);
    let circle = arc([10.0, 0.0, 5.0], [0.0, 0.0], [10.0, 0.0, 5.0]);
    assert_eq!(moves(two_decimals, vec![feed(10.0, 0.0, 5.0), circle])[1], "G3 I-10.0 J0.0");
}

#[test]
fn an_arc_whose_rounded_numbers_are_no_circle_is_an_error() {
    let (sin, cos) = libm::sincos(1.0);
    let steps = vec![feed(10.0, 0.0, 5.0), arc([10.0, 0.0, 5.0], [0.0, 0.0], [10.0 * cos, 10.0 * sin, 5.0])];
    let coarse = bare("<NumberFormat>0.0</NumberFormat>");
    let expected = "PB756 in the output, the arc to (5.403, 8.415) has the radius 10.0000 at its start and 9.9860 at its end (give the post's number format more decimals)";
    assert_eq!(errors(&coarse, &job(steps.clone())), [expected]);
    assert_eq!(moves("<NumberFormat>0.0##</NumberFormat>", steps)[1], "G3 X5.403 Y8.415 I-10.0 J0.0");
}

#[test]
fn the_tolerance_of_rounded_arcs_is_two_micrometres() {
    let written = |to: f64| {
        let arc = arc([10.0, 0.0, 5.0], [0.0, 0.0], [0.0, to, 5.0]);
        output(&bare(""), &job(vec![feed(10.0, 0.0, 5.0), arc]), &PostOptions::default())
    };
    assert!(written(10.0019).is_ok());
    assert!(written(10.0021).is_err());
    let inches = |to: f64| {
        let arc = arc([254.0, 0.0, 5.0], [0.0, 0.0], [0.0, to * 25.4, 5.0]);
        let job = Job { units: Units::Inches, ..job(vec![feed(254.0, 0.0, 5.0), arc]) };
        output(&bare("<NumberFormat>0.0#####</NumberFormat>"), &job, &PostOptions::default())
    };
    assert!(inches(10.00019).is_ok());
    assert!(inches(10.00021).is_err());
}

#[test]
fn moves_that_are_missing_at_the_end_are_named() {
    let post = read(&bare("<FeedMove>{$_f}</FeedMove>")).unwrap();
    let options = PostOptions { manual_spindle: true, ..PostOptions::default() };
    let steps = vec![feed(10.0, 0.0, 5.0), feed(10.0, 9.0, 5.0)];
    let errors = texts(&post.write(&job(steps), &options).unwrap_err());
    assert!(errors[0].starts_with("PB767 the output ends before all moves of the program"), "{errors:?}");
}

/// If start, end and centre of this arc are rounded separately, its radii differ by 0.00218 mm.
#[test]
fn an_arc_that_rounding_spoils_is_written_with_the_centre_beside() {
    let [from, to] = [[17.795_258, -5.848_452, 5.0], [33.620_06, -27.932_546, 5.0]];
    let spoiled = arc(from, [26.566_68, -16.274_95], to);
    let three_decimals = "<NumberFormat>0.0##</NumberFormat>";
    let written = moves(three_decimals, vec![feed(from[0], from[1], 5.0), spoiled]);
    assert_eq!(written[1], "G3 X33.62 Y-27.933 I8.771 J-10.427");
}

#[test]
fn arcs_of_other_planes_have_their_own_offsets() {
    let circle = Arc { plane: Plane::Zx, centre: [5.0, 5.0], clockwise: true, extra_turns: 0 };
    let turn = Move {
        from: [0.0, 0.0, 5.0].into(),
        to: [5.0, 0.0, 10.0].into(),
        shape: MoveShape::Arc(circle),
        pace: Pace::Feed(0.0),
        named: None,
    };
    let mut job = job(vec![JobStep::Move(turn)]);
    job.operations[0].plane = Plane::Zx;
    assert_eq!(lines(&bare(""), &job)[2], "G2 X5.0 Z10.0 I5.0 K0.0");
    assert_eq!(lines(&bare("<InvertArcs>true</InvertArcs>"), &job)[2], "G3 X5.0 Z10.0 I5.0 K0.0");
    job.operations[0].plane = Plane::Xy;
    job.operations[0].steps = vec![quarter()];
    assert!(lines(&bare("<InvertArcs>true</InvertArcs>"), &job)[2].starts_with("G3"), "only in the XZ plane");
}

#[test]
fn the_texts_of_cutting_stand_round_the_moves_through_the_surface() {
    let elements = "<StartCut>M3</StartCut><EndCut>M5</EndCut>";
    let steps = vec![
        rapid(0.0, 0.0, 0.0),
        feed(0.0, 0.0, -1.0),
        feed(1.0, 0.0, -1.0),
        rapid(1.0, 0.0, 0.0),
        rapid(1.0, 0.0, 5.0),
    ];
    let expected = ["G0 Z0.0", "M3", "G1 F100.0 Z-1.0", "G1 X1.0", "G0 Z0.0", "M5", "G0 Z5.0"];
    assert_eq!(moves(elements, steps), expected);
}

#[test]
fn a_beam_without_z_is_switched_all_the_same() {
    let elements = "<StartCut>M3</StartCut><EndCut>M5</EndCut><Rapid>{$g0} {$_x} {$_y}</Rapid><FeedMove>{$g1} {$_f} {$_x} {$_y}</FeedMove>";
    let steps = vec![feed(0.0, 0.0, -1.0), feed(1.0, 0.0, -1.0), rapid(1.0, 0.0, 5.0)];
    let expected = ["G0 X0.0 Y0.0", "M3", "G1 F100.0", "G1 X1.0", "M5"];
    assert_eq!(lines(&bare(elements), &job(steps)), expected);
}

#[test]
fn clearance_goes_down_by_feed_on_demand() {
    let mut job = job(vec![]);
    job.operations[0].entry = Entry::Clearance;
    job.operations[0].plunge_feed = Some(60.0);
    let slow = bare("<MOP>G0 Z9\n{$blocks}</MOP><RapidDownToClearance>false</RapidDownToClearance>")
        .replace("<MOP>{$blocks}</MOP>", "");
    assert_eq!(lines(&slow, &job), ["G0 Z9", "G1 F60.0 Z5.0"]);
    assert_eq!(lines(&slow.replace("Z9", "Z1"), &job), ["G0 Z1", "G0 Z5.0"], "up it is a rapid");
}

#[test]
fn paths_are_wrapped_round_a_cylinder() {
    let elements = "<RotaryWrap>true</RotaryWrap><AxisOfRotation>X</AxisOfRotation><RotaryAxis>A</RotaryAxis>\
                    <FeedMove>{$g1} {$_x} {$_z} {$_a}</FeedMove>";
    let mut job = job(vec![feed(3.0, 10.0 * std::f64::consts::PI, -1.0)]);
    job.operations[0].surface = 10.0;
    assert_eq!(lines(&bare(elements), &job)[2], "G1 X3.0 Z-1.0 A180.0");
}

#[test]
fn an_angle_stands_in_place_of_the_axis_across() {
    let turn = 20.0 * std::f64::consts::PI;
    let wrapped = |elements: &str, width: f64, cycles: bool| {
        let hole = Hole {
            at: [3.0, width],
            level: 15.0,
            retract: 11.0,
            exit: 15.0,
            bottom: 8.0,
            feed: Some(60.0),
            kind: HoleKind::Plain,
        };
        let mut job =
            job(vec![rapid(3.0, 0.0, 15.0), feed(3.0, 0.0, 9.0), rapid(3.0, 0.0, 15.0), JobStep::Hole(hole)]);
        (job.operations[0].surface, job.operations[0].clearance) = (10.0, 15.0);
        job.operations[0].entry = Entry::Clearance;
        let options = PostOptions { cycles, ..PostOptions::default() };
        let text = bare(&format!("<RotaryWrap>true</RotaryWrap>{elements}"));
        read(&text.replace("<PostFile>", "<PostFile>G21 G90\n")).unwrap().write(&job, &options)
    };
    let text = |output: pathbuild_post::Output| String::from_utf8(output.text).unwrap();
    let is_only_about_feeds = |output: &pathbuild_post::Output| {
        let found = texts(&output.warnings);
        found.len() == 1 && found[0].contains("PB752 F is the speed along the surface")
    };
    for cycles in [false, true] {
        let output = wrapped("", turn / 2.0, cycles).unwrap_or_else(|errors| panic!("{:?}", texts(&errors)));
        assert!(is_only_about_feeds(&output), "{:?}", texts(&output.warnings));
        let text = text(output);
        assert!(text.contains("A180.0") && !text.contains('Y') && !text.contains("G81"), "{text}");
    }
    // The rotary axis turns around Y, with the spelling of the manual.
    let round_y = wrapped("<AxisOfSpin>Y</AxisOfSpin><RotaryAxis>B</RotaryAxis>", turn, false).unwrap();
    assert!(is_only_about_feeds(&round_y), "{:?}", texts(&round_y.warnings));
    assert!(!text(round_y).contains('X'));
    for (elements, expected) in [
        ("<FeedMove>{$g1} {$_x} Y0 {$_z} {$_a}</FeedMove>", "replaces Y"),
        ("<Rapid>{$g0} {$_x} {$_z} A0</Rapid>", "PB767"),
        ("<Rapid>{$g0} {$_x} {$_z}</Rapid>", "PB767"),
    ] {
        let errors = texts(&wrapped(elements, turn / 2.0, false).expect_err(elements));
        assert!(errors[0].contains("PB767") && errors[0].contains(expected), "{elements}: {errors:?}");
    }
    for (width, is_wide) in [(turn, false), (turn * 1.001, true)] {
        let output = wrapped("", width, false).unwrap();
        assert_eq!(!is_only_about_feeds(&output), is_wide, "{width}: {:?}", texts(&output.warnings));
    }
}

#[test]
fn dwells_and_probes_have_sections_of_their_own() {
    let steps = vec![JobStep::Dwell { seconds: 1.5 }, JobStep::probe([0.0, 0.0, -5.0], Some(40.0))];
    assert_eq!(moves("", steps.clone()), ["G4 P1.5", "G38.2 F40.0 X0.0 Y0.0 Z-5.0"]);
    assert_eq!(moves("<Dwell>G4 S{$move.p}</Dwell>", steps)[0], "G4 S1.5");
}

fn hole(x: f64, kind: HoleKind) -> Hole {
    Hole { at: [x, 0.0], level: 5.0, retract: 1.0, bottom: -3.0, exit: 5.0, feed: Some(60.0), kind }
}

#[track_caller]
fn cycles(elements: &str, holes: Vec<Hole>) -> Vec<String> {
    let steps = holes.into_iter().map(JobStep::Hole).collect();
    lines_with(&bare(elements), &job(steps), &PostOptions { cycles: true, ..PostOptions::default() })
        .split_off(2)
}

#[test]
fn holes_become_cycles_in_one_group() {
    let holes = vec![hole(0.0, HoleKind::Plain), hole(8.0, HoleKind::Plain)];
    let expected = ["G98", "G81 X0.0 Y0.0 Z-3.0 R1.0 F60.0", "G81 X8.0 Z-3.0", "G80", "G0 Z5.0"];
    assert_eq!(cycles("", holes), expected, "Z is at R after each hole, so it is written every time");
}

#[test]
fn pecks_and_dwells_have_their_own_cycles() {
    let holes = vec![hole(0.0, HoleKind::Peck { depth: 1.5 }), hole(8.0, HoleKind::Dwell { seconds: 2.0 })];
    let expected = [
        "G98",
        "G83 X0.0 Y0.0 Z-3.0 Q1.5 R1.0 F60.0",
        "G80",
        "G0 Z5.0",
        "G0 X8.0",
        "G98",
        "G82 X8.0 Y0.0 Z-3.0 P2.0 R1.0",
        "G80",
        "G0 Z5.0",
    ];
    assert_eq!(cycles("", holes), expected, "each in a group of its own");
}

#[test]
fn cycles_may_be_modal() {
    let modal = "<Drill>{$_g81} {$_x} {$_y} {$_z} {$_r} {$_f}</Drill>";
    let holes = vec![hole(0.0, HoleKind::Plain), hole(8.0, HoleKind::Plain)];
    assert_eq!(cycles(modal, holes)[1..3], ["G81 X0.0 Y0.0 Z-3.0 R1.0 F60.0", "X8.0 Z-3.0"]);
}

#[test]
fn a_hole_that_ends_lower_than_it_began_is_no_cycle() {
    let low = Hole { exit: 2.0, ..hole(8.0, HoleKind::Plain) };
    assert_eq!(cycles("", vec![low]), ["G0 X8.0", "G0 Z1.0", "G1 F60.0 Z-3.0", "G0 Z2.0"]);
}

#[test]
fn a_cycle_states_what_the_control_forgot_at_the_end_of_the_last_one() {
    let peck = |x: f64| JobStep::Hole(hole(x, HoleKind::Peck { depth: 1.5 }));
    let steps = vec![peck(0.0), rapid(20.0, 0.0, 5.0), peck(30.0)];
    let lines = lines_with(&bare(""), &job(steps), &PostOptions { cycles: true, ..PostOptions::default() });
    let cycles: Vec<&String> = lines.iter().filter(|line| line.starts_with("G83")).collect();
    assert_eq!(cycles, ["G83 X0.0 Y0.0 Z-3.0 Q1.5 R1.0 F60.0", "G83 X30.0 Y0.0 Z-3.0 Q1.5 R1.0"]);
}

#[test]
fn holes_are_moves_where_cycles_are_not_asked_for() {
    let steps = vec![JobStep::Hole(hole(8.0, HoleKind::Peck { depth: 3.0 }))];
    let expected = ["G0 X8.0", "G0 Z1.0", "G1 F60.0 Z-2.0", "G0 Z1.0", "G0 Z-1.746", "G1 Z-3.0", "G0 Z5.0"];
    assert_eq!(moves("", steps), expected);
}

#[test]
fn a_template_of_moves_stands_for_a_cycle() {
    let elements = "<G81/><CannedCycleStart/><CannedCycleEnd/><Drill>
        {$g0} {$_x} {$_y}
        {$g0} Z{$mop.retractheight}
        {$g1} {$_z} {$_f}
        {$g0} Z{$mop.clearanceplane}
        </Drill>";
    let expected =
        ["G0 X0.0 Y0.0", "G0 Z1.0", "G1 Z-3.0 F60.0", "G0 Z5.0", "G0 X8.0", "G0 Z1.0", "G1 Z-3.0", "G0 Z5.0"];
    assert_eq!(cycles(elements, vec![hole(0.0, HoleKind::Plain), hole(8.0, HoleKind::Plain)]), expected);
}

#[test]
fn a_hole_that_would_not_be_drilled_is_an_error() {
    let drilled = |elements: &str| {
        let job = job(vec![JobStep::Hole(hole(8.0, HoleKind::Peck { depth: 1.0 }))]);
        output(&bare(elements), &job, &PostOptions { cycles: true, ..PostOptions::default() })
    };
    let expected = |section: &str| {
        vec![format!(
            "PB755 the post writes nothing that drills the hole at (8, 0): {section} is empty \
             (write the hole as moves (cycles = false), or give the post a text for it)"
        )]
    };
    assert_eq!(texts(&drilled("<G83/>").unwrap_err()), expected("G83"));
    assert_eq!(texts(&drilled("<DrillPeck/>").unwrap_err()), expected("DrillPeck"));
    assert!(drilled("<G81/>").is_ok(), "another cycle's word");
    assert!(drilled("<G83/><DrillPeck>G1 {$z}\nG0 Z{$mop.clearanceplane}</DrillPeck>").is_ok());
}

/// A laser does not move in Z, so the cuts of its beam are compared as seen from above.
#[test]
fn a_beam_without_z_is_read_back_from_above() {
    let mut job = job(vec![
        rapid(1.0, 0.0, 5.0),
        feed(1.0, 0.0, -1.0),
        feed(9.0, 0.0, -1.0),
        rapid(9.0, 0.0, 5.0),
        rapid(1.0, 4.0, 5.0),
        feed(1.0, 4.0, -1.0),
        feed(9.0, 4.0, -2.0),
        rapid(9.0, 4.0, 5.0),
    ]);
    job.operations[0].spindle = Some(Turning::Clockwise);
    job.operations[0].speed = Some(1000.0);
    let written = |change: [&str; 2], dialect: Option<&str>| {
        let elements = "<Header>G21 G90</Header><ToolChange/><MOP>{$blocks}</MOP><Rapid>{$g0} {$_x} {$_y}</Rapid>\
            <FeedMove>{$g1} {$_f} {$_x} {$_y}</FeedMove><ArcCW>{$g2} {$_x} {$_y} {$i} {$j}</ArcCW>\
            <ArcCCW>{$g3} {$_x} {$_y} {$i} {$j}</ArcCCW><StartCut>M3 {$s}</StartCut><EndCut>M5</EndCut>\
            <Footer>M5\nM30</Footer>";
        let text = support::definition(&elements.replace(change[0], change[1]));
        let options = PostOptions { dialect: dialect.map(Into::into), ..PostOptions::default() };
        read(&text).unwrap().write(&job, &options).map_err(|errors| texts(&errors))
    };
    for dialect in [None, Some("grbl"), Some("linuxcnc")] {
        assert!(written(["_", "_"], dialect).is_ok(), "{dialect:?} {:?}", written(["_", "_"], dialect));
    }
    for change in [
        ["<EndCut>M5", "<EndCut>(on)"],
        ["<StartCut>M3 {$s}", "<StartCut>(off)"],
        ["{$_f} {$_x}", "{$_f} X0"],
    ] {
        assert!(written(change, None).is_err(), "{change:?}");
    }
}
