//! The finished program. (book: program/gcode)

use std::collections::BTreeMap;

use pathbuild_diagnostic::EntityKind;
use pathbuild_path::Xy;

/// A finished program: the steps of the machine before they are written in any dialect.
///
/// It begins at (0, 0, `start_height`). The frame around it (book: program/gcode) is added when it is written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Name of the emitted path, with dots, as the drawing spells its layer.
    pub path: Box<str>,
    /// Suffix added to the names of its files (R).
    pub output_suffix: Box<str>,
    /// File name of the drawing, without directory.
    pub drawing: Box<str>,
    /// Cutter diameter O in mm.
    pub tool: f64,
    /// Sweep height S in mm.
    pub sweep_height: f64,
    /// Upper face T of the material in mm.
    pub thickness: f64,
    /// Whether it is to be written in the form of `PathDxf2GCode`. (book: program/compatible)
    pub compatible: bool,
    /// Texts referred to by steps.
    pub names: Names,
    /// Moves and comments in order. Sweeps are merged; nothing follows the last step.
    pub steps: Vec<Step>,
    /// Z-probes in the order in which they are measured, starting with #51.
    pub probes: Vec<ProbePoint>,
    /// Elements on the layers of its paths that do not belong to them.
    pub left_out: Vec<LeftOut>,
}

/// Curves on the layers of a path that do not belong to its program (PB111).
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Name of the path.
    pub path: Box<str>,
    /// Their types, with the number of curves of each.
    pub entities: Vec<(EntityKind, usize)>,
}

/// A point at which the real height is measured before milling. (book: language/probes)
#[derive(Clone, Debug, PartialEq)]
pub struct ProbePoint {
    /// In program coordinates.
    pub at: Xy,
    /// In the coordinates of its drawing, where the user will look for it.
    pub drawn_at: Xy,
    /// Expected height in mm.
    pub height: f64,
    /// Probing feed in mm/min.
    pub feed: f64,
    /// Label (L).
    pub label: Option<Box<str>>,
}

impl Program {
    /// O in mm, if the same cutter mills everything.
    pub fn cutter(&self) -> Option<f64> {
        let mut cutters = self.steps.iter().filter_map(|step| match step {
            Step::Comment(Comment::Element { cutter, .. }) => Some(*cutter),
            _ => None,
        });
        cutters.all(|cutter| cutter == self.tool).then_some(self.tool)
    }

    /// Height of the upper face of the material in mm, if it is the same everywhere.
    pub fn surface(&self) -> Option<f64> {
        let mut surfaces = self.steps.iter().filter_map(|step| match step {
            Step::Comment(Comment::Element { surface, .. }) => Some(*surface),
            _ => None,
        });
        surfaces.all(|surface| surface == self.thickness).then_some(self.thickness)
    }

    /// The largest cutter diameter O in mm.
    pub fn largest_cutter(&self) -> f64 {
        let cutters = self.steps.iter().filter_map(|step| match step {
            Step::Comment(Comment::Element { cutter, .. }) => Some(*cutter),
            _ => None,
        });
        cutters.fold(self.tool, f64::max)
    }

    /// S0, which is slightly above S, so that the first sweep always writes its Z.
    pub fn start_height(&self) -> f64 {
        self.sweep_height * (1.0 + 0.000_002)
    }
}

/// The feed in mm/min at the start of a compatible program: the header sets it, and plunges do not write a feed.
pub(crate) const FIRST_FEED: f64 = 150.0;

/// A move or a comment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the type says it")]
pub enum Step {
    Move { to: Move, count: Count },
    Comment(Comment),
}

/// A move from the current position. Coordinates are absolute and in mm, feeds in mm/min.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Move {
    /// `G00 X Y`: a rapid in the plane at the current height.
    Sweep { to: Xy },
    /// `G00 Z`: a rapid up or down.
    Lift { z: Height },
    /// `G01 F Z`: down into the material.
    Drill { feed: f64, z: Height },
    /// `G01 F X Y Z`.
    Line { feed: f64, to: Xy, z: Height },
    /// `G02`/`G03 F I J X Y Z`. `centre` is relative to the start of the arc, like I and J. `is_spiral` marks a half circle of a helical
    /// circle, which the native dialect writes with a plain `I0`.
    Arc { feed: f64, clockwise: bool, centre: Xy, to: Xy, z: Height, is_spiral: bool },
}

/// A height, and the point for which it is corrected in programs with probes. (book: program/gcode, `Z<expr(z, xy)>`)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Height {
    /// Z in mm.
    pub z: f64,
    /// The point for which the height is corrected: the start of the move or the centre of a helical circle, not the end of the move.
    pub at: Xy,
}

/// The contribution of a move to the statistics of the original tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count {
    /// The label it is counted under.
    pub class: Class,
    /// Length in mm as counted by the original tool: in the plane, but for sweeps including the difference in height.
    pub length: f64,
    /// Feed in mm/min used to calculate the time; `None` is the rapid feed.
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
        /// Its start in mm, in the coordinates of its drawing instead of those of the program.
        at: Xy,
        /// Bottom of the hole or chain in mm, in program heights. Drilling cycles need it.
        bottom: f64,
        /// Height of the upper face of the material there, in mm.
        surface: f64,
        /// Cutter diameter O in mm, which may differ between embedded paths.
        cutter: f64,
        /// Peck depth C of a hole.
        peck: Option<f64>,
    },
    /// Start of a pass of a milling chain.
    Pass {
        /// Number of the pass, counted from 1.
        number: u32,
        /// Depth in mm, in program heights.
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

    /// The text with an index returned by [`intern`](Self::intern) of the same table.
    pub fn get(&self, id: NameId) -> &str {
        &self.texts[id.0 as usize]
    }
}
