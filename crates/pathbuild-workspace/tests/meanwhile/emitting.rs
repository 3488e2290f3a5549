//! Programs that are made while something happens.

use std::fs;
use std::sync::Arc;
use std::sync::atomic::AtomicI64;

use camino::Utf8PathBuf;
use pathbuild_db::System;
use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::Code;
use pathbuild_workspace::emit::Task;

use crate::mischief::{Event, Mischief};
use crate::on_disk::OnDisk;

const CONFIGURATION: &str = "library = [\"lib\"]\nfeed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n[emit]\ntargets = [\"8*\"]\n";
const DRAWING: &str = "lib/8001.1P.dxf";
const PROGRAM: &str = "lib/8001.1P_Milling.gcode";
const WRITE: Task = Task::Write { force: false };

/// A machine that is busy for a moment, whenever that is: a path is walked along for its check and for its program.
#[test]
fn no_program_lacks_what_took_too_long() {
    // So many segments that the walk looks at the clock.
    let lines: String = (0..300).map(|x| format!("mill {x},0 {},0\n", x + 1)).collect();
    let drawn = format!("layer 8001.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\n{lines}end 300,0");
    let emitted = |system: Arc<dyn System>| {
        let place = OnDisk::configured(CONFIGURATION, &[(DRAWING, &drawn)]);
        let made = place.emit(system, false, WRITE);
        let codes: Vec<Code> = made.diagnostics.iter().map(|found| found.code()).collect();
        (codes, fs::read_to_string(place.path().join(PROGRAM)).ok())
    };
    let expected = emitted(Arc::new(OsSystem));
    assert!(expected.0.is_empty() && expected.1.is_some());
    let is_given_up = |time: &i64| {
        let busy = Mischief {
            trigger: String::new(),
            countdown: AtomicI64::new(*time),
            lasts: false,
            is_before: false,
            event: Event::Busy,
            victim: Utf8PathBuf::new(),
            bytes: Vec::new(),
        };
        let found = emitted(Arc::new(busy));
        let is_given_up = found == (vec![Code::LimitReached], None);
        assert!(is_given_up || found == expected, "the clock is looked at for the {time}th time: {found:?}");
        is_given_up
    };
    assert_eq!((1..10).filter(is_given_up).count(), 2);
}
