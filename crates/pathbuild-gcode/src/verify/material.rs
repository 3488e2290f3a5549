//! Keeps track of the known material, and finds rapid moves through material that has not been removed. (book: program/reading)
//!
//! No drawing contains the extent of the material. It is only known within the cutter's diameter O of the cuts of a program, up to the height T of
//! the upper face that applies there. Nothing is known or reported elsewhere.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Message, Point};
use pathbuild_motion::{Action, Axes, Move, MoveShape, Pace, Plane, Position, Step, widest_chord};
use pathbuild_toolpath as toolpath;
use pathbuild_toolpath::{Comment, ProgramStep as Emitted};

use super::excursion::Excursions;
use super::height_map::{Capsule, HeightMap, RESIDUE_HEIGHT};
use crate::interpret::Program;
use crate::read::Problems;

/// Maximum number of cells in memory. A resolution of the stock that would require more cells is made coarser.
const MAX_CELLS_IN_MEMORY: f64 = 16e6;

/// Minimum number of cells across the cutter for a useful map.
const MIN_CELLS_ACROSS_CUTTER: f64 = 4.0;

/// Ratio of the side of a cell to the greatest distance of chords from their arc.
const CELL_PER_SAGITTA: f64 = 4.0;

/// Half the width of the strip along a centre line in which material counts as hit, as a share of the side of a cell: more than half the diagonal of
/// a cell, so that the strip contains the centres of cells.
const CENTRE_LINE_HALF_WIDTH: f64 = 0.75;

/// Width in mm beside a cut up to which material is attributed to rounding.
const RESIDUE_WIDTH: f64 = 0.01;

/// The side of a cell in mm for flat cutters, as long as a program is not too large: a rapid move that takes off more than some hundredths of a
/// millimetre is a crash.
const FINE_RESOLUTION: f64 = 0.02;

/// Upper bound on the cells visited at a resolution finer than that of the stock, so that the check takes a fraction of a second.
const FINE_VISITED_CELLS: f64 = 1e8;

/// Upper bound on the visits per cell within O of a cut: one to add the material, half a visit on average to raise and to cut it, because a cut is
/// only half as wide, and the cost of the rows.
const VISITS_PER_CELL: f64 = 3.0;

/// Applies the moves of a program to the stock and reports rapid moves that hit material, and cuts through material above their own surface.
pub(super) fn check(program: &(impl Program + ?Sized), stock: &Stock, problems: &mut Problems) {
    apply_moves(program, stock, problems, &mut |material, step, movement, problems| {
        material.check_excursion(step, movement, problems);
        if movement.pace == Pace::Rapid {
            material.check_rapid(step, movement, problems);
        } else {
            material.check_cut(step, movement, problems);
        }
    });
}

/// Returns the lines of the rapid moves that hit material, in the order of the moves. For programs that are too large for the map, it is empty or
/// incomplete.
pub fn rapid_hits(program: &(impl Program + ?Sized), stock: &Stock) -> Vec<u32> {
    let mut lines = Vec::new();
    apply_moves(program, stock, &mut Problems::default(), &mut |material, step, movement, _| {
        if movement.pace == Pace::Rapid && material.first_hit(step.order, movement).is_some() {
            lines.push(step.line);
        }
    });
    lines
}

