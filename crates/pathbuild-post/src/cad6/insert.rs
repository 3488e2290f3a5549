//! Files that control texts insert. Only those below the post's own directory are read.

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

/// What stands before the name of a file, with a `*` behind it.
pub(super) const INSERTION: &str = r"\\\~*";

/// The files that control texts insert whatever the program: those whose names are made of nothing but texts and the user's macros.
pub(crate) fn foreseen(definition: &Definition, macros: &[PostMacro]) -> BTreeSet<Utf8PathBuf> {
    let mut variables = Variables::new(definition.aliases.iter().map(|(other, own)| (&**other, &**own)));
    assign_macros(&mut variables, macros);
    // A text that cannot be expanded is no part of a program.
    let texts = definition.texts().filter_map(|(_, text)| Expanded::new(&text.text, &variables).ok());
    texts.flat_map(|expanded| names(&expanded.text)).filter_map(|name| below(&name)).collect()
}

/// The names of files in an expanded text.
fn names(text: &str) -> Vec<String> {
    let names = text.split(INSERTION).skip(1).filter_map(|rest| Some(rest.split_once('*')?.0));
    names
        .filter(|name| !name.contains(UNDEFINED))
        .map(|name| name.chars().filter(|c| !is_mark(*c)).collect())
        .collect()
}

/// The content of a file, without the end of its last line, or the reason why not.
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

/// The path as one that leads nowhere but down. Backslashes are those of Windows.
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
