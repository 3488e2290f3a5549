//! Tests control texts: the examples of the manual, and every rule of the language.

use std::collections::BTreeMap;

use camino::Utf8Path;
use pathbuild_diagnostic::reasons::NO_FILE;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::{
    Hole, HoleKind, Job, JobStep, Output, PostDefinition, PostFiles, PostMacro, PostOptions, Units,
};

use crate::support::{arc, feed, job, operation, rapid, texts, unchecked};

/// The rectangle of the manual: from (50, 100), 100 x 50 mm, clockwise, safety height 100, depth 20.
const RECTANGLE: &str = r#"
[post]
name = "DIN"
decimals = 3
[text]
program-start = '''
{=LineNumber{10}}
%~PrgName~
G17 {?~Units~==2||~Units~==3{$G70}{$G71}} G90'''
tool-change = '''
T{#~MachineToolNo~} S{#~MillingSpindleRate~}
G00 G40 Z{+~ZClearance~}'''
contour-start = '''
G00 G40 X{+~X1~} Y{+~Y1~}
G00 Z{+~ZWorking~} {?~MillingSpindleDir~{$M04}{$M03}}
G01 Z{+~Z1~} F{#~LoweringVel~} {?~ToolControl1~{$M08}}'''
line = 'G01 X{+~X1~} Y{+~Y1~}{?~FirstContourElement~ {$ F{#~MovingVel~}}}'
contour-end = 'G00 Z{+~ZClearance~} M05{?~ToolControl1~{$ M09}}'
program-end = 'M30'
"#;

fn rectangle() -> Job {
    let cut = |x, y| JobStep::feed([x, y, -20.0], Some(400.0));
    let mut operation = operation(
        "rectangle",
        1,
        vec![
            rapid(50.0, 100.0, 100.0),
            rapid(50.0, 100.0, 5.0),
            JobStep::feed([50.0, 100.0, -20.0], Some(250.0)),
            cut(50.0, 150.0),
            cut(150.0, 150.0),
            cut(150.0, 100.0),
            cut(50.0, 100.0),
            rapid(50.0, 100.0, 100.0),
        ],
    );
    operation.entry = pathbuild_post::Entry::At([0.0, 0.0, 100.0]);
    operation.clearance = 100.0;
    operation.spindle = Some(Turning::Clockwise);
    operation.speed = Some(4000.0);
    operation.coolant = Some(Coolant::FLOOD);
    Job { name: "TEST-DIN-ISO".into(), operations: vec![operation], ..Job::default() }
}

fn output(definition: &str, job: &Job, options: &PostOptions<'_>) -> Result<Output, Vec<Diagnostic>> {
    unchecked(&PostDefinition::read(definition.as_bytes(), Utf8Path::new("test.toml"))?, job, options)
}

#[track_caller]
fn written(definition: &str, job: &Job) -> String {
    match output(definition, job, &PostOptions::default()) {
        Ok(output) => String::from_utf8(output.text).unwrap(),
        Err(diagnostics) => panic!("{}", texts(&diagnostics).join("\n")),
    }
}

#[test]
#[expect(clippy::disallowed_methods, reason = "it reads the books")]
fn the_manual_s_rectangle_comes_out_byte_for_byte() {
    let expected = "\
N10 %TEST-DIN-ISO
N20 G17 G71 G90
N30 T1 S4000
N40 G00 G40 Z+100
N50 G00 G40 X+50 Y+100
N60 G00 Z+5 M03
N70 G01 Z-20 F250 M08
N80 G01 X+50 Y+150 F400
N90 G01 X+150 Y+150
N100 G01 X+150 Y+100
N110 G01 X+50 Y+100
N120 G00 Z+100 M05 M09
N130 M30
";
    assert_eq!(written(RECTANGLE, &rectangle()), expected);
    // The books contain the same example.
    for lang in ["en", "de"] {
        let page =
            format!("{}/../../docs/{lang}/src/reference/post-definitions.md", env!("CARGO_MANIFEST_DIR"));
        let page = std::fs::read_to_string(page).unwrap();
        assert!(page.contains(&format!("```toml{RECTANGLE}```")), "{lang}: another definition");
        assert!(page.contains(&format!("```text\n{expected}```")), "{lang}: another program");
    }
}

/// Evaluates a text at the start of a program, with variables.
fn text_with(text: &str, variables: &[(&str, &str)]) -> Result<Output, Vec<Diagnostic>> {
    let definition =
        format!("[post]\nnumber-lines = false\ndecimals = 2\n[text]\nprogram-start = '''{text}'''");
    let macros =
        variables.iter().map(|&(name, value)| PostMacro { name: name.into(), value: value.into() }).collect();
    output(&definition, &job(vec![]), &PostOptions { macros, ..PostOptions::default() })
}

