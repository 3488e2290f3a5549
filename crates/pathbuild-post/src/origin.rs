//! Records which text of a definition produced a line of the output.

/// The text of a definition that produced a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LineOrigin {
    /// Name of the section or control text.
    pub(crate) section: &'static str,
    /// Line of the definition's file, counted from 1; 0 if the text is the default for an absent one.
    pub(crate) line: u32,
}
