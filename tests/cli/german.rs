//! Tests the command line in German, and in English, word for word. (book: reference/commands)

use std::collections::HashSet;
use std::ffi::OsString;

use crate::support::{Place, program, runs};
use clap::{Arg, Command};
use insta::assert_snapshot;
use pathbuild::args::Cli;
use pathbuild::german::{self, catalogue};
use pathbuild_diagnostic::Lang;

/// Texts of the catalogue that are not part of the command line's definition: reasons for rejecting a value.
const REFUSALS: [&str; 9] = [
    "expected a number from 1 to 1024",
    "expected a date such as 2026-12-31",
    "there is no such diagnostic: `pathbuild explain` lists all codes",
    "expected FORMAT=FILE",
    "the format is full, concise, json, sarif, github, gitlab, junit or html",
    "expected the name of a file",
    "the name of the file is missing",
    "unknown dialect",
    "an address is PORT, IP, IP:PORT, localhost or NAME:PORT (drawings, paths and directories stand before --serve)",
];

fn texts(command: &Command, found: &mut HashSet<String>) {
    assert!(command.get_long_about().is_none(), "{}: only the short text has its German", command.get_name());
    let own = [command.get_about(), command.get_after_help()].into_iter().flatten();
    found.extend(own.map(ToString::to_string));
    for argument in command.get_arguments() {
        texts_of_argument(argument, found);
    }
    for inner in command.get_subcommands() {
        texts(inner, found);
    }
}

fn texts_of_argument(argument: &Arg, found: &mut HashSet<String>) {
    let id = argument.get_id();
    assert!(argument.get_long_help().is_none(), "{id}: only the short text has its German");
    let shows_default = argument.get_action().takes_values() && !argument.get_default_values().is_empty();
    assert!(!shows_default, "{id}: clap would show the default in English");
    found.extend(argument.get_help().map(ToString::to_string));
    found.extend(argument.get_help_heading().map(str::to_owned));
    if argument.get_action().takes_values() {
        found.extend(argument.get_value_names().unwrap_or_default().iter().map(ToString::to_string));
        let values = argument.get_possible_values();
        found.extend(values.iter().filter_map(|value| value.get_help()).map(ToString::to_string));
    }
}

#[test]
fn every_text_of_the_command_line_has_its_german_and_no_other_has() {
    let mut found: HashSet<String> = REFUSALS.map(str::to_owned).into();
    texts(&german::command(Lang::En), &mut found);
    let lacking: Vec<&String> = found.iter().filter(|text| german::german(text).is_none()).collect();
    assert!(lacking.is_empty(), "without German: {lacking:#?}");
    let superfluous: Vec<_> = catalogue().filter(|(en, _)| !found.contains(*en)).collect();
    assert!(superfluous.is_empty(), "not in the command line: {superfluous:#?}");
    let once: HashSet<&str> = catalogue().map(|(en, _)| en).collect();
    assert_eq!(once.len(), catalogue().count());
}

/// Collects the full names of all commands, such as `post list`.
fn commands(command: &Command, before: &str, names: &mut Vec<String>) {
    for inner in command.get_subcommands().filter(|inner| inner.get_name() != "help") {
        let name = format!("{before}{}", inner.get_name());
        commands(inner, &format!("{name} "), names);
        names.push(name);
    }
}

fn all_help(lang: &str) -> String {
    let (place, mut names) = (Place::new(), vec![String::new()]);
    commands(&german::command(Lang::En), "", &mut names);
    let one = |name: &String| {
        let help = place.run(&format!("{name} --help --lang {lang}"));
        assert_eq!((help.status, help.stderr.as_str()), (Some(0), ""), "{help}");
        if name != "compat" {
            assert_eq!(place.run(&format!("{name} -h --lang {lang}")).stdout, help.stdout, "{name}");
        }
        assert_eq!(place.run(&format!("help {name} --lang={lang}")).status, Some(2), "no option of help");
        let own = help.stdout.split("\nCommon options:").next().unwrap_or_default();
        let own = own.split("\nAllgemeine Optionen:").next().unwrap_or_default();
        format!("== {name} ==\n{}\n", if name.is_empty() { &help.stdout } else { own.trim_end() })
    };
    names.iter().map(one).collect()
}

#[test]
fn help_of_every_command_in_english() {
    assert_snapshot!(all_help("en"));
}

#[test]
fn help_of_every_command_in_german() {
    let help = all_help("de");
    for english in
        ["Usage", "Options:", "Arguments", "Commands", "[OPTIONS]", "possible values", "Print", "COMMAND"]
    {
        assert!(!help.contains(english), "{english}");
    }
    assert_snapshot!(help);
}

