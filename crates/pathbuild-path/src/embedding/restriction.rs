//! `--restrict PARENT:CHILD`. (book: language/embedding)

use regex::Regex;

use crate::names::PathName;

/// Paths whose names match PARENT may only embed paths whose names match CHILD.
#[derive(Clone, Debug)]
pub struct Restriction {
    /// Matched anywhere in the name of the embedding path.
    parent: Regex,
    /// Matched anywhere in the name of the embedded path.
    child: Regex,
}

impl Restriction {
    /// Creates a rule from two regular expressions.
    ///
    /// # Errors
    /// If one of them is not a valid regular expression.
    pub fn new(parent: &str, child: &str) -> Result<Self, regex::Error> {
        Ok(Self { parent: Regex::new(parent)?, child: Regex::new(child)? })
    }

    /// Whether the rule applies to the embeddings of this path.
    pub(super) fn concerns(&self, parent: &PathName) -> bool {
        parent.is_match(&self.parent)
    }

    /// The expression that embedded names must match.
    pub(super) fn child(&self) -> &Regex {
        &self.child
    }
}
