//! `--restrict PARENT:CHILD`. (book: language/embedding)

use regex::Regex;

use crate::name::PathName;

/// Paths whose name matches PARENT may embed only paths whose name matches CHILD.
#[derive(Clone, Debug)]
pub struct Restriction {
    /// Searched in the embedding path's name.
    parent: Regex,
    /// Searched in the embedded path's name.
    child: Regex,
}

impl Restriction {
    /// A rule of two regular expressions.
    ///
    /// # Errors
    /// When one of them is no regular expression.
    pub fn new(parent: &str, child: &str) -> Result<Self, regex::Error> {
        Ok(Self { parent: Regex::new(parent)?, child: Regex::new(child)? })
    }

    /// Whether the rule applies to what this path embeds.
    pub(super) fn concerns(&self, parent: &PathName) -> bool {
        parent.is_match(&self.parent)
    }

    /// What embedded names must match.
    pub(super) fn child(&self) -> &Regex {
        &self.child
    }
}
