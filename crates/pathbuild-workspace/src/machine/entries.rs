//! The entries of a machine description, from which the values of known keys are taken one by one. The remaining entries have no counterpart in
//! `pathbuild.toml` and are returned as unused.

use pathbuild_diagnostic::messages::configuration::{NUMBER, POSITIVE};
use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Text, Value as MessageValue};
use rustc_hash::FxHashMap;

use super::{DescribedValue, Description, Quantity};

/// An entry of a description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Name of the entry, for example `$110` or `axes/x/max_travel_mm`.
    pub name: String,
    /// The value as written in the description.
    pub value: String,
    /// Line of the entry, counted from 1, if it is known.
    pub line: Option<u32>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct NumberWithLine {
    pub(super) number: f64,
    line: Option<u32>,
}

#[derive(Debug, Default)]
pub(super) struct Entries {
    list: Vec<Entry>,
    is_used: Vec<bool>,
    /// For each name, the index of the entry in force: the last one, unless `is_first_effective`.
    by_name: FxHashMap<String, usize>,
    /// Whether the first entry of each name is in force, not the last.
    is_first_effective: bool,
    values: Vec<DescribedValue>,
    problems: Vec<Diagnostic>,
}

impl Entries {
    pub(super) fn with_first_effective() -> Self {
        Self { is_first_effective: true, ..Self::default() }
    }

    pub(super) fn add(&mut self, name: impl Into<String>, value: impl Into<String>, line: usize) {
        let name = name.into();
        if !(self.is_first_effective && self.by_name.contains_key(&name)) {
            self.by_name.insert(name.clone(), self.list.len());
        }
        let line = u32::try_from(line).ok();
        self.list.push(Entry { name, value: value.into(), line });
        self.is_used.push(false);
    }

    /// Returns an entry without marking it as used.
    pub(super) fn get(&self, name: &str) -> Option<&Entry> {
        Some(&self.list[*self.by_name.get(name)?])
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Entry> {
        self.list.iter()
    }

    /// Returns the entry in force for a name, and marks all entries of this name as used. Reports other entries of this name with different values.
    pub(super) fn take(&mut self, name: &str) -> Option<&Entry> {
        let index = *self.by_name.get(name)?;
        let taken = &self.list[index];
        for (other, is_used) in self.list.iter().zip(&mut self.is_used) {
            if other.name != name || std::mem::replace(is_used, true) || other.value == taken.value {
                continue;
            }
            let problem = Diagnostic::new(&say::ENTRY_TWICE).quoting("name", name);
            let problem =
                problem.quoting("value", other.value.as_str()).quoting("taken", taken.value.as_str());
            let problem = problem.with("line", u64::from(taken.line.unwrap_or_default()));
            self.problems.push(problem.at_line(other.line, None));
        }
        Some(&self.list[index])
    }

    /// Takes the number in the entry of this name. Reports a value that is not a number.
    pub(super) fn number(&mut self, name: &str) -> Option<NumberWithLine> {
        self.number_where(name, |_| true, &NUMBER)
    }

    fn positive(&mut self, name: &str) -> Option<NumberWithLine> {
        self.number_where(name, |number| number > 0.0, &POSITIVE)
    }

    fn number_where(
        &mut self,
        name: &str,
        is_fit: fn(f64) -> bool,
        expected: &'static Text,
    ) -> Option<NumberWithLine> {
        let entry = self.take(name)?;
        let number = entry.value.parse().ok().filter(|number: &f64| number.is_finite() && is_fit(*number));
        if let Some(number) = number {
            return Some(NumberWithLine { number, line: entry.line });
        }
        let entry = entry.clone();
        self.report_invalid_value(&entry, expected);
        None
    }

    /// Reports an entry with a value that is not of the kind that the key needs.
    pub(super) fn report_invalid_value(&mut self, entry: &Entry, expected: &'static Text) {
        let problem = Diagnostic::new(&say::VALUE_NOT_TAKEN).quoting("name", entry.name.as_str());
        let problem =
            problem.quoting("value", entry.value.as_str()).with("expected", MessageValue::Prose(expected));
        self.report(problem.at_line(entry.line, None));
    }

    pub(super) fn report(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }

    pub(super) fn set(&mut self, key: &'static str, value: Quantity, sources: &[&str]) {
        let source = sources.join(", ");
        self.values.push(DescribedValue { key, value, source, is_for_new_tools: false });
    }

    /// Sets a key to the number of an entry, multiplied by `scale`.
    pub(super) fn set_number(&mut self, key: &'static str, name: &str, scale: f64) {
        if let Some(reading) = self.positive(name) {
            self.set(key, Quantity::Number(rounded(reading.number * scale)), &[name]);
        }
    }

    /// Sets a key to the numbers of the entries for X, Y and Z, multiplied by `scale`. Sets nothing unless all three are positive numbers.
    pub(super) fn set_axes(&mut self, key: &'static str, names: [&str; 3], scale: f64) {
        let readings = names.map(|name| self.positive(name));
        let given: Vec<&str> =
            names.into_iter().zip(readings).filter_map(|(name, reading)| reading.map(|_| name)).collect();
        if let [Some(x), Some(y), Some(z)] = readings {
            let numbers = [x, y, z].map(|reading| rounded(reading.number * scale));
            self.set(key, Quantity::Numbers(numbers.to_vec()), &names);
        } else if let Some(first) = readings.into_iter().flatten().next()
            && names.iter().any(|name| self.get(name).is_none())
        {
            let problem = Diagnostic::new(&say::AXES_INCOMPLETE).quoting("key", key);
            self.report(problem.quoting("given", given.join(", ")).at_line(first.line, None));
        }
    }

    /// Sets `spindle-speeds` from the entries of the lowest and the highest speed. The lowest is 0 if the description does not limit it.
    pub(super) fn set_speeds(&mut self, least: &str, most: &str) {
        let (lower, upper) = (self.number(least), self.number(most));
        let from = lower.map_or(0.0, |reading| reading.number);
        let Some(upper) = upper else { return };
        self.set_range(from, upper.number, upper.line, &[least, most]);
    }

    /// Sets `spindle-speeds`, or reports that the range is empty.
    pub(super) fn set_range(&mut self, from: f64, to: f64, line: Option<u32>, sources: &[&str]) {
        if 0.0 <= from && from < to {
            self.set("spindle-speeds", Quantity::Numbers(vec![rounded(from), rounded(to)]), sources);
        } else {
            let problem = Diagnostic::new(&say::EMPTY_SPEEDS).with("from", from).with("to", to);
            self.report(problem.at_line(line, None));
        }
    }

    pub(super) fn finish(self, format: &'static str) -> Description {
        let unused = self.list.into_iter().zip(self.is_used).filter(|(_, is_used)| !is_used);
        let unused = unused.map(|(entry, _)| entry).collect();
        let Self { values, problems, .. } = self;
        Description { values, unused, problems, ..Description::new(format) }
    }
}

/// Rounds away the digits that a conversion of units leaves behind.
pub(super) fn rounded(number: f64) -> f64 {
    const DIGITS: f64 = 1e6;
    (number * DIGITS).round() / DIGITS
}