#[test]
fn help_follows_environment_and_configurations() {
    let help = |place: &Place, variable: Option<&str>, line: &str| {
        let mut program = program();
        let configurations = if cfg!(windows) { "APPDATA" } else { "XDG_CONFIG_HOME" };
        program.env(configurations, place.configurations()).current_dir(place.path());
        program.envs(variable.map(|lang| ("PATHBUILD_LANG", lang)));
        let output = program.args(line.split_whitespace()).output().unwrap();
        String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
    };
    let place = Place::new();
    for line in
        ["help emit", "emit --help", "emit -h", "--help", "help", "", "help post list", "emit --nonsense"]
    {
        assert!(help(&place, Some("de"), line).contains("Aufruf: pathbuild"), "{line}");
        assert!(help(&place, None, line).contains("Usage: pathbuild"), "{line}");
        assert!(
            help(&place, Some("de"), &format!("--lang en {line}")).contains("Usage: pathbuild"),
            "{line}"
        );
    }
    assert!(help(&Place::new().users("lang = \"de\"\n"), None, "help emit").contains("Aufruf:"));
    assert!(help(&Place::new().users("lang = \"de\"\n"), Some("en"), "help emit").contains("Usage:"));
    assert!(
        help(&Place::new().file("pathbuild.toml", "lang = \"de\"\n"), None, "help emit").contains("Aufruf:")
    );
}

#[test]
fn usage_errors_in_german() {
    let lines = [
        "chek",
        "post lst",
        "check --eror-on-warning",
        "--baseline a check",
        "check --formt json",
        "check --format jsn",
        "check --color allways",
        "check --nonsense",
        "check --feed",
        "check --format",
        "emit -o",
        "check --reason why",
        "emit --check --remove-stale",
        "check -q -v",
        "check --no-cache --cache-dir a",
        "check --date",
        "import",
        "adjust",
        "cache",
        "cache sise",
        "init x",
        "check --config a --config b",
        "check -j 0",
        "check -j two",
        "check --report sarif",
        "check --report sarif=",
        "check --report pdf=a.pdf",
        "import a --dialect x",
        "watch --serve nowhere",
        "completions tcsh",
        "verify a --- b",
    ];
    let lines: Vec<String> = lines.iter().map(|line| format!("--lang de {line}")).collect();
    assert_snapshot!(runs(&Place::new(), lines.iter().map(String::as_str)));
}

#[test]
fn refusals_in_german() {
    let place =
        Place::of("== a.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n");
    let place = place.file("a.gcode", "G0 X0\n");
    let lines = [
        "check",
        "graph",
        "why",
        "watch",
        "watch --format sarif a.dxf",
        "rdeps",
        "check --format dot a.dxf",
        "check --format html a.dxf",
        "check --report json=- --format json a.dxf",
        "explain --report json=a PB001",
        "explain PB23",
        "emit a.dxf",
        "emit",
        "emit a.dxf --join x",
        "emit a.dxf --dialect grbl",
        "emit a.dxf --date hello",
        "emit . -o - --feed 1 --rapid 1 --sweep-height 20",
        "post",
        "post a.gcode --post native",
        "cache dir",
        "q-project a.dxf --path-name 1234.1P",
        "q-project a.dxf --path-name x",
        "q-project a.dxf -o a.dxf",
        "view .",
        "view a.dxf -o a.txt",
        "diff a.dxf b.dxf -o a.txt",
        "diff -- -x",
        "verify a.gcode --against .",
        "verify a.gcode --against a.dxf",
        "list [",
        "adjust a.dxf b.dxf --max-correction 1 --log l",
        "compat /k3 a.dxf",
        "compat a.dxf /f",
        "compat /c",
        "compat /h",
    ];
    let lines: Vec<String> = lines.iter().map(|line| format!("--lang de {line}")).collect();
    assert_snapshot!(runs(&place, lines.iter().map(String::as_str)));
}

#[test]
fn refusals_of_git_in_german() {
    assert_snapshot!(runs(
        &Place::new(),
        ["--lang de diff nothing", "--lang de check --changed-since HEAD ."].into_iter()
    ));
}

#[test]
fn the_german_definition_reads_the_same_command_lines() {
    for line in [
        "check a.dxf -j 2",
        "emit --check",
        "post list",
        "a.dxf",
        "completions bash",
        "import a --dialect grbl",
    ] {
        let line: Vec<OsString> =
            ["pathbuild"].into_iter().chain(line.split(' ')).map(OsString::from).collect();
        assert!(Cli::matches(&german::command(Lang::De), &line).is_ok(), "{line:?}");
    }
}

#[test]
fn the_manual_in_german() {
    let manual = Place::new().run("man --lang de").stdout;
    let heads = |begin: &str| -> Vec<String> {
        manual.lines().filter(|line| line.starts_with(begin)).map(str::to_owned).collect()
    };
    let sections = heads(".SS ");
    let expected = ["ÜBERSICHT", "BESCHREIBUNG", "OPTIONEN", "ARGUMENTE", "\"ALLGEMEINE OPTIONEN\""];
    for section in &sections {
        assert!(expected.iter().any(|it| section == &format!(".SS {it}")), "{section}");
    }
    assert!(manual.contains("Listet die eingebauten Postprozessoren auf"));
    for english in ["SYNOPSIS", "DESCRIPTION", "OPTIONS", "Print", "possible values"] {
        assert!(!manual.contains(english), "{english}");
    }
}
