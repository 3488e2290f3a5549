//! Assigns layers to paths. (book: language/layers-and-names)

use pathbuild_dxf::{Drawing, Layer};

use crate::names::{PathName, PathPattern};

/// The path layers of a drawing.
pub(super) struct PathLayers {
    /// The path layers in file order, except that the layers of a path follow its first one.
    found: Vec<FoundLayer>,
    /// The memberships by layer number.
    memberships: Vec<Option<Membership>>,
}

/// A path layer.
pub(super) struct FoundLayer {
    /// The name of its path, as spelt by the layer.
    pub(super) path: PathName,
    /// Its number among the layers of the drawing.
    pub(super) number: usize,
    /// The number of the first layer of its path.
    first: usize,
}

/// The place of a layer in a path.
#[derive(Clone, Copy)]
pub(super) struct Membership {
    /// Index of the path in the drawing.
    pub(super) path: usize,
    /// Index of the layer in the path.
    pub(super) layer: u32,
}

impl PathLayers {
    /// Finds the path layers of a drawing.
    pub(super) fn find(drawing: &Drawing, pattern: &PathPattern) -> Self {
        let layer = |(number, layer): (usize, &Layer)| {
            let path = pattern.layer(&layer.name)?.path;
            Some(FoundLayer { path, number, first: number })
        };
        let mut found: Vec<FoundLayer> = drawing.layers.iter().enumerate().filter_map(layer).collect();
        found.sort_by(|one, other| one.path.cmp(&other.path));
        for of_path in found.chunk_by_mut(|one, other| one.path == other.path) {
            let first = of_path[0].number;
            for layer in of_path {
                layer.first = first;
            }
        }
        found.sort_by_key(|layer| layer.first);
        let mut memberships = vec![None; drawing.layers.len()];
        for (path, layers) in by_path(&found).enumerate() {
            for (layer, found) in (0_u32..).zip(layers) {
                memberships[found.number] = Some(Membership { path, layer });
            }
        }
        Self { found, memberships }
    }

    /// The layers of each path, in order of first appearance.
    pub(super) fn by_path(&self) -> impl Iterator<Item = &[FoundLayer]> {
        by_path(&self.found)
    }

    /// The membership of a layer; `None` if it is not a path layer.
    pub(super) fn membership(&self, layer: u32) -> Option<Membership> {
        self.memberships[layer as usize]
    }
}

fn by_path(found: &[FoundLayer]) -> impl Iterator<Item = &[FoundLayer]> {
    found.chunk_by(|one, other| one.first == other.first)
}
