//! The control texts of a definition: which there are, and when each is called. (section 1.6)

macro_rules! kinds {
    ($($(#[$doc:meta])* $variant:ident $name:literal;)*) => {
        /// When a control text is called.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum ControlTextKind {
            $($(#[$doc])* $variant,)*
        }

        impl ControlTextKind {
            /// Every kind.
            pub(super) const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The key in a definition.
            pub(super) fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
}

kinds! {
    /// Once, first.
    ProgramStart "program-start";
    /// Once, last.
    ProgramEnd "program-end";
    /// Before an object whose tool differs from the one before, and before the first.
    ToolChange "tool-change";
    /// At the start of each contour.
    ContourStart "contour-start";
    /// At its end.
    ContourEnd "contour-end";
    /// A straight element.
    Line "line";
    /// A circular one.
    Arc "arc";
    /// A curve; no program has any.
    Bezier "bezier";
    /// A hole, where there is such a text.
    Cycle "cycle";
    /// A hole otherwise.
    Point "point";
    /// In front of each line.
    LineNumber "line-number";
    /// After the last object.
    PrimaryRun "primary-run";
    /// After all that.
    BeforeRepeat "before-repeat";
    /// Around subprograms; no program has any.
    SubprogramStart "subprogram-start";
    /// Likewise.
    SubprogramEnd "subprogram-end";
    /// pathbuild's own: every rapid move. With it, contours have no start and end, and every move is written as it is.
    Rapid "rapid";
    /// pathbuild's own: waiting for a person.
    Stop "stop";
    /// pathbuild's own: standing still.
    Dwell "dwell";
    /// pathbuild's own: a remark.
    Comment "comment";
}

/// A control text as its file has it.
#[derive(Clone, Debug)]
pub(super) struct ControlText {
    /// Without the line end before the closing quotes.
    pub(super) text: String,
    /// Where its first character stands in the file, from 1; nothing in built-in texts.
    pub(super) begins: Option<(u32, u32)>,
}

impl ControlText {
    /// Line and column, from 1, of a byte within the text.
    pub(super) fn place(&self, byte: usize) -> (u32, u32) {
        let before = &self.text[..self.text.floor_char_boundary(byte)];
        let line = before.matches('\n').count();
        let column = before.rsplit('\n').next().unwrap_or("").chars().count();
        (count(line) + 1, count(column) + 1)
    }

    /// Line and column, from 1, of a byte within the file.
    pub(super) fn place_in_file(&self, byte: usize) -> Option<(u32, u32)> {
        let (first_line, first_column) = self.begins?;
        let (line, column) = self.place(byte);
        let column = if line == 1 { first_column + column - 1 } else { column };
        Some((first_line + line - 1, column))
    }

    /// The line in which a byte is, and where it begins.
    pub(super) fn line_around(&self, byte: usize) -> (usize, &str) {
        let byte = self.text.floor_char_boundary(byte);
        let start = self.text[..byte].rfind('\n').map_or(0, |end| end + 1);
        (start, self.text[start..].lines().next().unwrap_or(""))
    }
}

fn count(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
