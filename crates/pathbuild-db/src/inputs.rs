//! What queries start from: files, directories, and what is asked for.

use camino::Utf8PathBuf;

/// A drawing. Its bytes are read inside queries, after `revision` was asked for, and not kept.
#[salsa::input(debug)]
pub struct SourceFile {
    /// Normalised: relative to the working directory where it was given so.
    #[returns(ref)]
    pub path: Utf8PathBuf,
    /// Raised whenever the file may have changed, appeared or gone.
    #[returns(copy)]
    pub revision: u64,
}

/// A directory whose file names say where paths are.
#[salsa::input(debug)]
pub struct Directory {
    /// Normalised.
    #[returns(ref)]
    pub path: Utf8PathBuf,
    /// Raised whenever a file in it was created, removed or renamed.
    #[returns(copy)]
    pub revision: u64,
}

/// A path that somebody asks for.
#[salsa::input(debug)]
pub struct Target {
    /// The drawing that defines it.
    #[returns(copy)]
    pub file: SourceFile,
    /// The path's name.
    #[returns(ref)]
    pub name: Box<str>,
    /// What for.
    #[returns(ref)]
    pub role: Role,
}

/// What a path is asked for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Its program: it must have no variables, and its S is `--sweep-height` where it gives none.
    Emitted,
    /// Whether it is right, with example values for its variables, and S as if it were embedded.
    Checked,
    /// The same with these values.
    CheckedWith(pathbuild_path::Bindings),
}
