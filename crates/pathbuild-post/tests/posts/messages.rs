//! Tests messages about definitions: which text produced a line, why a value is missing, and which texts are doubtful.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_motion::Turning;
use pathbuild_post::{Job, PostDefinition, PostOptions, Units};

use crate::support::{DIN, arc, bare, definition, feed, job, rapid, read, read_toml, texts};

fn notes(found: &[Diagnostic]) -> Vec<String> {
    found.iter().flat_map(|found| found.notes.iter().map(|note| note.text(Lang::En))).collect()
}

fn milled() -> Job {
    let mut job =
        job(vec![rapid(0.0, 0.0, 5.0), feed(0.0, 0.0, -1.0), feed(9.0, 0.0, -1.0), rapid(9.0, 0.0, 5.0)]);
    (job.operations[0].spindle, job.operations[0].speed) = (Some(Turning::Clockwise), Some(1000.0));
    job
}

#[test]
fn a_finding_names_the_text_that_wrote_the_line() {
    let text = bare("<Rapid/>\n<FeedMove>\n{$_g1} {$_f}\n  {$_x} {$_y}\n</FeedMove>");
    let found = read(&text).unwrap().write(&milled(), &PostOptions::default()).unwrap_err();
    assert!(
        notes(&found).iter().any(|note| note.starts_with("the line comes from FeedMove, line ")),
        "{:?}",
        notes(&found)
    );
    let text = DIN.replace("line = 'G01 X{+~X1~}", "line = 'G01 X{+~X1~+1}");
    let line = 1 + text.lines().position(|line| line.starts_with("line =")).expect("the text");
    let options = PostOptions { dialect: Some("linuxcnc".into()), ..PostOptions::default() };
    let found = read_toml(&text).write(&milled(), &options).unwrap_err();
    let expected = format!("the line comes from line, line {line} of the definition");
    assert!(notes(&found).contains(&expected), "{:?}", notes(&found));
    // A default text has no line.
    let found = read(&definition("<Dialect>grbl</Dialect>"))
        .unwrap()
        .write(&milled(), &PostOptions::default())
        .unwrap_err();
    assert!(
        notes(&found).contains(
            &"the line comes from the default text of ToolChange, which the definition does not contain"
                .into()
        ),
        "{:?}",
        notes(&found)
    );
}

#[test]
fn a_variable_that_exists_has_a_reason_for_having_no_value() {
    let without = |line: &str| {
        let text = DIN.replace("(tool ~ToolName~", &format!("{line} ~ToolName~"));
        let mut job = milled();
        job.operations[0].speed = None;
        texts(&read_toml(&text).write(&job, &PostOptions::default()).unwrap_err())[0].clone()
    };
    assert!(
        without("").contains("MillingSpindleRate has no value here: the tool has no spindle speed"),
        "{}",
        without("")
    );
    assert!(without("(~Date~)").contains("Date has no value here: --date is not given"));
    assert!(without("(~XC~)").contains("XC has no value here: it has a value only in the text arc"));
    assert!(
        without("(~MilingSpindleRate~)").contains("did you mean MillingSpindleRate?"),
        "one that there is not"
    );
}

#[test]
fn texts_have_a_form_and_are_no_numbers() {
    let head = |statement: &str| {
        let text =
            DIN.replace("'G17 G21 G90'", &format!("'({statement})\nG17 G21 G90'").replace('\'', "\'\'\'"));
        read_toml(&text)
            .write(&milled(), &PostOptions::default())
            .map(|output| String::from_utf8(output.text).unwrap().lines().next().unwrap_or("").to_owned())
    };
    assert_eq!(head("{s ~PrgName~}").unwrap(), "(part)");
    assert_eq!(head("{6s ~PrgName~}").unwrap(), "(  part)");
    assert_eq!(head("{-6s ~PrgName~}.").unwrap(), "(part  .)");
    for number in ["{#~PrgName~}", "{~PrgName~+1}", "{f ~PrgName~}"] {
        let errors = texts(&head(number).unwrap_err());
        assert!(errors[0].contains("\"part\" is a text, not a number"), "{number}: {errors:?}");
    }
}

