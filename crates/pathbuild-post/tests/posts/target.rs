//! Tests which outputs the target of a post accepts, and how others are refused.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::dialect::Charset;
use pathbuild_gcode::verify::{Machine, Travel};
use pathbuild_motion::Turning;
use pathbuild_post::{Hole, HoleKind, Job, JobStep, Output, PostDefinition, PostOptions};

use crate::support::{definition, feed, job, rapid, read, read_toml, texts};

/// Writes a text literally, for a target.
fn write_with(target: &str, text: &str, options: &PostOptions<'_>) -> Result<Output, Vec<Diagnostic>> {
    let text = definition(&format!(
        "<PostFile>{text}</PostFile><EndOfLine>\\n</EndOfLine><SuppressParserErrors>true</SuppressParserErrors>{target}"
    ));
    // The output is not a complete program.
    let options = PostOptions { unchecked: true, ..options.clone() };
    PostDefinition::read(text.as_bytes(), Utf8Path::new("test.cbpp"))?.write(&job(vec![]), &options)
}

fn dialect(name: &str) -> String {
    format!("<Dialect>{name}</Dialect>")
}

#[track_caller]
fn written(target: &str, text: &str) -> String {
    match write_with(&dialect(target), text, &PostOptions::default()) {
        Ok(output) => String::from_utf8(output.text).unwrap(),
        Err(errors) => panic!("{}", texts(&errors).join("\n")),
    }
}

#[track_caller]
fn refused(target: &str, text: &str) -> Vec<String> {
    let errors =
        write_with(&dialect(target), text, &PostOptions::default()).expect_err("the text must be refused");
    errors.iter().map(|error| error.text(Lang::En)).collect()
}

fn rejected(line: u32, target: &str, word: &str) -> String {
    format!("line {line} of the output: {target} does not accept \"{word}\"")
}

/// The number of errors is limited, both within one line and over several lines, because each error contains part of its line.
#[test]
fn so_many_errors_are_told() {
    for (text, count) in
        [("A1 ".repeat(20), 20), ("A1 ".repeat(21), 20), ("A1\n".repeat(21), 20), ("A1 ".repeat(19), 19)]
    {
        assert_eq!(refused("grbl", &text).len(), count, "{text}");
    }
}

#[test]
fn words_that_the_target_does_not_know_are_errors() {
    assert_eq!(
        refused("grbl", "G21\nT1 M6\nG64 X1"),
        [rejected(2, "grbl", "M6"), rejected(3, "grbl", "G64")]
    );
    assert_eq!(refused("grbl", "A1"), [rejected(1, "grbl", "A1")]);
    assert_eq!(refused("grbl", "G81 X1 Z-1 R1"), [rejected(1, "grbl", "G81")]);
    assert_eq!(refused("linuxcnc", "M30 G22.5"), [rejected(1, "linuxcnc", "G22.5")]);
    assert_eq!(refused("marlin", "M30"), [rejected(1, "marlin", "M30")]);
    assert_eq!(refused("marlin", "N5 G1 X2"), [rejected(1, "marlin", "N5")]);
    assert_eq!(written("grbl", "N5 G1 X2"), "N5 G1 X2\n");
    assert_eq!(refused("fanuc", "G90.1"), [rejected(1, "fanuc", "G90.1")]);
    assert_eq!(
        refused("xpertmill", "G00 X1\nM3\nG90"),
        [rejected(2, "xpertmill", "M3"), rejected(3, "xpertmill", "G90")]
    );
}

#[test]
fn text_that_is_no_words_is_an_error() {
    assert_eq!(refused("linuxcnc", "G0 X = 1")[0], rejected(1, "linuxcnc", "X"));
    assert_eq!(refused("haas", "G0 X1,5"), [rejected(1, "haas", ","), rejected(1, "haas", "5")]);
}

#[test]
fn what_the_target_takes_passes() {
    assert_eq!(written("grbl", "n10 g0x1 y-2.5 ; a\nG38.2 Z -1 F5"), "n10 g0x1 y-2.5 ; a\nG38.2 Z -1 F5\n");
    assert_eq!(written("haas", "/ O01000 (a)"), "/ O01000 (a)\n");
}

#[test]
fn comments_are_no_words_but_in_the_target_s_own_form() {
    assert_eq!(written("linuxcnc", "G0 (M999) X1 ; M999"), "G0 (M999) X1 ; M999\n");
    assert_eq!(written("xpertmill", "% // M999"), "% // M999\n");
    assert_eq!(refused("xpertmill", "(a)").len(), 3);
    assert_eq!(refused("marlin", "(a)").len(), 3);
    assert_eq!(refused("fanuc", "; M0").first(), Some(&rejected(1, "fanuc", ";")));
}

#[test]
fn percent_frames_a_program_where_the_target_knows_it() {
    assert_eq!(written("linuxcnc", "%\nM2\n%"), "%\nM2\n%\n");
    assert_eq!(refused("grbl", "%\nM2"), [rejected(1, "grbl", "%")]);
}

