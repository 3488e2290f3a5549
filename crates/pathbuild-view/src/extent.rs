//! Bounding boxes.

/// A point in the plane: x, y.
pub type Point = [f64; 2];

/// Lower left and upper right corner of a box.
pub(crate) type Corners = [Point; 2];

/// Returns the bounding box of all finite boxes; `None` if there are none.
pub(crate) fn bounding_box(boxes: impl IntoIterator<Item = Corners>) -> Option<Corners> {
    let is_finite = |corners: &Corners| corners.as_flattened().iter().all(|value| value.is_finite());
    boxes.into_iter().filter(is_finite).reduce(enclosing_box)
}

/// Returns the bounding box of two boxes.
pub(crate) fn enclosing_box([low, high]: Corners, [lower, higher]: Corners) -> Corners {
    [[0, 1].map(|axis| low[axis].min(lower[axis])), [0, 1].map(|axis| high[axis].max(higher[axis]))]
}

/// Returns the box with this margin on all sides.
pub(crate) fn with_margin([low, high]: Corners, margin: f64) -> Corners {
    [low.map(|at| at - margin), high.map(|at| at + margin)]
}

/// Returns the box, enlarged to at least this width and height. Its middle remains.
pub(crate) fn with_min_extent([mut low, mut high]: Corners, least: f64) -> Corners {
    for axis in [0, 1] {
        let missing = (least - (high[axis] - low[axis])).max(0.0) / 2.0;
        low[axis] -= missing;
        high[axis] += missing;
    }
    [low, high]
}