#[track_caller]
fn text(text: &str, variables: &[(&str, &str)]) -> String {
    match text_with(text, variables) {
        Ok(output) => String::from_utf8(output.text).unwrap(),
        Err(diagnostics) => panic!("{}", texts(&diagnostics).join("\n")),
    }
}

#[track_caller]
fn error(text: &str) -> String {
    texts(&text_with(text, &[("Q1", "5"), ("Q2", "~Q2~")]).unwrap_err()).join("\n")
}

#[test]
fn the_manual_s_tips() {
    let with_parentheses = [("Q1", "180.2543"), ("Q2", "100.0"), ("Q3", "(~Q1~-~Q2~)")];
    assert_eq!(text("X {,-~Q3~*2}", &with_parentheses), "X -160,51\n");
    let without = [("Q1", "180.2543"), ("Q2", "100.0"), ("Q3", "~Q1~-~Q2~")];
    assert_eq!(text("X {,-~Q3~*2}", &without), "X -380,25\n");
}

#[test]
fn increments_are_terms_in_parentheses() {
    let definition = "[post]\nnumber-lines = false\n[text]\nline = 'G1 X{.-~XIncr~*2} Z{.~Z1~}'";
    let steps = vec![feed(1.0, 0.0, 5.0), feed(3.5, 0.0, 5.0)];
    assert_eq!(written(definition, &job(steps)), "G1 X-2 Z5\nG1 X-5 Z5\n");
}

#[test]
fn operators_within_statements() {
    let examples = [
        ("2^^8*2", "512"),
        ("8/2*4", "16"),
        ("8+2*4", "16"),
        ("10-2/4", "9.5"),
        ("100^^0.5", "10"),
        ("24&15", "8"),
        ("16|8", "24"),
        ("24^31", "7"),
        ("(!12)", "0"),
    ];
    for (term, expected) in examples {
        assert_eq!(text(&format!("{{{term}}}"), &[]), format!("{expected}\n"), "{term}");
    }
}

#[test]
fn every_statement_has_its_result() {
    let examples = [
        ("{?1{$a}{$b}}", "a"),
        ("{?0{$a}{$b}}", "b"),
        ("{?0{$a}}-", "-"),
        ("{?2>1 {1} {2}}", "1"),
        ("{\"{$a}{$a} {$same}{$other}}", "same"),
        ("{\"{$a}{$b} {$same}{$other}}", "other"),
        ("{\"{$a}{$b}{$same}}-", "-"),
        ("{!Q9 {$missing}{$there}}", "missing"),
        ("{!Q1 {$missing}{$there}}", "there"),
        ("{$ a {$b} c}", " a b c"),
        ("{$}-", "-"),
        ("{*a {remark} here}-", "-"),
        ("{1/4}", "0.25"),
        ("{'1234.5}", "1,234.50"),
        ("{%1.005} {.1.005} {,1.005}", "1.01 1.01 1,01"),
        ("{+2} {&-2.5} {+0}", "+2 -2,5 +0"),
        ("{#2.5}", "3"),
        ("{8.2f 1.5}|{d 2.6}|{x 255}|{b 5}|{s 0.1}", "    1.50|3|ff|101|0.1"),
        ("{f 1.5} {g 1500}", "1.500000 1.500000e3"),
    ];
    for (statement, expected) in examples {
        assert_eq!(text(statement, &[("Q1", "5")]), format!("{expected}\n"), "{statement}");
    }
}

#[test]
fn variables_are_replaced_before_statements_run() {
    let assigned = "[post]\nnumber-lines = false\n[text]\nprogram-start = '{=Q1 {2}}a~Q1~'\nprogram-end = 'b~Q1~ {#~Q1~+1}'";
    let macros = vec![PostMacro { name: "Q1".into(), value: "1".into() }];
    let output = output(assigned, &job(vec![]), &PostOptions { macros, ..PostOptions::default() }).unwrap();
    assert_eq!(
        String::from_utf8(output.text).unwrap(),
        "a1\nb2 3\n",
        "a text sees what the one before it assigned"
    );
    let doubts = texts(&output.warnings);
    assert_eq!(doubts.len(), 1);
    assert!(
        doubts[0].starts_with("4: PB760 program-start, line 1, column 11: Q1 is assigned before this"),
        "{doubts:?}"
    );
}