/// Applies the moves of a program to the stock. Each move is passed to the caller before it cuts. The program is processed several times: to find the
/// size of the map, to find where there is material, and to remove it.
fn apply_moves(
    program: &(impl Program + ?Sized),
    stock: &Stock,
    problems: &mut Problems,
    look: &mut dyn FnMut(&mut KnownMaterial<'_>, &Step, &Move, &mut Problems),
) {
    let mut extent = MaterialEstimate::default();
    each_checkable_move(program, stock, &mut |step, movement| extent.add(step, movement, stock));
    if extent.pieces > stock.most_pieces {
        let (line, limit) = (extent.line, stock.most_pieces);
        return problems.add_at_line(&say::TOO_MANY_PIECES, line, |d| {
            d.with("count", extent.pieces).with("limit", limit).quoting("key", "verify-pieces")
        });
    }
    let Some(resolution) = extent.resolution(stock) else {
        return report_too_large(extent.line, stock, problems);
    };
    let mut material = KnownMaterial::new(stock, resolution, stock.cells());
    let mut reached = 0;
    let mut each = |take: &mut dyn FnMut(&mut KnownMaterial<'_>, &Step, &Move)| {
        each_checkable_move(program, stock, &mut |step, movement| {
            if !material.map.is_exhausted() {
                reached = step.line;
                take(&mut material, step, movement);
            }
        });
    };
    each(&mut |material, step, movement| material.add_material(step.order, movement));
    if !stock.is_level() {
        each(&mut |material, step, movement| material.raise_material(step.order, movement));
    }
    each(&mut |material, step, movement| {
        look(material, step, movement, problems);
        if matches!(movement.pace, Pace::Feed(_)) {
            material.remove_material(step.order, movement);
        }
    });
    if material.map.is_exhausted() {
        report_too_large(reached, stock, problems);
    }
}

fn report_too_large(line: u32, stock: &Stock, problems: &mut Problems) {
    problems.add_at_line(&say::TOO_LARGE_TO_FOLLOW, line, |d| {
        d.with("limit", stock.cells()).quoting("key", "verify-cells")
    });
}

/// Whether those of the given cuts that are entirely below a rapid move have cleared its path, assuming material up to `surface` all around. Returns
/// false as well if the number of cells does not suffice. The moves have the numbers of their steps, which are also their order.
pub(super) fn have_cleared_path<'c>(
    order: u32,
    movement: &Move,
    surface: f64,
    cuts: impl IntoIterator<Item = &'c (u32, Move)>,
    stock: &Stock,
    cells: u64,
) -> bool {
    let Some(piece) = stock.at(order) else { return true };
    let mut material = KnownMaterial::new(stock, stock.resolution(), cells);
    for part in material.parts(movement) {
        material.map.add(&capsule(&part, piece.cutter.diameter / 2.0), surface);
    }
    let height = movement.from.z().min(movement.to.z()) + RESIDUE_HEIGHT;
    for (order, cut) in cuts.into_iter().filter(|(_, cut)| cut.from.z().max(cut.to.z()) <= height) {
        material.remove_material(*order, cut);
    }
    material.first_hit(order, movement).is_none() && !material.map.is_exhausted()
}

/// Passes each move to `take`, with its step. A move whose end is unknown only ends an excursion. A rapid move whose start is unknown is replaced by a vertical one
/// to its end: whether that end is in the material does not depend on where the tool comes from.
fn each_checkable_move(program: &(impl Program + ?Sized), stock: &Stock, take: &mut dyn FnMut(&Step, &Move)) {
    let highest = stock.highest().filter(|highest| highest.is_finite());
    program.each(&mut |step| {
        let Action::Move(movement) = &step.action else { return };
        if movement.is_known() {
            return take(step, movement);
        }
        if let Some(highest) =
            highest.filter(|_| movement.pace == Pace::Rapid && movement.to.known == Axes::ALL)
        {
            let [x, y, z] = movement.to.at;
            let from = Position::known(x, y, z.max(highest));
            take(step, &Move { from, shape: MoveShape::Line, named: None, ..*movement });
        } else {
            take(step, movement);
        }
    });
}

/// The extent of the material that a program cuts.
#[derive(Default)]
struct MaterialEstimate {
    /// Upper bound of the area in mm² within O of cutting moves; areas that are cut repeatedly are counted each time.
    area: f64,
    /// Upper bound of the area in mm² within O of rapid moves below the highest surface.
    passed: f64,
    /// Number of these rapid moves.
    passes: f64,
    /// Number of parts into which cutting arcs and slopes are divided at the resolution of the stock, without the first part of each move.
    pieces: u64,
    /// Upper bound of the area in mm² by which the parts of cutting moves overlap at the fine resolution.
    overlap: f64,
    /// Bounding box in X and Y of all cuts, enlarged on each side by the diameter of the cutter; `None` before the first cut.
    sides: Option<[(f64, f64); 2]>,
    /// The last line with a cut.
    line: u32,
}

