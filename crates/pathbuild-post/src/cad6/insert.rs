//! Files that control texts insert. Only those below the post's own directory are read.

use camino::{Utf8Component, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::NOT_BELOW_POST;

use crate::PostFiles;

/// The content of a file, without the end of its last line, or the reason why not.
pub(super) fn read(name: &str, files: &dyn PostFiles) -> Result<Vec<u8>, Value> {
    let path = below(name).ok_or(Value::Word(&NOT_BELOW_POST))?;
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