#[test]
fn a_helix_without_z_is_mended_in_the_text_of_arcs() {
    let arc = arc(false, [9.0, 0.0, -1.0], [0.0; 2], [-9.0, 0.0, -2.0], Some(100.0));
    let mut job = milled();
    job.operations[0].steps = vec![rapid(9.0, 0.0, 5.0), feed(9.0, 0.0, -1.0), arc, rapid(-9.0, 0.0, 5.0)];
    let flat = |text: &str| DIN.replace(text, text.strip_suffix(" Z{+~Z1~}").unwrap_or(text));
    let both = flat("arc = '{?~ArcDir~{$G03}{$G02}} X{+~X1~} Y{+~Y1~} Z{+~Z1~}");
    let both = both.replace("line = 'G01 X{+~X1~} Y{+~Y1~} Z{+~Z1~}", "line = 'G01 X{+~X1~} Y{+~Y1~}");
    let found = texts(&read_toml(&both).write(&job, &PostOptions::default()).unwrap_err());
    assert!(found[0].contains("the text `arc` has no ~Z1~"), "{found:?}");
    let with_line = flat("arc = '{?~ArcDir~{$G03}{$G02}} X{+~X1~} Y{+~Y1~} Z{+~Z1~}");
    assert!(read_toml(&with_line).write(&job, &PostOptions::default()).is_ok(), "lines have Z");
    // Without a text for arcs, the helix is written as lines.
    let lines_only = both.lines().filter(|line| !line.starts_with("arc = ")).collect::<Vec<_>>().join("\n");
    let found = texts(&read_toml(&lines_only).write(&job, &PostOptions::default()).unwrap_err());
    assert!(found[0].contains("has no ~Z1~") && !found[0].contains("the text `arc`"), "{found:?}");
}

#[test]
fn doubtful_options_and_bare_macros_are_told() {
    let warnings = |file: &str, text: &str| {
        let post = PostDefinition::read(text.as_bytes(), Utf8Path::new(file));
        post.and_then(|post| {
            post.write(&milled(), &PostOptions { unchecked: true, ..PostOptions::default() })
        })
        .map_or_else(|errors| texts(&errors), |output| texts(&output.warnings))
    };
    for (format, is_coarse) in [("0", true), ("#", true), ("0.0", true), ("0.00", false), ("0.##", false)] {
        let found = warnings("t.cbpp", &definition(&format!("<NumberFormat>{format}</NumberFormat>")));
        assert_eq!(
            found.iter().any(|it| it.contains("PB752 NumberFormat")),
            is_coarse,
            "{format}: {found:?}"
        );
    }
    for (decimals, is_coarse) in [(0, true), (1, true), (2, false)] {
        let found = warnings("t.toml", &DIN.replace("[text]", &format!("decimals = {decimals}\n[text]")));
        assert_eq!(found.iter().any(|it| it.contains("PB752 decimals")), is_coarse, "{decimals}: {found:?}");
    }
    let bare = warnings("t.cbpp", &definition("<Header>{units} {$distancemode}</Header>"));
    assert!(bare[0].contains("PB751 {units} in Header") && bare[0].contains("{$units}"), "{bare:?}");
    assert_eq!(
        warnings(
            "t.cbpp",
            &definition("<Header>{$units} {own}</Header><SuppressParserErrors>true</SuppressParserErrors>")
        ),
        Vec::<String>::new()
    );
    let open = warnings("t.cbpp", &definition("<Header>{$tool.length}</Header>"));
    assert!(open[0].contains("PB754") && open[0].contains("under [macros]"), "{open:?}");
}

