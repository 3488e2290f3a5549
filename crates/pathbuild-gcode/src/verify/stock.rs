//! What is known of the material. (book: program/reading)
//!
//! Its extent is in no drawing. Material is known only within O of where a program cuts, up to the surface T that holds there;
//! elsewhere nothing is known, and nothing is said.

use pathbuild_motion::{Action, Move, Pace};
use pathbuild_toolpath::{Comment, Program, Step as Emitted};

use crate::interpret::Program as Steps;

/// The finest resolution that is any use, in mm: programs have three decimals.
const FINEST: f64 = 0.01;

/// Where nobody says otherwise, so many cells are visited at most.
const MOST_VISITED: u64 = 1_000_000_000;

/// Cells across the narrowest cutter, where nobody says otherwise.
const CELLS_ACROSS: f64 = 12.0;

/// The material's upper face and the cutter, from line to line of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Stock {
    /// In the order of lines. Before the first, nothing is known.
    pieces: Vec<StockSpan>,
    /// The highest surface of all: asked for each rapid move, so not looked for each time.
    highest: Option<f64>,
    /// Side of a cell of the height map, in mm.
    resolution: f64,
    /// The most cells that are visited, cells that many moves visit counted as often.
    cells: u64,
    /// The most pieces that arcs and slopes are cut into.
    most_pieces: u64,
}

/// What holds from a line on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StockSpan {
    /// From 1; of a program that was never text, the number of the step.
    pub line: u32,
    /// Height of the material's upper face T, in mm.
    pub surface: f64,
    /// Diameter of the cutter O, in mm.
    pub cutter: f64,
}

impl Stock {
    /// Material with one surface and one cutter, both in mm, for a whole program.
    pub fn uniform(surface: f64, cutter: f64) -> Self {
        Self::of_pieces(vec![StockSpan { line: 0, surface, cutter }])
    }

    /// Material whose surface or cutter changes; pieces are in the order of their lines.
    pub fn of_pieces(pieces: Vec<StockSpan>) -> Self {
        let highest = pieces.iter().map(|piece| piece.surface).reduce(f64::max);
        let stock = Self { pieces, highest, resolution: FINEST, cells: MOST_VISITED, most_pieces: u64::MAX };
        let resolution = stock.narrowest().map_or(FINEST, |cutter| cutter / CELLS_ACROSS);
        stock.with_resolution(resolution)
    }

    /// The material of a program, for the moves that [`moves_of`](crate::interpret::moves_of) gives.
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

    /// The material of a program in the native dialect that comes without its drawing: where a rapid move down hands over to a cutting one
    /// is T (book: program/gcode), one for each embedded path. `None` if there is no such place.
    pub fn of_native_text(program: &(impl Steps + ?Sized), cutter: f64) -> Option<Self> {
        let mut pieces = Vec::new();
        let mut section = Section { line: 0, surface: None };
        let mut before: Option<Move> = None;
        program.each(&mut |step| match &step.action {
            Action::Comment(text) if is_subpath_border(text) => {
                pieces.extend(section.piece(cutter));
                section = Section { line: step.line, surface: None };
            }
            Action::Move(it) => {
                if let Some(last) = before.replace(*it) {
                    section.hand_over(&last, it);
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

    /// The same with another side of cells, in mm; one that is too fine to be of use is made coarser.
    pub fn with_resolution(self, resolution: f64) -> Self {
        Self { resolution: resolution.max(FINEST), ..self }
    }

    /// The same with another limit of the cells that are visited. (`[limits] verify-cells`)
    pub fn with_cells(self, most: u64) -> Self {
        Self { cells: most, ..self }
    }

    /// The same with another limit of the pieces that arcs and slopes are cut into. (`[limits] verify-pieces`)
    pub fn with_pieces(self, most: u64) -> Self {
        Self { most_pieces: most, ..self }
    }

    /// The most pieces that arcs and slopes are cut into.
    pub(super) fn most_pieces(&self) -> u64 {
        self.most_pieces
    }

    /// The most cells that are visited.
    pub(super) fn cells(&self) -> u64 {
        self.cells
    }

    /// The diameter of the narrowest cutter, in mm.
    pub(super) fn narrowest(&self) -> Option<f64> {
        self.pieces.iter().map(|piece| piece.cutter).reduce(f64::min)
    }

    /// The diameter of the widest cutter, in mm; 0 where nothing is known.
    pub(super) fn widest(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.cutter).fold(0.0, f64::max)
    }

    /// The highest surface of all.
    pub(super) fn highest(&self) -> Option<f64> {
        self.highest
    }

    /// What holds in a line.
    pub(super) fn at(&self, line: u32) -> Option<&StockSpan> {
        let later = self.pieces.partition_point(|piece| piece.line <= line);
        later.checked_sub(1).map(|index| &self.pieces[index])
    }
}

/// A part of a native program that belongs to one path.
struct Section {
    line: u32,
    surface: Option<f64>,
}

impl Section {
    /// Two moves one after the other: down by rapid, then down by feed?
    fn hand_over(&mut self, first: &Move, second: &Move) {
        let is_vertical = |it: &Move| it.from.at[..2] == it.to.at[..2] && it.to.z() < it.from.z();
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
