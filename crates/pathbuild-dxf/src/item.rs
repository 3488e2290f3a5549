//! What is read of one entity, before it is placed in the drawing.

use pathbuild_diagnostic::EntityKind;

use crate::layers::LayerId;
use crate::line_types::LineType;
use crate::shapes::{Ellipse, Insert, Spline};
use crate::trouble::Trouble;
use crate::{Geometry, Origin};

/// An entity on a layer that may be wanted.
#[derive(Clone, Debug)]
pub(crate) struct Item<'a> {
    pub(crate) traits: Traits,
    pub(crate) shape: Result<Shape<'a>, Trouble<'a>>,
}

/// What every entity has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Traits {
    pub(crate) layer: LayerId,
    pub(crate) line_type: LineType,
    pub(crate) kind: EntityKind,
    pub(crate) origin: Origin,
    /// Group 60 says so.
    pub(crate) is_invisible: bool,
}

/// The shape of an entity in the coordinates of the space that it is in.
#[derive(Clone, Debug)]
pub(crate) enum Shape<'a> {
    /// One that the drawing language knows.
    Plain(Geometry),
    /// The lines and arcs of a polyline.
    Parts(Vec<Geometry>),
    /// To be approximated where it is placed.
    Ellipse(Box<Ellipse>),
    /// To be approximated where it is placed.
    Spline(Box<Spline>),
    /// The contents of a block.
    Insert(Box<Insert<'a>>),
}
