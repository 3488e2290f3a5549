//! Defines the finished program, the origins of its steps, its lengths and times, and an estimate of its size. (book: program/gcode)

use std::collections::BTreeMap;
use std::ops::Add;
use std::ptr;

use pathbuild_diagnostic::EntityKind;
use pathbuild_path::{
    Bars, Chain, ChainSegment, CutParameters, Helix, Item, Path, Placement, WalkedPath, Xy,
};

/// A finished program: the steps of the machine before they are written in any dialect.
///
/// It begins at (0, 0, `start_height`). The frame around it (book: program/gcode) is added when it is written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Name of the emitted path, with dots, as the drawing spells its layer.
    pub path: Box<str>,
    /// Suffix added to the names of the program's files (R).
    pub output_suffix: Box<str>,
    /// File name of the drawing, without directory.
    pub drawing: Box<str>,
    /// Cutter diameter O in mm.
    pub tool: f64,
    /// Sweep height S in mm.
    pub sweep_height: f64,
    /// Upper face T of the material in mm.
    pub thickness: f64,
    /// Whether the program is to be written in the form of `PathDxf2GCode`. (book: program/compatible)
    pub compatible: bool,
    /// Texts referred to by steps.
    pub names: Names,
    /// Moves and comments in order. Consecutive sweeps are merged. The final lift belongs to the frame and is not among them.
    pub steps: Vec<ProgramStep>,
    /// Z-probes in the order in which they are measured, starting with #51.
    pub probes: Vec<ProbePoint>,
    /// Curves on the layers of the program's paths that do not belong to these paths (PB111).
    pub left_out: Vec<OmittedCurves>,
}

/// Curves on the layers of a path that do not belong to its program (PB111).
#[derive(Clone, Debug, PartialEq)]
pub struct OmittedCurves {
    /// Name of the path. The curves are on its layers.
    pub path: Box<str>,
    /// Types of the curves, with the number of curves of each.
    pub entities: Vec<(EntityKind, usize)>,
}

/// A point at which the real height is measured before milling. (book: language/probes)
#[derive(Clone, Debug, PartialEq)]
pub struct ProbePoint {
    /// Position in program coordinates.
    pub at: Xy,
    /// Position in the coordinates of the probe's drawing, where the user will look for it.
    pub drawn_at: Xy,
    /// Expected height in mm.
    pub height: f64,
    /// Probing feed in mm/min.
    pub feed: f64,
    /// The drawing's label for the probe (L).
    pub label: Option<Box<str>>,
}

impl Program {
    /// Returns O in mm, if the same cutter mills everything.
    pub fn cutter(&self) -> Option<f64> {
        self.elements().all(|(cutter, _)| cutter == self.tool).then_some(self.tool)
    }

    /// Returns the height of the upper face of the material in mm, if it is the same everywhere.
    pub fn surface(&self) -> Option<f64> {
        self.elements().all(|(_, surface)| surface == self.thickness).then_some(self.thickness)
    }

    /// Returns the largest cutter diameter O in mm.
    pub fn largest_cutter(&self) -> f64 {
        self.elements().map(|(cutter, _)| cutter).fold(self.tool, f64::max)
    }

    /// Returns the cutter diameter of each element, and the upper face of its material, in mm.
    fn elements(&self) -> impl Iterator<Item = (f64, f64)> {
        self.steps.iter().filter_map(|step| match step {
            ProgramStep::Comment(Comment::Element { cutter, surface, .. }) => Some((*cutter, *surface)),
            _ => None,
        })
    }

    /// Returns the peck depth C in mm that applies from each element on, by step number as in [`moves`](Self::moves).
    pub fn pecks(&self) -> Vec<(u32, Option<f64>)> {
        let peck = |(number, step): (u32, &ProgramStep)| match step {
            ProgramStep::Comment(Comment::Element { peck, .. }) => Some((number, *peck)),
            _ => None,
        };
        (1_u32..).zip(&self.steps).filter_map(peck).collect()
    }

    /// Returns S0 in mm, which is slightly above S, so that the first sweep always writes its Z.
    pub fn start_height(&self) -> f64 {
        self.sweep_height * (1.0 + 0.000_002)
    }
}

