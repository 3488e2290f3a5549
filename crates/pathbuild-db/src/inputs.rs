//! Inputs of the queries: files, directories, targets, and the settings. (book: reference/configuration)
//!
//! Settings have one field for each consumer, so that changing the feed does not invalidate the parsed drawings.

use std::sync::Arc;
use std::time::Duration;

use camino::Utf8PathBuf;
use pathbuild_dxf::Units;
use pathbuild_path::{FilePattern, Language, PathOptions, Restriction};

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

/// A directory. Its file names determine where paths are defined.
#[salsa::input(debug)]
pub struct Directory {
    /// The normalised path of the directory.
    #[returns(ref)]
    pub path: Utf8PathBuf,
    /// Incremented whenever the names of the files in the directory may have changed.
    #[returns(copy)]
    pub revision: u64,
}

/// A path that a client asks for.
#[salsa::input(debug)]
pub struct Target {
    /// The drawing that defines the path.
    #[returns(copy)]
    pub file: SourceFile,
    /// Name of the path. Its case does not matter.
    #[returns(ref)]
    pub name: Box<str>,
    /// The purpose for which the path is queried.
    #[returns(ref)]
    pub role: Role,
}

/// The purpose for which a path is queried.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// The program of the path is to be emitted: the path must not have variables, and `--sweep-height` applies if it has no S of its own.
    Emitted,
    /// The path is to be checked, with example values for its variables and S as if it were embedded.
    Checked,
    /// The path is to be checked with these values of its variables.
    CheckedWith(pathbuild_path::Bindings),
}

/// The settings of a run.
#[salsa::input(singleton, debug)]
pub struct Settings {
    /// Options for reading drawings.
    #[returns(ref)]
    pub reading: Reading,
    /// Settings of the drawing language.
    #[returns(ref)]
    pub language: Arc<Language>,
    /// The pattern by which file names give the names of paths.
    #[returns(ref)]
    pub file_pattern: FilePattern,
    /// Directories searched for embedded paths after the drawing's own, in order.
    #[returns(ref)]
    pub search: Vec<Utf8PathBuf>,
    /// Rules about which paths may embed which.
    #[returns(ref)]
    pub restrictions: Vec<Restriction>,
    /// Values used if a drawing gives no F or S.
    #[returns(copy)]
    pub fold: PathOptions,
    /// Limits on the size of programs, beyond which they are refused.
    #[returns(copy)]
    pub limits: Limits,
}

/// Options for reading drawings.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The treatment of $INSUNITS, which states the unit of a drawing.
    pub units: Units,
    /// Tolerance in mm for approximating ELLIPSE and SPLINE; 0 leaves them out.
    pub approximate_curves: f64,
    /// Maximum size of a file in bytes.
    pub file_size: u64,
    /// Maximum number of entities in a drawing.
    pub entities: usize,
    /// Maximum length of a text in bytes.
    pub text_length: usize,
    /// Maximum time for walking a path. It belongs to reading because a drawing's index contains the result of the walk.
    pub walk_time: Duration,
    /// Whether to hash drawings, so that a program can name its source. Hashing takes about as long as reading.
    pub is_hashed: bool,
    /// Whether to ignore all entities that PathDxf2GCode does not know.
    pub compatible: bool,
}

/// Limits beyond which work is refused with PB005.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum number of moves in a program.
    pub moves: u64,
    /// Maximum size in bytes of a program's moves in memory.
    pub memory: u64,
    /// Maximum number of paths in a program that differ in drawing or values: each takes memory, however little it mills.
    pub paths: u64,
}
