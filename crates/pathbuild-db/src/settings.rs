//! Settings from the configuration and the options, one field for each consumer, so that changing the feed does not invalidate the parsed
//! drawings. (book: reference/configuration)

use std::sync::Arc;
use std::time::Duration;

use camino::Utf8PathBuf;
use pathbuild_dxf::Units;
use pathbuild_path::{FilePattern, Language, PathOptions, Restriction};

/// The settings of a run.
#[salsa::input(singleton, debug)]
pub struct Settings {
    /// How drawings are read.
    #[returns(ref)]
    pub reading: Reading,
    /// Settings of the drawing language.
    #[returns(ref)]
    pub language: Arc<Language>,
    /// How file names map to path names.
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
    /// Limits beyond which work is refused.
    #[returns(copy)]
    pub limits: Limits,
}

/// How drawings are read.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The unit that $INSUNITS stands for.
    pub units: Units,
    /// Tolerance in mm for approximating ELLIPSE and SPLINE; 0 ignores them.
    pub approximate_curves: f64,
    /// Maximum size of a file in bytes.
    pub file_size: u64,
    /// Maximum number of entities.
    pub entities: usize,
    /// Maximum length of a text in bytes.
    pub text_length: usize,
    /// Maximum time for walking a path. It belongs to reading because a drawing's index contains the result of the walk.
    pub walk_time: Duration,
    /// Whether to hash drawings, so that a program can name its source. This takes about as long as reading them.
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