/// The feed in mm/min at the start of a compatible program: its header sets this feed, and plunges do not write one.
pub(crate) const FIRST_FEED: f64 = 150.0;

/// A move or a comment, as the writer of a program needs it.
///
/// It carries what a step of the machine (`pathbuild_motion::Step`) cannot: how PathDxf2GCode counts the move, the point for which its
/// height is corrected, half circles of helices, and comments that name elements. [`Program::moves`] gives the machine's moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the type says it")]
pub enum ProgramStep {
    Move { to: PlannedMove, count: Count },
    Comment(Comment),
}

/// A move from the current position. Coordinates are absolute and in mm, feeds in mm/min.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum PlannedMove {
    /// `G00 X Y`: a rapid in the plane at the current height.
    Sweep { to: Xy },
    /// `G00 Z`: a rapid up or down.
    Lift { z: Height },
    /// `G01 F Z`: a straight cut down into the material.
    Drill { feed: f64, z: Height },
    /// `G01 F X Y Z`: a straight cut.
    Line { feed: f64, to: Xy, z: Height },
    /// `G02`/`G03 F I J X Y Z`: an arc. `centre` is relative to the start of the arc, like I and J. `is_spiral` marks a half circle of a helical
    /// circle, which the native dialect writes with a plain `I0`.
    Arc { feed: f64, clockwise: bool, centre: Xy, to: Xy, z: Height, is_spiral: bool },
}

impl PlannedMove {
    /// Returns where a move that begins at `from` ends.
    pub(crate) fn end(&self, from: Tip) -> Tip {
        match *self {
            Self::Sweep { to } => Tip { at: to, ..from },
            Self::Lift { z } | Self::Drill { z, .. } => Tip { z: z.z, ..from },
            Self::Line { to, z, .. } | Self::Arc { to, z, .. } => Tip { at: to, z: z.z },
        }
    }
}

impl ProgramStep {
    /// Returns the target height of a move; `None` for a sweep, which keeps its height.
    pub fn height(&self) -> Option<Height> {
        match *self {
            Self::Comment(_) | Self::Move { to: PlannedMove::Sweep { .. }, .. } => None,
            Self::Move {
                to:
                    PlannedMove::Lift { z }
                    | PlannedMove::Drill { z, .. }
                    | PlannedMove::Line { z, .. }
                    | PlannedMove::Arc { z, .. },
                ..
            } => Some(z),
        }
    }
}

/// A height, and the point for which it is corrected in programs with probes. (book: program/gcode, `Z<expr(z, xy)>`)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Height {
    /// Z in mm.
    pub z: f64,
    /// The point in program coordinates for which the height is corrected: the start of the move or the centre of a helical circle.
    /// [`Correction::steps`](crate::Correction::steps) replaces it by the end of the move.
    pub at: Xy,
}

/// The contribution of a move to the statistics of PathDxf2GCode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count {
    /// The label under which the move is counted.
    pub class: MoveClass,
    /// Length in mm as PathDxf2GCode counts it: in the plane for milling, the difference in height for plunges and lifts, and the distance in space
    /// for sweeps from one element to the next.
    pub length: f64,
    /// Feed in mm/min used to calculate the time; `None` is the rapid feed.
    pub feed: Option<f64>,
}

/// The labels of PathDxf2GCode's statistics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it")]
pub enum MoveClass {
    Milling,
    Drilling,
    Sweep,
}

/// A comment between moves. Texts are in [`Program::names`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Comment {
    /// `(Q:...)`, a comment from the drawing for the operator.
    Question(NameId),
    /// Start of an embedded path.
    StartSubpath(NameId),
    /// End of an embedded path.
    EndSubpath(NameId),
    /// Start of a drawn element.
    Element {
        /// Kind of the element.
        kind: ElementKind,
        /// Start of the element in mm, in the coordinates of its drawing instead of those of the program.
        at: Xy,
        /// Z of the bottom of the hole or chain in mm, in program coordinates. Posts need it for drilling cycles.
        bottom: f64,
        /// Height of the upper face of the material at the element, in mm.
        surface: f64,
        /// Cutter diameter O in mm, which may differ between embedded paths.
        cutter: f64,
        /// Peck depth C of a hole in mm.
        peck: Option<f64>,
    },
    /// Start of a pass of a milling chain.
    Pass {
        /// Number of the pass, counted from 1.
        number: u32,
        /// Z of the pass in mm, in program coordinates.
        z: f64,
    },
}