impl MaterialEstimate {
    fn add(&mut self, step: &Step, movement: &Move, stock: &Stock) {
        if let Some(piece) = stock.at(step.order).filter(|_| is_low_rapid(movement, stock)) {
            self.passed += covered_area(movement, piece.cutter.diameter);
            self.passes += 1.0;
        }
        let Some(piece) = cutting_piece(step.order, movement, stock) else { return };
        self.line = step.line;
        self.area += covered_area(movement, piece.cutter.diameter);
        self.pieces += u64::from(part_count(movement, stock.resolution() / CELL_PER_SAGITTA)) - 1;
        let parts = f64::from(part_count(movement, FINE_RESOLUTION / CELL_PER_SAGITTA));
        self.overlap += parts * piece.cutter.diameter * piece.cutter.diameter;
        let sides = self.sides.get_or_insert([(f64::INFINITY, f64::NEG_INFINITY); 2]);
        for (side, extent) in sides.iter_mut().zip(movement.extent()) {
            let Some((low, high)) = extent else { continue };
            *side = (side.0.min(low - piece.cutter.diameter), side.1.max(high + piece.cutter.diameter));
        }
    }

    /// Returns the side of a cell in mm; `None` if the program is too large for a useful map.
    fn resolution(&self, stock: &Stock) -> Option<f64> {
        let in_box: f64 = self.sides.iter().flatten().map(|(low, high)| (high - low).max(0.0)).product();
        let kept = self.area.min(in_box);
        let visited = VISITS_PER_CELL * self.area + self.passed.min(self.passes * in_box);
        #[expect(clippy::cast_precision_loss, reason = "a limit")]
        let cells = stock.cells() as f64;
        let least = |visited: f64, cells: f64| {
            libm::sqrt(visited / cells).max(libm::sqrt(kept / MAX_CELLS_IN_MEMORY))
        };
        let coarse = stock.resolution().max(least(visited, cells));
        let fine = FINE_RESOLUTION.max(least(visited + self.overlap, FINE_VISITED_CELLS.min(cells)));
        let resolution =
            if stock.has_only_flat_cutters() && self.passes > 0.0 { coarse.min(fine) } else { coarse };
        let is_of_use = stock.narrowest().is_none_or(|cutter| resolution * MIN_CELLS_ACROSS_CUTTER <= cutter);
        (is_of_use && resolution.is_finite()).then_some(resolution)
    }
}

struct KnownMaterial<'s> {
    stock: &'s Stock,
    has_only_flat_cutters: bool,
    /// The lowest surface of the stock in mm. Where the material is unknown, excursions are compared with this one, because a higher surface may be
    /// that of another sheet.
    lowest: Option<f64>,
    resolution: f64,
    map: HeightMap,
    excursions: Excursions,
    /// Whether the last rapid move hit material. The cuts after it then go through the same material.
    has_hit: bool,
}

impl<'s> KnownMaterial<'s> {
    fn new(stock: &'s Stock, resolution: f64, cells: u64) -> Self {
        let map = HeightMap::new(resolution, cells);
        let (has_only_flat_cutters, lowest) = (stock.has_only_flat_cutters(), stock.lowest());
        Self {
            stock,
            has_only_flat_cutters,
            lowest,
            resolution,
            map,
            excursions: Excursions::default(),
            has_hit: false,
        }
    }

    /// Adds the material within O of a cutting move. Where the surface is unknown, material is only added along the rapid moves to be checked.
    fn add_material(&mut self, order: u32, movement: &Move) {
        let is_unknown = |piece: &StockSpan| piece.surface == f64::INFINITY;
        if self.stock.at(order).is_some_and(is_unknown) {
            if movement.pace == Pace::Rapid && movement.is_known() {
                for part in self.parts(movement) {
                    self.map.add(&capsule(&part, self.resolution), f64::INFINITY);
                }
            }
            return;
        }
        let Some(piece) = cutting_piece(order, movement, self.stock) else { return };
        for part in self.parts(movement) {
            if part.lowest() < piece.surface {
                self.map.add(&capsule(&part, piece.cutter.diameter), piece.surface);
            }
        }
    }

