//! An entity as read, before it is placed in the drawing.

use pathbuild_diagnostic::EntityKind;

use crate::layers::LayerId;
use crate::line_types::LineType;
use crate::shapes::{Ellipse, Insert, Spline};
use crate::trouble::EntityError;
use crate::{Geometry, Origin};

/// An entity on a layer that may be wanted.
#[derive(Clone, Debug)]
pub(crate) struct Item<'a> {
    pub(crate) traits: Traits,
    pub(crate) shape: Result<Shape<'a>, EntityError<'a>>,
}

/// The properties that all entities have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Traits {
    pub(crate) layer: LayerId,
    pub(crate) line_type: LineType,
    pub(crate) kind: EntityKind,
    pub(crate) origin: Origin,
    /// Whether group 60 hides it.
    pub(crate) is_invisible: bool,
}

/// The shape of an entity in the coordinates of its space.
#[derive(Clone, Debug)]
pub(crate) enum Shape<'a> {
    /// A shape of the drawing language.
    Plain(Geometry),
    /// The lines and arcs of a polyline.
    Parts(Vec<Geometry>),
    /// Approximated when it is placed.
    Ellipse(Box<Ellipse>),
    /// Approximated when it is placed.
    Spline(Box<Spline>),
    /// The contents of a block.
    Insert(Box<Insert<'a>>),
}
