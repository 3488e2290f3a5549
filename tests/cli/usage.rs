//! Tests incorrect usage: there is a message, no side effect, and exit status 2. (book: reference/commands)

use std::ffi::OsString;

#[cfg(unix)]
use crate::support::program;
use crate::support::{Place, Run, runs};
use clap::{CommandFactory, Parser};
use insta::assert_snapshot;
use pathbuild::args::Cli;

/// Returns the output without the list of commands, which is compared with the actual commands instead.
fn without_commands(run: &Run) -> String {
    let shown = run.to_string();
    let (before, rest) = shown.split_once("\nCommands:\n").expect("a list of commands");
    let (commands, after) = rest.split_once("\n\n").expect("an end of the list");
    for command in Cli::command().get_subcommands().filter(|it| !it.is_hide_set()) {
        assert!(
            commands.lines().any(|line| line.split_whitespace().next() == Some(command.get_name())),
            "{run}"
        );
    }
    format!("{before}\nCommands: ...\n\n{after}")
}

#[test]
fn without_a_command_the_help_is_shown() {
    assert_snapshot!(without_commands(&Place::new().run("")));
}

#[test]
fn help_of_the_program_lists_what_is_built() {
    assert_snapshot!(without_commands(&Place::new().run("--help")));
}

#[test]
fn help_of_a_command_lists_its_options_and_the_common_ones() {
    assert_snapshot!(Place::new().run("check --help"));
}

#[test]
fn version_is_a_result() {
    let run = Place::new().run("--version");
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(run.stdout, concat!("pathbuild ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn unknown_commands_and_options_name_the_nearest() {
    let lines = [
        "chek",
        "check --eror-on-warning",
        "check --formt json",
        "check --format jsn",
        "check --color allways",
    ];
    assert_snapshot!(runs(&Place::new(), lines));
}

#[test]
fn options_without_their_value_are_wrong() {
    assert_snapshot!(runs(&Place::new(), ["check --feed", "check --format", "check --jobs", "emit -o"]));
}

#[test]
fn options_that_need_or_exclude_each_other_say_so() {
    let lines = ["check --reason why", "emit --moves", "emit --check --remove-stale", "check -q -v"];
    assert_snapshot!(runs(&Place::new(), lines));
}

#[test]
fn threads_are_counted_from_one_to_1024() {
    assert_snapshot!(runs(&Place::new(), ["check -j 0", "check -j 1025", "check -j two"]));
}

#[test]
fn a_report_is_a_format_and_a_file() {
    let lines = [
        "check --report sarif",
        "check --report sarif=",
        "check --report dot=a.dot",
        "check --report pdf=a.pdf",
    ];
    assert_snapshot!(runs(&Place::new(), lines));
}

#[test]
fn graph_formats_are_for_graph_commands() {
    assert_snapshot!(runs(&Place::new(), ["check --format dot", "emit --format mermaid"]));
}

#[test]
fn common_options_stand_before_or_after_the_command() {
    let place = Place::new();
    for line in
        ["--format dot check", "check --format dot", "check --format=dot", "--color=never check --format=dot"]
    {
        let run = place.run(line);
        assert_eq!(run.status, Some(2), "{run}");
        assert!(run.stderr.contains("dot and mermaid are for graph"), "{run}");
    }
}

#[cfg(unix)]
#[test]
fn arguments_that_are_no_text_are_wrong_usage() {
    use std::os::unix::ffi::OsStrExt;
    let output = program().arg("check").arg(std::ffi::OsStr::from_bytes(b"\xff.dxf")).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_error() {
    use std::process::Stdio;
    let mut child = program().arg("--help").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = program().arg("--help").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: cannot write to standard output"));
}

/// Normally, only the given command is fully defined, but all commands are if the command line has an error. Messages must not differ.
#[test]
fn a_command_line_says_the_same_whatever_of_the_commands_is_defined() {
    let lines = [
        "",
        "check",
        "check a.dxf b -j 2 --no-cache -qq --report json=x",
        "-qq check a.dxf",
        "--feed 100 check --feed 200",
        "check --feed -1 --search a --search b --lang de --color never",
        "check -q -v",
        "check --nonsense",
        "check --jobs 0",
        "check --reason why",
        "check --help",
        "check -- --feed",
        "chek",
        "emit 8001.1P --sweep-height 40",
        "emit emit",
        "init",
        "init -v",
        "init x",
        "man",
        "cache size",
        "cache",
        "config show a.dxf",
        "post",
        "help",
        "help check",
        "--help",
        "--version",
        "check --version",
        "compat --print -- -x 1",
    ];
    for line in lines {
        let line = ["pathbuild"].into_iter().chain(line.split_whitespace());
        let line: Vec<OsString> = line.map(OsString::from).collect();
        let said = |read: Result<Cli, clap::Error>| match read {
            Ok(cli) => format!("{cli:?}"),
            Err(error) => format!("{:?} {}", error.kind(), error.render()),
        };
        assert_eq!(said(Cli::read(&line)), said(Cli::try_parse_from(&line)), "{line:?}");
    }
}

/// An empty argument would name the working directory: `emit "$NAME"` in a script would write all programs if the variable is not set.
#[test]
fn an_empty_argument_is_refused() {
    let place = Place::new().file("pathbuild.toml", "library = [\".\"]");
    for arguments in
        [&["check", ""][..], &["emit", "--out-dir", "", "."], &["check", "--search", ""], &["list", ""]]
    {
        let run = place.run_with(arguments);
        assert_eq!(run.status, Some(2), "{run}");
        assert!(run.stderr.contains("is empty"), "{run}");
    }
    assert_ne!(place.run_with(&["list", "."]).status, Some(2));
}
