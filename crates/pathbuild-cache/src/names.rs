//! A compact list of file names.

use std::cmp::Ordering;
use std::fmt;
use std::ops::Range;

/// File names stored in one string: a directory may hold ten thousand drawings.
#[derive(Clone, Default)]
pub struct Names {
    text: String,
    /// Where each name is in `text`.
    spans: Vec<Range<usize>>,
}

impl Names {
    /// Appends a name.
    pub fn push(&mut self, name: &str) {
        let begin = self.text.len();
        self.text.push_str(name);
        self.spans.push(begin..self.text.len());
    }

    /// Number of names.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// Whether there are no names.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The names, in their current order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> {
        self.spans.iter().map(|span| &self.text[span.clone()])
    }

    /// Sorts the names.
    pub fn sort_by(&mut self, compare: impl Fn(&str, &str) -> Ordering) {
        let Self { text, spans } = self;
        spans.sort_unstable_by(|a, b| compare(&text[a.clone()], &text[b.clone()]));
    }
}

impl<'t> Extend<&'t str> for Names {
    fn extend<I: IntoIterator<Item = &'t str>>(&mut self, names: I) {
        names.into_iter().for_each(|name| self.push(name));
    }
}

impl<'t> FromIterator<&'t str> for Names {
    fn from_iter<I: IntoIterator<Item = &'t str>>(names: I) -> Self {
        let mut all = Self::default();
        all.extend(names);
        all
    }
}

impl PartialEq for Names {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl Eq for Names {}

impl fmt::Debug for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
