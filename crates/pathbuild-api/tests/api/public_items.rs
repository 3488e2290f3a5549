//! Checks that the public items are those of `public-items.txt`. `PATHBUILD_UPDATE=1 cargo test -p pathbuild-api` writes that file anew; review
//! what has changed in it.

use std::fmt::Write;
use std::fs;

use pathbuild_testkit::project;

/// Returns the public declarations of a file as rustfmt formats it, one on each line, with the variants of public enums.
fn public_items(source: &str) -> String {
    // Lines that precede a declaration are listed with it: attributes, and the type whose functions follow.
    let (mut items, mut before, mut is_enum) = (String::new(), Vec::new(), false);
    let mut lines = source.lines();
    while let Some(line) = lines.next() {
        let text = line.trim();
        let is_variant = is_enum && line.starts_with("    ") && text.ends_with(',');
        is_enum = text.starts_with("pub enum ") || is_enum && line != "}";
        let is_attribute =
            text.starts_with("#[derive(") || text == "#[non_exhaustive]" || text == "#[doc(hidden)]";
        if is_attribute || text.starts_with("impl ") && !text.contains(" for ") {
            before.retain(|earlier: &String| is_attribute && earlier.starts_with('#'));
            before.push(text.trim_end_matches([' ', '{']).to_owned());
        } else if is_variant || text.starts_with("pub ") || text.starts_with("impl ") {
            before.drain(..).for_each(|line| items += &(line + "\n"));
            let depth = line.len() - line.trim_start().len();
            _ = writeln!(items, "{:depth$}{}", "", whole(text, &mut lines));
        } else if !text.starts_with("//") && !text.is_empty() && line.starts_with(char::is_alphabetic) {
            before.clear();
        }
    }
    items
}

/// Returns a declaration up to its body, with its further lines.
fn whole<'a>(first: &str, lines: &mut impl Iterator<Item = &'a str>) -> String {
    let ends: &[char] = match first {
        _ if first.starts_with("pub use ") => &[';'],
        _ if first.starts_with("pub fn ") => &['{'],
        _ => &['{', ';', ',', '}'],
    };
    let mut item = first.to_owned();
    while !item.ends_with(ends) {
        let Some(line) = lines.next() else { break };
        item.extend([" ", line.trim()]);
    }
    item.strip_suffix('{').unwrap_or(&item).trim_end().to_owned()
}

#[test]
fn the_public_items_are_listed() {
    let directory = project().join("crates/pathbuild-api");
    let mut found = String::new();
    for file in ["lib", "library", "options", "baseline", "finding", "path", "report", "verify", "watch"] {
        let source = fs::read_to_string(directory.join(format!("src/{file}.rs"))).unwrap();
        _ = writeln!(found, "{file}.rs\n\n{}", public_items(&source));
    }
    let list = directory.join("public-items.txt");
    if std::env::var_os("PATHBUILD_UPDATE").is_some() {
        fs::write(&list, &found).unwrap();
    }
    let listed = fs::read_to_string(&list).unwrap_or_default().replace("\r\n", "\n");
    assert!(listed == found, "public-items.txt is out of date: PATHBUILD_UPDATE=1 writes it");
}