#[test]
fn an_assignment_keeps_the_result_of_its_statement() {
    let both = "[post]\nnumber-lines = false\n[text]\nprogram-start = '{=Q1{$x{#1.6}}}{=Q2 {1+1}}'\nprogram-end = '~Q1~ ~Q2~'";
    assert_eq!(written(both, &job(vec![])), "x2 2\n");
}

#[test]
fn a_branch_that_is_not_taken_does_nothing() {
    let both = "[post]\nnumber-lines = false\n[text]\nprogram-start = '{=Q1{1}}'\ntool-change='{?0{=Q1{2}}}{?1{*}{=Q1{3}}}'\nline='{~Z1~}'\nprogram-end = '~Q1~'";
    assert_eq!(written(both, &job(vec![feed(1.0, 0.0, 5.0)])), "5\n1\n");
    assert_eq!(text("{!Q7 {$new}{#~Q7~+1}}", &[]), "new\n", "nor is a variable missed there");
    assert_eq!(text("{?0{1/0}{$fine}}", &[]), "fine\n");
}

#[test]
fn lines_that_come_out_blank_are_dropped_and_blank_lines_stay() {
    assert_eq!(text("a\n{?0{$x}}\n\n  {*}  \nb  \n~Q1~", &[("Q1", "")]), "a\n\nb\n");
    assert_eq!(text("a\n{$x\n\ny}", &[]), "a\nx\ny\n", "a statement stood in all of its lines");
}

#[test]
fn trailing_blanks_stay_on_demand() {
    let definition = "[post]\nnumber-lines = false\ntrim = false\n[text]\nprogram-start = 'a  '";
    assert_eq!(written(definition, &job(vec![])), "a  \n");
}

#[test]
fn escapes_stand_for_themselves() {
    assert_eq!(text(r"\~ \{ \} \\ \x", &[]), "~ { } \\ \\x\n");
    assert_eq!(text(r"{$\}\{\~}", &[]), "}{~\n");
    let bytes = text_with(r"\\\~1B\\\~ff.", &[]).unwrap().text;
    assert_eq!(bytes, b"\x1b\xff.\n");
    let cut = texts(&text_with(r"\\\~0x", &[]).unwrap_err());
    assert_eq!(cut, ["5: PB759 program-start, line 1, column 1: two hexadecimal digits are missing here"]);
}

#[test]
fn a_name_of_the_program_means_nothing_to_the_texts() {
    let mut job = job(vec![]);
    job.name = "~X1~{$a}\\".into();
    let definition = "[post]\nnumber-lines = false\n[text]\nprogram-start = '(~PrgName~)'";
    assert_eq!(written(definition, &job), "(-X1-{$a}/)\n", "nor to any control");
}

#[test]
fn lines_are_numbered_by_a_text_of_their_own() {
    let definition = |number: &str| {
        format!("[post]\n{number}\nprogram-start = 'a\n\n{{*}}\nb'")
            .replace("'a", "'''\na")
            .replace("b'", "b'''")
    };
    assert_eq!(written(&definition("[text]"), &job(vec![])), "N10 a\n\nN20 b\n");
    let own = "[text]\nline-number = 'L{#~LineNumber~}:{=LineNumber{#~LineNumber~+1}}'";
    assert_eq!(written(&definition(own), &job(vec![])), "L10:a\n\nL11:b\n");
    assert_eq!(written(&definition("number-lines = false\n[text]"), &job(vec![])), "a\n\nb\n");
}

#[test]
fn settings_hold() {
    let crlf = "[post]\nend-of-line = \"crlf\"\nextension = \".din\"\nnumber-lines = false\ndecimals = 1\nunits = \"inch\"\n[text]\nprogram-start = '{.~ZClearance~} {~Units~}'";
    let output = output(crlf, &job(vec![]), &PostOptions::default()).unwrap();
    assert_eq!((output.text.as_slice(), &*output.extension), (b"0.2 2\r\n".as_slice(), "din"));
    assert_eq!(written(&crlf.replace("crlf", "lf"), &job(vec![])), "0.2 2\n");
    assert!(PostDefinition::read(crlf.replace("crlf", "cr").as_bytes(), Utf8Path::new("t.toml")).is_err());
    let inches = Job { units: Units::Inches, ..job(vec![]) };
    assert_eq!(written(&crlf.replace("units = \"inch\"\n", ""), &inches), "0.2 2\r\n", "else the program's");
}

