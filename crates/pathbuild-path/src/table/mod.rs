//! The sorted table of a directory's name ranges: which files may hold a path, in O(log n + hits) once it is
//! asked often. (spec/20-paths-and-files.md)

mod groups;
mod numbers;
mod tree;

use self::groups::GroupTable;
use self::numbers::{NumberTable, holding};
use crate::files::{NameRange, PathKey};
use crate::number_range::NumberRange;

/// The name ranges of many files, for looking up path names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RangeTable(Order);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Order {
    /// All are numbers, as with the default pattern.
    Numbers(NumberTable),
    /// Every group is always an integer, or always a text.
    Groups(GroupTable),
    /// "Integers by value, the rest as text" is no order: all ranges are looked at.
    None(Vec<(NameRange, u32)>),
}

/// Ranges on their way into a table, each with the number of the file that it is in the name of.
#[derive(Clone, Debug, Default)]
pub struct Ranges {
    numbers: Vec<(NumberRange, u32)>,
    others: Vec<(NameRange, u32)>,
}

impl Ranges {
    /// One more range.
    pub fn push(&mut self, range: NameRange, file: u32) {
        match range.numbers() {
            Some(numbers) => self.numbers.push((numbers, file)),
            None => self.others.push((range, file)),
        }
    }

    /// The numbers of the files that may hold a path, from this one on.
    pub fn files(&self, path: &PathKey, first: u32) -> Vec<u32> {
        let others = self.others.iter().filter(|(range, file)| *file >= first && range.holds(path));
        let others = others.map(|(_, file)| *file);
        // They are in the order of their files.
        let numbers = &self.numbers[self.numbers.partition_point(|(_, file)| *file < first)..];
        if let Some(path) = path.number() {
            return holding(numbers, path).chain(others).collect();
        }
        let holds = |(range, _): &&(NumberRange, u32)| NameRange::from(*range).holds(path);
        numbers.iter().filter(holds).map(|(_, file)| *file).chain(others).collect()
    }
}

impl From<Ranges> for RangeTable {
    fn from(Ranges { numbers, others }: Ranges) -> Self {
        if others.is_empty() {
            return Self(Order::Numbers(NumberTable::new(numbers)));
        }
        let numbers = numbers.into_iter().map(|(range, file)| (range.into(), file));
        let all: Vec<(NameRange, u32)> = numbers.chain(others).collect();
        Self(GroupTable::new(&all).map_or(Order::None(all), Order::Groups))
    }
}

impl RangeTable {
    /// Whether look-ups use an order. When not, each looks at every range.
    pub fn is_sorted(&self) -> bool {
        !matches!(self.0, Order::None(_))
    }

    /// The numbers of the files that may hold a path: ascending, each once.
    pub fn files(&self, path: &PathKey) -> Vec<u32> {
        let mut files = match (&self.0, path.number()) {
            (Order::Numbers(table), Some(path)) => table.files(path),
            (Order::Numbers(table), None) => {
                scan(table.entries().map(|(range, file)| (range.into(), file)), path)
            }
            (Order::Groups(table), _) => table.files(path),
            (Order::None(ranges), _) => scan(ranges.iter().cloned(), path),
        };
        files.sort_unstable();
        files.dedup();
        files
    }
}

impl Default for RangeTable {
    fn default() -> Self {
        Ranges::default().into()
    }
}

fn scan(ranges: impl Iterator<Item = (NameRange, u32)>, path: &PathKey) -> Vec<u32> {
    ranges.filter(|(range, _)| range.holds(path)).map(|(_, file)| file).collect()
}
