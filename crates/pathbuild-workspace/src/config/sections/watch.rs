//! `[watch]`: how changes are detected.

use std::fmt::Debug;
use std::time::Duration;

use crate::config::kind::Key;
use crate::config::kinds::number::{DURATION, SWITCH};
use crate::config::origin::SourcedValue;
use crate::config::reader::Table;
use crate::config::result_kind::ResultKind;
use crate::config::show::ShownSetting;

section! {
    /// how long no file may change before drawings are read again
    debounce: Duration = "debounce", DURATION, Duration::from_millis(50), r#""50 ms""#, Neither;
    /// look for changes at intervals (network drives)
    poll: bool = "poll", SWITCH, false, "false", Neither;
}
