/// A record of the layer table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The name as spelt in the drawing.
    pub name: String,
    /// The line type of BYLAYER entities.
    pub line_type: String,
    /// Colour number.
    pub colour: u8,
    /// Unusual states of the layer.
    pub states: Vec<LayerState>,
}

/// An unusual state of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerState {
    /// Switched off.
    Off,
    /// Frozen.
    Frozen,
    /// Locked.
    Locked,
    /// Used by entities, but missing from the layer table.
    Unlisted,
}

impl Layer {
    /// A visible layer, CONTINUOUS, white.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), line_type: "CONTINUOUS".to_owned(), colour: 7, states: Vec::new() }
    }

    /// Whether the layer is in this state.
    pub fn is(&self, state: LayerState) -> bool {
        self.states.contains(&state)
    }
}
