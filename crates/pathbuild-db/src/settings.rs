//! What the configuration and the options say, one field for each consumer, so that a changed feed does not read drawings again.
//! (book: reference/configuration)

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
    /// What the drawing language needs to know.
    #[returns(ref)]
    pub language: Arc<Language>,
    /// What file names say about paths.
    #[returns(ref)]
    pub file_pattern: FilePattern,
    /// Directories where embedded paths are looked for beyond the drawing's own, in order.
    #[returns(ref)]
    pub search: Vec<Utf8PathBuf>,
    /// Which paths may embed which.
    #[returns(ref)]
    pub restrictions: Vec<Restriction>,
    /// What holds where a drawing gives no F or S.
    #[returns(copy)]
    pub fold: PathOptions,
    /// What is refused as too much.
    #[returns(copy)]
    pub limits: Limits,
}

/// How drawings are read.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What $INSUNITS means.
    pub units: Units,
    /// Tolerance for ELLIPSE and SPLINE in mm; 0: left out.
    pub approximate_curves: f64,
    /// Largest file in bytes.
    pub file_size: u64,
    /// Most entities.
    pub entities: usize,
    /// Longest text in bytes.
    pub text_length: usize,
    /// Longest time of a walk along a path, of which a drawing's index knows the outcome, whoever asks for it.
    pub walk_time: Duration,
    /// Whether drawings are hashed, for saying out of which a program was made. It takes about as long as reading them.
    pub is_hashed: bool,
    /// Whether only those entities count that PathDxf2GCode knows.
    pub compatible: bool,
}

/// What is refused as too much: PB005.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most moves of a program.
    pub moves: u64,
    /// Most bytes that the moves of a program may take in memory.
    pub memory: u64,
    /// Most paths in a program that differ in their drawings or values: each costs memory, however little it mills.
    pub paths: u64,
}

impl Default for Reading {
    fn default() -> Self {
        Self {
            units: Units::Header,
            approximate_curves: 0.0,
            file_size: 256 << 20,
            entities: 2_000_000,
            text_length: 65_536,
            walk_time: Duration::from_mins(1),
            is_hashed: false,
            compatible: false,
        }
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self { moves: 50_000_000, memory: 1 << 30, paths: 100_000 }
    }
}
