//! What has to be known beside the file to interpret it.

/// How a file is interpreted. The default is what the file alone says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Which height a number with a correction formula stands for.
    pub heights: Heights,
    /// The machine's offsets, where they are known.
    pub offsets: Option<MachineOffsets>,
    /// XpertMILL: what G70 and G71 mean.
    pub unit_codes: UnitCodes,
    /// XpertMILL: I and J are the centre itself, not its distance from the arc's beginning.
    pub absolute_arc_centres: bool,
    /// XpertMILL: F is passed over, so that the layers' feeds hold.
    pub ignore_feed: bool,
    /// Mach3: the machine counts P of G4 in milliseconds.
    pub milliseconds: bool,
}

/// Which height `Z1.023(==1.000+0.5*[#51-2.000])` stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heights {
    /// The number in front of the formula: where the tool goes.
    #[default]
    AsWritten,
    /// That number less the correction, which is the formula's value with the measured heights less its value with the drawn ones: where
    /// the tool would go if the material were as thick as drawn.
    Nominal,
}

/// What G70 and G71 mean. (book: program/reading)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnitCodes {
    /// As DIN has it, and the filter's own examples: G70 inches, G71 millimetres.
    #[default]
    Din,
    /// As the filter's table has it: the other way round.
    Table,
}

/// Where the coordinate systems and named places lie, in machine coordinates, in mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineOffsets {
    /// The zeros of G54, G55 ... G59, G59.1, G59.2, G59.3.
    pub systems: [[f64; 3]; 9],
    /// Where G28 and G30 go.
    pub home: [[f64; 3]; 2],
}
