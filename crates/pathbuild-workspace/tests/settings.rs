//! Tests which settings are part of the cache keys: each is changed alone, and the keys of checks and of programs must change or stay as expected.
//! (book: reference/configuration)

#![expect(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_workspace::Inputs;
use pathbuild_workspace::config::{self, Overrides, ResultKind, Settings};
use tempfile::TempDir;

/// Whether the results of `check`, and those of `emit`, depend on a setting.
const BOTH: [bool; 2] = [true, true];
const PROGRAMS: [bool; 2] = [false, true];
const NONE: [bool; 2] = [false, false];

/// For each key, a configuration that sets it to a value other than its default, and the results that depend on it.
const CHANGES: &[(&str, &str, [bool; 2])] = &[
    ("feed", "feed = 1", BOTH),
    ("rapid", "rapid = 1", PROGRAMS),
    ("sweep-height", "sweep-height = 1", BOTH),
    ("probe-feed", "probe-feed = 1", PROGRAMS),
    ("library", "library = ['other']", NONE),
    ("search", "search = ['other']", BOTH),
    ("path-pattern", "path-pattern = 'a'", BOTH),
    ("file-pattern", "file-pattern = 'a'", BOTH),
    ("restrict", "restrict = ['8:9']", BOTH),
    ("keep-out", "keep-out = 'CLAMP'", BOTH),
    ("part", "part = 'PART'", BOTH),
    ("part-held", "part-held = 'otherwise'", BOTH),
    ("part-tolerance", "part-tolerance = 0.05", BOTH),
    ("lang", "lang = 'de'", PROGRAMS),
    ("comment-lang", "comment-lang = 'de'", PROGRAMS),
    ("units", "units = 'mm'", BOTH),
    ("charset", "charset = 'utf-8'", PROGRAMS),
    ("approximate-curves", "approximate-curves = 1", BOTH),
    ("join-tolerance", "join-tolerance = 1", BOTH),
    ("compatible", "compatible = true", BOTH),
    ("z-model", "z-model = 'plane'", PROGRAMS),
    ("z-split", "z-split = 1", PROGRAMS),
    ("post", "post = 'grbl'", PROGRAMS),
    ("spindle", "spindle = 'manual'", PROGRAMS),
    ("cycles", "cycles = true", BOTH),
    ("out-dir", "out-dir = 'other'", PROGRAMS),
    ("line-types", "[line-types]\nMITTE = 'CENTER'", BOTH),
    ("severity", "[severity]\nPB210 = 'ignore'", NONE),
    ("severity-in", "[[severity-in]]\nfiles = ['a']\nPB210 = 'ignore'", NONE),
    ("tool", "[tool.2mm]\ndiameter = 2", BOTH),
    ("macros", "[macros]\na = 'b'", PROGRAMS),
    ("emit.targets", "[emit]\ntargets = ['8*']", NONE),
    ("emit.sheet", "[emit]\nsheet = 'svg'", PROGRAMS),
    ("limits.file-size", "[limits]\nfile-size = '1 MiB'", BOTH),
    ("limits.entities", "[limits]\nentities = 1", BOTH),
    ("limits.embedding-moves", "[limits]\nembedding-moves = 1", BOTH),
    ("limits.embedded-paths", "[limits]\nembedded-paths = 1", BOTH),
    ("limits.library-entries", "[limits]\nlibrary-entries = 1", NONE),
    ("limits.verify-cells", "[limits]\nverify-cells = 1", NONE),
    ("limits.verify-pieces", "[limits]\nverify-pieces = 1", NONE),
    ("limits.program-memory", "[limits]\nprogram-memory = 1", BOTH),
    ("limits.output-size", "[limits]\noutput-size = 1", PROGRAMS),
    ("limits.ignore-file-size", "[limits]\nignore-file-size = '1 KiB'", NONE),
    ("limits.text-length", "[limits]\ntext-length = 1", BOTH),
    ("limits.seconds-per-path", "[limits]\nseconds-per-path = 1", BOTH),
    ("machine.dwell", "[machine]\ndwell = \"milliseconds\"", PROGRAMS),
    ("machine.spin-up", "[machine]\nspin-up = 1", PROGRAMS),
    ("machine.x", "[machine]\nx = [0, 1]", PROGRAMS),
    ("machine.y", "[machine]\ny = [0, 1]", PROGRAMS),
    ("machine.z", "[machine]\nz = [0, 1]", PROGRAMS),
    ("machine.maximum-feed", "[machine]\nmaximum-feed = 1", BOTH),
    ("machine.travel", "[machine]\ntravel = [1, 1, 1]", PROGRAMS),
    ("machine.spindle-speeds", "[machine]\nspindle-speeds = [1, 2]", PROGRAMS),
    ("machine.rates", "[machine]\nrates = [1, 1, 1]", NONE),
    ("machine.accelerations", "[machine]\naccelerations = [1, 1, 1]", NONE),
    ("machine.junction-deviation", "[machine]\njunction-deviation = 1", NONE),
    ("verify.require", "[verify]\nrequire = ['rapids']", NONE),
    ("warnings.below-plate", "[warnings]\nbelow-plate = 1", BOTH),
    ("warnings.infeed", "[warnings]\ninfeed = 2", BOTH),
    ("warnings.mark-depth", "[warnings]\nmark-depth = 1", BOTH),
    ("warnings.text-margin", "[warnings]\ntext-margin = 1", BOTH),
    ("warnings.hole-margin", "[warnings]\nhole-margin = 1", BOTH),
    ("watch.debounce", "[watch]\ndebounce = '1 s'", NONE),
    ("watch.poll", "[watch]\npoll = true", NONE),
];

#[test]
fn each_setting_asks_another_question_of_those_whom_it_concerns() {
    let directory = TempDir::new().unwrap();
    let base = Utf8Path::from_path(directory.path()).unwrap();
    let defaults = questions(&settings(base, ""));
    for (name, text, expected) in CHANGES {
        let changed = questions(&settings(base, text));
        let differs = [defaults[0] != changed[0], defaults[1] != changed[1]];
        assert_eq!(differs, *expected, "{name}");
    }
}

#[test]
fn every_setting_is_tried() {
    let schema = config::schema();
    let keys = |table: &serde_json::Value| -> Vec<String> {
        table["properties"].as_object().unwrap().keys().cloned().collect()
    };
    let mut expected = BTreeSet::new();
    for name in keys(&schema) {
        if matches!(&*name, "emit" | "limits" | "machine" | "verify" | "warnings" | "watch") {
            expected.extend(keys(&schema["properties"][&name]).iter().map(|key| format!("{name}.{key}")));
        } else {
            expected.insert(name);
        }
    }
    assert_eq!(CHANGES.iter().map(|(name, ..)| (*name).to_owned()).collect::<BTreeSet<_>>(), expected);
}

fn settings(base: &Utf8Path, text: &str) -> Settings {
    fs::write(base.join("pathbuild.toml"), text).unwrap();
    let (settings, faults) = config::load(
        &pathbuild_db::system::OsSystem::shared(),
        &Overrides::default(),
        &Inputs::default(),
        base,
    );
    assert!(faults.is_empty(), "{text}: {faults:?}");
    Settings { file: Some(Utf8PathBuf::from("pathbuild.toml")), ..settings }
}

/// Returns the settings in the cache keys of `check` and of `emit`.
fn questions(settings: &Settings) -> [String; 2] {
    [ResultKind::Check, ResultKind::Emit].map(|whose| {
        let mut text = String::new();
        settings.visit_inputs(whose, &mut |name, value| _ = writeln!(text, "{name} = {value:?}"));
        text
    })
}