/// The kinds of elements distinguished in programs. (Glossary in book: reference/glossary)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it")]
pub enum ElementKind {
    MillingChain,
    DrilledHole,
    HelicalCircle,
    Sweep,
}

/// Index of a text in [`Names`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NameId(u32);

/// Position of the tool tip in the plane, and its Z, in mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tip {
    pub(crate) at: Xy,
    pub(crate) z: f64,
}

/// Texts that steps refer to by index, so that steps are small and can be copied.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    texts: Vec<Box<str>>,
    numbers: BTreeMap<Box<str>, NameId>,
}

impl Names {
    /// Returns the index of a text, adding it if it is new.
    pub fn intern(&mut self, text: &str) -> NameId {
        if let Some(number) = self.numbers.get(text) {
            return *number;
        }
        let number = NameId(u32::try_from(self.texts.len()).expect("a program has fewer than 2^32 names"));
        self.texts.push(text.into());
        self.numbers.insert(text.into(), number);
        number
    }

    /// Returns the text with an index that [`intern`](Self::intern) of the same table returned.
    pub fn get(&self, id: NameId) -> &str {
        &self.texts[id.0 as usize]
    }
}

// Records which element of which path each step of a program comes from.

/// The origin of each step of a program. It is only recorded on request, because it is as long as the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace<Id> {
    /// The paths in the program, beginning with the emitted one. A path that is embedded twice occurs twice.
    pub occurrences: Vec<Occurrence<Id>>,
    /// The element from which each step of the program originates.
    pub steps: Vec<StepOrigin>,
    /// The origin of each element of [`Program::probes`].
    pub probes: Vec<ProbeOrigin>,
}

/// A path at its place in a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence<Id> {
    /// Identifier of the path and of the values of its variables.
    pub id: Id,
    /// The element that embeds the path; `None` for the emitted path.
    pub parent: Option<StepOrigin>,
    /// Placement of the path's drawing in the program.
    pub placement: Placement,
    /// Height in mm by which the path is raised.
    pub raised: f64,
    /// Sweep height S of the path in mm, before it is raised.
    pub sweep_height: f64,
}

/// The element of a placed path from which a step originates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepOrigin {
    /// Index into [`Trace::occurrences`].
    pub occurrence: u32,
    /// Index into [`DrawnElements::elements`](pathbuild_path::DrawnElements::elements) of its path; `None` before the first element.
    pub element: Option<u32>,
}

/// The probe of a placed path from which a probe of the program originates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ProbeOrigin {
    /// Index into [`Trace::occurrences`].
    pub occurrence: u32,
    /// Index into [`Path::probes`] of its path.
    pub probe: usize,
}

impl<Id> Default for Trace<Id> {
    fn default() -> Self {
        Self { occurrences: Vec::new(), steps: Vec::new(), probes: Vec::new() }
    }
}

// Estimates the number of moves of a path before they are computed, so that limits can be checked first.

/// Estimates the number of moves of a path without its embedded paths: never less than half the real number; saturates.
pub fn own_moves(path: &Path, walked: &WalkedPath) -> u64 {
    walked.items.iter().map(|item| moves(path, walked, item)).fold(0, u64::saturating_add)
}

/// Estimates the memory in bytes for this number of moves in a program, each with a comment.
pub fn estimated_bytes(moves: u64) -> u64 {
    moves.saturating_mul(2 * size_of::<ProgramStep>() as u64)
}

fn moves(path: &Path, walked: &WalkedPath, item: &Item) -> u64 {
    match item {
        Item::Chain(chain) => chain_moves(path, chain, walked.members(chain)),
        Item::Helix { helix, .. } => helix_moves(path, &path.helices[*helix as usize]),
        Item::Hole { .. } | Item::Sweep(_) | Item::Subpath(_) => 4,
    }
}