    /// Raises the material in a cutting move's own way, so that the highest surface of all cuts that go through a place applies there, in any order.
    /// Beside a cut, where a lower sheet may lie, the lowest one applies.
    fn raise_material(&mut self, order: u32, movement: &Move) {
        let Some(piece) =
            cutting_piece(order, movement, self.stock).filter(|piece| piece.surface.is_finite())
        else {
            return;
        };
        for part in self.parts(movement).filter(|part| part.lowest() < piece.surface) {
            self.map.raise(&capsule(&part, piece.cutter.removed / 2.0), piece.surface);
        }
    }

    /// Reports rapid moves down and up again without any other move between them, as if a hole were drilled or a slot milled with them. Where the
    /// material is known, the map decides instead.
    fn check_excursion(&mut self, step: &Step, movement: &Move, problems: &mut Problems) {
        let Some(piece) = self.stock.at(step.order) else { return };
        let is_unknown = |descent: &Move| {
            let place = [descent.to.x(), descent.to.y()];
            let tip = Capsule::new(place, place, piece.cutter.diameter / 2.0);
            self.map.highest_above(&tip, f64::NEG_INFINITY).is_none()
        };
        if let Some(ended) = self.excursions.step(step.line, movement, self.lowest, is_unknown) {
            problems.add_at_line(&say::RAPID_DIP, ended.line, |d| {
                d.with("z", ended.z()).with("surface", ended.surface).at_point(ended.place())
            });
        }
    }

    /// Removes the material along a cutting move, in a strip at least two cells wide, so that a cut of unknown width removes material as well.
    fn remove_material(&mut self, order: u32, movement: &Move) {
        let Some(piece) = cutting_piece(order, movement, self.stock) else { return };
        let highest = self.stock.highest().unwrap_or(piece.surface);
        for part in self.parts(movement).filter(|part| part.lowest() < highest) {
            let radius = (piece.cutter.removed / 2.0 + self.slack()).max(self.resolution);
            self.map.cut(&capsule(&part, radius), part.lowest());
        }
    }

    fn check_rapid(&mut self, step: &Step, movement: &Move, problems: &mut Problems) {
        let hit = self.first_hit(step.order, movement);
        self.has_hit = hit.is_some();
        let Some(Hit { message, z, height, at: [x, y] }) = hit else { return };
        // A strip of material of this width contains the centres of cells, wherever it is.
        let resolution = self.resolution + 2.0 * self.slack();
        problems.add_at_line(message, step.line, |diagnostic| {
            diagnostic
                .with("z", z)
                .with("height", height)
                .with("point", Point::new(x, y))
                .with("resolution", resolution)
                .at_point(Point::new(x, y))
        });
    }

    /// Reports cuts through material that is above their own surface, because another cut of the program goes through it from higher up.
    fn check_cut(&mut self, step: &Step, movement: &Move, problems: &mut Problems) {
        let Some(piece) = cutting_piece(step.order, movement, self.stock) else { return };
        if self.has_hit || self.stock.highest().is_none_or(|highest| piece.surface >= highest) {
            return;
        }
        let radius =
            (piece.cutter.removed / 2.0 - self.slack()).max(CENTRE_LINE_HALF_WIDTH * self.resolution);
        let hit = self.parts(movement).find_map(|part| {
            let hit = self.map.highest_above(&capsule(&part, radius), piece.surface + RESIDUE_HEIGHT)?;
            Some((part.lowest(), hit))
        });
        if let Some((z, (height, [x, y]))) = hit {
            problems.add_at_line(&say::CUT_IN_HIGHER_MATERIAL, step.line, |d| {
                let d = d.with("z", z).with("height", height).with("point", Point::new(x, y));
                d.at_point(Point::new(x, y))
            });
        }
    }

