//! What the errors of a path leave unknown, so that all errors that do not follow from others are reported at once.
//! (book: reference/diagnostics)

use crate::element::Element;
use crate::geometry::Xy;
use crate::letter::Letters;

/// What errors in the drawing of a path leave unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DrawingFaults {
    /// Letters in texts without an element: any element may lack them for that reason.
    pub(crate) stray_letters: Letters,
    /// Whether there is an unreadable entity, which may be anything.
    pub(crate) has_broken_entity: bool,
    /// Whether there are two starts, either of which may have the path's text.
    pub(crate) has_second_start: bool,
    /// End markers after the first.
    pub(crate) other_ends: Vec<Xy>,
    /// Circles without a meaning: the walk may turn or end there.
    pub(crate) unclear_circles: Vec<Xy>,
    /// Lines and arcs of unknown line types: the path runs along them in an unknown way.
    pub(crate) unclear_curves: Vec<Element>,
    /// Variables with an erroneous definition.
    pub(crate) variables: Vec<char>,
}

/// What is unknown about a path with errors.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Faults {
    /// Letters whose values are unknown.
    pub(crate) letters: Letters,
    /// Whether an error may hide I of a segment.
    pub(crate) is_infeed_unknown: bool,
    /// Whether the walk cannot be checked, because its start, its order or a segment is unknown.
    pub(crate) is_walk_unknown: bool,
    /// Possible ends of the path; empty if the end is unknown.
    pub(crate) ends: Vec<Xy>,
    /// See [`DrawingFaults::unclear_circles`].
    pub(crate) unclear_circles: Vec<Xy>,
}
