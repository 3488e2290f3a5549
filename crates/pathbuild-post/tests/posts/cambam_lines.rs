//! Tests how CamBam templates become lines, and how each line affects the next.

use pathbuild_diagnostic::Lang;
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::{Hole, HoleKind, Job, JobStep, PostMacro, PostOptions, Units, VelocityMode};

use crate::support::{bare, definition, feed, job, lines, lines_with, operation, output, rapid, read, texts};

#[test]
fn lines_are_trimmed_and_blank_ones_dropped() {
    let text = definition("<PostFile>\n\n   M0 \t  M1  \n{$cbfile.header}\n \t\n{$mop.tag}\nM2</PostFile>");
    assert_eq!(lines(&text, &job(vec![])), ["M0 M1", "M2"]);
}

#[test]
fn a_macro_of_several_lines_becomes_several_lines() {
    let text = definition("<PostFile>{$spindle} {$s}</PostFile><SpindleCW>\n M8\n M3\n</SpindleCW>");
    let mut job = job(vec![]);
    job.operations[0].spindle = Some(Turning::Clockwise);
    job.operations[0].speed = Some(1000.4);
    assert_eq!(lines(&text, &job), ["M8", "M3", "S1000"]);
}

#[test]
fn lines_end_with_carriage_return_unless_the_definition_says_otherwise() {
    let ends = |element: &str| {
        let text = definition(&format!("<PostFile>M0\nM1</PostFile>{element}"));
        String::from_utf8(output(&text, &job(vec![]), &PostOptions::default()).unwrap().text).unwrap()
    };
    assert_eq!(ends(""), "M0\r\nM1\r\n");
    assert_eq!(ends("<EndOfLine>\\n</EndOfLine>"), "M0\nM1\n");
}

#[test]
fn upper_case_is_for_everything() {
    let text = definition("<PostFile>( part ) m5</PostFile><UpperCase>true</UpperCase>");
    assert_eq!(lines(&text, &job(vec![])), ["( PART ) M5"]);
}

#[test]
fn lines_are_numbered_but_for_those_that_are_skipped() {
    let numbers = "<AddLineNumbers>true</AddLineNumbers><LineNumberStart>10</LineNumberStart><LineNumberIncrement>5</LineNumberIncrement>";
    let file = "<PostFile>%\nO1\n(a)\n:1\n;b\nM0\n\nM1</PostFile>";
    assert_eq!(
        lines(&definition(&format!("{file}{numbers}")), &job(vec![])),
        ["%", "O1", "(a)", ":1", ";b", "N10 M0", "N15 M1"]
    );
    let more = "<LineNumberFormat>0000</LineNumberFormat><LineNumberPrefix>:</LineNumberPrefix>\
                <LineNumberSpaceAfter>false</LineNumberSpaceAfter><LineNumberSkip>M</LineNumberSkip>";
    let expected = [":0010%", ":0015O1", ":0020(a)", ":0025:1", ":0030;b", "M0", "M1"];
    assert_eq!(lines(&definition(&format!("{file}{numbers}{more}")), &job(vec![])), expected);
}

#[test]
fn the_date_is_the_one_given_else_left_out_with_its_blanks() {
    let text = |template: &str| definition(&format!("<PostFile>{template}</PostFile>"));
    let dated = PostOptions { date: Some("1/2/2026 3:04".into()), ..PostOptions::default() };
    assert_eq!(lines_with(&text("({$cbfile.name} {$date})"), &job(vec![]), &dated), ["(part 1/2/2026 3:04)"]);
    assert_eq!(lines(&text("({$cbfile.name} {$date})"), &job(vec![])), ["(part)"]);
    assert_eq!(lines(&text("{$comment} {$cbfile.name} {$date} {$endcomment}"), &job(vec![])), ["( part )"]);
    assert_eq!(lines(&text("{$date} {$date} (a)"), &job(vec![])), ["(a)"]);
}

#[test]
fn a_bracket_in_a_name_does_not_end_the_comment() {
    let mut job = job(vec![JobStep::Comment("a (b)\nc".into())]);
    job.operations[0].name = "x) M3".into();
    let text = bare("<MOP>( {$mop.name} )\n{$blocks}</MOP>").replace("<MOP>{$blocks}</MOP>", "");
    assert_eq!(lines(&text, &job), ["( x] M3 )", "G0 Z5.0", "G0 X0.0 Y0.0", "( a [b] c )"]);
}

#[test]
fn values_are_not_expanded_again() {
    let mut job = job(vec![]);
    job.name = "{$units}".into();
    assert_eq!(lines(&definition("<PostFile>({$cbfile.name})</PostFile>"), &job), ["({$units})"]);
}

