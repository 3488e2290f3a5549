//! Names of files.

use std::cmp::Ordering;
use std::fmt;
use std::ops::Range;

/// Names in some order, in one text: a directory of ten thousand drawings has as many.
#[derive(Clone, Default)]
pub struct Names {
    text: String,
    /// Where each is.
    spans: Vec<Range<usize>>,
}

impl Names {
    /// One more name.
    pub fn push(&mut self, name: &str) {
        let begin = self.text.len();
        self.text.push_str(name);
        self.spans.push(begin..self.text.len());
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// All of them.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> {
        self.spans.iter().map(|span| &self.text[span.clone()])
    }

    /// Puts them in order.
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