/// Writes `milled` with a line in the text of the tool change, in both languages of definitions. Returns the findings.
fn with_line(line: &str, setting: [&str; 2]) -> [Vec<Diagnostic>; 2] {
    let change = format!("<ToolChange>T{{$tool.index}}\nM6\n{line}\n{line}\nS1000 M3</ToolChange>");
    let cbpp = definition(&format!(
        "<PostFile>G17 G21 G90\n{{$mops}}\nM5\nM30</PostFile><MOP>{{$toolchange}}\n{{$blocks}}</MOP>{change}{}",
        setting[0]
    ));
    let toml = DIN
        .replace("T{#~MachineToolNo~} S", &format!("T{{#~MachineToolNo~}} M06\n{line}\n{line}\nS"))
        .replace("'M30'", "'''M05\nM30'''")
        .replace("[text]", &format!("{}\n[text]", setting[1]));
    [read(&cbpp).unwrap(), read_toml(&toml)].map(|post| {
        match post.write(&milled(), &PostOptions::default()) {
            Ok(output) => output.warnings,
            Err(errors) => errors,
        }
    })
}

/// Both kinds of definitions are read back by the same rules if no dialect is named.
#[test]
fn a_line_that_is_no_gcode_is_a_warning_in_both_languages() {
    for line in ["CALL PGM X", "$H", "$32=0", "TRAORI", "HELLO"] {
        for found in with_line(line, ["", ""]) {
            let found = texts(&found);
            assert_eq!(found.len(), 1, "once is enough: {found:?}");
            assert!(found[0].contains(&format!("PB758 the post writes \"{line}\"")), "{found:?}");
        }
    }
    for line in [":10", "M0", "(HELLO)"] {
        for found in with_line(line, ["", ""]) {
            assert_eq!(texts(&found), [""; 0], "{line}");
        }
    }
    let suppressed = ["<SuppressParserErrors>true</SuppressParserErrors>", "suppress-parser-errors = true"];
    for found in with_line("HELLO", suppressed) {
        assert_eq!(texts(&found), [""; 0]);
    }
}

/// Some controls end a line at a CR and run what follows, even in a comment. Without `)`, a comment may end anywhere.
#[test]
fn a_comment_ends_in_its_line() {
    let written = |comment: &str| {
        let toml = DIN.replace("'G17 G21 G90'", &format!("'G17 G21 G90 {comment}'"));
        match read_toml(&toml).write(&milled(), &PostOptions::default()) {
            Ok(output) => texts(&output.warnings),
            Err(errors) => texts(&errors),
        }
    };
    for (comment, finding) in [
        (r"(x)", ""),
        (r"(x)\\\~0D", ""),
        (r"(x\\\~0DG0 Z-5)", "PB767 line 1 "),
        (r"(x)\\\~0DM0", "PB767 line 1 "),
        ("; x", ""),
        ("(x", "PB752 the output contains (,"),
    ] {
        let found = written(comment);
        let is_right = if finding.is_empty() { found.is_empty() } else { found[0].contains(finding) };
        assert!(is_right, "{comment}: {found:?}");
    }
}

#[test]
fn a_word_that_sets_a_zero_is_a_warning_in_both_languages() {
    for (line, word) in [("G10 L2 P1 X5", "G10"), ("G10 L20 P2 X5", "G10"), ("G92 X5 Y0 Z0\nG92.1", "G92")] {
        for found in with_line(line, ["", ""]) {
            let expected = format!("PB752 the output sets a zero of the machine with {word}");
            assert!(texts(&found).iter().any(|text| text.contains(&expected)), "{line}: {:?}", texts(&found));
        }
    }
    for line in ["G10 L2 P1 X5 R3", "G10 P1 R3", "G10 L1 P1 Z5"] {
        for found in with_line(line, ["", ""]) {
            assert!(texts(&found)[0].contains("PB767"), "{line}: {:?}", texts(&found));
        }
    }
    for line in ["G54", "G92.1", "G52 X0 Y0 Z0"] {
        for found in with_line(line, ["", ""]) {
            assert_eq!(texts(&found), [""; 0], "{line}");
        }
    }
}

#[test]
fn a_word_without_a_known_effect_is_a_warning_even_alone_in_its_line() {
    for (line, word) in [("D2", "D"), ("E1", "E"), ("M49", "M49"), ("M42", "M42")] {
        for found in with_line(line, ["", ""]) {
            let expected = format!("PB752 the output contains {word},");
            assert!(texts(&found).iter().any(|text| text.contains(&expected)), "{line}: {:?}", texts(&found));
        }
    }
    for found in with_line("M48", ["", ""]) {
        assert_eq!(texts(&found), [""; 0]);
    }
}