#[test]
fn a_bare_number_is_a_tool_where_the_target_knows_that() {
    assert_eq!(written("xpertmill", "M06 05"), "M06 05\n");
    assert_eq!(
        refused("xpertmill", "G00 05"),
        [rejected(1, "xpertmill", "0"), rejected(1, "xpertmill", "5")]
    );
    assert_eq!(refused("fanuc", "M06 05").len(), 2);
}

#[test]
fn lines_are_as_long_as_the_target_takes_them() {
    let line = |letters: usize| format!("G0 (a remark) X{}", "0".repeat(letters));
    assert!(write_with(&dialect("grbl"), &line(76), &PostOptions::default()).is_ok());
    assert_eq!(
        refused("grbl", &line(77)),
        ["line 1 of the output has 80 characters; grbl accepts at most 79"]
    );
    assert!(write_with(&dialect("rs274"), &line(240), &PostOptions::default()).is_ok());
    assert_eq!(
        refused("rs274", &line(242)),
        ["line 1 of the output has 257 characters; rs274 accepts at most 256"]
    );
    // Marlin drops comments while it receives a line, but no blanks.
    let marlin = |zeros: usize| format!("G0 X{}; {}", "0".repeat(zeros), "a remark ".repeat(20));
    assert!(write_with(&dialect("marlin"), &marlin(92), &PostOptions::default()).is_ok());
    assert!(refused("marlin", &marlin(93))[0].contains("marlin accepts at most 96"));
    let comment = |length: usize| format!("({})", "x".repeat(length));
    assert!(write_with(&dialect("rs274"), &comment(254), &PostOptions::default()).is_ok());
    assert_eq!(
        refused("rs274", &comment(255)),
        ["line 1 of the output is a comment of 257 characters; rs274 accepts at most 256"]
    );
}

#[test]
fn grbl_gets_no_byte_that_it_would_act_on() {
    assert_eq!(written("grbl", "(Über 5 µm? ~80% „ja“!) G0 X1"), "(Ueber 5 um. -80- .ja..) G0 X1\n");
    assert_eq!(refused("grbl", "G0 X1 !"), [rejected(1, "grbl", "!")]);
    let utf8 = PostOptions { charset: Charset::Utf8, ..PostOptions::default() };
    assert_eq!(
        write_with(&dialect("grbl"), "(Ä)", &utf8).unwrap().text,
        b"(Ae)\n",
        "whatever the configuration says"
    );
}

#[test]
fn raw_bytes_that_grbl_would_act_on_are_errors() {
    let post = PostDefinition::read(
        b"[post]\ndialect = \"grbl\"\nnumber-lines = false\n[text]\nprogram-start = '(\\\\\\~84)'",
        Utf8Path::new("t.toml"),
    )
    .unwrap();
    assert!(post.write(&job(vec![]), &PostOptions::default()).is_err());
}

#[test]
fn umlauts_are_written_as_the_configuration_says() {
    assert_eq!(written("linuxcnc", "(Öse ÖSE Ö ÜBÜ)"), "(Oese OESE Oe UEBUE)\n");
    let utf8 = PostOptions { charset: Charset::Utf8, ..PostOptions::default() };
    assert_eq!(write_with(&dialect("linuxcnc"), "(Öse)", &utf8).unwrap().text, "(Öse)\n".as_bytes());
    assert_eq!(write_with("", "(Öse)", &PostOptions::default()).unwrap().text, b"(Oese)\n");
}

#[test]
fn comments_within_comments_are_no_such_where_that_is_an_error() {
    assert_eq!(written("linuxcnc", "(a (b) M0"), "(a [b) M0\n");
    assert_eq!(written("grbl", "(a (b) M0"), "(a (b) M0\n");
}

#[test]
fn what_somebody_answers_for_is_not_read_back_and_a_note_says_so() {
    let post =
        PostDefinition::read(definition("<PostFile>M2</PostFile>").as_bytes(), Utf8Path::new("t.cbpp"))
            .unwrap();
    let program = job(vec![feed(1.0, 0.0, -1.0)]);
    for dialect in [None, Some("linuxcnc".into())] {
        let options = PostOptions { dialect, ..PostOptions::default() };
        assert!(post.write(&program, &options).is_err(), "the moves are lost");
        let notes = post.write(&program, &PostOptions { unchecked: true, ..options }).unwrap().notes;
        let notes: Vec<String> = notes.iter().map(|note| note.text(Lang::En)).collect();
        assert_eq!(notes, ["the output was not compared with the program, because unchecked = true is set"]);
    }
}

#[test]
fn the_dialect_given_wins_over_the_definition_s() {
    let options = |name: &str| PostOptions { dialect: Some(name.into()), ..PostOptions::default() };
    assert!(write_with(&dialect("grbl"), "T1 M6", &options("linuxcnc")).is_ok());
    assert!(write_with(&dialect("linuxcnc"), "T1 M6", &options("grbl")).is_err());
}

