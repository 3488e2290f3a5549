//! Every dependency has a licence compatible with MIT OR Apache-2.0 distribution, and none brings in unused heavy dependencies.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use serde_json::Value;

use crate::support;

/// Licences that only require their text to be included. A crate with a choice needs one of them; one with several (`AND`) needs all.
const ALLOWED: [&str; 13] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// All packages of the workspace and its dependencies, according to Cargo.lock.
fn packages() -> Vec<Value> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--all-features"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs, since it runs this test");
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo prints JSON");
    metadata["packages"].as_array().expect("there are packages").clone()
}

#[test]
fn every_dependency_has_an_allowed_licence() {
    let packages = packages();
    assert!(packages.len() > 50, "only {} packages: is this the workspace?", packages.len());
    let refused: Vec<String> = packages
        .iter()
        .filter(|package| !is_allowed(package["license"].as_str().unwrap_or_default()))
        .map(|package| format!("{} {}: {}", package["name"], package["version"], package["license"]))
        .collect();
    assert!(refused.is_empty(), "not on the list in this test:\n{}", refused.join("\n"));
}

/// `packaging/dependencies.md` has a row for each crate in the workspace's table of dependencies, and for nothing else.
#[test]
fn every_dependency_says_what_it_is_for() {
    let project = support::project();
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

/// Later versions of `image` bring them in; Cargo.lock pins an earlier one, which `cargo update` would undo.
#[test]
fn nothing_reads_colour_profiles() {
    let packages = packages();
    let is_in = |name: &str| packages.iter().any(|package| package["name"] == name);
    assert!(is_in("image"), "it is gone, and with it what this test is for");
    assert!(!is_in("moxcms"), "moxcms is back: cargo update image --precise 0.25.6");
}

#[test]
fn a_choice_needs_one_and_a_sum_needs_all() {
    assert!(is_allowed("GPL-3.0-only OR MIT"));
    assert!(is_allowed("(Apache-2.0 OR MIT) AND BSD-3-Clause"));
    assert!(is_allowed("MIT/Apache-2.0"));
    assert!(!is_allowed("MIT AND GPL-3.0-only"));
    assert!(!is_allowed("MPL-2.0"));
    assert!(!is_allowed(""));
}

fn is_allowed(expression: &str) -> bool {
    let mut all = expression.split(" AND ").map(|part| part.trim().trim_matches(['(', ')']));
    let one = |part: &str| {
        part.split(" OR ")
            .flat_map(|part| part.split('/'))
            .any(|name| ALLOWED.contains(&name.trim().trim_matches(['(', ')'])))
    };
    all.all(one)
}
