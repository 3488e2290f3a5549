//! Tables with user-defined keys.

use std::fmt::Debug;

use pathbuild_diagnostic::Code;

use crate::config::kind::Key;
use crate::config::kinds::table::{LINE_TYPES, MACROS, SEVERITY, SEVERITY_IN, TOOLS};
use crate::config::origin::SourcedValue;
use crate::config::reader::Table;
use crate::config::result_kind::ResultKind;
use crate::config::show::ShownSetting;
use crate::config::types::{Level, LineTypeAlias, Macro, SeveritiesIn, Tool};

section! {
    /// further names: name in the drawing = one of the known line types
    line_types: Vec<LineTypeAlias> = "line-types", LINE_TYPES, Vec::new(), "[line-types]\n\"MITTE\" = \"CENTER\"", Check;
    /// code = "error" | "warning" | "ignore"; errors that protect programs from being wrong
    /// (PB0 to PB5) cannot be lowered
    severity: Vec<(Code, Level)> = "severity", SEVERITY, Vec::new(), "[severity]\nPB210 = \"ignore\"", Neither;
    /// the same for some drawings: globs, relative to this file
    severity_in: Vec<SeveritiesIn> = "severity-in", SEVERITY_IN, Vec::new(), "[[severity-in]]\nfiles = [\"old/**\"]\nPB112 = \"ignore\"", Neither;
    /// a tool, for post-processors: found by O (and by paths, a pattern of path names)
    tools: Vec<Tool> = "tool", TOOLS, Vec::new(),
        "[tool.2mm]\ndiameter = 2\nnumber = 1\npaths = '[A-Z]$'\nspindle = 12000\ndirection = \"cw\"\ncoolant = \"off\"", Emit;
    /// texts for post-processors: a macro {$name}, or ~name~ in control texts; they take precedence over the definition's
    macros: Vec<Macro> = "macros", MACROS, Vec::new(), "[macros]\noperator = \"anna\"", Emit;
}
