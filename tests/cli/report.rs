//! Tests how findings are processed before they are displayed: deduplication, sorting, severities, baseline, counting. (book: reference/commands,
//! book: reference/diagnostics)

use std::time::Duration;

use crate::support::Place;
use camino::Utf8Path;
use pathbuild::report::summary;
use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{
    Diagnostic, ElementId, EntityKind, Handle, Lang, Point, Severity, TextFault, TraceStep,
};
use pathbuild_path::PathName;
use pathbuild_workspace::Inputs;
use pathbuild_workspace::check::CheckedFile;
use pathbuild_workspace::config::{self, Overrides};
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::findings::Fingerprint;
use pathbuild_workspace::{SilentReporter, Workspace};

fn diagnostic() -> Diagnostic {
    Diagnostic::new(&files::NOT_DXF)
        .quoting("found", "x")
        .in_file(Utf8Path::new("/work/parts/2913.dxf"))
        .in_path("2913.1P")
        .at_element(ElementId(3), EntityKind::Line, "2913.1P", Point::new(1.0, 2.0))
        .with_text(TextFault::new("B5 T5", 0..2))
}

fn located(mut diagnostic: Diagnostic, line: u32) -> Diagnostic {
    diagnostic.locate(line, Some(Handle(1)));
    diagnostic
}

fn fingerprint(diagnostic: Diagnostic) -> Fingerprint {
    Fingerprint::of(&[diagnostic])[0]
}

#[test]
fn the_same_finding_is_reported_once_however_it_was_met() {
    let traced = |path: &str| {
        let mut traced = diagnostic();
        traced.trace =
            vec![TraceStep { file: "/work/8001.dxf".into(), path: path.into(), point: Point::new(0.0, 0.0) }];
        traced
    };
    assert_eq!(Findings::new(vec![traced("8001.1P"), diagnostic(), traced("8001.2P")]).diagnostics.len(), 1);
    assert_eq!(Findings::new(vec![diagnostic().quoting("found", "y"), diagnostic()]).diagnostics.len(), 2);
    let between = vec![diagnostic(), diagnostic().quoting("found", "y"), traced("8001.1P")];
    assert_eq!(Findings::new(between).diagnostics.len(), 2);
    assert_eq!(
        Findings::new(vec![diagnostic(), diagnostic().at_point(Point::new(1.0, 2.001))]).diagnostics.len(),
        2
    );
}

#[test]
fn the_order_is_file_path_place_whatever_came_first() {
    let sorted = vec![
        diagnostic().in_file(Utf8Path::new("/work/a.dxf")).in_path("9999.9Z"),
        located(diagnostic().in_path("2913.0P"), 90),
        located(diagnostic(), 7),
        located(diagnostic(), 70),
    ];
    let mut shuffled = sorted.clone();
    shuffled.reverse();
    shuffled.swap(0, 2);
    assert_eq!(Findings::new(shuffled).diagnostics, sorted);
}

#[test]
fn a_fingerprint_survives_what_does_not_change_the_finding() {
    let original = fingerprint(located(diagnostic(), 10));
    assert_eq!(fingerprint(located(diagnostic(), 20)), original, "lines shift");
    assert_eq!(
        fingerprint(diagnostic().in_file(Utf8Path::new("/elsewhere/2913.dxf"))),
        original,
        "the file is moved"
    );
    assert_eq!(fingerprint(diagnostic().in_path("2913.1p")), original, "case of the path's name");
    assert_eq!(
        fingerprint(diagnostic().at_point(Point::new(1.0004, 2.0))),
        original,
        "less than a micrometre"
    );
    assert_eq!(
        fingerprint(diagnostic().with_text(TextFault::new("B5 T7", 0..2))),
        original,
        "another parameter changes"
    );
    let mut lowered = diagnostic();
    lowered.severity = Severity::Warning;
    assert_eq!(fingerprint(lowered), original, "the severity is changed");
}

#[test]
fn a_fingerprint_changes_with_the_finding() {
    let original = fingerprint(diagnostic());
    assert_ne!(fingerprint(diagnostic().in_file(Utf8Path::new("/work/parts/2914.dxf"))), original);
    assert_ne!(fingerprint(diagnostic().in_path("2913.2P")), original);
    assert_ne!(fingerprint(diagnostic().at_point(Point::new(1.002, 2.0))), original);
    assert_ne!(fingerprint(diagnostic().with_text(TextFault::new("B6 T5", 0..2))), original);
    assert_ne!(fingerprint(Diagnostic { message: &files::LIMIT, ..diagnostic() }), original);
}

#[test]
fn findings_that_look_alike_have_fingerprints_of_their_own() {
    let all =
        Fingerprint::of(&[located(diagnostic(), 1), located(diagnostic(), 2), located(diagnostic(), 3)]);
    assert!(all[0] != all[1] && all[1] != all[2] && all[0] != all[2]);
    assert_eq!(all[0], fingerprint(diagnostic()), "one more does not change the first");
}

