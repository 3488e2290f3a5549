//! The control texts of a definition, when each is called, and the positions of errors in them. (book: reference/post-definitions)

use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Text, TextFault};

macro_rules! kinds {
    ($($variant:ident $name:literal $en:literal $de:literal;)*) => {
        /// The kinds of control texts, which differ in when they are called.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum ControlTextKind {
            $(#[doc = $en] $variant,)*
        }

        impl ControlTextKind {
            pub(super) const ALL: &[Self] = &[$(Self::$variant,)*];

            /// Key of the text in the table `[text]` of a definition.
            pub(super) fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// Describes when the text is called, for the book.
            pub(super) fn when(self) -> Text {
                match self {
                    $(Self::$variant => Text { en: $en, de: $de },)*
                }
            }
        }
    };
}

kinds! {
    ProgramStart "program-start" "once, first" "einmal, zuerst";
    ProgramEnd "program-end" "once, last" "einmal, zuletzt";
    ToolChange "tool-change" "before the first object, and before each object whose tool differs from the previous one" "vor dem ersten Objekt und vor jedem Objekt, dessen Werkzeug ein anderes ist als das vorige";
    ContourStart "contour-start" "at the start of each contour, at the height of rapid moves: over its first point, down by rapid to `~ZWorking~`, by feed to `~Z1~`" "am Anfang jeder Kontur, in Eilganghöhe: über ihren ersten Punkt, im Eilgang abwärts bis `~ZWorking~`, mit Vorschub bis `~Z1~`";
    ContourEnd "contour-end" "at the end of each contour: by rapid up to `~ZClearance~`" "am Ende jeder Kontur: im Eilgang aufwärts bis `~ZClearance~`";
    Line "line" "for each straight element" "bei jedem geraden Element";
    Arc "arc" "for each arc" "bei jedem Bogen";
    Bezier "bezier" "never: no program has curves" "nie: Kein Programm hat Kurven";
    Cycle "cycle" "for each hole, if there is such a text" "bei jeder Bohrung, wenn es diesen Text gibt";
    Point "point" "for each hole, if there is no `cycle`" "bei jeder Bohrung, wenn es kein `cycle` gibt";
    LineNumber "line-number" "in front of each line, with `number-lines`; without such a text it is `N{#~LineNumber~}` in steps of 10" "vor jeder Zeile, mit `number-lines`; ohne diesen Text gilt `N{#~LineNumber~}` in Schritten von 10";
    PrimaryRun "primary-run" "once, after the last object" "einmal, nach dem letzten Objekt";
    BeforeRepeat "before-repeat" "once, after `primary-run`" "einmal, nach `primary-run`";
    SubprogramStart "subprogram-start" "never: no program has subprograms" "nie: Kein Programm hat Unterprogramme";
    SubprogramEnd "subprogram-end" "never: no program has subprograms" "nie: Kein Programm hat Unterprogramme";
    Rapid "rapid" "extension of pathbuild: for each rapid move. With it, `contour-start` and `contour-end` are not called, and every move is written as it is" "Zusatz von pathbuild: bei jedem Eilgang. Damit werden `contour-start` und `contour-end` nicht aufgerufen, und jede Bewegung steht für sich";
    Stop "stop" "extension of pathbuild: where the machine waits for the operator" "Zusatz von pathbuild: wo die Maschine auf den Bediener wartet";
    Dwell "dwell" "extension of pathbuild: where the tool stands still for `~DwellTime~` seconds" "Zusatz von pathbuild: wo das Werkzeug `~DwellTime~` Sekunden steht";
    Comment "comment" "extension of pathbuild: for each comment, `~CommentText~`" "Zusatz von pathbuild: bei jedem Kommentar, `~CommentText~`";
}

/// A control text, before its variables and statements are replaced.
#[derive(Clone, Debug)]
pub(super) struct ControlText {
    /// The text without the line break before its closing quotes.
    pub(super) text: String,
    /// Line and column of the text's first character in the file, counted from 1; `None` for built-in texts.
    pub(super) begins: Option<(u32, u32)>,
}

impl ControlText {
    /// Converts the offset of a byte in the text to line and column within the text, counted from 1.
    pub(super) fn place(&self, byte: usize) -> (u32, u32) {
        let before = &self.text[..self.text.floor_char_boundary(byte)];
        let line = before.matches('\n').count();
        let column = before.rsplit('\n').next().unwrap_or("").chars().count();
        (count(line) + 1, count(column) + 1)
    }

    /// Converts the offset of a byte in the text to line and column within the file, counted from 1; `None` for built-in texts.
    pub(super) fn place_in_file(&self, byte: usize) -> Option<(u32, u32)> {
        let (first_line, first_column) = self.begins?;
        let (line, column) = self.place(byte);
        let column = if line == 1 { first_column + column - 1 } else { column };
        Some((first_line + line - 1, column))
    }

    /// Returns the offset at which the line of a byte begins, and the line.
    pub(super) fn line_around(&self, byte: usize) -> (usize, &str) {
        let byte = self.text.floor_char_boundary(byte);
        let start = self.text[..byte].rfind('\n').map_or(0, |end| end + 1);
        (start, self.text[start..].lines().next().unwrap_or(""))
    }
}

fn count(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Adds the position of an error to its diagnostic: the name of the text, line and column in it, and line and column in the file.
pub(super) fn locate(
    diagnostic: Diagnostic,
    kind: ControlTextKind,
    text: &ControlText,
    span: Range<usize>,
    file: &Utf8Path,
) -> Diagnostic {
    let (line, column) = text.place(span.start);
    let (start, content) = text.line_around(span.start);
    let fault = TextFault::new(content, span.start - start..span.end.saturating_sub(start));
    let mut diagnostic = diagnostic
        .quoting("text", kind.name())
        .with("line", u64::from(line))
        .with("column", u64::from(column))
        .with_text(fault)
        .in_file(file);
    if let Some((line, column)) = text.place_in_file(span.start) {
        diagnostic = diagnostic.at_line(line, Some(column));
    }
    diagnostic
}
