//! What the faults of a path leave unknown, so that all errors that do not follow from them are reported at once.
//! (book: reference/diagnostics)

use crate::element::Element;
use crate::geometry::Xy;
use crate::letter::Letters;

/// What the drawing of a path leaves unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DrawingFaults {
    /// Letters of texts that belong to no element: each element may lack them for that reason.
    pub(crate) stray_letters: Letters,
    /// An entity that cannot be read may be anything.
    pub(crate) has_broken_entity: bool,
    /// Of two starts it is not known which one holds the path's text.
    pub(crate) has_second_start: bool,
    /// Ends behind the first.
    pub(crate) other_ends: Vec<Xy>,
    /// Circles that mean nothing as they are: the walk may turn or end there.
    pub(crate) unclear_circles: Vec<Xy>,
    /// Lines and arcs of unknown line types: the path runs along them, whatever happens there.
    pub(crate) unclear_curves: Vec<Element>,
    /// Variables whose definition is at fault.
    pub(crate) variables: Vec<char>,
}

/// What is not known of a path that has errors.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Faults {
    /// Letters of which it is not known what the path says.
    pub(crate) letters: Letters,
    /// A segment's I may be hidden by an error.
    pub(crate) is_infeed_unknown: bool,
    /// Nothing can be said of the walk: its start, its order or a segment is unknown.
    pub(crate) is_walk_unknown: bool,
    /// Where the path may end; nothing where the end is not known.
    pub(crate) ends: Vec<Xy>,
    /// See [`DrawingFaults::unclear_circles`].
    pub(crate) unclear_circles: Vec<Xy>,
}
