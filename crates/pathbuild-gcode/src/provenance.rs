//! The header line that identifies the origin of a program. (book: program/gcode)
//!
//! `pathbuild 0.2.0 3f2a9c0d41b7e685-09c1d2e3 fanuc O2 T5` consists of the version, a hash of the moves and formulas, a hash of the
//! options, the dialect, the diameter O of the cutter and the height T of the material's upper face, both in mm. O or T is omitted if
//! it changes within the file.
//!
//! A program with equal hashes and an unmodified body is up to date, regardless of the version that wrote it, and even if its drawing has
//! been saved since.
//!
//! Native programs and posts both write the line with [`Display`](fmt::Display); [`FromStr`] parses it, and [`Provenance::of_head`] finds it.

use std::borrow::Borrow;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use blake3::{Hash, Hasher};
use pathbuild_diagnostic::Number;
use pathbuild_toolpath::{Comment, Height, PlannedMove, ProbePoint, Program, ProgramStep, Xy};
use serde::{Deserialize, Serialize};

use crate::dialect::Dialect;

/// The origin of a program, as stated by its header line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of pathbuild that wrote the program.
    pub version: Box<str>,
    /// Hash of the program's moves and formulas, in hexadecimal digits.
    pub moves: Box<str>,
    /// Hash of the options, in hexadecimal digits.
    pub options: Box<str>,
    /// Dialect of the program; `None` if the post names none.
    pub dialect: Option<Dialect>,
    /// Diameter O of the cutter in mm, if a single cutter mills everything.
    pub cutter: Option<f64>,
    /// Height T of the material's upper face in mm, if it is the same everywhere.
    pub thickness: Option<f64>,
}

/// Version of pathbuild that is running.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The first word of the header line.
const NAME: &str = "pathbuild";

/// Number of lines at the beginning of a file in which the header line is searched for.
const HEAD_LINES: usize = 40;

/// Number of bytes at the beginning of a file in which the header line is searched for.
pub const HEAD_BYTES: usize = 4096;

impl Provenance {
    /// Computes the provenance of programs, in the order in which they are milled. `options` are the bytes of everything else that the text depends
    /// on.
    pub fn of_programs<P: Borrow<Program>>(programs: &[P], options: &[u8], dialect: Option<Dialect>) -> Self {
        let programs = || programs.iter().map(Borrow::borrow);
        Self {
            version: VERSION.into(),
            moves: hash(programs()).to_hex()[..16].into(),
            options: blake3::hash(options).to_hex()[..8].into(),
            dialect,
            cutter: common(programs().map(|program| program.tool)),
            thickness: common(programs().map(Program::surface)).flatten(),
        }
    }

    /// Whether programs with these provenances make the same moves with the same options, regardless of the versions that wrote them.
    pub fn is_same(&self, other: &Self) -> bool {
        (&self.moves, &self.options) == (&other.moves, &other.options)
    }

    /// Finds the provenance at the beginning of a program, and returns it with the text of the next line, which is the title. `None` if
    /// the program was not written by pathbuild.
    pub fn of_head(head: &[u8]) -> Option<(Self, Box<str>)> {
        let mut lines = head_remarks(head);
        let provenance = lines.find_map(|line| line.parse().ok())?;
        Some((provenance, lines.next().unwrap_or_default().into()))
    }
}

/// Returns the first lines of a program, without block numbers and comment marks.
pub(crate) fn head_remarks(head: &[u8]) -> impl Iterator<Item = String> {
    let text = String::from_utf8_lossy(&head[..head.len().min(HEAD_BYTES)]);
    let lines: Vec<String> =
        text.lines().take(HEAD_LINES).map(|line| without_comment_marks(line).to_owned()).collect();
    lines.into_iter()
}

/// Returns the value of all items if they are equal, otherwise `None`.
fn common<T: PartialEq>(mut values: impl Iterator<Item = T>) -> Option<T> {
    let first = values.next()?;
    values.all(|value| value == first).then_some(first)
}

/// Whether two files contain the same program, that is, are equal except for the version of pathbuild.
pub fn is_same_program(a: &[u8], b: &[u8]) -> bool {
    let is_same = |a: &[u8], b: &[u8]| match (version_in(a), version_in(b)) {
        (Some(x), Some(y)) => a[..x.start] == b[..y.start] && a[x.end..] == b[y.end..],
        _ => false,
    };
    a == b || is_same(a, b)
}

fn version_in(program: &[u8]) -> Option<Range<usize>> {
    let head = &program[..program.len().min(HEAD_BYTES)];
    let mut begin = 0;
    for line in head.split_inclusive(|byte| *byte == b'\n').take(HEAD_LINES) {
        if let Ok(text) = str::from_utf8(line)
            && let Ok(found) = without_comment_marks(text).parse::<Provenance>()
        {
            let name = text.find(|c: char| c.eq_ignore_ascii_case(&'p'))? + NAME.len() + 1;
            return Some(begin + name..begin + name + found.version.len());
        }
        begin += line.len();
    }
    None
}

/// Strips the block number and the comment marks from a line.
pub(crate) fn without_comment_marks(line: &str) -> &str {
    let line = line.trim();
    let digits =
        line.strip_prefix(['N', 'n']).map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    let line = digits.unwrap_or(line).trim_start_matches([';', '/', ' ']);
    let inner = line.strip_prefix('(').and_then(|line| line.strip_suffix(')'));
    inner.unwrap_or(line).trim()
}

