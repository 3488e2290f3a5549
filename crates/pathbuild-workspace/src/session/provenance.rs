//! Out of what a program was made: the line by which a sheet at the machine can be traced. (spec/60-gcode.md, "The program")
//!
//! `pathbuild 0.1.0 3f2a9c0d41b7e685-09c1d2e3`: the program's version, a hash of the drawings' bytes, and one of the options that matter.
//! Neither depends on directories or times.

use std::fmt;
use std::str::FromStr;

use blake3::Hasher;
use pathbuild_db::{Database, SourceFile, content_hash};

use crate::config::Settings;
use crate::posting::Poster;

/// The provenance of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// The version of pathbuild.
    pub version: Box<str>,
    /// The hash of the path's name and of the drawings that it was made from.
    pub drawings: Box<str>,
    /// The hash of the options.
    pub options: Box<str>,
}

impl Provenance {
    /// That of a path made from these drawings, its own first, with these settings, through this post.
    pub fn new(
        db: &Database,
        path: &str,
        files: &[SourceFile],
        settings: &Settings,
        poster: Option<&Poster>,
    ) -> Self {
        let mut drawings = Hasher::new();
        part(&mut drawings, path.as_bytes());
        for file in files {
            part(&mut drawings, &content_hash(db, *file).unwrap_or_default());
        }
        Self {
            version: VERSION.into(),
            drawings: short(&drawings, 16),
            options: short(&options(settings, poster), 8),
        }
    }

    /// That of a program on disk and its title, by its first bytes; `None` where it is not pathbuild's. They are the second and third line
    /// of a native program, and comments near the beginning of what a post wrote.
    pub fn of_program(head: &[u8]) -> Option<(Self, Box<str>)> {
        let text = String::from_utf8_lossy(head);
        let mut lines = text.lines().take(HEAD_LINES).map(remark);
        // Some posts write capitals only.
        let provenance = lines.find_map(|line| line.to_lowercase().parse().ok())?;
        Some((provenance, lines.next()?.into()))
    }
}

/// A line without the marks of a comment.
fn remark(line: &str) -> &str {
    let line = line.trim().trim_start_matches([';', '/', ' ']);
    let inner = line.strip_prefix('(').and_then(|line| line.strip_suffix(')'));
    inner.unwrap_or(line).trim()
}

/// Among so many lines a post's remarks are looked for.
const HEAD_LINES: usize = 40;

/// How much of a program its provenance and title are in, however long the drawing's name is.
pub const HEAD: usize = 4096;

impl fmt::Display for Provenance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{NAME} {} {}-{}", self.version, self.drawings, self.options)
    }
}

/// Reads what is shown.
impl FromStr for Provenance {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let mut words = text.split(' ');
        let (Some(NAME), Some(version), Some(hashes), None) =
            (words.next(), words.next(), words.next(), words.next())
        else {
            return Err(());
        };
        let (drawings, options) = hashes.split_once('-').ok_or(())?;
        Ok(Self { version: version.into(), drawings: drawings.into(), options: options.into() })
    }
}

const NAME: &str = "pathbuild";
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Everything in the configuration that a program's text depends on. Where drawings are looked for, and what is forbidden, is not in it: that
/// decides which drawings there are, and those are hashed themselves.
fn options(settings: &Settings, poster: Option<&Poster>) -> Hasher {
    let general = &settings.general;
    let mut hasher = Hasher::new();
    let mut add = |value: &dyn fmt::Debug| part(&mut hasher, format!("{value:?}").as_bytes());
    add(&(general.feed.value, general.rapid.value, general.sweep_height.value, general.probe_feed.value));
    add(&(&general.path_pattern.value, general.units.value, &settings.tables.line_types.value));
    add(&(general.approximate_curves.value, general.join_tolerance.value, general.compatible.value));
    add(&(general.z_model.value, settings.z_split()));
    add(&(general.lang.value, general.charset.value));
    if let Some(poster) = poster {
        part(&mut hasher, &poster.identity());
    }
    hasher
}

/// Adds some bytes so that they cannot run into those before and behind them.
fn part(hasher: &mut Hasher, bytes: &[u8]) {
    hasher.update(&(bytes.len() as u64).to_le_bytes());
    hasher.update(bytes);
}

/// The first digits of a hash.
fn short(hasher: &Hasher, digits: usize) -> Box<str> {
    hasher.finalize().to_hex()[..digits].into()
}