#[test]
fn aliases_are_other_names() {
    let definition = "[post]\nnumber-lines = false\n[alias]\nX1 = \"Xe\"\nLineNumber = \"Satz\"\n[text]\nline = 'X{.~Xe~} {.~Z1~}{=Satz{7}}'\nprogram-end = '~LineNumber~'";
    assert_eq!(written(definition, &job(vec![feed(2.0, 0.0, 5.0)])), "X2 5\n7\n");
    let unknown = PostDefinition::read(b"[alias]\nX9 = \"Xe\"", Utf8Path::new("t.toml")).unwrap();
    let warnings = texts(&unchecked(&unknown, &job(vec![]), &PostOptions::default()).unwrap().warnings);
    assert!(warnings[0].starts_with("2: PB760 pathbuild has no variable X9"), "{warnings:?}");
    for name in ["X e", "X~", ""] {
        let wrong =
            PostDefinition::read(format!("[alias]\nX1 = \"{name}\"").as_bytes(), Utf8Path::new("t.toml"));
        let errors = texts(&wrong.unwrap_err());
        assert!(
            errors[0].starts_with("2: PB750") && errors[0].contains("the name of a variable"),
            "{errors:?}"
        );
    }
}

#[test]
fn unknown_keys_are_errors_that_name_the_nearest() {
    let definition = "[post]\ndezimals = 3\n[text]\nprogramm-start = ''\n[other]\n";
    let expected = [
        "2: PB750 the key post.dezimals is unknown (did you mean decimals?)",
        "4: PB750 the key text.programm-start is unknown (did you mean program-start?)",
        "5: PB750 the key other is unknown (use one of post, text, alias)",
    ];
    let mut errors =
        texts(&PostDefinition::read(definition.as_bytes(), Utf8Path::new("t.toml")).unwrap_err());
    errors.sort();
    assert_eq!(errors, expected);
}

#[test]
fn wrong_values_and_broken_toml_are_errors_with_their_place() {
    let errors = |definition: &str| {
        texts(&PostDefinition::read(definition.as_bytes(), Utf8Path::new("t.toml")).unwrap_err())
    };
    assert_eq!(
        errors("[post]\ndecimals = 10"),
        ["2: PB750 decimals is \"10\", but must be a whole number up to 9"]
    );
    assert_eq!(errors("[post]\nunits = \"cm\""), ["2: PB750 units is \"cm\", but must be mm or inch"]);
    assert_eq!(errors("[text]\nline = 5"), ["2: PB750 line is \"5\", but must be a text"]);
    assert!(errors("[post\n")[0].starts_with("1: PB750 the definition cannot be read"));
}

#[test]
fn errors_say_where_in_the_text_and_in_the_file_they_are() {
    let definition = "[text]\nprogram-start = '''\nG90\nX{.~X1~+}\n'''";
    let post = PostDefinition::read(definition.as_bytes(), Utf8Path::new("t.toml")).unwrap();
    let macros = vec![PostMacro { name: "X1".into(), value: "123.456".into() }];
    let errors =
        unchecked(&post, &job(vec![]), &PostOptions { macros, ..PostOptions::default() }).unwrap_err();
    let expected =
        "4: PB759 program-start, line 2, column 9: the term ends where a value or \")\" is expected";
    assert_eq!(texts(&errors), [expected]);
    assert_eq!(errors[0].place.column, Some(9), "not moved by what the variable held");
    let shown = errors[0].text.as_ref().unwrap();
    assert_eq!((&*shown.text, shown.span()), ("X{.~X1~+}", 8..9));
}

#[test]
fn what_is_wrong_in_a_text_is_an_error() {
    let examples = [
        ("a~b", "PB759 program-start, line 1, column 2: \"~\" begins no variable"),
        ("~Q1", "PB759 program-start, line 1, column 1: \"~\" begins no variable"),
        ("~X9~", "PB751 program-start, line 1, column 1: there is no variable X9 here"),
        (
            "~Radios~",
            "PB751 program-start, line 1, column 1: there is no variable Radios here (did you mean Radius?",
        ),
        ("{.~X1~}", "PB751 program-start, line 1, column 3: X1 has no value here: no move has been made yet"),
        (
            "~Q2~",
            "PB753 program-start, line 1, column 1: variables in the text of Q2 are nested more than 32 levels deep",
        ),
        ("a}", "PB759 program-start, line 1, column 2: this brace closes nothing"),
        ("{$a", "PB759 program-start, line 1, column 4: a statement is not closed"),
        ("{*a", "PB759 program-start, line 1, column 1: a statement is not closed"),
        ("{1{2}}", "PB759 program-start, line 1, column 3: the statement must end here"),
        ("{?1}", "PB759 program-start, line 1, column 3: a statement in braces is expected here"),
        ("{?1 $a}", "PB759 program-start, line 1, column 3: a statement in braces is expected here"),
        ("{=1{2}}", "PB759 program-start, line 1, column 3: the name of a variable is expected here"),
        ("{=~Q1~{2}}", "PB759 program-start, line 1, column 3: the name of a variable is expected here"),
        ("{§1}", "PB759 program-start, line 1, column 1: statements with \"§\" are not supported"),
        ("{1/0}", "PB759 program-start, line 1, column 2: the term has no value"),
        (
            "{x 1.5}",
            "PB759 program-start, line 1, column 1: bitwise operators and binary formats need a whole number",
        ),
        ("{1,5}", "PB759 program-start, line 1, column 3: \",\" is not expected here"),
        (r"\\\~*a", "PB759 program-start, line 1, column 1: the name of the file to insert does not end"),
    ];
    for (text, expected) in examples {
        let error = error(text);
        assert!(error.starts_with(&format!("5: {expected}")), "{text}: {error}");
    }
}