#[test]
fn states_are_written_when_they_change() {
    let mut job = Job { operations: vec![], ..job(vec![]) };
    for velocity in [VelocityMode::ExactStop, VelocityMode::ExactStop, VelocityMode::ConstantVelocity] {
        job.operations.push(operation("m", 1, vec![]));
        job.operations.last_mut().unwrap().velocity = velocity;
    }
    let text = definition("<PostFile>{$mops}</PostFile><MOP>M1 {$velocitymode} {$workplane}</MOP>");
    assert_eq!(lines(&text, &job), ["M1 G61 G17", "M1", "M1 G64"]);
}

#[test]
fn the_header_has_the_first_operation_s_values_and_the_footer_the_last_one_s() {
    let operations = vec![operation("a", 1, vec![]), operation("b", 2, vec![])];
    let job = Job { operations, ..job(vec![]) };
    let text = definition(
        "<PostFile>{$mop.name} {$tool.index}\n{$mops}\n{$mop.name} {$tool.index}</PostFile><MOP/>",
    );
    assert_eq!(lines(&text, &job), ["a 1", "b 2"]);
}

fn spindle_job() -> Job {
    let mut operations =
        vec![operation("a", 1, vec![]), operation("b", 1, vec![]), operation("c", 2, vec![])];
    for operation in &mut operations {
        operation.spindle = Some(Turning::Clockwise);
        operation.speed = Some(1000.0);
    }
    Job { operations, ..job(vec![]) }
}

const SPINDLE: &str = "<PostFile>{$mops}</PostFile><MOP>{$toolchange}\n{$spindle} {$s}</MOP>";

#[test]
fn a_tool_change_makes_the_spindle_unknown() {
    let text = definition(&format!("{SPINDLE}<ToolChange>T{{$tool.index}} M6</ToolChange>"));
    assert_eq!(lines(&text, &spindle_job()), ["T1 M6", "M3 S1000", "S1000", "T2 M6", "M3 S1000"]);
}

#[test]
fn a_tool_word_without_a_change_registers_nothing() {
    let text = definition(&format!("{SPINDLE}<ToolChange>T{{$tool.index}}</ToolChange>"));
    assert_eq!(lines(&text, &spindle_job()), ["T1", "M3 S1000", "T1", "S1000", "T2", "S1000"]);
}

#[test]
fn a_spindle_that_is_written_by_hand_is_known() {
    let text =
        definition("<PostFile>M3\n{$spindle}\nM5\n{$spindle}\n{$spindle(off)} {$spindlecw}</PostFile>");
    assert_eq!(lines(&text, &spindle_job()), ["M3", "M5", "M3", "M5 M3"]);
}

#[test]
fn without_a_word_about_the_spindle_nothing_is_written() {
    let text = definition("<PostFile>{$spindle} {$s} M8</PostFile>");
    assert_eq!(lines(&text, &job(vec![])), ["M8"]);
}

#[test]
fn coolant_is_written_when_it_changes() {
    let mut job = spindle_job();
    for (operation, coolant) in job.operations.iter_mut().zip([Coolant::FLOOD, Coolant::FLOOD, Coolant::OFF])
    {
        operation.coolant = Some(coolant);
    }
    let text = definition("<PostFile>{$mops}</PostFile><MOP>{$coolant}</MOP>");
    assert_eq!(lines(&text, &job), ["M8", "M9"]);
}

#[test]
fn coolant_that_a_post_does_not_write_is_noted() {
    let mut job = spindle_job();
    let notes = |job: &Job| {
        let notes = output(&definition(SPINDLE), job, &PostOptions::default()).unwrap().notes;
        notes.iter().any(|note| note.text(Lang::En).contains("{$coolant}"))
    };
    assert!(!notes(&job));
    job.operations[0].coolant = Some(Coolant::FLOOD);
    assert!(notes(&job));
}

#[test]
fn lines_written_by_hand_move_the_tool() {
    let text = bare("<MOP>{$blocks}\nG1 Z0 F60\n{$clearance}</MOP>").replace("<MOP>{$blocks}</MOP>", "");
    let expected = ["G0 Z5.0", "G0 X0.0 Y0.0", "G1 Z0 F60", "G0 Z5.0"];
    assert_eq!(lines(&text, &job(vec![])), expected);
    let by_machine = text.replace("G1 Z0 F60", "G0 G53 Z5");
    assert_eq!(lines(&by_machine, &job(vec![]))[3], "G0 Z5.0", "machine coordinates are other ones");
    let tool_length = text.replace("G1 Z0 F60", "G43 H1");
    assert_eq!(lines(&tool_length, &job(vec![])).len(), 3, "nothing moved");
    let relative = text.replace("G1 Z0 F60", "G91 G0 Z5\nG90");
    assert_eq!(lines(&relative, &job(vec![]))[4], "G0 Z5.0", "how far up is not followed");
}

