//! From which element of which path each step of a program comes.

use pathbuild_path::Placement;

/// Where the steps of a program come from. Kept only where somebody wants to see it: it is as long as the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace<Id> {
    /// The paths in the program, the emitted one first; one that is embedded twice is there twice.
    pub occurrences: Vec<Occurrence<Id>>,
    /// For each step of the program the element that it belongs to.
    pub steps: Vec<Drawn>,
}

/// A path where it lies in a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence<Id> {
    /// Which path, with which values.
    pub id: Id,
    /// What embeds it: index into [`Trace::occurrences`], and the element there; `None` for the emitted path.
    pub parent: Option<Drawn>,
    /// How its drawing lies in the program.
    pub placement: Placement,
    /// What it is raised by, in mm.
    pub raised: f64,
    /// S in mm, before it is raised.
    pub sweep_height: f64,
}

/// An element in a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Drawn {
    /// Index into [`Trace::occurrences`].
    pub occurrence: u32,
    /// Index into [`Drawn::elements`](pathbuild_path::Drawn::elements) of its path; `None` where no element was begun yet.
    pub element: Option<u32>,
}

impl<Id> Default for Trace<Id> {
    fn default() -> Self {
        Self { occurrences: Vec::new(), steps: Vec::new() }
    }
}
