use pathbuild_draw::model::{Entity, Shape};

/// Bytes of the fixed parts (header, usual tables, empty blocks and objects), of a layer, and of a block.
const FRAME: usize = 14_500;
const LAYER: usize = 155;
const BLOCK: usize = 500;

/// Bytes of a hatch line.
pub(super) const HATCH_LINE: usize = 167;

/// Estimated size of a drawing in bytes in R2000, precise to a few per cent.
pub(super) fn estimate<'a>(
    layers: usize,
    blocks: usize,
    entities: impl Iterator<Item = &'a Entity>,
) -> usize {
    FRAME + LAYER * layers + BLOCK * blocks + entities.map(entity).sum::<usize>()
}

fn entity(entity: &Entity) -> usize {
    let shape = match &entity.shape {
        Shape::Line(_) => 140,
        Shape::Arc(_) => 170,
        Shape::Circle(_) => 120,
        Shape::Polyline(polyline) => 110 + 30 * polyline.vertices.len(),
        Shape::Ellipse(_) => 185,
        Shape::Solid(_) => 205,
        Shape::Spline(spline) => 180 + 50 * (spline.control.len() + spline.fit.len()),
        Shape::Insert(_) => 155,
        Shape::Text(text) => 140 + text.value.len(),
        Shape::MText(text) => 205 + text.value.len(),
        Shape::Dimension(_) => 400,
        Shape::Raw(pairs) => pairs.iter().map(|pair| 7 + pair.value.len()).sum(),
    };
    shape + entity.line_type.as_ref().map_or(0, |name| 7 + name.len())
}
