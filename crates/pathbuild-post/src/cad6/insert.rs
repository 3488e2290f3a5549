//! Files inserted by control texts. Only files below the directory of the post are read.

use std::collections::BTreeSet;

use camino::{Utf8Component, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::NOT_BELOW_POST;

use super::definition::Definition;
use super::expand::Expanded;
use super::marks::{UNDEFINED, is_mark};
use super::program::assign_macros;
use super::variables::Variables;
use crate::{PostFiles, PostMacro};

/// Introduces the name of an inserted file, which ends with a `*`.
pub(super) const INSERTION: &str = r"\\\~*";

/// Returns the files that control texts insert in every program: those whose names consist only of literal text and the user's macros.
pub(crate) fn foreseen(definition: &Definition, macros: &[PostMacro]) -> BTreeSet<Utf8PathBuf> {
    let mut variables = Variables::new(definition.aliases.iter().map(|(other, own)| (&**other, &**own)));
    assign_macros(&mut variables, macros);
    // Texts that cannot be expanded cannot be part of a program.
    let texts = definition.texts().filter_map(|(_, text)| Expanded::new(&text.text, &variables).ok());
    texts.flat_map(|expanded| names(&expanded.text)).filter_map(|name| below(&name)).collect()
}

/// Names of the files inserted by an expanded text.
fn names(text: &str) -> Vec<String> {
    let names = text.split(INSERTION).skip(1).filter_map(|rest| Some(rest.split_once('*')?.0));
    names
        .filter(|name| !name.contains(UNDEFINED))
        .map(|name| name.chars().filter(|c| !is_mark(*c)).collect())
        .collect()
}

/// Returns the content of a file without its last line break, or the reason why it cannot be read.
pub(super) fn read(name: &str, files: &dyn PostFiles) -> Result<Vec<u8>, Value> {
    let path = below(name).ok_or(Value::Prose(&NOT_BELOW_POST))?;
    let mut content = files.read(&path)?;
    for end in [b'\n', b'\r'] {
        if content.last() == Some(&end) {
            content.pop();
        }
    }
    Ok(content)
}

/// Returns the path if it stays below the current directory. Backslashes are separators, as on Windows.
fn below(name: &str) -> Option<Utf8PathBuf> {
    let path = Utf8PathBuf::from(name.replace('\\', "/"));
    let is_drive = name.contains(':');
    let is_down =
        path.components().all(|part| matches!(part, Utf8Component::Normal(_) | Utf8Component::CurDir));
    (is_down && !is_drive && path.file_name().is_some()).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::below;

    #[test]
    fn only_ways_down_are_gone() {
        for inside in ["head.nc", "sub/head.nc", r"sub\head.nc", "./head.nc"] {
            assert!(below(inside).is_some(), "{inside}");
        }
        for outside in [
            "",
            ".",
            "../head.nc",
            r"sub\..\..\head.nc",
            "/etc/passwd",
            r"\\server\x",
            r"C:\head.nc",
            "C:head.nc",
        ] {
            assert!(below(outside).is_none(), "{outside}");
        }
    }
}