#[test]
fn an_unknown_dialect_is_an_error_that_names_the_nearest() {
    let errors = write_with(&dialect("linuxcmc"), "M2", &PostOptions::default()).unwrap_err();
    assert!(texts(&errors)[0].starts_with("PB750 there is no dialect linuxcmc"), "{:?}", texts(&errors));
    assert!(texts(&errors)[0].ends_with("(did you mean linuxcnc?)"), "{:?}", texts(&errors));
}

fn pecked() -> Job {
    let kind = HoleKind::Peck { depth: 2.0 };
    job(vec![JobStep::Hole(Hole {
        at: [0.0, 0.0],
        level: 5.0,
        retract: 1.0,
        bottom: -3.0,
        exit: 5.0,
        feed: Some(60.0),
        kind,
    })])
}

#[test]
fn a_control_without_cycles_gets_their_moves() {
    let options =
        |name: &str| PostOptions { dialect: Some(name.into()), cycles: true, ..PostOptions::default() };
    let cycle = |definition_text: &str, name: &str| {
        let text =
            definition(&format!("<PostFile>{{$mops}}</PostFile><MOP>{{$blocks}}</MOP>{definition_text}"));
        let output = PostDefinition::read(text.as_bytes(), Utf8Path::new("t.cbpp"))
            .unwrap()
            .write(&pecked(), &options(name))
            .unwrap();
        String::from_utf8(output.text).unwrap()
    };
    assert!(cycle("", "linuxcnc").contains("G83 X0.0 Y0.0 Z-3.0 Q2.0 R1.0 F60.0"));
    let moves = cycle("", "grbl");
    assert!(
        !moves.contains("G83") && moves.contains("G1 F60.0 Z-1.0") && moves.contains("G1 Z-3.0"),
        "{moves}"
    );
}

/// G73 breaks the chips, but does not clear them from the hole.
#[test]
fn the_tool_leaves_the_hole_between_two_pecks() {
    let errors = |cycle: &str, dialect: &str| {
        let text = format!("<PostFile>{{$mops}}</PostFile><MOP>{{$blocks}}</MOP><G83>{cycle}</G83>");
        let options = PostOptions { dialect: Some(dialect.into()), cycles: true, ..PostOptions::default() };
        let definition = PostDefinition::read(definition(&text).as_bytes(), Utf8Path::new("t.cbpp")).unwrap();
        let errors = definition.write(&pecked(), &options).err().unwrap_or_default();
        errors.iter().map(|error| error.notes[0].text(Lang::En)).collect::<Vec<_>>()
    };
    for dialect in ["linuxcnc", "mach3"] {
        assert_eq!(errors("G83", dialect), [""; 0]);
        let found = errors("G73", dialect);
        assert!(found[0].starts_with("between two pecks, the tool rises only to Z -0.746"), "{found:?}");
    }
}

#[test]
fn a_definition_that_writes_the_moves_of_a_hole_itself_is_let() {
    let kind = HoleKind::Plain;
    let plain =
        Hole { at: [0.0, 0.0], level: 5.0, retract: 1.0, bottom: -3.0, exit: 5.0, feed: Some(60.0), kind };
    let text = definition(
        "<PostFile>{$mops}</PostFile><MOP>{$blocks}</MOP><G81/><CannedCycleStart/><CannedCycleEnd/>\
         <Drill>(by hand)\n{$g0} Z{$mop.retractheight}\n{$g1} {$z} {$f}\n{$g0} Z{$mop.clearanceplane}</Drill>",
    );
    let options = PostOptions { dialect: Some("grbl".into()), cycles: true, ..PostOptions::default() };
    let post = PostDefinition::read(text.as_bytes(), Utf8Path::new("t.cbpp")).unwrap();
    let output = post.write(&job(vec![JobStep::Hole(plain)]), &options).unwrap();
    assert!(String::from_utf8(output.text).unwrap().contains("(by hand)"));
}

/// Writes a job with `unchecked`, which must succeed, and then for a dialect in which the text is read back.
fn read_back(elements: &str, steps: Vec<JobStep>) -> Result<(), Vec<String>> {
    let text = definition(&format!("<PostFile>{{$mops}}</PostFile><MOP>{{$blocks}}</MOP>{elements}"));
    let post = PostDefinition::read(text.as_bytes(), Utf8Path::new("t.cbpp")).unwrap();
    let unchecked = PostOptions { unchecked: true, ..PostOptions::default() };
    post.write(&job(steps.clone()), &unchecked).unwrap();
    let options = PostOptions { dialect: Some("linuxcnc".into()), ..PostOptions::default() };
    post.write(&job(steps), &options).map(drop).map_err(|errors| {
        let notes =
            |error: &Diagnostic| error.notes.iter().map(|note| note.text(Lang::En)).collect::<String>();
        errors.iter().map(|error| format!("{} {}", error.text(Lang::En), notes(error))).collect()
    })
}