/// Fingerprints are stored in users' files, so they must never change.
#[test]
fn a_fingerprint_is_the_same_in_every_version() {
    assert_eq!(fingerprint(diagnostic()).to_string(), "5de19581b4c0da5ba455d08b2bcd2ebf");
}

#[test]
fn severities_are_those_of_the_configuration_and_the_last_part_that_names_the_file() {
    let place = tempfile::TempDir::new().unwrap();
    let directory = Utf8Path::from_path(place.path()).unwrap();
    let text = "[severity]\nPB007 = \"error\"\nPB008 = \"ignore\"\n\
        [[severity-in]]\nfiles = [\"old/**\"]\nPB007 = \"ignore\"\nPB112 = \"error\"\n\
        [[severity-in]]\nfiles = [\"old/new/*.dxf\"]\nPB007 = \"warning\"\n";
    #[expect(clippy::disallowed_methods, reason = "a test's own file")]
    std::fs::write(directory.join("pathbuild.toml"), text).unwrap();
    let (settings, faults) =
        config::load(&OsSystem::shared(), &Overrides::default(), &Inputs::default(), directory);
    assert_eq!(faults, []);
    let workspace = Workspace {
        settings,
        system: OsSystem::shared(),
        own_lang: None,
        system_lang: None,
        working_directory: directory.to_owned(),
        jobs: None,
        cache: None,
        reporter: std::sync::Arc::new(SilentReporter),
        is_date_decisive: std::sync::Arc::default(),
    };
    let severity = |diagnostic: Diagnostic| {
        workspace.findings(vec![diagnostic]).diagnostics.first().map(|diagnostic| diagnostic.severity)
    };
    let judged = |message, file: &str| severity(Diagnostic::new(message).in_file(&directory.join(file)));
    let end = pathbuild_diagnostic::messages::all().find(|message| message.code.number() == 7).unwrap();
    let encoding = pathbuild_diagnostic::messages::all().find(|message| message.code.number() == 8).unwrap();
    assert_eq!(judged(end, "a.dxf"), Some(Severity::Error));
    assert_eq!(judged(end, "old/a.dxf"), None);
    assert_eq!(judged(end, "OLD/x/a.dxf"), None);
    assert_eq!(judged(end, "old/new/a.dxf"), Some(Severity::Warning));
    assert_eq!(judged(end, "old/new/x/a.dxf"), None);
    assert_eq!(judged(encoding, "old/new/a.dxf"), None);
    assert_eq!(judged(&files::EMPTY_FILE, "a.dxf"), Some(Severity::Error));
    assert_eq!(severity(Diagnostic::new(end)), Some(Severity::Error), "without a file");
}

#[test]
fn the_summary_counts_and_agrees_in_number() {
    let path = || PathName::new("1234.1P");
    let file = |paths: usize| CheckedFile {
        file: "a.dxf".into(),
        paths: std::iter::repeat_with(path).take(paths).collect(),
    };
    let of = |diagnostics: Vec<Diagnostic>, checked: Vec<CheckedFile>| Findings {
        checked,
        ..Findings::new(diagnostics)
    };
    let warning = |line| {
        let mut warning = located(diagnostic(), line);
        warning.severity = Severity::Warning;
        warning
    };
    let time = Duration::from_millis(449);
    let none = of(vec![], vec![]);
    assert_eq!(summary(&none, 0, time, Lang::En), "0 paths in 0 drawings: no errors, no warnings (0.4 s)");
    let one = of(vec![located(diagnostic(), 1), warning(2)], vec![file(1)]);
    assert_eq!(
        summary(&one, 1, time, Lang::En),
        "1 path in 1 drawing: 1 error in 1 drawing, 1 warning, 1 known (0.4 s)"
    );
    assert_eq!(
        summary(&one, 0, time, Lang::De),
        "1 Pfad in 1 Zeichnung: 1 Fehler in 1 Zeichnung, 1 Warnung (0,4 s)"
    );
    let other = diagnostic().in_file(Utf8Path::new("/work/b.dxf"));
    let errors = vec![located(diagnostic(), 1), located(diagnostic(), 2), other, warning(3), warning(4)];
    let many = of(errors, vec![file(1_000), file(1_014)]);
    assert_eq!(
        summary(&many, 0, time, Lang::En),
        "2,014 paths in 2 drawings: 3 errors in 2 drawings, 2 warnings (0.4 s)"
    );
    assert_eq!(
        summary(&many, 0, time, Lang::De),
        "2.014 Pfade in 2 Zeichnungen: 3 Fehler in 2 Zeichnungen, 2 Warnungen (0,4 s)"
    );
}