#[test]
fn texts_that_no_program_calls_are_errors() {
    let read = |text: &str| {
        let definition = format!("[text]\nprogram-start = 'a'\n{text}\n");
        PostDefinition::read(definition.as_bytes(), Utf8Path::new("t.toml"))
            .map(drop)
            .map_err(|errors| texts(&errors))
    };
    for (text, expected) in [
        ("bezier = 'a'", "the text bezier is never called: no program needs it"),
        ("subprogram-start = 'a'", "the text subprogram-start is never called: no program needs it"),
        ("subprogram-end = 'a'", "the text subprogram-end is never called: no program needs it"),
        (
            "contour-start = 'a'\nrapid = 'b'",
            "contour-start is never called, because the definition has rapid",
        ),
        ("contour-end = 'a'\nrapid = 'b'", "contour-end is never called, because the definition has rapid"),
        ("point = 'a'\ncycle = 'b'", "point is never called, because the definition has cycle"),
    ] {
        let errors = read(text).unwrap_err();
        assert_eq!(errors.len(), 1, "{text}: {errors:?}");
        assert!(errors[0].starts_with(&format!("3: PB759 {expected}")), "{text}: {errors:?}");
    }
    for text in
        ["bezier = ''", "contour-end = ''\nrapid = 'b'", "contour-end = 'a'\nrapid = ''", "cycle = 'b'"]
    {
        assert_eq!(read(text), Ok(()), "{text}");
    }
}

#[test]
fn nesting_and_growth_have_an_end() {
    let nested = |depth: usize| format!("{}a{}", "{$".repeat(depth), "}".repeat(depth));
    assert_eq!(text(&nested(64), &[]), "a\n");
    assert!(error(&nested(65)).contains("PB753"));
    let chain = |depth: usize| -> Vec<(String, String)> {
        (0..depth).map(|index| (format!("Q{index}"), format!("~Q{}~", index + 1))).collect()
    };
    let run = |pairs: &[(String, String)]| {
        let pairs: Vec<_> = pairs.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
        text_with("~Q0~", &pairs)
    };
    let mut fits = chain(31);
    fits.push(("Q31".into(), "x".into()));
    assert!(run(&fits).is_ok());
    fits.last_mut().unwrap().1 = "~Q32~".into();
    fits.push(("Q32".into(), "x".into()));
    assert!(run(&fits).is_err());
    let doubled: Vec<_> =
        (0..31).map(|index| (format!("Q{index}"), format!("~Q{0}~~Q{0}~", index + 1))).collect();
    let with_end = |end: &str| [doubled.clone(), vec![("Q31".to_owned(), end.to_owned())]].concat();
    let many = "more than 10000 variables are replaced in this text";
    assert!(texts(&run(&with_end("x")).unwrap_err())[0].contains(many));
    assert!(texts(&run(&with_end("")).unwrap_err())[0].contains(many), "even of nothing");
    let of_length = |bytes: usize| text_with("~Q1~", &[("Q1", &"x".repeat(bytes))]);
    // A mark of four bytes stands before each variable.
    assert!(of_length(65_536 - 4).is_ok());
    let found = texts(&of_length(65_537 - 4).unwrap_err());
    assert!(found[0].contains("replacing the variables makes the text longer than 65536 bytes"), "{found:?}");
}

#[test]
fn doubtful_terms_are_warnings() {
    let warnings = |text: &str| texts(&text_with(text, &[("Q1", "-5")]).unwrap().warnings).join("\n");
    assert!(
        warnings("{-~Q1~}")
            .starts_with("5: PB760 program-start, line 1, column 2: CAD6 accepts only one sign")
    );
    assert!(warnings("{3&1==1}").contains("whether & | ^ or the comparison is evaluated first"));
    assert!(warnings("{sin(90)}").contains("functions are an extension"));
    assert!(warnings("~ZClearance~").contains("ZClearance is written with all its decimals"));
    assert_eq!(warnings("{.~ZClearance~} ~PrgName~ {5-~Q1~}"), "");
}