#[test]
fn what_moves_otherwise_than_the_program_is_not_written() {
    let steps = || vec![feed(0.0, 0.0, -1.0), feed(10.0, 0.0, -1.0), rapid(10.0, 0.0, 5.0)];
    assert_eq!(read_back("", steps()), Ok(()));
    let errors = read_back("<FeedMove>{$g1} {$_f} {$-x} {$_y} {$_z}</FeedMove>", steps()).unwrap_err();
    assert!(errors[0].starts_with("line 4 of the output differs from the program"), "{errors:?}");
    assert!(read_back("<FeedMove>{$g1} F99 {$_x} {$_y} {$_z}</FeedMove>", steps()).is_err(), "another feed");
    assert!(read_back("<FeedMove>{$g0} {$_x} {$_y} {$_z}</FeedMove>", steps()).is_err(), "a rapid");
    assert!(read_back("<FeedMove>{$g1} {$_f} {$_x} {$_y}</FeedMove>", steps()).is_err(), "no Z");
    let between = vec![feed(0.04, 0.0, -1.0), feed(9.04, 0.0, -1.0)];
    assert_eq!(
        read_back("<NumberFormat>0.0</NumberFormat>", between),
        Ok(()),
        "within half a unit of the last digit"
    );
}

/// Lengths that the definition itself contains need a decimal point as well.
#[test]
fn literal_lengths_have_a_point_where_the_control_may_need_it() {
    let written = |target: &str, length: &str| {
        let text = format!(
            "<PostFile>{{$mops}}</PostFile><MOP>G0 Z{length}\nG0 Z6.0\n{{$blocks}}</MOP><Dialect>{target}</Dialect>"
        );
        let post = read(&definition(&text)).unwrap();
        let steps = vec![feed(0.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)];
        post.write(&job(steps), &PostOptions::default()).map(drop).map_err(|errors| errors.len())
    };
    for target in ["fanuc", "haas"] {
        assert_eq!(written(target, "20."), Ok(()));
        assert_eq!(written(target, "20"), Err(1), "{target}");
    }
    assert_eq!(written("linuxcnc", "20"), Ok(()));
}

/// A switch at the machine decides whether a line that begins with `/` is run (block delete).
#[test]
fn lines_that_a_switch_can_skip_must_not_be_needed() {
    let written = |dialect: &str, elements: &str| {
        let text = format!(
            "<PostFile>G21 G90 G17 G94\n{{$mops}}\nM30</PostFile><MOP>/M1\n/M8\n/G4 P1.0\n{{$blocks}}</MOP>{elements}{dialect}"
        );
        let steps = vec![feed(0.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)];
        read(&definition(&text)).unwrap().write(&job(steps), &PostOptions::default())
    };
    for dialect in ["linuxcnc", "fanuc", "haas", ""] {
        let dialect = if dialect.is_empty() { String::new() } else { self::dialect(dialect) };
        assert!(written(&dialect, "").is_ok(), "{dialect}: {:?}", written(&dialect, "").err());
        for elements in [
            "<Rapid>/{$g0} {$_x} {$_y} {$_z}</Rapid>",
            "<FeedMove>/{$g1} {$_f} {$_x} {$_y} {$_z}</FeedMove>",
            "<MOP>/ M3 S100\n{$blocks}</MOP><PostFile>{$mops}\nM5\nM30</PostFile>",
            "<FeedMove>/{$g1}\n{$_f} {$_x} {$_y} {$_z}</FeedMove>",
            "<FeedMove>/{$_f}\n{$g1} {$_x} {$_y} {$_z}</FeedMove>",
            "<MOP>G18\n/G17\n{$blocks}</MOP>",
            "<MOP>G91\nN10 /G90\n{$blocks}</MOP>",
            "<AddLineNumbers>true</AddLineNumbers><FeedMove>/{$g1} {$_f} {$_x} {$_y} {$_z}</FeedMove>",
        ] {
            let errors = texts(&written(&dialect, elements).expect_err(elements));
            let is_told = |text: &String| text.contains("PB762 `/` begins a line") || text.contains("\"/\"");
            assert!(errors.iter().any(is_told), "{dialect} {elements}: {errors:?}");
        }
    }
}

#[test]
fn corners_are_rounded_within_a_limit() {
    let warnings = |dialect: &str, words: &str, part_tolerance: f64| {
        let elements = format!("<Header>{{$units}} {{$distancemode}} G17\n{words}</Header>{dialect}");
        let steps = vec![feed(0.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)];
        let text =
            format!("<PostFile>{{$header}}\n{{$mops}}\nM30</PostFile><MOP>{{$blocks}}</MOP>{elements}");
        let options = PostOptions { part_tolerance, ..PostOptions::default() };
        texts(&read(&definition(&text)).unwrap().write(&job(steps), &options).unwrap().warnings)
    };
    for dialect in [&*dialect("linuxcnc"), ""] {
        for (words, part_tolerance, is_told) in [
            ("G64 P0.01", 0.0, false),
            ("G64 P0.011", 0.0, true),
            ("G64 P0.02", 0.02, false),
            ("G64 P5", 0.02, true),
            ("G64 P2 Q2", 0.02, true),
            ("G64", 0.02, false),
            ("G61", 0.02, false),
        ] {
            let found = warnings(dialect, words, part_tolerance);
            let is_found = found.iter().any(|text| text.contains("PB787"));
            assert_eq!(is_found, is_told, "{dialect} {words}: {found:?}");
        }
    }
}

