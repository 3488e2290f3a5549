use super::record::Pair;
use crate::model::Version;

/// The objects section, with handles that other sections refer to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Objects {
    first: u64,
}

/// The objects of every CAD drawing. `#n` is the handle of object n; `#m` and `#p` are the block records of model and paper space.
const R2000: &str = include_str!("objects_r2000.txt");
const R13: &str = include_str!("objects_r13.txt");

/// Number of handles that the objects occupy.
const COUNT: u64 = 16;
const LAYOUTS: [u64; 2] = [4, 5];
const PLOT_STYLE: u64 = 10;

impl Objects {
    /// Creates the objects with handles from `first` on.
    pub(crate) fn from(first: u64) -> Self {
        Self { first }
    }

    /// The first handle after those of the objects.
    pub(crate) fn end(self) -> u64 {
        self.first + COUNT
    }

    pub(crate) fn layouts(self) -> [u64; 2] {
        LAYOUTS.map(|number| self.first + number)
    }

    pub(crate) fn plot_style(self) -> u64 {
        self.first + PLOT_STYLE
    }

    /// The pairs of the section.
    pub(crate) fn pairs(self, version: Version, spaces: [u64; 2]) -> Vec<Pair<'static>> {
        let text = if version >= Version::R2000 { R2000 } else { R13 };
        let mut lines = text.lines();
        let mut pairs = Vec::new();
        while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
            let code = code.trim().parse().unwrap_or_default();
            pairs.push(self.resolve(code, value, spaces));
        }
        pairs
    }

    fn resolve(self, code: i32, value: &'static str, spaces: [u64; 2]) -> Pair<'static> {
        match value.strip_prefix('#') {
            Some("m") => Pair::handle(code, spaces[0]),
            Some("p") => Pair::handle(code, spaces[1]),
            Some(number) => Pair::handle(code, self.first + number.parse::<u64>().unwrap_or_default()),
            None => Pair::new(code, value),
        }
    }
}
