use std::collections::BTreeMap;

/// Stands for strings while they pass through the crate `dxf`, which would change some of their characters.
#[derive(Debug, Default)]
pub(crate) struct Tickets {
    numbers: BTreeMap<String, usize>,
    strings: Vec<String>,
}

impl Tickets {
    /// The string itself when nothing in it is in danger, else its ticket.
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

    /// The string of a ticket; `None` for what is none.
    pub(crate) fn redeem(&self, ticket: &str) -> Option<&str> {
        let number = ticket.strip_prefix('<')?.strip_suffix('>')?;
        self.strings.get(number.parse::<usize>().ok()?).map(String::as_str)
    }
}
