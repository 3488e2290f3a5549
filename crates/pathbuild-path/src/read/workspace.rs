//! Memory that is needed while a path is read, and kept for the next one: lists that are made for every path.

use std::cell::Cell;

use super::elements::Elements;
use super::layers::{FoundLayer, Membership};
use super::texts::LayerTexts;
use crate::text::ParameterTexts;

/// Empty lists with room for what comes.
#[derive(Default)]
pub(super) struct Workspace {
    pub(super) path_layers: Vec<FoundLayer>,
    pub(super) memberships: Vec<Option<Membership>>,
    elements: Vec<Elements>,
    layers: Vec<LayerTexts<'static>>,
    texts: Vec<ParameterTexts>,
}

thread_local! {
    static KEPT: Cell<Workspace> = Cell::default();
}

/// So many lists of a kind are kept, if each has room for no more than so much.
const LISTS: usize = 4;
const ROOM: usize = 1024;

impl Workspace {
    /// Works in what is kept on this thread.
    pub(super) fn with<R>(work: impl FnOnce(&mut Self) -> R) -> R {
        let mut workspace = KEPT.take();
        let result = work(&mut workspace);
        if workspace.path_layers.capacity().max(workspace.memberships.capacity()) <= ROOM {
            KEPT.set(workspace);
        }
        result
    }

    pub(super) fn elements(&mut self) -> Elements {
        self.elements.pop().unwrap_or_default()
    }

    pub(super) fn layer(&mut self) -> LayerTexts<'static> {
        self.layers.pop().unwrap_or_default()
    }

    pub(super) fn texts(&mut self) -> ParameterTexts {
        self.texts.pop().unwrap_or_default()
    }

    /// Takes back what is no longer needed.
    pub(super) fn keep_elements(&mut self, elements: Elements) {
        if self.elements.len() < LISTS && elements.room() <= ROOM {
            self.elements.push(elements);
        }
    }

    pub(super) fn keep_layer(&mut self, layer: LayerTexts<'_>) {
        if self.layers.len() < LISTS && layer.room() <= ROOM {
            self.layers.push(layer.emptied());
        }
    }

    pub(super) fn keep_texts(&mut self, mut texts: ParameterTexts) {
        texts.clear();
        if self.texts.len() < LISTS && texts.room() <= ROOM {
            self.texts.push(texts);
        }
    }
}
