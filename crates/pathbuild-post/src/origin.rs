//! Where a definition has the text that wrote a line of the output.

/// The text of a definition that wrote a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LineOrigin {
    /// The section's or control text's name.
    pub(crate) section: &'static str,
    /// 1-based line of the definition's file; 0 of a text that stands in for an absent one.
    pub(crate) line: u32,
}
