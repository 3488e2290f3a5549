//! Tests reading CamBam definitions, and the errors in them.

use pathbuild_diagnostic::Lang;
use pathbuild_post::{JobStep, PostMacro, PostOptions};

use crate::support::{
    arc, bare, definition, errors, feed, job, lines, lines_with, output, read, shared, texts,
};

#[test]
fn absent_sections_have_defaults() {
    let written = lines(&definition(""), &job(vec![feed(0.0, 0.0, -1.0)]));
    let expected = [
        "( Made using CamBam - http://www.cambam.co.uk )",
        "( part )",
        "( T1 : 3.0 )",
        "G21 G90 G64 G40",
        "G0 Z5.0",
        "( T1 : 3.0 )",
        "T1 M6",
        "( mill )",
        "G17",
        "G0 X0.0 Y0.0",
        "G1 F100.0 Z-1.0",
        "G0 Z5.0",
        "M5",
        "M30",
    ];
    assert_eq!(written, expected);
}

#[test]
fn empty_sections_are_empty() {
    let elements = "<ToolChange/><UnitsMM></UnitsMM><VelocityModeConstantVelocity />";
    let written = lines(&definition(elements), &job(vec![]));
    assert_eq!(written[3..6], ["G90 G40", "G0 Z5.0", "( mill )"]);
}

#[test]
fn scalars_may_be_padded() {
    let elements = bare("<NumberFormat>\n 0.0 \n</NumberFormat>");
    assert_eq!(
        lines(&elements, &job(vec![feed(0.06, 0.0, 5.0)])),
        ["G0 Z5.0", "G0 X0.0 Y0.0", "G1 F100.0 X0.1"]
    );
}

#[test]
fn entities_are_resolved() {
    let text =
        definition("<PostFile>&lt;A&gt; &amp; B</PostFile><SuppressParserErrors>true</SuppressParserErrors>");
    assert_eq!(lines(&text, &job(vec![])), ["<A> & B"]);
}

#[test]
fn a_byte_order_mark_and_any_line_ends_are_fine() {
    let text =
        format!("\u{feff}{}", bare("<MOP>M7\r\nM8\n{$blocks}</MOP>").replace("<MOP>{$blocks}</MOP>", ""));
    assert_eq!(lines(&text, &job(vec![])), ["M7", "M8", "G0 Z5.0", "G0 X0.0 Y0.0"]);
}

#[test]
fn an_unknown_element_is_a_warning() {
    let written = output(&bare("<Wobble>1</Wobble>"), &job(vec![]), &PostOptions::default()).unwrap();
    assert_eq!(
        texts(&written.warnings),
        [
            "3: PB752 <Wobble> is not an element of CamBam definitions and is ignored (correct its name, or remove it)"
        ]
    );
}

#[test]
fn a_repeated_element_is_a_warning_and_the_last_one_holds() {
    let text = bare("<G0>G00</G0>\n<G0>G000</G0>");
    let written = output(&text, &job(vec![]), &PostOptions::default()).unwrap();
    assert_eq!(
        texts(&written.warnings),
        ["4: PB752 <G0> occurs again; the last one applies (keep only one of them)"]
    );
    assert_eq!(lines(&text, &job(vec![]))[0], "G000 Z5.0");
    // Both names of one setting.
    let axes = |second: &str| {
        let text = bare(&format!("<AxisOfSpin>X</AxisOfSpin>\n{second}"));
        texts(&output(&text, &job(vec![]), &PostOptions::default()).unwrap().warnings)
    };
    assert!(axes("<AxisOfRotation>Y</AxisOfRotation>")[0].contains("PB752 <AxisOfRotation> occurs again"));
    assert_eq!(axes("<RotaryAxis>A</RotaryAxis>"), [""; 0]);
}

#[test]
fn an_option_with_a_wrong_value_is_an_error_with_its_line() {
    let text = definition("\n<UpperCase>perhaps</UpperCase>\n<ArcToLinesTolerance>0</ArcToLinesTolerance>");
    let expected = [
        "4: PB750 UpperCase is \"perhaps\", but must be true or false",
        "5: PB750 ArcToLinesTolerance is \"0\", but must be a number above 0",
    ];
    assert_eq!(texts(&read(&text).unwrap_err()), expected);
}