/// Without G90.1 every control takes I and J for distances from the start of the arc.
#[test]
fn absolute_centres_must_be_stated_in_both_languages() {
    let mut job = milled();
    let quarter = arc(false, [9.0, 0.0, -1.0], [9.0, 10.0], [19.0, 10.0, -1.0], Some(100.0));
    job.operations[0].steps.insert(3, quarter);
    job.operations[0].steps[4] = rapid(19.0, 10.0, 5.0);
    let cbpp = |start: &str, mode: &str| {
        read(&definition(&format!(
            "<PostFile>G17 G21 G90 {start}\n{{$mops}}\nM5\nM30</PostFile>\
             <MOP>{{$toolchange}}\nS1000 M3\n{{$blocks}}</MOP><ArcCenterMode>{mode}</ArcCenterMode>"
        )))
        .unwrap()
    };
    let toml = |start: &str, centre: [&str; 2]| {
        let text = DIN
            .replace("G17 G21 G90", &format!("G17 G21 G90 {start}"))
            .replace("'M30'", "'''M05\nM30'''")
            .replace("T{#~MachineToolNo~}", "T{#~MachineToolNo~} M06\n");
        read_toml(&text.replace("~IRel~", centre[0]).replace("~JRel~", centre[1]))
    };
    let (absolute, relative) = (["~XC~", "~YC~"], ["~IRel~", "~JRel~"]);
    let result = |post: PostDefinition, dialect: &str| {
        let dialect = Some(dialect.into()).filter(|_| !dialect.is_empty());
        post.write(&job, &PostOptions { dialect, ..PostOptions::default() })
            .map_err(|errors| (texts(&errors), notes(&errors)))
    };
    for post in [cbpp("", "Absolute"), toml("", absolute), toml("G91.1", absolute)] {
        for dialect in ["", "linuxcnc"] {
            let found = result(post.clone(), dialect).unwrap_err();
            assert!(found.1.iter().any(|note| note.contains("but G90.1 is missing")), "{found:?}");
        }
    }
    for post in [
        cbpp("{$arccentermode}", "Absolute"),
        cbpp("", "Incremental"),
        toml("G90.1", absolute),
        toml("", relative),
    ] {
        result(post, "").unwrap_or_else(|errors| panic!("{errors:?}"));
    }
}

/// Two decimals are precise enough in mm, but in inches they round by up to 0.127 mm.
#[test]
fn rounding_is_judged_in_millimetres() {
    let found = |post: PostDefinition, job: &Job| match post.write(job, &PostOptions::default()) {
        Ok(output) => texts(&output.warnings),
        Err(errors) => texts(&errors),
    };
    let codes = |found: &[String]| {
        assert!(!found.iter().any(|text| text.contains("PB767")), "{found:?}");
        let codes = found.iter().filter(|text| text.contains("which rounds coordinates"));
        codes.map(|text| text.split("PB").nth(1).unwrap()[..3].to_owned()).collect::<Vec<_>>().join(" ")
    };
    for (unit, decimals, code) in [
        ("mm", 2, ""),
        ("mm", 1, "752"),
        ("mm", 0, "750"),
        ("inch", 4, ""),
        ("inch", 3, "752"),
        ("inch", 2, "750"),
        ("inch", 1, "750"),
    ] {
        let words = if unit == "mm" { "G21" } else { "G20" };
        let texts = DIN.replace("G21", words).replace("F{#", "F{+");
        let post =
            read_toml(&texts.replace("[text]", &format!("decimals = {decimals}\nunits = '{unit}'\n[text]")));
        let found_in = found(post, &milled());
        assert_eq!(codes(&found_in), code, "{unit}, {decimals}: {found_in:?}");
        let format = format!("<NumberFormat>0.{}</NumberFormat>", "0".repeat(decimals));
        let units = if unit == "mm" { Units::Millimetres } else { Units::Inches };
        let found_in = found(read(&definition(&format)).unwrap(), &Job { units, ..milled() });
        assert_eq!(codes(&found_in), code, "{unit}, {format}: {found_in:?}");
    }
    let unstated = read_toml(
        &DIN.replace("G21", "G20").replace("F{#", "F{+").replace("[text]", "units = 'inch'\n[text]"),
    );
    let found_in = found(unstated, &milled());
    assert!(
        found_in[0].starts_with("PB752 decimals is \"3\", which rounds coordinates by up to 0.013 mm"),
        "{found_in:?}"
    );
}