/// The column of a fault is that in the text as written, before variables are replaced.
#[test]
fn faults_of_texts_have_their_column() {
    let column = |text: &str| {
        let fault = texts(&text_with(text, &[("Q1", " 5 ")]).unwrap_err())[0].clone();
        let (_, behind) = fault.split_once(", column ").unwrap();
        behind.split(':').next().unwrap().parse::<u32>().unwrap()
    };
    let columns = ["~Q1~ab{c", "~Q1~ab~Q", "{.~Q1~", "{.~Q1~}{?0{~Q1~", "abc}"].map(column);
    assert_eq!(columns, [9, 7, 1, 11, 4]);
}

/// Calls each function, and one that does not exist.
#[test]
fn functions_are_those_of_the_manual_and_some_more() {
    let value = |term: &str| text_with(&format!("{{.{term}}}"), &[]);
    for (term, expected) in [
        ("abs(0-2.5)", "2.5"),
        ("sqrt(6.25)", "2.5"),
        ("int(0-2.5)", "-2"),
        ("round(2.6)", "3"),
        ("floor(0-2.5)", "-3"),
        ("ceil(2.1)", "3"),
        ("sin(30)", "0.5"),
        ("cos(60)", "0.5"),
        ("tan(45)", "1"),
        ("asin(0.5)", "30"),
        ("acos(0.5)", "60"),
        ("atan(1)", "45"),
        ("min(3,1,2)", "1"),
        ("max(3,1,2)", "3"),
        ("mod(0-1,3)", "2"),
        ("atan2(1,0)", "90"),
    ] {
        let text = value(term).unwrap_or_else(|errors| panic!("{term}: {:?}", texts(&errors)));
        assert_eq!(String::from_utf8_lossy(&text.text).trim(), expected, "{term}");
    }
    assert!(value("rounded(2.6)").is_err());
}

/// Files in memory.
#[derive(Debug)]
struct Files(BTreeMap<&'static str, &'static [u8]>);

impl PostFiles for Files {
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value> {
        self.0.get(path.as_str()).map(|content| content.to_vec()).ok_or(Value::Prose(&NO_FILE))
    }
}

#[test]
fn files_are_inserted_as_they_are() {
    let files = Files([("sub/head.nc", b"G90\nX~X1~ {$a} \xe4\n".as_slice())].into());
    let definition = r"[text]
program-start = '''
A
\\\~*sub/~PrgName~.nc*
B\\\~*sub\head.nc*'''";
    let options = PostOptions { files: &files, ..PostOptions::default() };
    let named = Job { name: "head".into(), ..job(vec![]) };
    let output = output(definition, &named, &options).unwrap();
    let expected: &[u8] = b"N10 A\nG90\nX~X1~ {$a} \xe4\nN20 BG90\nX~X1~ {$a} \xe4\n";
    assert_eq!(output.text, expected, "alone on its line a file brings its own numbers");
}

#[test]
fn files_that_are_missing_or_lie_elsewhere_are_errors() {
    let missing = error(r"a\\\~*x.nc*");
    assert!(missing.starts_with(
        "5: PB761 program-start, line 1, column 2: x.nc cannot be inserted: this post has no directory"
    ));
    assert!(error(r"\\\~*../x.nc*").contains("it does not lie below the post's directory"));
    assert!(error(r"\\\~*/etc/passwd*").contains("it does not lie below the post's directory"));
}

/// A post whose output shows which texts are used.
const CALLS: &str = "
[post]
number-lines = false
[text]
program-start = 'start {.~ZClearance~}'
program-end = 'end'
tool-change = 'tool {~MachineToolNo~} {.~ZClearance~}'
contour-start = 'contour {~ContourNo~} X{.~X1~} Y{.~Y1~} Z{.~Z1~} from {.~ZWorking~} at {.~ZClearance~} F{.~LoweringVel~}'
contour-end = 'up {.~ZClearance~}'
line = 'line {.~X1~} {.~Y1~} F{.~MovingVel~} {~FirstContourElement~}{~LastContourElement~}'
arc = 'arc {.~X1~} {.~Y1~} I{.~IRel~} J{.~JRel~} C{.~XC~},{.~YC~} R{.~Radius~} {.~StartAngle~} {.~EndAngle~} {.~SweepAngle~} {~ArcDir~}'
primary-run = 'primary'
before-repeat = 'repeat'
comment = '(~CommentText~)'
";