/// A typing error must not overwrite a drawing, a program or the configuration.
#[test]
fn no_report_replaces_a_source_or_a_program() {
    let place =
        Place::new().file("pathbuild.toml", "library = [\".\"]\n").file("a.dxf", "x").file("a.nc", "M30\n");
    let place = place
        .file("a_Z.txt", "#51=2.1\n")
        .file("own.cbpp", "x")
        .file("own.toml", "x")
        .file("notes.txt", "a note\n");
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0\nend 40,0\n";
    let place = place.file("b/1234.1P.dxf", pathbuild_testkit::sheet(drawing).unwrap().to_dxf());
    let commands = [
        "check --report json=a.dxf",
        "check --report json=a.NC",
        "check --report html=pathbuild.toml",
        "check --baseline a.dxf --update-baseline",
        "verify a.nc --report json=a.nc",
        "check --report json=a_Z.txt",
        "check --report json=own.cbpp",
        "check --baseline own.toml --update-baseline",
        "check --baseline notes.txt --update-baseline",
        "emit b --rapid 1000 --sweep-height 20 --deps a_Z.txt",
        "emit b --rapid 1000 --sweep-height 20 --deps a.dxf",
    ];
    for command in commands {
        let run = place.run(command);
        assert!(run.stderr.contains("PB004") && run.stderr.contains("would be lost"), "{run}");
    }
    let kept = ["pathbuild.toml", "a.dxf", "a.nc", "a_Z.txt", "own.cbpp", "own.toml", "notes.txt"];
    let kept = kept.map(|name| place.read(name));
    assert_eq!(kept, ["library = [\".\"]\n", "x", "M30\n", "#51=2.1\n", "x", "x", "a note\n"]);
    assert_eq!(place.run("check --report json=a_Zz.txt").status, Some(1), "written, with errors of a.dxf");
    assert!(place.path().join("a_Zz.txt").exists());
    assert!(!place.path().join("a.NC").exists() || place.read("a.NC") == "M30\n");
}

/// Ignore files, the baseline and the texts that the post inserts are part of the configuration.
#[test]
fn no_output_replaces_a_part_of_the_configuration() {
    let post = "[post]\nname = \"mine\"\nextension = \"mpf\"\ndialect = \"linuxcnc\"\n[text]\n\
                program-start = '\\\\\\~*head.txt*'\nline = 'G01 X{.~X1~} Y{.~Y1~} Z{.~Z1~} F{.~MovingVel~}'\n\
                rapid = 'G00 X{.~X1~} Y{.~Y1~} Z{.~Z1~}'\ntool-change = 'S{#~MillingSpindleRate~} M03'\nprogram-end = 'M30'\n";
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0\nend 40,0\n";
    let head = "G21 G90 G17 G94\n";
    let place = Place::new()
        .file("1234.dxf", pathbuild_testkit::sheet(drawing).unwrap().to_dxf())
        .file(
            "pathbuild.toml",
            "library = [\".\"]\nrapid = 1000\nsweep-height = 20\n[tool.a]\ndiameter = 2\nspindle = 9000\n",
        )
        .file("posts/my.toml", post)
        .file("posts/head.txt", head)
        .file(".ignore", "")
        .file("pathbuild-baseline.txt", "");
    let emit = "emit 1234.1P --post posts/my.toml --dialect linuxcnc";
    assert_eq!(place.run(emit).status, Some(0), "{}", place.run(emit));
    let program = place.read("1234_Milling.mpf");
    let refused = |command: &str| {
        let run = place.run(command);
        assert!(run.stderr.contains("PB004") && run.stderr.contains("would be lost"), "{run}");
    };
    for name in [".ignore", ".gitignore", "pathbuild-baseline.txt", "./posts/../pathbuild-baseline.txt"] {
        refused(&format!("check --report json={name}"));
        refused(&format!("{emit} --deps {name}"));
    }
    refused("check --baseline .ignore --update-baseline");
    refused("post 1234_Milling.mpf --dialect linuxcnc --post grbl -o .ignore");
    refused("post 1234_Milling.mpf --dialect linuxcnc --post grbl -o pathbuild-baseline.txt");
    refused(&format!("{emit} --deps 1234_Milling.mpf"));
    refused(&format!("{emit} --deps posts/head.txt"));
    refused("post 1234_Milling.mpf --dialect linuxcnc --post posts/my.toml -o posts/head.txt");
    let configuration = place.read("pathbuild.toml");
    let place = place.file("pathbuild.toml", format!("post = \"posts/my.toml\"\n{configuration}"));
    let run = place.run("check --report json=1234_Milling.mpf");
    assert!(run.stderr.contains("it has the name of a G-code program"), "{run}");
    let run = place.run("check --report json=posts/head.txt");
    assert!(run.stderr.contains("it belongs to the post-processor"), "{run}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("1234.dxf", place.path().join("link.txt")).unwrap();
        let run = place.run("check --report json=link.txt");
        assert!(run.stderr.contains("it has the name of a drawing"), "{run}");
    }
    assert_eq!(place.read("posts/head.txt"), head);
    assert_eq!(place.read("1234_Milling.mpf"), program);
    assert_eq!(place.read(".ignore") + &place.read("pathbuild-baseline.txt"), "");
    // Beside them, any name will do.
    for name in ["posts/tail.txt", "ignore", "1234_Milling.txt", "report.mpf"] {
        assert_eq!(place.run(&format!("check --report json={name}")).status, Some(0), "{name}");
        assert!(place.path().join(name).exists(), "{name}");
    }
}
