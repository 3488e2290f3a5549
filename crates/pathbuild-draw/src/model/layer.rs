/// A record of the layer table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The name, as the drawing spells it.
    pub name: String,
    /// What BYLAYER means on it.
    pub line_type: String,
    /// Colour number.
    pub colour: u8,
    /// What is unusual about it.
    pub states: Vec<LayerState>,
}

/// States of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerState {
    /// Switched off.
    Off,
    /// Frozen.
    Frozen,
    /// Locked.
    Locked,
    /// In use, but missing from the layer table.
    Unlisted,
}

impl Layer {
    /// A visible layer, CONTINUOUS, white.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), line_type: "CONTINUOUS".to_owned(), colour: 7, states: Vec::new() }
    }

    /// Whether it is in this state.
    pub fn is(&self, state: LayerState) -> bool {
        self.states.contains(&state)
    }
}