/// The section that writes no move is reported first, then the errors that follow from it.
#[test]
fn texts_for_moves_must_move() {
    let steps = vec![feed(0.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)];
    for (section, text) in
        [("Rapid", ""), ("Rapid", "(up)"), ("Rapid", "{$comment} up {$endcomment}"), ("FeedMove", " ")]
    {
        let errors = read_back(&format!("<{section}>{text}</{section}>"), steps.clone()).unwrap_err();
        assert!(errors[0].starts_with(&format!("{section} writes no move")), "{errors:?}");
        assert!(errors.len() > 1, "{errors:?}");
    }
    let errors = read_back("<Rapid>G0 X1</Rapid>", steps.clone()).unwrap_err();
    assert!(!errors.iter().any(|error| error.contains("writes no move")), "{errors:?}");
    assert_eq!(read_back("<Rapid>{$g0} {$_x} {$_y} {$_z}</Rapid>", steps), Ok(()));
}

/// Writes a cut to X10, with these texts before and after it, for LinuxCNC on a machine.
fn run_on(machine: Machine, before: &str, behind: &str) -> Result<(), Vec<String>> {
    let text = format!(
        "<PostFile>{{$mops}}{behind}</PostFile><MOP>{before}\n{{$blocks}}</MOP><Dialect>linuxcnc</Dialect>"
    );
    let post = PostDefinition::read(definition(&text).as_bytes(), Utf8Path::new("t.cbpp")).unwrap();
    let options = PostOptions { machine: Some(machine), ..PostOptions::default() };
    let steps = vec![feed(0.0, 0.0, -1.0), feed(10.0, 0.0, -1.0), rapid(10.0, 0.0, 5.0)];
    post.write(&job(steps), &options).map(drop).map_err(|errors| texts(&errors))
}

#[test]
fn a_program_that_breaks_a_rule_of_verify_is_not_written() {
    let any = Machine::default;
    assert_eq!(run_on(any(), "M3 S1000", "M5"), Ok(()));
    assert_eq!(run_on(any(), "", ""), Ok(()), "the operator sees to the spindle");
    for (before, behind, code) in [
        ("M5", "", "PB745 this is a cutting move with the spindle off"),
        ("", "M5", "PB745 "),
        ("M3 S0", "M5", "PB745 this is a cutting move with the spindle at speed 0"),
        ("M3", "M5", "PB745 "),
    ] {
        let errors = run_on(any(), before, behind).unwrap_err();
        assert!(errors[0].starts_with(code), "{before}, {behind}: {errors:?}");
    }
    let spindle = |speeds| Machine { spindle: Some(speeds), ..Machine::default() };
    assert_eq!(run_on(spindle((500.0, 1000.0)), "M3 S1000", "M5"), Ok(()));
    let errors = run_on(spindle((500.0, 999.0)), "M3 S1000", "M5").unwrap_err();
    assert!(errors[0].starts_with("PB746 S 1000 is outside the machine's range of 500 to 999"), "{errors:?}");
    let travel = |x| {
        let size = Some(Travel::Size([x, 100.0, 100.0]));
        Machine { travel: size, ..Machine::default() }
    };
    assert_eq!(run_on(travel(10.0), "M3 S1000", "M5"), Ok(()));
    let errors = run_on(travel(9.99), "M3 S1000", "M5").unwrap_err();
    assert!(errors[0].starts_with("PB748 "), "{errors:?}");
}

#[test]
fn somebody_who_answers_for_the_moves_does_not_answer_for_rules() {
    let post = |dialect: &str| {
        let text = format!("<PostFile>{{$mops}}</PostFile><MOP>M5\n{{$blocks}}</MOP>{dialect}");
        PostDefinition::read(definition(&text).as_bytes(), Utf8Path::new("t.cbpp")).unwrap()
    };
    let options = PostOptions { unchecked: true, ..PostOptions::default() };
    let job = job(vec![feed(0.0, 0.0, -1.0), rapid(0.0, 0.0, 5.0)]);
    let errors = texts(&post("<Dialect>linuxcnc</Dialect>").write(&job, &options).unwrap_err());
    assert!(errors[0].starts_with("PB745 "), "{errors:?}");
    assert!(post("").write(&job, &options).is_ok(), "without a dialect the meaning of M5 is unknown");
}

#[test]
fn what_the_reader_refuses_is_not_written() {
    let errors = read_back("<MOP>G1 X1\n{$blocks}</MOP>", vec![feed(0.0, 0.0, -1.0)]).unwrap_err();
    assert!(errors[0].contains("this cutting move has no feed"), "{errors:?}");
}