/// Lines are at most 0.05 mm from the arc that they replace. Who permits more is told so.
#[test]
fn a_permitted_distance_from_arcs_that_is_not_used_is_reported() {
    let is_limited = |post: PostDefinition, job: &Job| {
        let warnings = texts(&post.write(job, &PostOptions::default()).unwrap().warnings);
        let limited =
            warnings.iter().find(|it| it.contains("that replace arcs are nevertheless at most 0.05 mm away"));
        limited.inspect(|text| assert!(text.contains("PB752"), "{text}")).cloned()
    };
    let cambam = |units: Units, distance: &str| {
        let post = definition(&format!("<ArcToLinesTolerance>{distance}</ArcToLinesTolerance>"));
        is_limited(read(&post).unwrap(), &Job { units, ..milled() })
    };
    let cad6 = |distance: &str| {
        is_limited(
            read_toml(&DIN.replace("[text]", &format!("arc-tolerance = {distance}\n[text]"))),
            &milled(),
        )
    };
    for (is_reported, found) in [
        (false, cambam(Units::Millimetres, "0.05")),
        (true, cambam(Units::Millimetres, "0.051")),
        (false, cambam(Units::Inches, "0.0019")),
        (true, cambam(Units::Inches, "0.002")),
        (false, cad6("0.05")),
        (true, cad6("0.051")),
    ] {
        assert_eq!(found.is_some(), is_reported, "{found:?}");
    }
    let unstated = is_limited(read(&definition("")).unwrap(), &milled());
    assert_eq!(unstated, None);
    assert!(cad6("0.5").unwrap().contains("arc-tolerance is \"0.5\""));
}

#[test]
fn ends_of_lines_may_have_signs_in_front() {
    let end = |end: &str| {
        let text = bare("")
            .replace("<EndOfLine>\\n</EndOfLine>", "")
            .replace("\n</PostProcessor>", &format!("<EndOfLine>{end}</EndOfLine></PostProcessor>"));
        let post = read(&text)?;
        post.write(&milled(), &PostOptions { unchecked: true, ..PostOptions::default() })
    };
    for (text, expected) in [("\\r\\n", "\r\n"), (" *\\r\\n", " *\r\n"), (";\\n", ";\n")] {
        let output = end(text).unwrap_or_else(|errors| panic!("{text}: {:?}", texts(&errors)));
        let first = String::from_utf8(output.text).unwrap();
        let first = first.split_inclusive('\n').next().unwrap();
        assert!(first.ends_with(expected), "{text:?}: {first:?}");
    }
    for wrong in ["*", "M0\\n", "\\n\\n\\n", ""] {
        assert!(end(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn utf_16_is_read_and_ansi_is_refused_with_advice() {
    let text = bare("<Notes>für die Fräse</Notes>");
    let wide = |mark: bool, unit: fn(u16) -> [u8; 2]| -> Vec<u8> {
        let mark = mark.then_some(0xFEFF);
        mark.into_iter().chain(text.encode_utf16()).flat_map(unit).collect()
    };
    for bytes in [
        wide(true, u16::to_le_bytes),
        wide(true, u16::to_be_bytes),
        wide(false, u16::to_le_bytes),
        wide(false, u16::to_be_bytes),
    ] {
        assert!(PostDefinition::read(&bytes, Utf8Path::new("t.cbpp")).is_ok());
    }
    let ansi: Vec<u8> = text.chars().map(|c| u8::try_from(c).unwrap()).collect();
    let found = texts(&PostDefinition::read(&ansi, Utf8Path::new("t.cbpp")).unwrap_err());
    assert!(found[0].starts_with("3: PB750") && found[0].contains("save it as UTF-8"), "{found:?}");
}
