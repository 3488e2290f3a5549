//! Inputs of the queries: files, directories and targets.

use camino::Utf8PathBuf;

/// A drawing. Queries read its bytes after they have read `revision`, and do not keep them.
#[salsa::input(debug)]
pub struct SourceFile {
    /// The normalised path; relative to the working directory if it was given as a relative path.
    #[returns(ref)]
    pub path: Utf8PathBuf,
    /// Incremented whenever the file may have changed, appeared or been removed.
    #[returns(copy)]
    pub revision: u64,
}

/// A directory, whose file names determine where paths are defined.
#[salsa::input(debug)]
pub struct Directory {
    /// The normalised path.
    #[returns(ref)]
    pub path: Utf8PathBuf,
    /// Incremented whenever a file in it was created, removed or renamed.
    #[returns(copy)]
    pub revision: u64,
}

/// A path that a client asks for.
#[salsa::input(debug)]
pub struct Target {
    /// The drawing that defines it.
    #[returns(copy)]
    pub file: SourceFile,
    /// The path's name.
    #[returns(ref)]
    pub name: Box<str>,
    /// The purpose of the query.
    #[returns(ref)]
    pub role: Role,
}

/// The purpose for which a path is queried.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// To emit its program: it must not have variables, and `--sweep-height` applies if it has no S of its own.
    Emitted,
    /// To check it, with example values for its variables and S as if it were embedded.
    Checked,
    /// To check it with these values.
    CheckedWith(pathbuild_path::Bindings),
}