    /// Returns the first material that a rapid move hits.
    fn first_hit(&mut self, order: u32, movement: &Move) -> Option<Hit> {
        let piece = self.stock.at(order).filter(|_| is_low_rapid(movement, self.stock))?;
        let is_plunge = movement.keeps_xy();
        let message = match is_plunge {
            _ if piece.surface == f64::INFINITY => &say::RAPID_AT_DEPTH,
            true => &say::RAPID_PLUNGE,
            false => &say::RAPID_IN_MATERIAL,
        };
        self.parts(movement).find_map(|part| {
            let z = if is_plunge { part.lowest() } else { part.highest() };
            // The capsule of a centre line contains at least one cell centre, and is narrower than the area that a cut along it clears.
            let least = CENTRE_LINE_HALF_WIDTH * self.resolution;
            let cutter = capsule(&part, (piece.cutter.colliding / 2.0 - self.slack()).max(least));
            self.map.highest_above(&cutter, z + RESIDUE_HEIGHT).map(|(height, at)| Hit {
                message,
                z,
                height,
                at,
            })
        })
    }

    /// Returns the width in mm beside a cut that is not counted as material. The centre of a cell is exact, but coordinates are rounded, and chords
    /// deviate from their arc. If the cutter is not flat, the width of the cut is not known either.
    fn slack(&self) -> f64 {
        if self.has_only_flat_cutters {
            RESIDUE_WIDTH + self.resolution / CELL_PER_SAGITTA
        } else {
            self.resolution
        }
    }

    fn parts(&self, movement: &Move) -> impl Iterator<Item = MovePiece> + use<> {
        pieces(movement, self.resolution / CELL_PER_SAGITTA)
    }
}

/// Material that a rapid move hits.
struct Hit {
    message: &'static Message,
    /// Height of the cutter's tip in mm.
    z: f64,
    /// Height of the material in mm.
    height: f64,
    at: [f64; 2],
}

fn capsule(part: &MovePiece, radius: f64) -> Capsule {
    let plane = |at: &[f64; 3]| [at[0], at[1]];
    Capsule::new(plane(&part.from), plane(&part.to), radius)
}

/// Returns the stock at a cutting move, or at a probe of a program that only probes; `None` if it is unknown or the move stays above the surface.
pub(super) fn cutting_piece(order: u32, movement: &Move, stock: &Stock) -> Option<StockSpan> {
    let is_in_material = matches!(movement.pace, Pace::Feed(_)) || stock.is_probed && movement.probes_down();
    let piece = stock.at(order).filter(|_| movement.is_known() && is_in_material)?;
    (movement.lowest() < piece.surface).then_some(*piece)
}

/// Whether a rapid move may hit known material: it neither stays above all material nor goes straight up.
fn is_low_rapid(movement: &Move, stock: &Stock) -> bool {
    let is_above = stock.highest().is_none_or(|highest| movement.from.z().min(movement.to.z()) >= highest);
    let goes_up = movement.keeps_xy() && movement.to.z() >= movement.from.z();
    movement.pace == Pace::Rapid && movement.is_known() && !is_above && !goes_up
}

/// Returns an upper bound of the area in mm² within O of a move. An arc with different radii at its ends extends to the larger one.
fn covered_area(movement: &Move, cutter: f64) -> f64 {
    let widest = movement.extent().iter().take(2).flatten().map(|(low, high)| high - low).fold(0.0, f64::max);
    let tips = 2.0 * cutter * slope_parts(movement);
    2.0 * cutter * (movement.length().max(widest) + tips)
}

/// Maximum height of a part of a slope, in mm.
const MAX_PART_HEIGHT: f64 = 0.05;

const MAX_PARTS_PER_MOVE: f64 = 4096.0;

/// A straight part of a move.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovePiece {
    pub(super) from: [f64; 3],
    pub(super) to: [f64; 3],
}

impl MovePiece {
    pub(super) fn lowest(&self) -> f64 {
        self.from[2].min(self.to[2])
    }

    pub(super) fn highest(&self) -> f64 {
        self.from[2].max(self.to[2])
    }
}