/// `/` is no comment: controls skip such a line only while block delete is switched on.
#[test]
fn a_slash_is_no_mark_of_comments() {
    let refused = |mark: &str| {
        read(&definition(&format!("<Comment>{mark}</Comment>"))).map(drop).map_err(|it| texts(&it))
    };
    assert!(refused("/").unwrap_err()[0].contains("PB750 Comment is \"/\""));
    assert_eq!(refused("//"), Ok(()));
    assert_eq!(refused("("), Ok(()));
}

#[test]
fn an_unknown_macro_is_an_error_with_its_line_and_the_nearest_name() {
    let text = definition(
        "<Footer>M5\nM9 {$spindel(off)}\n{$endrewin}</Footer>\n<DrillPeck>{$gabagool}</DrillPeck>",
    );
    let expected = [
        "4: PB751 unknown macro {$spindel(off)} in Footer (did you mean {$spindle}?)",
        "5: PB751 unknown macro {$endrewin} in Footer (did you mean {$endrewind}?)",
        "6: PB751 unknown macro {$gabagool} in DrillPeck (define it as \"$name=value\" in PostProcessorMacros or in the configuration)",
    ];
    assert_eq!(errors(&text, &job(vec![])), expected);
}

#[test]
fn a_macro_with_wrong_arguments_is_an_error() {
    let text = definition("<Footer>{$spindle(left)} {$x(1)} {$set(q,1)} {$check(1,2)}</Footer>");
    let expected = [
        "3: PB750 {$spindle(left)} in Footer has the wrong arguments; it takes nothing, up, cw, ccw or off",
        "3: PB750 {$x(1)} in Footer has the wrong arguments; it takes no arguments",
        "3: PB750 {$set(q,1)} in Footer has the wrong arguments; it takes x, y or z and a number or NaN, or tool",
        "3: PB750 {$check(1,2)} in Footer has the wrong arguments; it takes three coordinates",
    ];
    assert_eq!(texts(&read(&text).unwrap_err()), expected);
}

#[test]
fn a_macro_that_is_not_closed_is_an_error() {
    assert_eq!(
        texts(&read(&definition("<Footer>{$x</Footer>")).unwrap_err()),
        ["3: PB750 a macro in Footer is not closed (close it with \"}\")"]
    );
}

#[test]
fn what_is_no_definition_is_refused() {
    assert_eq!(
        texts(&read("<Other/>").unwrap_err()),
        [
            "PB750 the file contains <Other>, not <PostProcessor> (name a CamBam definition, a file whose first element is <PostProcessor>)"
        ]
    );
    assert_eq!(read("<PostProcessor>").unwrap_err()[0].code().to_string(), "PB750");
    let bytes = b"<PostProcessor>\xE4</PostProcessor>";
    let refused = pathbuild_post::PostDefinition::read(bytes, "x.cbpp".into()).unwrap_err();
    assert_eq!(
        refused[0].text(Lang::En),
        "the definition is not UTF-8 text: this line has a character in another encoding, such as ANSI"
    );
    // The file has CamBam's extension, so its text is parsed as XML and not as TOML.
    assert_eq!(read("").unwrap_err()[0].code().to_string(), "PB750");
    assert_eq!(read("[post]\n").unwrap_err()[0].code().to_string(), "PB750");
}

#[test]
fn entities_that_multiply_are_refused() {
    let text = "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\">]><PostProcessor>&b;</PostProcessor>";
    assert_eq!(read(text).unwrap_err()[0].code().to_string(), "PB750");
}

fn macros(pairs: &[(&str, &str)]) -> PostOptions<'static> {
    let macros =
        pairs.iter().map(|&(name, value)| PostMacro { name: name.into(), value: value.into() }).collect();
    PostOptions { macros, ..PostOptions::default() }
}

#[test]
fn the_configuration_s_macros_win_over_the_post_s() {
    let text = definition(
        "<PostFile>O{$o} {$p2}</PostFile><PostProcessorMacros>\n$o=1\n$p2=2\n</PostProcessorMacros>",
    );
    assert_eq!(lines(&text, &job(vec![])), ["O1 2"]);
    assert_eq!(lines_with(&text, &job(vec![]), &macros(&[("o", "1234")])), ["O1234 2"]);
}

#[test]
fn a_macro_of_the_configuration_needs_no_definition_in_the_post() {
    let text = definition("<PostFile>O{$o}</PostFile>");
    assert_eq!(lines_with(&text, &job(vec![]), &macros(&[("o", "7")])), ["O7"]);
}