#[test]
fn set_tells_where_the_tool_is() {
    let text = |set: &str| {
        bare(&format!("<MOP>{{$blocks}}\n{set}\n{{$clearance}}</MOP>")).replace("<MOP>{$blocks}</MOP>", "")
    };
    assert_eq!(lines(&text(""), &job(vec![])).len(), 2);
    assert_eq!(lines(&text("{$set(z,NaN)}"), &job(vec![]))[2..], ["G0 Z5.0"]);
    assert_eq!(lines(&text("$set(z,1)"), &job(vec![]))[2..], ["G0 Z5.0"]);
    assert_eq!(lines(&text("{$set(z,5)}"), &job(vec![])).len(), 2);
}

#[test]
fn check_goes_by_way_of_the_clearance_plane() {
    let text =
        |check: &str| bare(&format!("<MOP>{{$blocks}}\n{check}</MOP>")).replace("<MOP>{$blocks}</MOP>", "");
    let mut job = job(vec![feed(0.0, 0.0, -1.0)]);
    job.operations[0].plunge_feed = Some(50.0);
    assert_eq!(lines(&text("{$check(0,0,-1)}"), &job).len(), 3, "it is there");
    assert_eq!(lines(&text("{$check(,,-1)}"), &job).len(), 3, "it is there");
    assert_eq!(lines(&text("{$check(7,0,-2)}"), &job)[3..], ["G0 Z5.0", "G0 X7.0", "G1 F50.0 Z-2.0"]);
    assert_eq!(lines(&text("{$check(7,y,2)}"), &job)[3..], ["G0 Z5.0", "G0 X7.0", "G0 Z2.0"]);
}