/// Writes a cut with the spindle at 1000 1/min by a definition without a dialect that has these words in front of it.
fn after_words(words: &str, options: &PostOptions<'_>) -> Result<Output, Vec<Diagnostic>> {
    with_elements(words, "", options)
}

fn with_elements(words: &str, elements: &str, options: &PostOptions<'_>) -> Result<Output, Vec<Diagnostic>> {
    let mut job =
        job(vec![rapid(1.0, 0.0, 1.0), feed(1.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)]);
    job.operations[0].spindle = Some(Turning::Clockwise);
    job.operations[0].speed = Some(1000.0);
    let mop = format!(
        "<MOP>{{$toolchange}}\n{{$velocitymode}} {{$workplane}}\n{words}\n{{$blocks}}</MOP>{elements}"
    );
    read(&definition(&mop)).unwrap().write(&job, options)
}

/// A colon is the letter O to some controls, which begins another program, and others refuse a number without a letter.
#[test]
fn without_a_dialect_line_numbers_without_n_are_doubtful() {
    let doubts = |line: &str, prefix: Option<&str>| {
        let numbers = prefix.map(|prefix| {
            format!("<AddLineNumbers>true</AddLineNumbers><LineNumberPrefix>{prefix}</LineNumberPrefix>")
        });
        let written = with_elements(
            &format!("M3 S1000\n{line}"),
            &numbers.unwrap_or_default(),
            &PostOptions::default(),
        );
        texts(&written.unwrap_or_else(|errors| panic!("{line}: {:?}", texts(&errors))).warnings)
    };
    for (line, prefix, word) in [(":5 G0 Z5", None, ":"), ("", Some(":"), ":"), ("", Some(""), "1")] {
        let doubts = doubts(line, prefix);
        assert_eq!(doubts.len(), 1, "{line} {prefix:?}: {doubts:?}");
        assert!(
            doubts[0].starts_with("PB752") && doubts[0].contains(&format!("contains {word},")),
            "{doubts:?}"
        );
    }
    for (line, prefix) in [(":5", None), ("N5 G0 Z5", None), ("", Some("N")), ("", Some("n"))] {
        assert_eq!(doubts(line, prefix), [""; 0], "{line} {prefix:?}");
    }
}

/// Real definitions declare no dialect. Their output is interpreted as far as all controls agree.
#[test]
fn without_a_dialect_words_and_spindle_are_followed_too() {
    let written = after_words;
    let default = PostOptions::default();
    let refused = |words: &str| texts(&written(words, &default).expect_err(words)).join("\n");
    for word in
        ["G41 D1", "G68 R45", "G51 X2", "G93", "G95", "G16", "G7", "G96", "M98 P1", "M97 P1", "G43.1 Z1"]
    {
        let message = refused(&format!("M3 S1000\n{word}"));
        assert!(message.starts_with("PB767"), "{word}: {message}");
    }
    for line in [
        "G0 G1 X5", "G0 X0 X5", "G17 G18", "G20 G21", "G90 G91", "G54 G55", "M3 M4", "M3 M5", "G54 P2",
        "G59.1 P2",
    ] {
        let message = refused(&format!("M3 S1000\n{line}"));
        assert!(message.starts_with("PB762"), "{line}: {message}");
    }
    for line in ["G80 G0", "G21 G71", "G90 G90", "M7 M8", "M9 M5\nM3", "G54"] {
        assert!(written(&format!("M3 S1000\n{line}"), &default).is_ok(), "{line}");
    }
    for (words, code) in [
        ("", "PB767"),
        ("S1000", "PB767"),
        ("M4 S1000", "PB767"),
        ("M3", "PB745"),
        ("M3 S1000\nM5", "PB745"),
        ("M5 S1000", "PB745"),
    ] {
        let message = refused(words);
        assert!(message.contains(code), "{words}: {message}");
    }
    let doubts = |words: &str| match written(words, &default) {
        Ok(output) => texts(&output.warnings),
        Err(errors) => panic!("{words}: {:?}", texts(&errors)),
    };
    for words in ["M3 S1000", "G64 G40 G49 G54 G94 G80\nM8\nM3 S1000", "G61 M3 S1000"] {
        assert_eq!(doubts(words), Vec::<String>::new(), "{words}");
    }
    for (words, word) in [
        ("M3 S1000\nM110", "M110"),
        ("M3 S1000\nG55", "G55"),
        ("M3 S1000\nG0 Z5 E1", "E"),
        ("M3 S1000\nG0 Z5 D1", "D"),
        ("M3 S1000\nG0 Z5 O5", "O"),
        ("M3 S1000\nG0 Z5 R2", "R"),
        ("M3 S1000\nG0 Z5 L3", "L"),
        ("M3 S1000\nG0 Z5 H1", "H"),
    ] {
        assert!(
            doubts(words)[0].starts_with("PB752") && doubts(words)[0].contains(word),
            "{:?}",
            doubts(words)
        );
    }
    let linuxcnc = PostOptions { dialect: Some("linuxcnc".into()), ..PostOptions::default() };
    let warnings = texts(&written("M3 S1000\nG43.1 Z0", &linuxcnc).unwrap().warnings);
    assert!(warnings[0].starts_with("PB752 the output applies a tool length with G43.1"), "{warnings:?}");
    // A spindle word is not required if the operator controls the spindle, or if the user takes responsibility for the output.
    for options in [
        PostOptions { manual_spindle: true, ..PostOptions::default() },
        PostOptions { unchecked: true, ..PostOptions::default() },
    ] {
        assert!(written("", &options).is_ok());
    }
}

