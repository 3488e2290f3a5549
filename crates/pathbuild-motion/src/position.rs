//! Positions, sets of axes, and the planes of arcs.

/// A position in the program's first coordinate system, in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position {
    /// X, Y, Z.
    pub at: [f64; 3],
    /// The known axes. Positions are unknown at the start of the program, and after a move to a named position or a probe.
    pub known: Axes,
}

impl Position {
    /// A position with all axes known.
    pub fn known(x: f64, y: f64, z: f64) -> Self {
        Self { at: [x, y, z], known: Axes::ALL }
    }

    /// X, Y and Z; `None` for unknown axes.
    pub fn axes(&self) -> [Option<f64>; 3] {
        [0, 1, 2].map(|axis| self.known.has(Axes::of(axis)).then(|| self.at[axis]))
    }

    /// X in mm.
    pub fn x(&self) -> f64 {
        self.at[0]
    }

    /// Y in mm.
    pub fn y(&self) -> f64 {
        self.at[1]
    }

    /// Z in mm.
    pub fn z(&self) -> f64 {
        self.at[2]
    }
}

impl From<[Option<f64>; 3]> for Position {
    fn from(axes: [Option<f64>; 3]) -> Self {
        let known = (0..3).filter(|axis| axes[*axis].is_some());
        Self {
            at: axes.map(Option::unwrap_or_default),
            known: known.fold(Axes::NONE, |known, axis| known.with(Axes::of(axis))),
        }
    }
}

impl From<[f64; 3]> for Position {
    fn from(at: [f64; 3]) -> Self {
        Self { at, known: Axes::ALL }
    }
}

/// A set of the axes X, Y, Z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Axes(u8);

impl Axes {
    /// No axis.
    pub const NONE: Self = Self(0);
    /// X, Y and Z.
    pub const ALL: Self = Self(7);
    /// X and Y.
    pub const XY: Self = Self(3);
    /// Z.
    pub const Z: Self = Self(4);

    /// The axis with index 0 (X), 1 (Y) or 2 (Z).
    pub fn of(index: usize) -> Self {
        Self(1 << index)
    }

    /// Whether it contains all of `other`.
    pub fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The union of two sets.
    pub fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The axes that are not in `other`.
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The intersection of two sets.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// The plane of arcs and cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plane {
    /// G17.
    #[default]
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

impl Plane {
    /// Indices of the plane's first and second axis. Turning from the first to the second is counterclockwise.
    pub fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Zx => [2, 0],
            Self::Yz => [1, 2],
        }
    }

    /// Index of the axis across the plane.
    pub fn third(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Zx => 1,
            Self::Yz => 0,
        }
    }

    /// The plane's axes as a set.
    pub fn axes_of_plane(self) -> Axes {
        Axes::ALL.without(Axes::of(self.third()))
    }

    /// The coordinates of a position in the plane.
    pub fn project(self, at: &[f64; 3]) -> [f64; 2] {
        self.axes().map(|axis| at[axis])
    }
}
