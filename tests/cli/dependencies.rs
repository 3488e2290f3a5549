//! Checks the documents about dependencies; `packaging/deny` checks the crates themselves.

use std::collections::BTreeSet;
use std::fs;

use regex::Regex;

use crate::book::files_below;
use crate::support::project;

/// `packaging/dependencies.md` has a row for each crate in the workspace's table of dependencies, and for nothing else.
#[test]
fn every_dependency_says_what_it_is_for() {
    let project = project();
    let manifest: toml::Table = fs::read_to_string(project.join("Cargo.toml")).unwrap().parse().unwrap();
    let table = manifest["workspace"]["dependencies"].as_table().unwrap();
    let used: BTreeSet<&str> =
        table.keys().map(String::as_str).filter(|name| !name.starts_with("pathbuild")).collect();
    let page = fs::read_to_string(project.join("packaging/dependencies.md")).unwrap();
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.split_once(" |"));
    let listed: Vec<&str> =
        rows.map(|(name, _)| name).filter(|name| !["crate", "---"].contains(name)).collect();
    assert_eq!(listed.iter().copied().collect::<BTreeSet<_>>(), used);
    assert_eq!(listed.len(), used.len(), "a crate has two rows");
}

/// Documented commands contain `--locked`: without it, cargo may use untested versions of crates.
#[test]
fn every_documented_command_is_locked() {
    let project = project();
    let command =
        Regex::new("cargo (install|build|run|test|bench|check|clippy|doc|nextest run) [^`\n]*").unwrap();
    let top = ["ARCHITECTURE.md", "CONTRIBUTING.md", "README.md", "SECURITY.md", "action.yml"];
    let folders = [".github", "benches", "crates", "docs", "examples", "packaging", "templates"];
    let below = folders.iter().flat_map(|folder| {
        files_below(&project.join(folder)).into_iter().map(move |name| format!("{folder}/{name}"))
    });
    let is_text = |name: &String| {
        let name = name.as_str();
        [".md", ".yml", ".yaml"].iter().any(|end| name.ends_with(end)) && !name.contains("node_modules/")
    };
    let files = top.into_iter().map(String::from).chain(below.filter(is_text));
    let (mut commands, mut unlocked) = (0, Vec::new());
    for file in files {
        let text = fs::read_to_string(project.join(&file)).unwrap();
        for found in command.find_iter(&text) {
            commands += 1;
            if !found.as_str().contains("--locked") {
                unlocked.push(format!("{file}: {}", found.as_str()));
            }
        }
    }
    assert!(commands > 10, "only {commands} commands: are these the pages?");
    assert!(unlocked.is_empty(), "without --locked:\n{}", unlocked.join("\n"));
}
