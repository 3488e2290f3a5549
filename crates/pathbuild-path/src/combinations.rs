//! The combinations of values that a path's variables can have. (book: language/variables, `check --all-bindings`)

use std::collections::HashSet;

use smol_str::SmolStr;

use crate::definition::Definition;
use crate::variables::Bindings;

/// Combinations of values, and how many there are in all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Combinations {
    /// At most as many as were asked for, the example values first. Each value of each variable is in one of them, if that is possible
    /// with so few.
    pub chosen: Vec<Bindings>,
    /// How many there are.
    pub all: u64,
}

impl Combinations {
    /// Combines all values of lists and both ends of ranges.
    pub fn new(definitions: &[Definition], limit: usize) -> Self {
        let values: Vec<(char, Vec<SmolStr>)> =
            definitions.iter().map(|definition| (definition.name, corners(definition))).collect();
        let counts = || values.iter().map(|(_, values)| values.len());
        let all = counts().fold(1_u64, |all, count| all.saturating_mul(count as u64));
        let longest = counts().max().unwrap_or(1);
        // Value k of each variable, the k-th variable beginning with its k-th as the example values do; then all, counting.
        let diagonal = (0..longest).map(|k| at(&values, |index, count| (k + index) % count));
        let counted = (0..all).map(|number| {
            let mut rest = number;
            at(&values, |_, count| {
                let index = rest % count as u64;
                rest /= count as u64;
                usize::try_from(index).unwrap_or_default()
            })
        });
        let mut seen = HashSet::new();
        let distinct = diagonal.chain(counted).filter(|bindings| seen.insert(bindings.clone()));
        Self { chosen: distinct.take(limit.min(usize::try_from(all).unwrap_or(limit))).collect(), all }
    }
}

/// The values of a definition, each once.
fn corners(definition: &Definition) -> Vec<SmolStr> {
    let mut values: Vec<SmolStr> = Vec::new();
    for value in definition.corner_values() {
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}

/// The combination that takes of each variable the value that `choose` says, asked with the variable's number and its count of values.
fn at(values: &[(char, Vec<SmolStr>)], mut choose: impl FnMut(usize, usize) -> usize) -> Bindings {
    let value = |(index, (name, values)): (usize, &(char, Vec<SmolStr>))| {
        (*name, values[choose(index, values.len())].clone())
    };
    Bindings::new(values.iter().enumerate().map(value))
}
