//! The lines of the output with their numbers and line ends.

use super::options::Options;

/// The text written so far.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    options: &'a Options,
    text: String,
    next_number: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn new(options: &'a Options) -> Self {
        Self { options, text: String::new(), next_number: options.numbering.start.into() }
    }

    /// Adds a line, which must not be blank.
    pub(super) fn push(&mut self, line: &str) {
        if self.options.add_line_numbers
            && !line.starts_with(|first| self.options.numbering.skip.contains(first))
        {
            self.push_number();
        }
        self.text.push_str(line);
        self.text.push_str(&self.options.end_of_line);
    }

    fn push_number(&mut self) {
        let numbering = &self.options.numbering;
        self.text.push_str(&numbering.prefix);
        self.text.push_str(&numbering.format.format(self.next_number as f64));
        if numbering.space_after {
            self.text.push(' ');
        }
        self.next_number += u64::from(numbering.increment);
    }

    /// Length so far, in bytes.
    pub(super) fn length(&self) -> usize {
        self.text.len()
    }

    /// Returns the whole text.
    pub(super) fn finish(self) -> String {
        if self.options.upper_case { self.text.to_uppercase() } else { self.text }
    }
}
