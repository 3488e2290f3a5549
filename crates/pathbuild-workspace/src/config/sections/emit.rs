//! `[emit]`: what `emit` writes without arguments.

use std::fmt::Debug;

use crate::config::kind::Key;
use crate::config::kinds::pattern::PATTERNS;
use crate::config::kinds::text::choice;
use crate::config::origin::SourcedValue;
use crate::config::reader::Table;
use crate::config::result_kind::ResultKind;
use crate::config::show::ShownSetting;
use crate::config::types::{Pattern, SheetFormat};

section! {
    /// globs of path names: the paths that `emit` without arguments and `watch --emit` write
    targets: Vec<Pattern> = "targets", PATTERNS, Vec::new(), "[]", Neither;
    /// none | pdf | html | svg: a setup sheet for the machine operator, written beside each program
    sheet: SheetFormat = "sheet", choice::<SheetFormat>(), SheetFormat::No, r#""none""#, Emit;
}