impl fmt::Display for Provenance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { version, moves, options, dialect, cutter, thickness } = self;
        write!(f, "{NAME} {version} {moves}-{options}")?;
        dialect.map_or(Ok(()), |dialect| write!(f, " {dialect}"))?;
        cutter.map_or(Ok(()), |cutter| write!(f, " O{}", Number(cutter)))?;
        thickness.map_or(Ok(()), |thickness| write!(f, " T{}", Number(thickness)))
    }
}

/// Parses the displayed form, also in upper case, because some posts write only upper case.
impl FromStr for Provenance {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let text = text.to_ascii_lowercase();
        let mut words = text.split_ascii_whitespace();
        let (Some(NAME), Some(version), Some(hashes)) = (words.next(), words.next(), words.next()) else {
            return Err(());
        };
        let is_hash = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let (moves, options) = hashes.split_once('-').ok_or(())?;
        if !is_hash(moves) || !is_hash(options) {
            return Err(());
        }
        let mut read = Self {
            version: version.into(),
            moves: moves.into(),
            options: options.into(),
            dialect: None,
            cutter: None,
            thickness: None,
        };
        words.try_for_each(|word| read.take(word))?;
        Ok(read)
    }
}

impl Provenance {
    /// Parses one of the words after the hashes.
    fn take(&mut self, word: &str) -> Result<(), ()> {
        let number = |text: &str| text.parse().ok().filter(|number: &f64| number.is_finite()).ok_or(());
        if let Ok(dialect) = word.parse() {
            self.dialect = Some(dialect);
        } else if let Some(cutter) = word.strip_prefix('o') {
            self.cutter = Some(number(cutter)?);
        } else if let Some(thickness) = word.strip_prefix('t') {
            self.thickness = Some(number(thickness)?);
        } else {
            return Err(());
        }
        Ok(())
    }
}

/// Returns the hash of the programs in a file. Comments are ignored, except those that the drawing addresses to the operator.
pub(super) fn hash<'a>(programs: impl Iterator<Item = &'a Program>) -> Hash {
    let mut hasher = Hasher::new();
    for program in programs {
        let mut length = 0;
        each_block(program, |block| length += block.len() as u64);
        hasher.update(&length.to_le_bytes());
        each_block(program, |block| {
            hasher.update(block);
        });
    }
    hasher.finalize()
}

/// Number of bytes after which a block ends. All bytes of a program together would take as much memory as the program.
const BLOCK_BYTES: usize = 1 << 16;

/// Calls `use_block` with the bytes to hash of a program, block by block.
fn each_block(program: &Program, mut use_block: impl FnMut(&[u8])) {
    let mut bytes = HashInput(Vec::new());
    bytes.number(program.tool);
    bytes.number(program.sweep_height);
    for step in &program.steps {
        bytes.step(program, step);
        if bytes.0.len() >= BLOCK_BYTES {
            use_block(&bytes.0);
            bytes.0.clear();
        }
    }
    program.probes.iter().for_each(|probe| bytes.probe(probe));
    use_block(&bytes.0);
}

/// The bytes of a program from which its hash is computed.
struct HashInput(Vec<u8>);

impl HashInput {
    /// Appends a number, rounded to thousandths.
    #[expect(clippy::cast_possible_truncation, reason = "saturates far beyond any machine")]
    fn number(&mut self, number: f64) {
        let thousandths = (number * 1000.0).round_ties_even() as i64;
        self.0.extend(thousandths.to_le_bytes());
    }

    fn point(&mut self, point: Xy) {
        self.number(point.x);
        self.number(point.y);
    }

    /// Appends a height, and the point for which its formula is calculated.
    fn height(&mut self, height: Height) {
        self.number(height.z);
        self.point(height.at);
    }

    fn text(&mut self, text: &str) {
        self.0.extend((text.len() as u64).to_le_bytes());
        self.0.extend(text.as_bytes());
    }

    fn step(&mut self, program: &Program, step: &ProgramStep) {
        match *step {
            ProgramStep::Move { to, .. } => self.step_to(to),
            ProgramStep::Comment(Comment::Question(text)) => {
                self.0.push(b'Q');
                self.text(program.names.get(text));
            }
            ProgramStep::Comment(_) => {}
        }
    }

    fn step_to(&mut self, to: PlannedMove) {
        match to {
            PlannedMove::Sweep { to } => {
                self.0.push(b'S');
                self.point(to);
            }
            PlannedMove::Lift { z } => {
                self.0.push(b'Z');
                self.height(z);
            }
            PlannedMove::Drill { feed, z } => {
                self.0.push(b'D');
                self.number(feed);
                self.height(z);
            }
            PlannedMove::Line { feed, to, z } => {
                self.0.push(b'L');
                self.number(feed);
                self.point(to);
                self.height(z);
            }
            PlannedMove::Arc { feed, clockwise, centre, to, z, is_spiral } => {
                self.0.extend([b'A', clockwise.into(), is_spiral.into()]);
                self.number(feed);
                self.point(centre);
                self.point(to);
                self.height(z);
            }
        }
    }

    /// Appends a probe without its feed, which only affects the probing program.
    fn probe(&mut self, probe: &ProbePoint) {
        self.0.push(b'P');
        self.point(probe.at);
        self.point(probe.drawn_at);
        self.number(probe.height);
        self.text(probe.label.as_deref().unwrap_or_default());
    }
}