/// Lines that may move the tool, although the words that controls agree on do not say so.
#[test]
fn without_a_dialect_lines_that_may_move_are_refused() {
    let written = |line: &str| after_words(&format!("M3 S1000\n{line}"), &PostOptions::default());
    for line in ["G0 Z[#1+20]", "#5221=10", "o100 call", "G10 L1 P5 Z10", "G10 L11 P5 Z10", "%"] {
        let message = texts(&written(line).expect_err(line)).join("\n");
        assert!(message.starts_with("PB767"), "{line}: {message}");
    }
    for line in [
        "G0 A90",
        "G0 Z5 B1",
        "G0 U5",
        "G1 V5",
        "G0 W-5",
        "TRANS X10",
        "TRANS",
        "atrans Z1",
        "ROT RPL=45",
        "SCALE X2",
        "AMIRROR X0",
        "CYCLE800(1)",
        "G0 Z5 RL",
        "G0 Z=-5",
        "G0 Z = IC(-15)",
        "M1=3 X1=AC(5)",
        "RNDM=5",
        "R10=5",
        "PRESETON(Z,5)",
        "MCALL CYCLE81(5,0,1,-5)",
        "GOTOF END",
        "M30\nG0 Z9",
        "G80\nZ-5",
        "G80\nX5 Y5 Z9",
        "G0 % Z9",
        "G0 Z9 %",
    ] {
        let message = texts(&written(line).expect_err(line)).join("\n");
        assert!(message.starts_with("PB767"), "{line}: {message}");
    }
    for line in [
        "MSG(\"ROT\")",
        "TRANSFER",
        "G0 RL",
        "WAIT 5",
        "T=\"MILL\"",
        "SPOS=0 M1=3",
        "$32=0",
        "G80\nG0 Z9",
        "G0 Z9 (50 %)",
    ] {
        assert!(written(line).is_ok(), "{line}");
    }
}

/// A dwell in the wrong unit is a thousand times too short or too long.
#[test]
fn dwells_are_compared() {
    let job = |seconds| {
        job(vec![
            rapid(1.0, 0.0, 1.0),
            feed(1.0, 0.0, -1.0),
            JobStep::Dwell { seconds },
            rapid(1.0, 0.0, 5.0),
        ])
    };
    let written = |dialect: &str, dwell: &str, seconds| {
        let text = format!(
            "<PostFile>G21 G90 G17 G94\nG0 Z5.0\n{{$mops}}\nM30</PostFile><MOP>{{$blocks}}</MOP><Dwell>{dwell}</Dwell>{}",
            self::dialect(dialect)
        );
        read(&definition(&text)).unwrap().write(&job(seconds), &PostOptions::default())
    };
    for (dialect, dwell) in [
        ("fanuc", "G4 {$p}"),
        ("fanuc", "G4 X{$move.p}"),
        ("haas", "G4 {$p}"),
        ("linuxcnc", "G4 {$p}\nG4 P9"),
    ] {
        let errors = written(dialect, dwell, 0.5).err();
        assert!(errors.is_none(), "{dialect}: {errors:?}");
    }
    for (dialect, dwell) in [("fanuc", "G4 P{$move.p}"), ("haas", "G4 P500.0"), ("linuxcnc", "G4 P500")] {
        let errors = texts(&written(dialect, dwell, 0.5).expect_err(dialect));
        assert!(errors[0].contains("PB767 line 6 "), "{errors:?}");
    }
    assert!(written("linuxcnc", "", 0.0006).is_err(), "a dwell is lost");
    assert!(written("linuxcnc", "", 0.0005).is_ok(), "too short for the control's decimals");
    assert!(written("linuxcnc", "G4 P0.501", 0.5005).is_ok(), "half a millisecond");
}

