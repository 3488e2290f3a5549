//! Information needed to interpret a file that is not in the file itself.

/// Options for interpreting a file. The default relies on the file alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The height that a number with a correction formula represents.
    pub heights: Heights,
    /// The offsets of the machine, if they are known.
    pub offsets: Option<MachineOffsets>,
    /// XpertMILL: meaning of G70 and G71.
    pub unit_codes: UnitCodes,
    /// XpertMILL: whether I and J are the centre itself instead of its distance from the start of the arc.
    pub absolute_arc_centres: bool,
    /// XpertMILL: whether F is ignored, so that the feeds of the layers apply.
    pub ignore_feed: bool,
    /// Mach3: whether the machine counts P of G4 in milliseconds.
    pub milliseconds: bool,
}

/// The height that `Z1.023(==1.000+0.5*[#51-2.000])` represents.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heights {
    /// The number before the formula, which is where the tool goes.
    #[default]
    AsWritten,
    /// That number minus the correction, which is the difference between the formula's values with the measured and with the drawn heights.
    /// This
    /// is where the tool would go if the material were as thick as drawn.
    Nominal,
}

/// Meaning of G70 and G71. (book: program/reading)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnitCodes {
    /// As in DIN and in the filter's own examples: G70 inches, G71 millimetres.
    #[default]
    Din,
    /// As in the table of the filter: the other way round.
    Table,
}

/// The origins of coordinate systems and the named positions, in machine coordinates and mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineOffsets {
    /// The origins of G54, G55 ... G59, G59.1, G59.2, G59.3.
    pub systems: [[f64; 3]; 9],
    /// The targets of G28 and G30.
    pub home: [[f64; 3]; 2],
}
