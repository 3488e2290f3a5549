//! Uniform spelling of paths with `/` as the separator on every platform. Windows accepts it like its own `\`, and output, caches and
//! written files are the same everywhere.

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};

/// On Windows, returns a path with `/` as the separator. Paths that begin with `\\?\` stay unchanged: in these, Windows treats `/` as an ordinary
/// character. On other systems, all paths stay unchanged, because a backslash may be part of a name.
pub fn with_forward_slashes(path: Utf8PathBuf) -> Utf8PathBuf {
    if cfg!(windows) { replace_backslashes(path) } else { path }
}

/// Returns a path for system calls: `.` for an empty path, which they do not accept.
pub fn or_current_directory(path: &Utf8Path) -> &Utf8Path {
    if path.as_str().is_empty() { Utf8Path::new(".") } else { path }
}

/// Whether a path has the extension of a drawing, `.dxf` in any case.
pub fn is_drawing(path: &Utf8Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"))
}

/// Whether Windows takes a file of this name for a device, which depends only on the part before the first dot.
pub fn is_windows_device(name: &str) -> bool {
    let base = name.split('.').next().unwrap_or_default().trim_end().to_ascii_uppercase();
    let is_port = |kind: &str| {
        let port = base.strip_prefix(kind).unwrap_or_default();
        port.chars().count() == 1 && port.contains(|c| matches!(c, '1'..='9' | '¹' | '²' | '³'))
    };
    matches!(&*base, "CON" | "PRN" | "AUX" | "NUL" | "CONIN$" | "CONOUT$") || is_port("COM") || is_port("LPT")
}

/// Whether a file or directory of this name is hidden: the name begins with a dot. File managers, version control and interrupted transfers leave
/// such files behind.
pub fn is_hidden(name: &str) -> bool {
    name.starts_with('.')
}

/// Returns the path of a file in a directory, with separators as from [`with_forward_slashes`], in a single allocation of the right size.
pub fn join(directory: &Utf8Path, name: impl AsRef<Utf8Path>) -> Utf8PathBuf {
    let name = name.as_ref();
    let mut path = Utf8PathBuf::with_capacity(directory.as_str().len() + 1 + name.as_str().len());
    path.push(directory);
    path.push(name);
    with_forward_slashes(path)
}

/// Removes `.`, removes `..` together with the name before it, and normalises separators. Links are not resolved, so that a linked drawing belongs to
/// the directory where it appears. A `..` at the beginning of a relative path remains.
pub fn clean(path: &Utf8Path) -> Utf8PathBuf {
    let mut clean = Utf8PathBuf::new();
    for component in path.components() {
        match component {
            Utf8Component::ParentDir if clean.file_name().is_some() => _ = clean.pop(),
            // The root has no parent.
            Utf8Component::ParentDir if clean.has_root() => {}
            Utf8Component::CurDir => {}
            other => clean.push(other),
        }
    }
    with_forward_slashes(clean)
}

fn replace_backslashes(path: Utf8PathBuf) -> Utf8PathBuf {
    let text = path.as_str();
    if text.starts_with(r"\\?\") || !text.contains('\\') { path } else { text.replace('\\', "/").into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drives_shares_and_relative_paths_have_slashes() {
        for (path, expected) in [
            (r"parts\a.dxf", "parts/a.dxf"),
            (r"C:\parts/a.dxf", "C:/parts/a.dxf"),
            (r"\\server\share\a.dxf", "//server/share/a.dxf"),
            (r"\\?\C:\parts", r"\\?\C:\parts"),
            ("parts/a.dxf", "parts/a.dxf"),
        ] {
            assert_eq!(replace_backslashes(path.into()), expected);
        }
    }

    #[test]
    fn nothing_is_above_a_root() {
        for (path, expected) in
            [("/parts/../../a.dxf", "/a.dxf"), ("parts/./../a.dxf", "a.dxf"), ("../a.dxf", "../a.dxf")]
        {
            assert_eq!(clean(path.into()), expected);
        }
    }

    #[cfg(windows)]
    #[test]
    fn drives_and_shares_are_roots() {
        for (path, expected) in [
            (r"C:\parts\..\..\a.dxf", "C:/a.dxf"),
            (r"C:parts\..\a.dxf", "C:a.dxf"),
            (r"\\server\share\parts\..\..\a.dxf", "//server/share/a.dxf"),
            ("//server/share/parts/a.dxf", "//server/share/parts/a.dxf"),
            (r"\\?\C:\parts\a.dxf", r"\\?\C:\parts\a.dxf"),
        ] {
            assert_eq!(clean(path.into()), expected);
        }
        assert_eq!(join("//server/share".into(), "a.dxf"), "//server/share/a.dxf");
        assert_eq!(join(r"\\server\share\parts".into(), r"below\a.dxf"), "//server/share/parts/below/a.dxf");
    }

    #[test]
    fn where_a_backslash_is_a_letter_it_stays() {
        assert_eq!(with_forward_slashes(r"a\b".into()), if cfg!(windows) { "a/b" } else { r"a\b" });
    }
}