#[test]
fn lines_that_define_no_macro_and_built_in_names_are_warnings() {
    let text = bare("<PostProcessorMacros>o=1\n$x=2</PostProcessorMacros>");
    let written = output(&text, &job(vec![]), &PostOptions::default()).unwrap();
    let expected = [
        "3: PB752 \"o=1\" defines no macro and is ignored (define a macro as $name=value)",
        "4: PB752 $x is built in; its definition is ignored (give your macro another name)",
    ];
    assert_eq!(texts(&written.warnings), expected);
}

/// Returns macros of which each contains the next one: `$a1` contains `$a2`, and so on; the last one contains M0.
fn chain(length: usize) -> String {
    let link = |index: usize| format!("$a{index}={{$a{}}}\n", index + 1);
    let links: String = (1..length).map(link).collect();
    definition(&format!(
        "<PostFile>{{$a1}}</PostFile><PostProcessorMacros>{links}$a{length}=M0</PostProcessorMacros>"
    ))
}

#[test]
fn macros_may_contain_each_other_sixteen_deep() {
    assert_eq!(lines(&chain(16), &job(vec![])), ["M0"]);
    let expected = "PB753 PostProcessorMacros contains itself, or macros are nested more than 16 levels deep \
             (remove the macro that leads back to PostProcessorMacros, or nest macros less deeply)";
    assert_eq!(errors(&chain(17), &job(vec![])), [expected]);
}

#[test]
fn the_program_is_no_part_of_itself() {
    let within = "this section is itself part of the text that";
    let found = errors(&definition("<MOP>{$mops}</MOP>"), &job(vec![]));
    assert!(found[0].contains(&format!("PB753 {{$mops}} in MOP: {within} {{$mops}} inserts")), "{found:?}");
    let text = "<PostFile>{$mops}</PostFile><MOP>{$blocks}</MOP><FeedMove>{$blocks}</FeedMove>";
    let found = errors(&definition(text), &job(vec![feed(1.0, 0.0, -1.0)]));
    assert!(found[0].contains(&format!("PB753 {{$blocks}} in FeedMove: {within}")), "{found:?}");
}

#[test]
fn lathes_are_refused() {
    let values = [
        ("ClearancePlaneAxis", "X", "Z"),
        ("LatheXMode", "Diameter", "Radius"),
        ("LatheToolRadiusOffset", "true", "false"),
    ];
    for (option, lathe, mill) in values {
        let element = |value: &str| definition(&format!("<{option}>{value}</{option}>"));
        let errors = read(&element(lathe)).map(drop).unwrap_err();
        assert!(texts(&errors)[0].contains("PB750") && texts(&errors)[0].contains(option), "{errors:?}");
        assert!(read(&element(mill)).is_ok(), "{option}");
    }
}

#[test]
fn an_element_within_a_text_is_a_warning() {
    let text = definition("<PostFile>{$mops}<b>x</b></PostFile><Notes><i>y</i></Notes>");
    let post = read(&text).unwrap();
    let options = PostOptions { unchecked: true, ..PostOptions::default() };
    let warnings = texts(&post.write(&job(vec![]), &options).unwrap().warnings);
    let expected = [
        "3: PB752 <b> is within <PostFile>, which contains text only; it is ignored (write < as &lt; if it belongs to the text, otherwise move the element out of <PostFile>)",
        "3: PB752 <i> is within <Notes>, which contains text only; it is ignored (write < as &lt; if it belongs to the text, otherwise move the element out of <Notes>)",
    ];
    assert_eq!(warnings[..2], expected, "{warnings:?}");
}

#[test]
fn sections_that_contain_themselves_are_an_error() {
    let text = definition("<PostFile>{$header}</PostFile><Header>{$header}</Header>");
    assert_eq!(
        errors(&text, &job(vec![])),
        ["PB753 Header contains itself, or macros are nested more than 16 levels deep \
             (remove the macro that leads back to Header, or nest macros less deeply)"]
    );
}

#[test]
fn macros_that_multiply_come_to_an_end() {
    let link =
        |index: usize| vec![format!("$a{index}="), format!("{{$a{}}}", index + 1).repeat(10), "\n".into()];
    let links: String = (1..15).flat_map(link).collect();
    let text = definition(&format!(
        "<PostFile>{{$a1}}</PostFile><PostProcessorMacros>{links}$a15=\n</PostProcessorMacros>"
    ));
    assert_eq!(errors(&text, &job(vec![]))[0][..5], *"PB753");
}

