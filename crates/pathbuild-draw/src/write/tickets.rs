use std::borrow::Cow;
use std::collections::BTreeMap;

use super::record::Record;

/// Placeholders for strings while they pass through the crate `dxf`, which would change some of their characters.
#[derive(Debug, Default)]
pub(crate) struct Tickets {
    numbers: BTreeMap<String, usize>,
    strings: Vec<String>,
}

impl Tickets {
    /// The string itself if the crate leaves it unchanged, otherwise its ticket.
    pub(crate) fn ticket(&mut self, string: &str) -> String {
        let is_safe = |c: char| (' '..='~').contains(&c) && !matches!(c, '^' | '<');
        if string.chars().all(is_safe) {
            return string.to_owned();
        }
        let next = self.strings.len();
        let number = *self.numbers.entry(string.to_owned()).or_insert(next);
        if number == next {
            self.strings.push(string.to_owned());
        }
        format!("<{number}>")
    }

    /// Replaces the tickets by their strings.
    pub(crate) fn redeem_all<'a>(&'a self, record: &mut Record<'a>) {
        for pair in record {
            if let Some(string) = self.redeem(&pair.value) {
                pair.value = Cow::Borrowed(string);
            }
        }
    }

    fn redeem(&self, ticket: &str) -> Option<&str> {
        let number = ticket.strip_prefix('<')?.strip_suffix('>')?;
        self.strings.get(number.parse::<usize>().ok()?).map(String::as_str)
    }
}
