use std::fmt::Write;

use super::kind::Key;
use super::sections::{emit, general, limits, machine, tables, warnings, watch};

/// The text of a configuration with every key, its description, and its default or an example. All keys but `library` are commented out.
pub fn template() -> String {
    let mut text = HEAD.to_owned();
    for key in general::KEYS {
        entry(&mut text, key, if key.name == "library" { "" } else { "#" });
    }
    for key in tables::KEYS {
        table(&mut text, key);
    }
    let sections = [
        ("emit", emit::KEYS),
        ("limits", limits::KEYS),
        ("machine", machine::KEYS),
        ("warnings", warnings::KEYS),
        ("watch", watch::KEYS),
    ];
    for (name, keys) in sections {
        _ = write!(text, "\n[{name}]\n");
        for key in keys {
            entry(&mut text, key, "#");
        }
    }
    text
}

const HEAD: &str = "\
# Configuration of pathbuild. File names are relative to this file. Command-line options take precedence over it.
# Lines that begin with # and no blank are the defaults, or examples if there is no default: remove the # and change them.
# `pathbuild config show` prints the values in force.

";

fn entry(text: &mut String, key: &Key, mark: &str) {
    let line = format!("{mark}{} = {}", key.name, key.example);
    let [first, further @ ..] = key.meaning else { return };
    _ = writeln!(text, "{line:<28} #{first}");
    for meaning in further {
        _ = writeln!(text, "{:<28} #{meaning}", "");
    }
}

fn table(text: &mut String, key: &Key) {
    text.push('\n');
    for meaning in key.meaning {
        _ = writeln!(text, "#{meaning}");
    }
    for line in key.example.lines() {
        _ = writeln!(text, "#{line}");
    }
}