/// Returns the number of parts required because a move is not level, at least 1.
pub(super) fn slope_parts(movement: &Move) -> f64 {
    let is_plunge = movement.keeps_xy() && matches!(movement.shape, MoveShape::Line);
    let rise = match movement.shape {
        MoveShape::Arc(arc) if arc.plane != Plane::Xy => movement.length(),
        _ => libm::fabs(movement.to.z() - movement.from.z()),
    };
    if is_plunge { 1.0 } else { (rise / MAX_PART_HEIGHT).ceil().clamp(1.0, MAX_PARTS_PER_MOVE) }
}

/// Returns the number of parts into which a move is divided, at least 1.
pub(super) fn part_count(movement: &Move, sagitta: f64) -> u32 {
    let slope = slope_parts(movement);
    let count = match movement.shape {
        MoveShape::Line => slope,
        MoveShape::Arc(arc) => slope
            .max(arc.sweep(&movement.from, &movement.to) / widest_chord(arc.radius(&movement.from), sagitta)),
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 1 to MAX_PARTS_PER_MOVE"
    )]
    let count = count.ceil().clamp(1.0, MAX_PARTS_PER_MOVE) as u32;
    count
}

/// Divides a move into straight parts. Arcs become chords that deviate from them by at most `sagitta` mm.
pub(super) fn pieces(movement: &Move, sagitta: f64) -> impl Iterator<Item = MovePiece> + use<> {
    movement
        .split(part_count(movement, sagitta))
        .map(|piece| MovePiece { from: piece.from.at, to: piece.to.at })
}

/// The finest useful resolution in mm; programs have three decimals.
const MIN_RESOLUTION: f64 = 0.01;

/// Minimum width in mm that the map resolves for a cutter of which only the centre line is considered.
const MIN_CENTRE_LINE_CUTTER: f64 = 1.0;

const DEFAULT_MAX_VISITED_CELLS: u64 = 1_000_000_000;

/// Default for the number of cells across the narrowest cutter.
const DEFAULT_CELLS_ACROSS_CUTTER: f64 = 12.0;

/// The upper face of the material and the cutter, as they change while a program is executed.
#[derive(Clone, Debug, PartialEq)]
pub struct Stock {
    /// The spans in the order of execution. Before the first one, the stock is unknown.
    pieces: Vec<StockSpan>,
    /// Height of the highest surface in mm, cached because every rapid move is compared with it.
    highest: Option<f64>,
    /// Side of a cell of the height map, in mm.
    resolution: f64,
    /// Maximum number of cells that are visited, counting repeated visits.
    cells: u64,
    /// Maximum number of parts into which arcs and slopes are divided.
    pub(super) most_pieces: u64,
    /// Whether the program only probes the material, so that it is known at the probes.
    is_probed: bool,
}

/// The stock from a step on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StockSpan {
    /// Position of that step in the order of execution.
    pub order: u32,
    /// Height of the upper face T of the material, in mm.
    pub surface: f64,
    /// Widths of the cutter.
    pub cutter: Cutter,
}

/// Widths of a cutter, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// The diameter. Material is assumed within this distance of a cut.
    pub diameter: f64,
    /// Width that a cut certainly clears to its full depth. 0 stands for the centre line only.
    pub removed: f64,
    /// Width that collides with material at the height of the tip. 0 stands for the centre line only.
    pub colliding: f64,
    /// Radius of the corners, which is 0 for a flat tip; `None` if the shape is unknown. Only pictures show it.
    pub corner_radius: Option<f64>,
}

impl Cutter {
    /// Creates a cutter that is flat over its whole diameter.
    pub fn flat(diameter: f64) -> Self {
        Self { diameter, removed: diameter, colliding: diameter, corner_radius: Some(0.0) }
    }

    /// Returns the width in mm that the map of the material must resolve.
    fn smallest_detail(&self) -> f64 {
        if self.removed < self.colliding {
            self.removed.max(self.diameter / 4.0)
        } else if self.colliding == 0.0 {
            // The diameter that a program states for a V-bit may be that of its point.
            self.diameter.max(MIN_CENTRE_LINE_CUTTER)
        } else {
            self.diameter
        }
    }

