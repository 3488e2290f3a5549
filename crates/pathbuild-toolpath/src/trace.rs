//! Records which element of which path each step of a program comes from.

use pathbuild_path::Placement;

/// The origins of the steps of a program. It is as long as the program and only recorded on request.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace<Id> {
    /// The paths in the program, beginning with the emitted one. A path that is embedded twice occurs twice.
    pub occurrences: Vec<Occurrence<Id>>,
    /// The element of each step of the program.
    pub steps: Vec<StepOrigin>,
}

/// A path at its place in a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence<Id> {
    /// Identifies the path and the values of its variables.
    pub id: Id,
    /// The element that embeds it, or `None` for the emitted path.
    pub parent: Option<StepOrigin>,
    /// Placement of its drawing in the program.
    pub placement: Placement,
    /// Height by which it is raised, in mm.
    pub raised: f64,
    /// S in mm, before it is raised.
    pub sweep_height: f64,
}

/// An element in a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepOrigin {
    /// Index into [`Trace::occurrences`].
    pub occurrence: u32,
    /// Index into [`DrawnElements::elements`](pathbuild_path::DrawnElements::elements) of its path; `None` before the first element.
    pub element: Option<u32>,
}

impl<Id> Default for Trace<Id> {
    fn default() -> Self {
        Self { occurrences: Vec::new(), steps: Vec::new() }
    }
}