#[track_caller]
fn calls(definition: &str, steps: Vec<JobStep>) -> Vec<String> {
    written(definition, &job(steps)).lines().map(str::to_owned).collect()
}

#[test]
fn the_calls_come_in_their_order() {
    let cut = |x: f64, feed: f64| JobStep::feed([x, 1.0, -1.0], Some(feed));
    let steps = vec![
        rapid(1.0, 1.0, 5.0),
        rapid(1.0, 1.0, 0.5),
        JobStep::feed([1.0, 1.0, -1.0], Some(50.0)),
        cut(2.0, 100.0),
        JobStep::Comment("half".into()),
        cut(3.0, 100.0),
        cut(4.0, 80.0),
        rapid(4.0, 1.0, 7.0),
        rapid(0.0, 0.0, 7.0),
        rapid(0.0, 0.0, 5.0),
    ];
    let expected = [
        "start 5",
        "tool 1 5",
        "contour 1 X1 Y1 Z-1 from 0.5 at 5 F50",
        "line 2 1 F100 10",
        "(half)",
        "line 3 1 F100 00",
        "line 4 1 F80 11",
        "up 7",
        "primary",
        "repeat",
        "end",
    ];
    assert_eq!(calls(CALLS, steps), expected, "another feed counts as a first element");
}

#[test]
fn the_tool_is_changed_before_an_object_with_another_one() {
    let mill =
        |tool| operation("m", tool, vec![rapid(1.0, 0.0, 5.0), feed(1.0, 0.0, -1.0), rapid(1.0, 0.0, 5.0)]);
    let job = Job { operations: vec![mill(1), mill(1), mill(2)], ..job(vec![]) };
    let changes = written(CALLS, &job)
        .lines()
        .filter(|line| line.starts_with("tool"))
        .map(str::to_owned)
        .collect::<Vec<_>>();
    assert_eq!(changes, ["tool 1 5", "tool 2 5"]);
}

#[test]
fn arcs_have_their_variables() {
    let arc = arc(false, [10.0, 0.0, -1.0], [0.0; 2], [0.0, 10.0, -1.0], None);
    let steps = vec![rapid(10.0, 0.0, 5.0), feed(10.0, 0.0, -1.0), arc];
    assert_eq!(calls(CALLS, steps)[3], "arc 0 10 I-10 J0 C0,0 R10 0 90 90 1");
}

#[test]
fn wide_arcs_are_cut_on_demand() {
    let circle = arc(true, [10.0, 0.0, -1.0], [0.0; 2], [10.0, 0.0, -1.0], None);
    let steps = vec![rapid(10.0, 0.0, 5.0), feed(10.0, 0.0, -1.0), circle];
    let halves = calls(&CALLS.replace("[text]", "arc-sweep = 180\n[text]"), steps.clone());
    assert_eq!(
        halves[3..5],
        ["arc -10 0 I-10 J0 C0,0 R10 0 180 -180 0", "arc 10 0 I10 J0 C0,0 R10 180 0 -180 0"]
    );
    assert!(calls(CALLS, steps)[3].starts_with("arc 10 0 I-10 J0"));
}

#[test]
fn arcs_that_cannot_be_written_become_lines() {
    let helix = arc(false, [10.0, 0.0, -1.0], [0.0; 2], [0.0, 10.0, -2.0], Some(9.0));
    let steps = vec![rapid(10.0, 0.0, 5.0), feed(10.0, 0.0, -1.0), helix];
    let with_z =
        CALLS.replace("line = 'line", "line = 'Z{.~Z1~} line").replace("[text]", "arc-tolerance = 1\n[text]");
    let lines = calls(&with_z, steps.clone());
    assert_eq!([&*lines[3], &*lines[10]], ["Z-1.125 line 9.808 1.951 F9 10", "Z-2 line 0 10 F9 01"]);
    let no_z = output(CALLS, &job(steps), &PostOptions::default()).unwrap_err();
    assert!(
        texts(&no_z)[0]
            .starts_with("PB759 mill has a helix from Z -1 to Z -2, but the text `arc` has no ~Z1~"),
        "{:?}",
        texts(&no_z)
    );
}