    /// Combines the cutter with another source's diameter: the smaller diameter removes material, the larger one collides with it.
    #[must_use]
    pub fn combined_with_diameter(self, diameter: f64) -> Self {
        Self {
            diameter: self.diameter.max(diameter),
            removed: self.removed.min(diameter),
            colliding: self.colliding.max(diameter),
            corner_radius: self.corner_radius,
        }
    }
}

impl Stock {
    /// Creates stock with a single surface and cutter for an entire program, both in mm.
    pub fn uniform(surface: f64, cutter: f64) -> Self {
        Self::of_pieces(vec![StockSpan { order: 0, surface, cutter: Cutter::flat(cutter) }])
    }

    /// Creates stock whose surface or cutter changes; the pieces must be in the order of execution.
    pub fn of_pieces(pieces: Vec<StockSpan>) -> Self {
        let highest = pieces.iter().map(|piece| piece.surface).reduce(f64::max);
        let stock = Self {
            pieces,
            highest,
            resolution: MIN_RESOLUTION,
            cells: DEFAULT_MAX_VISITED_CELLS,
            most_pieces: u64::MAX,
            is_probed: false,
        };
        let resolution =
            stock.narrowest().map_or(MIN_RESOLUTION, |cutter| cutter / DEFAULT_CELLS_ACROSS_CUTTER);
        stock.with_resolution(resolution)
    }

    /// Creates stock with an unknown surface, for [`DepthRules`](super::DepthRules); the cutters must be in the order of execution. The whole
    /// diameter removes material, but only the centre line collides with it, because the shape of the stock is unknown as well.
    pub fn with_unknown_surface(cutters: &[(u32, Cutter)]) -> Self {
        let piece = |(order, cutter): &(u32, Cutter)| StockSpan {
            order: *order,
            surface: f64::INFINITY,
            cutter: Cutter { removed: cutter.diameter, colliding: 0.0, ..*cutter },
        };
        Self::of_pieces(cutters.iter().map(piece).collect())
    }

    /// Creates the stock of a program, for the moves returned by [`moves`](toolpath::Program::moves).
    pub fn of(program: &toolpath::Program) -> Self {
        let piece = |order, surface, cutter| StockSpan { order, surface, cutter: Cutter::flat(cutter) };
        let elements = (1_u32..).zip(&program.steps).filter_map(|(number, step)| match step {
            Emitted::Comment(Comment::Element { surface, cutter, .. }) => {
                Some(piece(number, *surface, *cutter))
            }
            _ => None,
        });
        Self::of_pieces(std::iter::once(piece(0, program.thickness, program.tool)).chain(elements).collect())
    }

    /// Derives the stock of a native program whose drawing is not available. The upper face T of each path is the greatest height at which one of
    /// its plunges changes from rapid to feed (book: program/gcode). `None` if there is no such plunge.
    pub fn of_native_text(program: &(impl Program + ?Sized), cutter: Cutter) -> Option<Self> {
        let mut pieces = Vec::new();
        let mut section = PathSection { order: 0, surface: None };
        let mut before: Option<Move> = None;
        program.each(&mut |step| match &step.action {
            Action::Comment(text) if is_subpath_border(text) => {
                pieces.extend(section.piece(cutter));
                section = PathSection { order: step.order, surface: None };
            }
            Action::Move(movement) => {
                if let Some(last) = before.replace(*movement) {
                    section.check_plunge_after_rapid(&last, movement);
                }
            }
            _ => {}
        });
        pieces.extend(section.piece(cutter));
        (!pieces.is_empty()).then(|| Self::of_pieces(pieces))
    }

    /// Raises the surface to `surface` wherever it is lower or unknown.
    #[must_use]
    pub fn raised_to(self, surface: f64) -> Self {
        let first = self.pieces.first().map(|first| StockSpan { order: 0, surface, ..*first });
        let raised = |piece: StockSpan| StockSpan { surface: piece.surface.max(surface), ..piece };
        let begins_late = |first: &StockSpan| self.pieces.iter().all(|piece| piece.order > first.order);
        let first = first.filter(begins_late);
        Self::of_pieces(first.into_iter().chain(self.pieces.iter().copied().map(raised)).collect())
    }