#[test]
fn a_value_that_the_program_lacks_is_an_error() {
    let text = definition("<PostFile>\n{$stock_x} {$tool.length}</PostFile>");
    let found = errors(&text, &job(vec![]));
    assert!(found[0].starts_with("4: PB754 {$stock_x} in PostFile has no value in mill (write "));
    let unnumbered = errors(&definition("<PostFile>{$program.number}</PostFile>"), &job(vec![]));
    assert!(unnumbered[0].ends_with("(set `program-number` in [post] of pathbuild.toml)"), "{unnumbered:?}");
}

#[test]
fn the_command_of_a_post_is_handed_out_only_when_it_will_be_run() {
    let command = "<PostBuildCommand>\"C:\\my tools\\x.bat\"</PostBuildCommand>\
                   <PostBuildCommandArgs>-f \"{$outfile}\" {$cbfile.name}</PostBuildCommandArgs>";
    let options = PostOptions { output: Some("a b.nc".into()), ..PostOptions::default() };
    let skipped = output(&bare(command), &job(vec![]), &options).unwrap();
    assert_eq!(skipped.post_build, None);
    let note =
        "the post's command \"C:\\my tools\\x.bat -f a b.nc part\" was not run; --run-post-build runs it";
    assert_eq!(skipped.notes[0].text(Lang::En), note);
    let run = output(&bare(command), &job(vec![]), &PostOptions { run_post_build: true, ..options }).unwrap();
    assert_eq!(run.post_build.unwrap(), ["C:\\my tools\\x.bat", "-f", "a b.nc", "part"]);
    assert!(run.notes.iter().all(|note| !note.text(Lang::En).contains("was not run")));
    let unknown = command.replace("{$cbfile.name}", "{$mine}");
    let expected = "PB751 unknown macro {$mine} in PostBuildCommandArgs (use one of {$outfile}, {$cbfile.name}: a command has no other macros)";
    assert_eq!(errors(&bare(&unknown), &job(vec![])), [expected]);
}

#[test]
fn an_empty_program_is_refused() {
    let empty = pathbuild_post::Job::default();
    assert_eq!(
        errors(&bare(""), &empty),
        [
            "PB765 the program mills nothing: there is nothing to write (check that this is the right file, and that it is complete)"
        ]
    );
    let at = |x| [x, 0.0, 0.0];
    let arc = |from, centre, to, feed| arc(false, [from, 0.0, 0.0], [centre; 2], [0.0, to, 0.0], feed);
    let nan = f64::NAN;
    for broken in [
        feed(nan, 0.0, 0.0),
        JobStep::feed(at(1.0), Some(nan)),
        JobStep::rapid(at(f64::INFINITY)),
        JobStep::Dwell { seconds: nan },
        arc(nan, 0.0, 1.0, None),
        arc(1.0, nan, 1.0, None),
        arc(1.0, 0.0, nan, None),
        arc(1.0, 0.0, 1.0, Some(nan)),
    ] {
        let found = errors(&bare(""), &job(vec![broken]));
        assert_eq!(
            found,
            [
                "PB765 mill has a coordinate or feed that is not a number (look for values in the program that are far too large, or divided by 0)"
            ]
        );
    }
}

/// A post with the macro waits for the spindle; one without it gets a note.
#[test]
fn a_wait_for_the_spindle_that_is_not_written_is_noted() {
    let notes = |elements: &str, spin_up| {
        let options = PostOptions { spin_up, ..PostOptions::default() };
        let output = output(&bare(elements), &job(vec![]), &options).unwrap();
        output.notes.iter().any(|note| note.text(Lang::En).contains("has no {$spindle(up)}"))
    };
    let switched = "<ToolChange>{$spindle} {$s}</ToolChange><MOP>{$toolchange}{$blocks}</MOP>";
    let waits = "<ToolChange>{$spindle} {$s} {$spindle(up)}</ToolChange><MOP>{$toolchange}{$blocks}</MOP>";
    let found = [notes(switched, 2.0), notes(switched, 0.0), notes(waits, 2.0), notes("", 2.0)];
    assert_eq!(found, [true, false, false, false]);
}

#[test]
fn real_definitions_run_unchanged() {
    let names = [
        "dialog-mei-tech",
        "grbl-okkcnc",
        "linuxcnc-touchoff",
        "linuxcnc-touchoff-win7",
        "pastebin-g43-linenumbers",
    ];
    for name in names {
        let Some(text) = shared(&format!("posts/{name}.cbpp")) else { return };
        let written = lines(&text, &job(vec![feed(0.0, 0.0, -1.0), feed(10.0, 0.0, -1.0)]));
        assert!(written.iter().any(|line| line.contains("X10.0")), "{name}: {written:#?}");
    }
}
