//! What a drawing is made of.

mod entity;
mod layer;
mod options;
mod point;
mod shape;

pub use entity::{Change, Entity, Note, NoteKind, Orientation};
pub use layer::{Layer, LayerState};
pub use options::{LineEnds, Options, Part, TextEncoding, Version};
pub use point::Point;
pub(crate) use point::sin_cos;
pub use shape::{
    Arc, Attachment, Circle, Dimension, Direction, Ellipse, Horizontal, Insert, Line, MText, Pair, Polyline,
    PolylineKind, Shape, Spline, Text, Vertex, Vertical,
};