    /// Returns the spans, in the order of execution.
    pub fn spans(&self) -> &[StockSpan] {
        &self.pieces
    }

    /// Whether the surface has the same height everywhere.
    pub fn is_level(&self) -> bool {
        self.pieces.iter().all(|piece| Some(piece.surface) == self.highest)
    }

    /// Returns the side of a cell of the height map, in mm.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Sets the side of a cell in mm. If it is too fine to be useful, a coarser one is used.
    pub fn with_resolution(self, resolution: f64) -> Self {
        Self { resolution: resolution.max(MIN_RESOLUTION), ..self }
    }

    /// Sets the maximum number of visited cells. (`[limits] verify-cells`)
    pub fn with_cells(self, most: u64) -> Self {
        Self { cells: most, ..self }
    }

    /// Sets the maximum number of parts into which arcs and slopes are divided. (`[limits] verify-pieces`)
    pub fn with_pieces(self, most: u64) -> Self {
        Self { most_pieces: most, ..self }
    }

    /// Sets whether the program only probes the material. Of a probe, only the centre is known.
    pub fn with_probes(mut self, is_probed: bool) -> Self {
        self.is_probed = is_probed;
        if is_probed {
            for piece in &mut self.pieces {
                (piece.cutter.removed, piece.cutter.colliding) = (0.0, 0.0);
            }
        }
        self
    }

    /// Whether every cutter clears exactly the width with which it collides. The exact width of any other cutter is not known.
    fn has_only_flat_cutters(&self) -> bool {
        self.pieces
            .iter()
            .all(|piece| piece.cutter.removed == piece.cutter.colliding && piece.cutter.removed > 0.0)
    }

    pub(super) fn cells(&self) -> u64 {
        self.cells
    }

    /// Returns the smallest width in mm that the map must resolve; `None` if there are no cutters.
    pub(super) fn narrowest(&self) -> Option<f64> {
        self.pieces.iter().map(|piece| piece.cutter.smallest_detail()).reduce(f64::min)
    }

    /// Returns the diameter of the widest cutter in mm; 0 if there are no cutters.
    pub(super) fn widest(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.cutter.diameter).fold(0.0, f64::max)
    }

    /// Returns the height in mm of the highest surface; `None` if there is no stock.
    pub fn highest(&self) -> Option<f64> {
        self.highest
    }

    /// Returns the height in mm of the lowest surface; `None` if there is no stock.
    pub(super) fn lowest(&self) -> Option<f64> {
        self.pieces.iter().map(|piece| piece.surface).reduce(f64::min)
    }

    /// Returns the stock that applies at a position in the order of execution; `None` before the first span.
    pub(super) fn at(&self, order: u32) -> Option<&StockSpan> {
        let later = self.pieces.partition_point(|piece| piece.order <= order);
        later.checked_sub(1).map(|index| &self.pieces[index])
    }
}

/// The steps of a native program that belong to a single path.
struct PathSection {
    order: u32,
    surface: Option<f64>,
}

impl PathSection {
    /// Checks two consecutive moves for a descent by rapid followed by a descent at feed.
    fn check_plunge_after_rapid(&mut self, first: &Move, second: &Move) {
        let is_vertical = |movement: &Move| movement.keeps_xy() && movement.to.z() < movement.from.z();
        if is_vertical(first)
            && is_vertical(second)
            && first.pace == Pace::Rapid
            && matches!(second.pace, Pace::Feed(_))
        {
            self.surface = Some(self.surface.map_or(first.to.z(), |known| known.max(first.to.z())));
        }
    }

    fn piece(&self, cutter: Cutter) -> Option<StockSpan> {
        self.surface.map(|surface| StockSpan { order: self.order, surface, cutter })
    }
}

fn is_subpath_border(comment: &str) -> bool {
    comment.starts_with("START Subpath ") || comment.starts_with("END Subpath ")
}
