//! The possible combinations of values for a path's variables. (book: language/variables, `check --all-bindings`)

use std::collections::HashSet;

use smol_str::SmolStr;

use crate::definition::Definition;
use crate::variables::Bindings;

/// Some combinations of values, and the total number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Combinations {
    /// The combinations, up to the limit, beginning with the example values. Every value of every variable occurs in one of them if the
    /// limit permits.
    pub chosen: Vec<Bindings>,
    /// The total number of combinations.
    pub all: u64,
}

impl Combinations {
    /// Combines all values of lists with both ends of ranges.
    pub fn new(definitions: &[Definition], limit: usize) -> Self {
        let values: Vec<(char, Vec<SmolStr>)> =
            definitions.iter().map(|definition| (definition.name, corners(definition))).collect();
        let counts = || values.iter().map(|(_, values)| values.len());
        let all = counts().fold(1_u64, |all, count| all.saturating_mul(count as u64));
        let longest = counts().max().unwrap_or(1);
        // Diagonal combinations first: number k takes value k + i of the i-th variable, as the example values do. Then all others in
        // counting order.
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

/// The values of a definition, without duplicates.
fn corners(definition: &Definition) -> Vec<SmolStr> {
    let mut values: Vec<SmolStr> = Vec::new();
    for value in definition.corner_values() {
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}

/// The combination in which `choose` selects the value of each variable, given the variable's index and number of values.
fn at(values: &[(char, Vec<SmolStr>)], mut choose: impl FnMut(usize, usize) -> usize) -> Bindings {
    let value = |(index, (name, values)): (usize, &(char, Vec<SmolStr>))| {
        (*name, values[choose(index, values.len())].clone())
    };
    Bindings::new(values.iter().enumerate().map(value))
}
