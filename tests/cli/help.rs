//! Tests the built-in documentation: pages on codes, completions, the manual. (book: reference/commands)

use crate::support::{Place, runs};
use clap::CommandFactory;
use insta::assert_snapshot;
use pathbuild_diagnostic::Code;
use pathbuild_testkit::Fixture;

#[test]
fn a_page_is_found_by_code_in_any_case_and_by_name() {
    let place = Place::new();
    let page = place.run("explain PB203").stdout;
    assert!(page.starts_with("# PB203 parameter-out-of-range\n"), "{page}");
    assert_eq!(place.run("explain pb203").stdout, page);
    assert_eq!(place.run("explain 203").stdout, page);
    assert_eq!(place.run("explain parameter-out-of-range").stdout, page);
}

#[test]
fn pages_speak_the_language_of_the_option_or_the_configuration() {
    let place = Place::new().file("pathbuild.toml", "lang = \"de\"");
    assert!(place.run("explain PB203").stdout.contains("## Häufige Ursachen"));
    assert!(place.run("explain PB203 --lang en").stdout.contains("## Usual causes"));
    assert!(Place::new().run("--lang de explain PB203").stdout.contains("## Häufige Ursachen"));
}

#[test]
fn a_page_is_shown_whatever_is_wrong_with_the_configuration() {
    let run = Place::new().file("pathbuild.toml", "fed = 1").run("explain PB003");
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{run}");
}

#[test]
fn several_pages_follow_each_other() {
    assert_snapshot!(Place::new().run("explain PB207 PB006"));
}

#[test]
fn an_unknown_code_names_the_nearest() {
    let lines = [
        "explain PB23",
        "explain PB999",
        "explain missing-parametr",
        "explain circle",
        "explain PB203 PB23",
        "explain PB23 --lang de",
    ];
    assert_snapshot!(runs(&Place::new(), lines));
}

#[test]
fn without_a_code_all_are_listed() {
    let run = Place::new().run("explain");
    assert_eq!(run.stdout.lines().count(), Code::ALL.len());
    assert_eq!(run.stdout.lines().next(), Some("PB001  unreadable-file              error"));
}

/// Every example has commands, because only the output of commands is tested.
#[test]
fn every_example_is_a_fixture_that_can_be_drawn() {
    for code in Code::ALL {
        let Some(text) = code.example() else { continue };
        let fixture = Fixture::parse(text).unwrap_or_else(|errors| panic!("{code}: {errors:?}"));
        assert!(!fixture.commands.is_empty(), "{code}");
        assert!(fixture.expects.iter().any(|expect| expect.code == *code), "{code}");
        for file in &fixture.files {
            assert!(!file.bytes().is_empty(), "{code}: {}", file.name);
        }
    }
}

#[test]
fn completions_are_scripts_that_ask_the_program() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let run = Place::new().run(&format!("completions {shell}"));
        assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{run}");
        assert!(run.stdout.contains("PATHBUILD_COMPLETE"), "{run}");
    }
    assert_snapshot!(Place::new().run("completions tcsh"));
}

#[test]
fn the_manual_has_every_visible_command_and_no_date() {
    let run = Place::new().run("man");
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""));
    let sections: Vec<_> = run.stdout.lines().filter_map(|line| line.strip_prefix(".SH \"")).collect();
    for command in pathbuild::args::Cli::command().get_subcommands().filter(|it| !it.is_hide_set()) {
        let section = format!("{}\"", command.get_name().to_uppercase());
        assert!(sections.contains(&&*section), "{section} is missing in {sections:?}");
    }
    let head = run.stdout.lines().find(|line| line.starts_with(".TH"));
    assert_eq!(
        head.map(|line| line.replace(env!("CARGO_PKG_VERSION"), "VERSION")).as_deref(),
        Some(".TH pathbuild 1  \"pathbuild VERSION\" ")
    );
}