/// Without a dialect, the time of G4 may be in seconds or milliseconds, but must equal that of the job in one of these units.
#[test]
fn dwells_of_texts_without_a_dialect_are_compared() {
    let steps = |seconds| {
        vec![rapid(1.0, 0.0, 1.0), feed(1.0, 0.0, -1.0), JobStep::Dwell { seconds }, rapid(1.0, 0.0, 5.0)]
    };
    let written = |dwell: &str, seconds| {
        let text = format!(
            "<PostFile>G21 G90 G17 G94\nG0 Z5.0\n{{$mops}}\nM30</PostFile><MOP>{{$blocks}}</MOP><Dwell>{dwell}</Dwell>"
        );
        read(&definition(&text)).unwrap().write(&job(steps(seconds)), &PostOptions::default())
    };
    for dwell in ["G4 P{$move.p}", "G04 X{$move.p}", "G4 F500", "G4 P9\nG4 {$p}", "WAIT {$move.p}"] {
        let errors = written(dwell, 0.5).err();
        assert!(errors.is_none(), "{dwell}: {errors:?}");
    }
    for dwell in ["G4 P5", "G4 P50", "G4 X0.6", "G4 F499"] {
        let errors = texts(&written(dwell, 0.5).expect_err(dwell));
        assert!(errors[0].contains("PB767 line 6 "), "{errors:?}");
    }
    // On most controls, F beside G4 is the feed of the cuts that follow.
    for (dwell, word) in [("G4 F0.5", "G4 F"), ("G4 S500", "G4 S"), ("G4 P0.5", ""), ("G4 X0.5", "")] {
        let warnings = texts(&written(dwell, 0.5).expect(dwell).warnings);
        let is_told =
            warnings.iter().any(|text| text.contains(&format!("PB752 the output contains {word},")));
        assert_eq!(is_told, !word.is_empty(), "{dwell}: {warnings:?}");
    }
}

/// Writes a cut with control texts that declare no dialect, and returns the first note of the error.
fn control_texts(settings: &str, start: &str, end: &str) -> Option<String> {
    let text = format!(
        "[post]\nnumber-lines = false\n{settings}\n[text]\nprogram-start = '{start}'\n\
         rapid = 'G00 X{{.~X1~}} Y{{.~Y1~}} Z{{.~Z1~}}'\n\
         line = 'G01 X{{.~X1~}} Y{{.~Y1~}} Z{{.~Z1~}} F{{.~MovingVel~}}'\nprogram-end = \"\"\"{end}\"\"\"\n"
    );
    let steps = vec![feed(0.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)];
    let errors = read_toml(&text).write(&job(steps), &PostOptions::default()).err()?;
    Some(errors[0].notes.first().map_or(String::new(), |note| note.text(Lang::En)))
}

/// A control in millimetres takes inches for millimetres, unless the text states the unit.
#[test]
fn inches_are_stated() {
    let inches = |start: &str| control_texts("units = \"inch\"", start, "M30");
    assert_eq!(inches("G20 G17 G90"), None);
    assert_eq!(inches("G70 G17 G90"), None);
    assert!(inches("G17 G90").unwrap().contains("millimetres are assumed"));
    assert_eq!(control_texts("", "G17 G90", "M30"), None, "a warning");
}

/// The output must stop where the probe of the program stops, if the target can.
#[test]
fn a_probe_that_touches_nothing_is_an_error() {
    let warnings = |dialect: &str, probe: &str| {
        let text = format!(
            "<PostFile>G17 G21 G90 G94\n{{$mops}}\nM30</PostFile><MOP>{{$blocks}}</MOP>\
             <Probe>{probe} {{$f}} {{$x}} {{$y}} {{$z}}</Probe>{dialect}"
        );
        let steps = vec![JobStep::probe([0.0, 0.0, -5.0], Some(40.0))];
        let output = read(&definition(&text)).unwrap().write(&job(steps), &PostOptions::default());
        texts(&output.unwrap_or_else(|errors| panic!("{:?}", texts(&errors))).warnings)
    };
    let is_told = |dialect: &str, probe: &str| {
        warnings(dialect, probe).iter().any(|text| text.contains("if the probe touches nothing"))
    };
    for target in ["linuxcnc", "grbl"] {
        assert!(!is_told(&dialect(target), "G38.2"));
        assert!(is_told(&dialect(target), "G38.3"));
    }
    assert!(!is_told("", "G31"));
}

/// `//` begins a comment of control texts, also within another comment.
#[test]
fn comments_of_control_texts_are_read_to_their_end() {
    let start = |text: &str| control_texts("", &format!("G17 G21 G90 {text}"), "M30");
    assert_eq!(start(r"// x\\\~0D"), None);
    assert!(start(r"// x\\\~0DG0 Z-5").unwrap().contains("CR"));
    let warnings = |comment: &str| {
        let text = format!(
            "[post]\nnumber-lines = false\n[text]\nprogram-start = 'G17 G21 G90 G00 Z{{.~ZClearance~}} {comment}'\n\
             rapid = 'G00 X{{.~X1~}} Y{{.~Y1~}} Z{{.~Z1~}}'\nline = 'G01 X{{.~X1~}} Y{{.~Y1~}} Z{{.~Z1~}} F{{.~MovingVel~}}'\n"
        );
        let steps = vec![feed(0.0, 0.0, -1.0), rapid(0.0, 0.0, 5.0)];
        texts(&read_toml(&text).write(&job(steps), &PostOptions::default()).unwrap().warnings)
    };
    assert_eq!(warnings("(http://x)"), [""; 0]);
    assert!(warnings("(http://x) (y")[0].contains("the output contains"));
}