fn chain_moves(path: &Path, chain: &Chain, members: &[ChainSegment]) -> u64 {
    let first = chain.first_depth.unwrap_or(path.thickness);
    // Consecutive segments usually share their parameters, so the last result is cached.
    let mut last: Option<(&CutParameters, u64)> = None;
    let segments = members.iter().map(|member| {
        let cut = member.cut(path);
        let known = last.filter(|(known, _)| ptr::eq(*known, cut));
        let (_, passes) =
            *last.insert(known.unwrap_or_else(|| (cut, pass_count(first - cut.bottom, chain.infeed))));
        let sections = cut.bars.map_or(1, |bars| section_count(&bars, member.curve(path).length()));
        passes.saturating_mul(sections.saturating_add(1))
    });
    let once = segments.fold(0, u64::saturating_add);
    if chain.first_depth.is_some() { once.saturating_mul(2) } else { once }
}

fn helix_moves(path: &Path, helix: &Helix) -> u64 {
    let spiral = pass_count(path.thickness - helix.bottom, helix.infeed).saturating_mul(2);
    let with_bars = helix.bars.map_or(0, |(depth, bars)| {
        let length = std::f64::consts::TAU * helix.axis_radius(path.tool);
        pass_count(helix.bottom - depth, helix.infeed).saturating_mul(section_count(&bars, length))
    });
    spiral.saturating_add(with_bars)
}

/// Returns the number of sections of a segment with bars: each gap is a slope, a low section, a slope and the next bar.
fn section_count(bars: &Bars, length: f64) -> u64 {
    whole(4.0 * bars.count(length) + 1.0)
}

fn pass_count(depth: f64, infeed: f64) -> u64 {
    whole((depth / infeed).ceil().max(0.0)).saturating_add(1)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, and is never negative"
)]
fn whole(number: f64) -> u64 {
    number as u64
}

/// The totals of a program, by the labels of PathDxf2GCode's statistics.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Statistics {
    pub milling: Total,
    pub drilling: Total,
    pub sweeps: Total,
    /// Number of moves counted.
    pub commands: u64,
}

/// Total length and time of moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Total {
    /// Length in mm.
    pub length: f64,
    /// Sum of length / feed in minutes, which ignores acceleration.
    pub time: f64,
}

/// Factor by which a machine is slower than length / feed.
const SLOWDOWN_FACTOR: f64 = 1.4;

impl Statistics {
    /// Returns the statistics that `PathDxf2GCode` writes for a program, with a rapid feed in mm/min. They use planned lengths, which can differ from
    /// those of the moves. Only compatible programs have such statistics.
    pub fn of_reference(program: &Program, rapid: f64) -> Self {
        let mut statistics = Self::default();
        for step in &program.steps {
            if let ProgramStep::Move { count, .. } = step {
                statistics.add(count, rapid);
            }
        }
        let last = program.steps.iter().rev().find_map(ProgramStep::height);
        let last = last.map_or(0.0, |last| (last.z - program.start_height()).abs());
        statistics.add(&Count { class: MoveClass::Sweep, length: last, feed: None }, rapid);
        statistics
    }

    /// Returns the sum of milling, drilling and sweeps.
    pub fn sum(&self) -> Total {
        let totals = [self.milling, self.drilling, self.sweeps];
        totals.into_iter().fold(Total::default(), Add::add)
    }

    fn add(&mut self, count: &Count, rapid: f64) {
        let total = match count.class {
            MoveClass::Milling => &mut self.milling,
            MoveClass::Drilling => &mut self.drilling,
            MoveClass::Sweep => &mut self.sweeps,
        };
        total.length += count.length;
        total.time += count.length / count.feed.unwrap_or(rapid);
        self.commands += 1;
    }
}

impl Add for Total {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { length: self.length + other.length, time: self.time + other.time }
    }
}

impl Total {
    /// Returns the estimated real time in whole minutes, rounded up after rounding to 0.0000001 s.
    pub fn minutes(&self) -> f64 {
        let seconds = SLOWDOWN_FACTOR * self.time * 60.0;
        ((seconds * 1e7).round() / 1e7 / 60.0).ceil()
    }
}
