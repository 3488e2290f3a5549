//! The finished program. (book: program/gcode)

use std::collections::BTreeMap;

use pathbuild_diagnostic::EntityKind;
use pathbuild_path::Xy;

/// A finished program: what the machine does, step by step, before any dialect writes it down.
///
/// It begins at (0, 0, `start_height`); the frame around it (book: program/gcode) is the writer's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The emitted path's name, as the drawing spells its layer, with points.
    pub path: Box<str>,
    /// R: what is added to the names of its files.
    pub output_suffix: Box<str>,
    /// The drawing's file name, without directory.
    pub drawing: Box<str>,
    /// Cutter diameter O in mm.
    pub tool: f64,
    /// Sweep height S in mm.
    pub sweep_height: f64,
    /// Upper face T of the material in mm.
    pub thickness: f64,
    /// Whether it is the program of `PathDxf2GCode`, to be written in its form. (book: program/compatible)
    pub compatible: bool,
    /// Texts that steps refer to.
    pub names: Names,
    /// The moves and comments in order. Sweeps are merged; nothing follows the last.
    pub steps: Vec<Step>,
    /// Z-probes in the order in which they are measured: the first is #51.
    pub probes: Vec<ProbePoint>,
    /// What is drawn on the layers of its paths and no part of it.
    pub left_out: Vec<LeftOut>,
}

/// Curves on the layers of a path that are no part of its program (PB111).
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// The path.
    pub path: Box<str>,
    /// Their types, each once, with their number.
    pub entities: Vec<(EntityKind, usize)>,
}

/// A point whose real height is measured before milling. (book: language/probes)
#[derive(Clone, Debug, PartialEq)]
pub struct ProbePoint {
    /// In the program.
    pub at: Xy,
    /// In its own drawing, which is where a person finds it.
    pub drawn_at: Xy,
    /// The height that is expected there, mm.
    pub height: f64,
    /// Probing feed in mm/min.
    pub feed: f64,
    /// L.
    pub label: Option<Box<str>>,
}

impl Program {
    /// O in mm, if everything is milled with the same.
    pub fn cutter(&self) -> Option<f64> {
        let mut cutters = self.steps.iter().filter_map(|step| match step {
            Step::Comment(Comment::Element { cutter, .. }) => Some(*cutter),
            _ => None,
        });
        cutters.all(|cutter| cutter == self.tool).then_some(self.tool)
    }

    /// The upper face of the material in mm, if all of it has the same.
    pub fn surface(&self) -> Option<f64> {
        let mut surfaces = self.steps.iter().filter_map(|step| match step {
            Step::Comment(Comment::Element { surface, .. }) => Some(*surface),
            _ => None,
        });
        surfaces.all(|surface| surface == self.thickness).then_some(self.thickness)
    }

    /// S0, a little more than S, so that the first sweep always writes its Z.
    pub fn start_height(&self) -> f64 {
        self.sweep_height * (1.0 + 0.000_002)
    }
}

/// The feed in mm/min at which a compatible program begins: its header sets it, and its plunges name none.
pub(crate) const FIRST_FEED: f64 = 150.0;

/// One move or comment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the type says it")]
pub enum Step {
    Move { to: Move, count: Count },
    Comment(Comment),
}

/// A move from wherever the tool is. Coordinates are absolute, in mm; feeds in mm/min.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Move {
    /// `G00 X Y`: rapid in the plane, at the present height.
    Sweep { to: Xy },
    /// `G00 Z`: rapid up or down.
    Lift { z: Height },
    /// `G01 F Z`: down into the material.
    Drill { feed: f64, z: Height },
    /// `G01 F X Y Z`.
    Line { feed: f64, to: Xy, z: Height },
    /// `G02`/`G03 F I J X Y Z`; `centre` is relative to where the arc begins, as I and J are. `is_spiral`: a half circle of a helical
    /// circle, which the native dialect writes with a plain `I0`.
    Arc { feed: f64, clockwise: bool, centre: Xy, to: Xy, z: Height, is_spiral: bool },
}

/// A height, and the point whose measured material height corrects it in programs with probes. (book: program/gcode, `Z<expr(z, xy)>`)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Height {
    /// Z in mm.
    pub z: f64,
    /// The point named, which is where a move begins, or a helical circle's centre, not where the move ends.
    pub at: Xy,
}

/// What a move adds to the reference's statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count {
    /// Under which label.
    pub class: Class,
    /// Length in mm, as the reference counts it: in the plane, but a sweep's with its difference in height.
    pub length: f64,
    /// The feed in mm/min that its time is reckoned with; `None` is the rapid feed.
    pub feed: Option<f64>,
}

/// The labels of the statistics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Class {
    Milling,
    Drilling,
    Sweep,
}

/// A remark between moves. Texts are in [`Program::names`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Comment {
    /// `(Q:...)`, the drawing's own comment for the machine.
    Question(NameId),
    /// An embedded path begins.
    StartSubpath(NameId),
    /// It ends.
    EndSubpath(NameId),
    /// A drawn element begins.
    Element {
        /// What it is.
        kind: ElementKind,
        /// Where it begins in its drawing (not in the program), in mm.
        at: Xy,
        /// Cutter feed-independent facts a cycle needs: bottom of the hole or chain in program heights, mm.
        bottom: f64,
        /// Upper face of the material there, mm.
        surface: f64,
        /// Diameter O of the cutter there, mm: an embedded path has its own.
        cutter: f64,
        /// The depth C from which a hole is pecked.
        peck: Option<f64>,
    },
    /// A milling chain comes to this depth (program height, mm), counted from 1.
    Pass {
        /// Number of the pass.
        number: u32,
        /// Its depth.
        z: f64,
    },
}

/// The elements that a machinist tells apart in a program. (Glossary in book: reference/glossary)
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

/// Texts that steps refer to by number, so that a step is small and can be copied.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    texts: Vec<Box<str>>,
    numbers: BTreeMap<Box<str>, NameId>,
}

impl Names {
    /// The number of a text, adding it if it is new.
    pub fn intern(&mut self, text: &str) -> NameId {
        if let Some(number) = self.numbers.get(text) {
            return *number;
        }
        let number = NameId(u32::try_from(self.texts.len()).expect("a program has fewer than 2^32 names"));
        self.texts.push(text.into());
        self.numbers.insert(text.into(), number);
        number
    }

    /// The text of a number that [`intern`](Self::intern) of the same table gave.
    pub fn get(&self, id: NameId) -> &str {
        &self.texts[id.0 as usize]
    }
}