#[test]
fn a_way_down_between_passes_is_never_lost() {
    let steps = || {
        vec![
            rapid(1.0, 0.0, 5.0),
            feed(1.0, 0.0, -1.0),
            feed(2.0, 0.0, -1.0),
            feed(2.0, 0.0, -2.0),
            feed(1.0, 0.0, -2.0),
        ]
    };
    assert!(output(CALLS, &job(steps()), &PostOptions::default()).is_err());
    let lifting = CALLS.replace("[text]", "lift-between-passes = true\n[text]");
    let expected =
        ["line 2 0 F100 11", "up 5", "contour 2 X2 Y0 Z-2 from -1 at 5 F100", "line 1 0 F100 11", "up 5"];
    assert_eq!(calls(&lifting, steps())[3..8], expected);
    let with_z = CALLS.replace("line = 'line", "line = 'Z{.~Z1~}");
    assert_eq!(calls(&with_z, steps())[4], "Z-2 2 0 F100 00");
}

#[test]
fn a_rapid_within_the_material_is_an_element() {
    let steps = vec![
        rapid(1.0, 0.0, 5.0),
        feed(1.0, 0.0, -1.0),
        feed(2.0, 0.0, -1.0),
        rapid(1.5, 0.0, -1.0),
        rapid(1.5, 0.0, 5.0),
    ];
    assert_eq!(calls(CALLS, steps)[3..6], ["line 2 0 F100 10", "line 1.5 0 F100 01", "up 5"]);
}

fn hole(x: f64) -> JobStep {
    let kind = HoleKind::Peck { depth: 2.0 };
    JobStep::Hole(Hole {
        at: [x, 0.0],
        level: 5.0,
        retract: 1.0,
        bottom: -3.0,
        exit: 5.0,
        feed: Some(60.0),
        kind,
    })
}

#[test]
fn a_hole_is_a_cycle_or_a_point_or_moves() {
    let steps = vec![feed(1.0, 0.0, 5.0), rapid(1.0, 0.0, 5.0), hole(8.0)];
    let point = "point = 'point {.~X1~} Z{.~Z1~} from {.~ZWorking~} at {.~ZClearance~} Q{.~PeckDepth~} F{.~LoweringVel~}'\n";
    let with_point = format!("{CALLS}{point}");
    assert_eq!(calls(&with_point, steps.clone())[5], "point 8 Z-3 from 1 at 5 Q2 F60");
    let with_cycle = format!("{CALLS}cycle = 'cycle {{.~X1~}} {{.~PeckDepth~}}'\n");
    assert_eq!(calls(&with_cycle, steps.clone())[5], "cycle 8 2");
    let without_peck = format!("{CALLS}cycle = 'cycle {{.~X1~}}'\n");
    assert_eq!(
        calls(&without_peck, steps.clone())[5],
        "contour 2 X8 Y0 Z-1 from 1 at 5 F60",
        "its pecks are moves"
    );
    assert_eq!(calls(CALLS, steps)[5], "contour 2 X8 Y0 Z-1 from 1 at 5 F60");
}

#[test]
fn a_text_for_rapids_writes_every_move_as_it_is() {
    let definition = "[post]\nnumber-lines = false\n[text]\ntool-change = 'T'\nrapid = 'G0 {.~X1~} {.~Y1~} {.~Z1~}'\nline = 'G1 {.~X1~} {.~Y1~} {.~Z1~} {~FirstContourElement~}'";
    let steps = vec![
        rapid(1.0, 0.0, 5.0),
        feed(1.0, 0.0, -1.0),
        feed(2.0, 0.0, -1.0),
        rapid(1.5, 0.0, -1.0),
        rapid(1.5, 0.0, 5.0),
    ];
    assert_eq!(
        calls(definition, steps),
        ["T", "G0 0 0 5", "G0 1 0 5", "G1 1 0 -1 1", "G1 2 0 -1 0", "G0 1.5 0 -1", "G0 1.5 0 5"]
    );
}

#[test]
fn what_a_post_has_no_text_for_is_an_error() {
    let dwell =
        output(CALLS, &job(vec![JobStep::Dwell { seconds: 1.0 }]), &PostOptions::default()).unwrap_err();
    assert_eq!(
        texts(&dwell),
        ["PB759 mill needs the text dwell, which the post does not have (add this text to the definition)"]
    );
    let probe = JobStep::probe([0.0; 3], None);
    let probe = output(CALLS, &job(vec![probe]), &PostOptions::default()).unwrap_err();
    assert_eq!(
        texts(&probe),
        ["PB759 mill needs the text probe, which the post does not have (add this text to the definition)"]
    );
    let with = format!("{CALLS}dwell = 'wait {{.~DwellTime~}}'");
    assert_eq!(calls(&with, vec![JobStep::Dwell { seconds: 1.5 }])[1], "wait 1.5");
}
