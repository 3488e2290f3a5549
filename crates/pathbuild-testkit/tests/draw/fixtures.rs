//! Tests fixtures with several files and expectations.

use pathbuild_diagnostic::{Code, Handle};
use pathbuild_testkit::{Content, Fixture};

const FIXTURE: &str = r#"# Two drawings.
$ check 8001.1P.dxf --path-pattern "a b"
#! exit 1
#! PB511 subpath-has-errors
$ emit 1234.1P.dxf
== sub/1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O3"
mill 0,0 40,0 "B6 I1"     #! PB203 parameter-out-of-range B is not less
#! missing-end
== pathbuild.toml ==
feed = 200   # == not a head ==
== broken.dxf verbatim ==
  0
SECTION
== 1234.1P_Milling.gcode expected ==
G00 Z1
"#;

#[test]
fn a_fixture_holds_commands_files_and_expectations() {
    let fixture = Fixture::parse(FIXTURE).unwrap();
    assert_eq!(fixture.commands[0].arguments, ["check", "8001.1P.dxf", "--path-pattern", "a b"]);
    assert_eq!((fixture.commands[0].exit, fixture.commands[1].exit), (Some(1), None));
    let names: Vec<(&str, u32)> = fixture.files.iter().map(|file| (file.name.as_str(), file.line)).collect();
    assert_eq!(names, [("sub/1234.1P.dxf", 6), ("pathbuild.toml", 11), ("broken.dxf", 13)]);
    assert_eq!(fixture.files[1].content, Content::Verbatim("feed = 200   # == not a head ==\n".to_owned()));
    assert_eq!(fixture.files[2].bytes(), b"  0\nSECTION\n");
    assert_eq!(fixture.files[0].bytes(), fixture.sheet("sub/1234.1P.dxf").unwrap().to_dxf());
    assert_eq!(fixture.expected_files, [("1234.1P_Milling.gcode".to_owned(), "G00 Z1\n".to_owned())]);
}

#[test]
fn an_expectation_knows_its_command_file_and_element() {
    let expects = Fixture::parse(FIXTURE).unwrap().expects;
    let codes: Vec<Code> = expects.iter().map(|expect| expect.code).collect();
    assert_eq!(codes, [Code::SubpathHasErrors, Code::ParameterOutOfRange, Code::MissingEnd]);
    assert_eq!((expects[0].command, &expects[0].file, expects[0].line), (Some(0), &None, 4));
    assert_eq!(expects[1].file.as_deref(), Some("sub/1234.1P.dxf"));
    assert_eq!((expects[1].command, expects[1].text.as_str()), (None, "B is not less"));
    assert_eq!(expects[1].handles, [Handle(0x102), Handle(0x103)], "the line and its text");
    assert!(expects[2].handles.is_empty());
}

fn error(text: &str) -> String {
    Fixture::parse(text).unwrap_err()[0].to_string()
}

#[test]
fn errors_have_the_line_of_the_fixture() {
    assert_eq!(error("== a.dxf ==\nlayer 1\nline 0,0 x\n").split(": ").next(), Some("line 3, column 10"));
    assert_eq!(
        error("== a.dxf ==\nend 0,0  #! PB999 x"),
        "line 2, column 10: \"PB999\" is no diagnostic's code"
    );
    assert_eq!(error("#! exit 1"), "line 1, column 1: an exit status belongs below a `$` line");
    assert_eq!(error("$ x\n#! exit one"), "line 2, column 9: \"one\" is no exit status");
    assert_eq!(
        error("hello"),
        "line 1, column 1: expected `$ command`, `#! ...`, `# remark` or `== NAME ==`"
    );
    assert_eq!(error("$ \"x"), "line 1, column 3: this quotation mark is never closed");
    assert_eq!(error("== a ==\n== a ==\n"), "line 2, column 4: there is a file \"a\" already");
}