/// The corners of the blank in a Heidenhain program are not approached. G31 without them is a probing move.
#[test]
fn corners_of_the_blank_are_no_moves() {
    let post = read(&definition("<PostFile>M30</PostFile>")).unwrap();
    let moves = |program: &str| {
        let translated = post.translate(program.as_bytes()).text;
        translated
            .lines()
            .skip(1)
            .filter(|line| line.contains('X'))
            .map(str::trim)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let blank = "G30 G17 X+0 Y+0 Z-40\nG31 G90 X+100 Y+100 Z+0\n";
    assert_eq!(moves(&format!("%\n{blank}G0 X5 Y5")), "G0 X5 Y5");
    assert_ne!(moves("%\nG31 G90 X+100 Y+100 Z+0\nG0 X5 Y5"), "G0 X5 Y5");
    assert_ne!(moves(&format!("%\n{blank}G31 G90 X+100 Y+100 Z+0\nG0 X5 Y5")), "G0 X5 Y5", "it has ended");
    assert_eq!(moves("%\nG31 X5 Z0 F40"), "G38.3 X5 Z0 F40");
}

#[test]
fn a_post_s_own_comments_are_not_read_back() {
    let text = definition(
        "<PostFile>{$comment} G0 Z7 {$endcomment}\n{$clearance}</PostFile><Comment>'</Comment><EndComment/>",
    );
    let written = output(&text, &job(vec![]), &PostOptions::default()).unwrap();
    assert_eq!(written.warnings, []);
    assert_eq!(String::from_utf8(written.text).unwrap(), "' G0 Z7\r\nG0 Z5.0\r\n");
}

#[test]
fn the_tool_table_lists_each_tool_once_in_order_of_use() {
    let operations = vec![operation("a", 5, vec![]), operation("b", 2, vec![]), operation("c", 5, vec![])];
    let text = definition(
        "<PostFile>{$tooltable}</PostFile><ToolTableItem>{$tool.index} {$tool.name}</ToolTableItem>",
    );
    assert_eq!(lines(&text, &Job { operations, ..job(vec![]) }), ["5 cutter", "2 cutter"]);
}

#[test]
fn custom_texts_of_program_and_operation_are_empty() {
    let text = definition(
        "<PostFile>{$cbfile.header}\n{$mops}\n{$cbfile.footer}</PostFile><MOP>{$mop.header}\nM7{$mop.footer}</MOP>",
    );
    assert_eq!(lines(&text, &job(vec![])), ["M7"]);
}

#[test]
fn values_of_the_program_have_their_macros() {
    let mut job = job(vec![rapid(1.0, 2.0, 3.0)]);
    let operation = &mut job.operations[0];
    operation.part = "plate".into();
    operation.cut_feed = Some(400.0);
    operation.plunge_feed = Some(60.0);
    operation.depth_increment = Some(0.5);
    operation.target_depth = Some(-2.0);
    let text = definition(
        "<PostFile>{$part.name}{$mop.tag} {$mop.clearanceplane} {$mop.retractheight} {$mop.stocksurface} {$mop.targetdepth}
{$mop.cutfeedrate} {$mop.plungefeedrate} {$mop.depthincrement} {$mop.dwell} {$mop.peckdistance} {$mop.holediameter}
{$mop.first.x} {$mop.first.y} {$mop.first.z}
{$tool.index} {$tool.diameter} {$tool.radius} {$tool.profile}{$tool.comment}
{$units} {$distancemode} {$arccentermode} {$lathexmode} {$cuttercomp(off)} {$cuttercomp(L)} {$cuttercomp(R)}
{$stop} {$repeat} {$endrewind}</PostFile><SuppressParserErrors>true</SuppressParserErrors>",
    );
    let expected = [
        "plate 5.0 1.0 0.0 -2.0",
        "400.0 60.0 0.5 0.0 0.0 3.0",
        "1.0 2.0 3.0",
        "1 3.0 1.5 EndMill",
        "G21 G90 G91.1 G8 G40 G41 G42",
        "M0 M47 M30",
    ];
    assert_eq!(lines(&text, &job), expected);
}

#[test]
fn the_first_point_of_a_drilling_is_above_its_first_hole() {
    let hole = Hole {
        at: [1.0, 2.0],
        level: 4.0,
        retract: 1.0,
        bottom: -3.0,
        exit: 5.0,
        feed: Some(60.0),
        kind: HoleKind::Plain,
    };
    let text = definition(
        "<PostFile>{$mop.first.x} {$mop.first.y} {$mop.first.z}</PostFile><SuppressParserErrors>true</SuppressParserErrors>",
    );
    assert_eq!(lines(&text, &job(vec![JobStep::Hole(hole)])), ["1.0 2.0 4.0"]);
}

#[test]
fn inches_are_written_where_the_program_is_in_inches() {
    let job = Job { units: Units::Inches, ..job(vec![feed(25.4, 0.0, 5.0)]) };
    let text = bare("<MOP>{$units} {$tool.diameter}\n{$blocks}</MOP>").replace("<MOP>{$blocks}</MOP>", "");
    assert_eq!(lines(&text, &job), ["G20 0.1181", "G0 Z0.1969", "G0 X0.0 Y0.0", "G1 F3.937 X1.0"]);
}

#[test]
fn stock_and_tool_values_come_from_whoever_knows_them() {
    let header = |macros: &[(&str, &str)], own: &str| {
        let text = format!(
            "<PostFile>{{$header}}\n{{$mops}}</PostFile><MOP>{{$blocks}}</MOP><EndOfLine>\\n</EndOfLine><PostProcessorMacros>{own}</PostProcessorMacros><Header>( {{$stock_width}} {{$-stock_x}} {{$tool.length}} )</Header>"
        );
        let given = |(name, value): &(&str, &str)| PostMacro { name: (*name).into(), value: (*value).into() };
        let options = PostOptions { macros: macros.iter().map(given).collect(), ..PostOptions::default() };
        let job = job(vec![feed(1.0, 0.0, -1.0)]);
        let written = output(&definition(&text), &job, &options);
        written.map(|it| String::from_utf8(it.text).unwrap().lines().next().unwrap_or("").to_owned())
    };
    let all = [("stock_width", "150"), ("stock_x", "-5"), ("tool.length", "42.5")];
    assert_eq!(header(&all, ""), Ok("( 150 5.0 42.5 )".to_owned()));
    assert_eq!(header(&all[1..], "$stock_width=90"), Ok("( 90 5.0 42.5 )".to_owned()));
    assert_eq!(header(&all, "$stock_width=90"), Ok("( 150 5.0 42.5 )".to_owned()), "the configuration wins");
    let missing = header(&all[..2], "").expect_err("the length is missing");
    assert_eq!(texts(&missing)[0].split(' ').take(2).collect::<Vec<_>>(), ["4:", "PB754"]);
}

#[test]
fn numbers_without_a_letter_and_cr_alone_are_read_as_they_were_written() {
    let numbers = "<AddLineNumbers>true</AddLineNumbers><LineNumberPrefix></LineNumberPrefix>";
    let [numbered, ended] = ["1 G21 G90\n2 G0 Z5\n10 G1 X1 F100", "G21 G90\rG0 Z5\rG1 X1 F100"];
    let translated = |elements: &str, text: &str| {
        let translated = read(&definition(elements)).unwrap().translate(text.as_bytes());
        (translated.text.lines().count(), translated.problems.len())
    };
    assert_eq!(translated(numbers, numbered), (3, 0));
    assert_eq!(translated("<EndOfLine>\\r</EndOfLine>", ended), (3, 0));
    assert_ne!(translated("", numbered), (3, 0));
    assert_ne!(translated("<EndOfLine>\\r\\n</EndOfLine>", ended), (3, 0));
}
