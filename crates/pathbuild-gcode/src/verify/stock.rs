//! What is known about the material. (book: program/reading)
//!
//! No drawing contains its extent. Material is only known within O of the cuts of a program, up to the surface T that applies there.
//! Nothing is known or reported elsewhere.

use pathbuild_motion::{Action, Move, Pace};
use pathbuild_toolpath::{Comment, Program, ProgramStep as Emitted};

use crate::interpret::Program as Steps;

/// The finest useful resolution in mm; programs have three decimals.
const FINEST: f64 = 0.01;

/// Default for the maximum number of visited cells.
const MOST_VISITED: u64 = 1_000_000_000;

/// Default for the number of cells across the narrowest cutter.
const CELLS_ACROSS: f64 = 12.0;

/// The upper face of the material and the cutter, as they change over the lines of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Stock {
    /// In the order of lines. Before the first, nothing is known.
    pieces: Vec<StockSpan>,
    /// The highest surface, which is needed for every rapid move.
    highest: Option<f64>,
    /// Side of a cell of the height map, in mm.
    resolution: f64,
    /// Maximum number of cells that are visited, counting repeated visits.
    cells: u64,
    /// Maximum number of parts into which arcs and slopes are divided.
    pub(super) most_pieces: u64,
}

/// The stock from a line on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StockSpan {
    /// Line counted from 1, or the step number for a program that does not exist as text.
    pub line: u32,
    /// Height of the upper face T of the material, in mm.
    pub surface: f64,
    /// Diameter of the cutter O, in mm.
    pub cutter: f64,
}

impl Stock {
    /// Stock with a single surface and cutter for an entire program, both in mm.
    pub fn uniform(surface: f64, cutter: f64) -> Self {
        Self::of_pieces(vec![StockSpan { line: 0, surface, cutter }])
    }

    /// Stock whose surface or cutter changes; the pieces must be in the order of their lines.
    pub fn of_pieces(pieces: Vec<StockSpan>) -> Self {
        let highest = pieces.iter().map(|piece| piece.surface).reduce(f64::max);
        let stock = Self { pieces, highest, resolution: FINEST, cells: MOST_VISITED, most_pieces: u64::MAX };
        let resolution = stock.narrowest().map_or(FINEST, |cutter| cutter / CELLS_ACROSS);
        stock.with_resolution(resolution)
    }

    /// The stock of a program, for the moves returned by [`Program::moves`].
    pub fn of(program: &Program) -> Self {
        let piece = |line, surface, cutter| StockSpan { line, surface, cutter };
        let elements = (1_u32..).zip(&program.steps).filter_map(|(number, step)| match step {
            Emitted::Comment(Comment::Element { surface, cutter, .. }) => {
                Some(piece(number, *surface, *cutter))
            }
            _ => None,
        });
        Self::of_pieces(std::iter::once(piece(0, program.thickness, program.tool)).chain(elements).collect())
    }

    /// The stock of a native program whose drawing is not available. T is the height at which a downward move changes from rapid to feed
    /// (book: program/gcode), separately for each embedded path. `None` if there is no such move.
    pub fn of_native_text(program: &(impl Steps + ?Sized), cutter: f64) -> Option<Self> {
        let mut pieces = Vec::new();
        let mut section = Section { line: 0, surface: None };
        let mut before: Option<Move> = None;
        program.each(&mut |step| match &step.action {
            Action::Comment(text) if is_subpath_border(text) => {
                pieces.extend(section.piece(cutter));
                section = Section { line: step.line, surface: None };
            }
            Action::Move(movement) => {
                if let Some(last) = before.replace(*movement) {
                    section.hand_over(&last, movement);
                }
            }
            _ => {}
        });
        pieces.extend(section.piece(cutter));
        (!pieces.is_empty()).then(|| Self::of_pieces(pieces))
    }

    /// The side of a cell of the height map, in mm.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Sets the side of a cell in mm. If it is too fine to be useful, a coarser one is used.
    pub fn with_resolution(self, resolution: f64) -> Self {
        Self { resolution: resolution.max(FINEST), ..self }
    }

    /// Sets the maximum number of visited cells. (`[limits] verify-cells`)
    pub fn with_cells(self, most: u64) -> Self {
        Self { cells: most, ..self }
    }

    /// Sets the maximum number of parts into which arcs and slopes are divided. (`[limits] verify-pieces`)
    pub fn with_pieces(self, most: u64) -> Self {
        Self { most_pieces: most, ..self }
    }

    /// Maximum number of visited cells.
    pub(super) fn cells(&self) -> u64 {
        self.cells
    }

    /// Diameter of the narrowest cutter, in mm.
    pub(super) fn narrowest(&self) -> Option<f64> {
        self.pieces.iter().map(|piece| piece.cutter).reduce(f64::min)
    }

    /// Diameter of the widest cutter in mm; 0 if nothing is known.
    pub(super) fn widest(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.cutter).fold(0.0, f64::max)
    }

    /// The highest surface.
    pub(super) fn highest(&self) -> Option<f64> {
        self.highest
    }

    /// The stock in a line.
    pub(super) fn at(&self, line: u32) -> Option<&StockSpan> {
        let later = self.pieces.partition_point(|piece| piece.line <= line);
        later.checked_sub(1).map(|index| &self.pieces[index])
    }
}

/// A part of a native program that belongs to a single path.
struct Section {
    line: u32,
    surface: Option<f64>,
}

impl Section {
    /// Checks two consecutive moves for a descent by rapid followed by a descent at feed.
    fn hand_over(&mut self, first: &Move, second: &Move) {
        let is_vertical = |movement: &Move| {
            movement.from.at[..2] == movement.to.at[..2] && movement.to.z() < movement.from.z()
        };
        if is_vertical(first)
            && is_vertical(second)
            && first.pace == Pace::Rapid
            && second.pace != Pace::Rapid
        {
            self.surface = Some(self.surface.map_or(first.to.z(), |known| known.max(first.to.z())));
        }
    }

    fn piece(&self, cutter: f64) -> Option<StockSpan> {
        self.surface.map(|surface| StockSpan { line: self.line, surface, cutter })
    }
}

fn is_subpath_border(comment: &str) -> bool {
    comment.starts_with("START Subpath ") || comment.starts_with("END Subpath ")
}
