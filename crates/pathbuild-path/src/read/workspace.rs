//! Memory that is needed while a path is read, and kept for the next one: lists that are made for every path.

use std::cell::RefCell;
use std::sync::Arc;

use super::collect::Collected;
use super::elements::Elements;
use super::layers::PathLayers;
use super::texts::LayerTexts;
use crate::raw::{Drawn, Position, RawPath, SourceMap};
use crate::reuse::Reuse;
use crate::text::ParameterTexts;

/// Empty lists with room for what comes.
#[derive(Default)]
pub(super) struct Workspace {
    path_layers: PathLayers,
    collected: Vec<Collected<'static>>,
    elements: Vec<Elements>,
    layers: Vec<LayerTexts<'static>>,
    lists_of_layers: Vec<Vec<LayerTexts<'static>>>,
    texts: Vec<ParameterTexts>,
    drawn: Vec<Arc<Drawn>>,
    positions: Vec<Vec<Position>>,
}

thread_local! {
    static KEPT: RefCell<Workspace> = RefCell::default();
}

/// So many of a kind are kept, if each has room for no more than so much.
const MOST: usize = 4;
const ROOM: usize = 1024;

impl Reuse for RawPath {
    fn reuse(self) {
        let Self { mut drawn, .. } = self;
        if let Some(unshared) = Arc::get_mut(&mut drawn) {
            unshared.clear();
            Workspace::with(|workspace| keep(drawn, |drawn| drawn.room(), &mut workspace.drawn));
        }
    }

    /// Where a [`Path`](crate::Path) shares what is drawn that stays as it is.
    fn shrink_to_fit(&mut self) {
        if let Some(drawn) = Arc::get_mut(&mut self.drawn) {
            drawn.shrink_to_fit();
        }
    }
}

impl Reuse for SourceMap {
    fn reuse(self) {
        let Self(mut positions) = self;
        positions.clear();
        Workspace::with(|workspace| keep(positions, Vec::capacity, &mut workspace.positions));
    }

    fn shrink_to_fit(&mut self) {
        self.0.shrink_to_fit();
    }
}

impl Workspace {
    /// Works in what is kept on this thread.
    pub(super) fn with<R>(work: impl FnOnce(&mut Self) -> R) -> R {
        KEPT.with_borrow_mut(work)
    }

    pub(super) fn path_layers(&mut self) -> PathLayers {
        std::mem::take(&mut self.path_layers)
    }

    pub(super) fn collected<'d>(&mut self) -> Vec<Collected<'d>> {
        emptied(std::mem::take(&mut self.collected))
    }

    pub(super) fn elements(&mut self) -> Elements {
        self.elements.pop().unwrap_or_default()
    }

    pub(super) fn layer(&mut self) -> LayerTexts<'static> {
        self.layers.pop().unwrap_or_default()
    }

    pub(super) fn layers<'d>(&mut self) -> Vec<LayerTexts<'d>> {
        emptied(self.lists_of_layers.pop().unwrap_or_default())
    }

    pub(super) fn texts(&mut self) -> ParameterTexts {
        self.texts.pop().unwrap_or_default()
    }

    pub(super) fn drawn(&mut self) -> Arc<Drawn> {
        self.drawn.pop().unwrap_or_default()
    }

    /// A map of nothing yet, with room for so many.
    pub(super) fn map(&mut self, count: usize) -> SourceMap {
        let mut positions = self.positions.pop().unwrap_or_default();
        positions.reserve(count);
        SourceMap(positions)
    }

    /// Takes back what is no longer needed.
    pub(super) fn keep_path_layers(&mut self, path_layers: PathLayers) {
        if path_layers.room() <= ROOM {
            self.path_layers = path_layers;
        }
    }

    pub(super) fn keep_collected(&mut self, collected: Vec<Collected<'_>>) {
        if collected.capacity() <= MOST {
            self.collected = emptied(collected);
        }
    }

    pub(super) fn keep_elements(&mut self, elements: Elements) {
        keep(elements, Elements::room, &mut self.elements);
    }

    pub(super) fn keep_layer(&mut self, layer: LayerTexts<'_>) {
        keep(layer.emptied(), LayerTexts::room, &mut self.layers);
    }

    pub(super) fn keep_layers(&mut self, layers: Vec<LayerTexts<'_>>) {
        keep(emptied(layers), Vec::capacity, &mut self.lists_of_layers);
    }

    pub(super) fn keep_texts(&mut self, mut texts: ParameterTexts) {
        texts.clear();
        keep(texts, ParameterTexts::room, &mut self.texts);
    }
}

fn keep<T>(thing: T, room: impl Fn(&T) -> usize, kept: &mut Vec<T>) {
    if kept.len() < MOST && room(&thing) <= ROOM {
        kept.push(thing);
    }
}

/// The memory of a list, for things of the same kind with another lifetime: collecting nothing in place leaves only that.
pub(super) fn emptied<T, U>(mut list: Vec<T>) -> Vec<U> {
    list.clear();
    list.into_iter().map_while(|_| None).collect()
}
