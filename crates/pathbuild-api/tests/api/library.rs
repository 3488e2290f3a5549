//! Tests requests on the library of the fixtures, and on drawings that change.

use std::fs;

use pathbuild_api::{
    CheckState, EmitOptions, Error, FileState, Lang, Library, LibraryOptions, MoveKind, Path, ProgramState,
    VerifyOptions, VerifyReport, WatchEnd, WatchReport,
};
use pathbuild_testkit::{project, sheet};
use tempfile::TempDir;

/// Opens the library of the fixtures, which no test writes to.
fn fixtures() -> Library {
    Library::open(project().join("fixtures/library")).unwrap()
}

const CONFIGURATION: &str = "library = [\"lib\"]\nfeed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n[emit]\ntargets = [\"8*\"]\n";

/// Returns the drawing of a path that mills from (0, 0) to (length, 0).
fn drawn(name: &str, length: u32) -> Vec<u8> {
    let text =
        format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MAl\"\nmill 0,0 {length},0 \"F80\"\nend {length},0");
    sheet(&text).unwrap().to_dxf()
}

/// Creates a library on disk with one path, 8001.1P.
fn on_disk() -> TempDir {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("pathbuild.toml"), CONFIGURATION).unwrap();
    fs::create_dir(directory.path().join("lib")).unwrap();
    fs::write(directory.path().join("lib/8001.1P.dxf"), drawn("8001.1P", 40)).unwrap();
    directory
}

fn codes<T: std::fmt::Debug>(result: Result<T, Error>) -> Vec<String> {
    match result.unwrap_err() {
        Error::Findings(found) | Error::Post(found) => {
            found.iter().map(pathbuild_api::Finding::code).collect()
        }
        other => panic!("{other:?}"),
    }
}

fn refusal<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    match result.unwrap_err() {
        Error::Refused(reason) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_library_is_checked_and_listed() {
    let library = fixtures();
    let (checked, listed) = (library.check(&[]).unwrap(), library.paths(&[]).unwrap());
    assert_eq!(checked.findings, []);
    assert_eq!((checked.paths, checked.drawings), (listed.paths.len(), listed.drawings));
    let named = library.paths(&["2050.*"]).unwrap().paths;
    assert_eq!(named.iter().map(|path| &*path.name).collect::<Vec<_>>(), ["2050.1P", "2050.2P"]);
    assert_eq!(named[0].file, "components/2050.1P.dxf");
    assert_eq!((named[0].material.as_deref(), named[0].thickness), (Some("20x2"), Some(2.0)));
    assert_eq!(named[0].program, ProgramState::None);
}

#[test]
fn findings_have_code_place_and_both_languages() {
    let checked = fixtures().check(&["mistakes"]).unwrap();
    let found = checked.findings.iter().find(|found| found.is_error() && found.span().is_some()).unwrap();
    assert!(found.code().starts_with("PB"), "{found:?}");
    assert_ne!(found.message(Lang::En), found.message(Lang::De));
    assert!(found.file().is_some_and(|file| file.starts_with("mistakes/")), "{found:?}");
    let (text, span) = (found.text().unwrap(), found.span().unwrap());
    assert!(!text[span].is_empty());
    assert_eq!(found.to_string(), format!("{}: {}", found.code(), found.message(Lang::En)));
}

/// The moves add up to the statistics, and each move names its line of the program.
#[test]
fn a_path_has_elements_and_moves() {
    let library = fixtures();
    let path = library.path("2050.1P").unwrap();
    let summary = &library.paths(&["2050.1P"]).unwrap().paths[0];
    let length: f64 = path.moves.iter().map(|it| it.length).sum();
    assert!((length - summary.length.unwrap()).abs() < 1e-6);
    let statistics = path.statistics.unwrap();
    assert!((statistics.milling + statistics.drilling + statistics.sweeps - length).abs() < 1e-6);
    assert_eq!(statistics.minutes, summary.minutes);
    let milled = path.moves.iter().find(|it| it.kind == MoveKind::Mill).unwrap();
    let element = &path.elements[milled.element.unwrap()];
    assert_eq!((&*element.path, &*element.file), ("2050.1P", "components/2050.1P.dxf"));
    let feed = element.parameter('F').unwrap();
    assert_eq!(Some(feed.value.parse::<f64>().unwrap()), milled.feed);
    assert!(path.moves.iter().all(|it| it.kind.cuts() || it.feed.is_none()));
}

#[test]
fn a_program_is_the_text_that_is_written() {
    let directory = on_disk();
    let library = Library::open(directory.path()).unwrap();
    let options = EmitOptions::new();
    let program = library.program("8001.1P", &options).unwrap();
    let written = library.emit(&[], &options).unwrap();
    assert_eq!(written.findings, []);
    let [file] = &*written.files else { panic!("{written:?}") };
    assert_eq!((&*file.file, file.state, &*file.path), (&*program.file, FileState::Written, "8001.1P"));
    assert_eq!(fs::read(directory.path().join(&file.file)).unwrap(), program.text);
    assert_eq!(library.emit(&[], &options).unwrap().files[0].state, FileState::Unchanged);
    let compare = EmitOptions::new().compare();
    assert_eq!(library.emit(&[], &compare).unwrap().files[0].state, FileState::Current);
    let posted = library.program("8001.1P", &EmitOptions::new().post("mach3")).unwrap();
    assert_ne!(posted.text, program.text);
}

#[test]
fn programs_are_verified_and_compared_with_their_drawing() {
    let directory = on_disk();
    let library = Library::open(directory.path()).unwrap();
    let written = library.emit(&[], &EmitOptions::new()).unwrap().files.remove(0).file;
    let against = VerifyOptions::new().against("8001.1P");
    let report = library.verify(&[&written], &against).unwrap();
    assert_eq!(report.findings, []);
    let comparison = report.programs[0].comparison.clone().unwrap();
    assert_eq!((&*comparison.path, comparison.equal), ("8001.1P", comparison.moves));
    let state = |report: &VerifyReport, name| {
        report.programs[0].checks.iter().find(|check| check.name == name).map(|check| check.state)
    };
    assert_eq!(state(&report, "drawing"), Some(CheckState::Made));
    fs::write(
        directory.path().join("other.nc"),
        "G21 G90\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG0 Z-1\nG1 X9 F90\nM30\n",
    )
    .unwrap();
    let options = VerifyOptions::new().dialect("grbl").cutter(2.0).surface(0.0).require("feeds");
    let report = library.verify(&["other.nc"], &options).unwrap();
    let codes: Vec<String> = report.findings.iter().map(pathbuild_api::Finding::code).collect();
    assert!(codes.contains(&"PB741".to_owned()), "{codes:?}");
    assert_eq!(
        (state(&report, "rapids"), state(&report, "feeds")),
        (Some(CheckState::Made), Some(CheckState::NotMade))
    );
    assert!(report.findings.iter().any(|finding| finding.message(Lang::En).contains("feeds")), "{codes:?}");
    assert!(library.verify(&["other.nc"], &VerifyOptions::new().dialect("klingon")).is_err());
    assert!(library.verify(&["other.nc"], &VerifyOptions::new().against("9999.1P")).is_err());
}

/// Results stay the same until an edit is reported.
#[test]
fn an_edit_is_seen_after_it_is_told_of() {
    let directory = on_disk();
    let library = Library::open(directory.path()).unwrap();
    let reach = |path: &Path| path.moves.iter().filter_map(|it| it.to[0]).fold(0.0, f64::max);
    assert_eq!(reach(&library.path("8001.1P").unwrap()), 40.0);
    fs::write(directory.path().join("lib/8001.1P.dxf"), drawn("8001.1P", 50)).unwrap();
    library.changed("lib/8001.1P.dxf").unwrap();
    assert_eq!(reach(&library.path("8001.1P").unwrap()), 50.0);
    fs::write(directory.path().join("lib/8002.1P.dxf"), drawn("8002.1P", 10)).unwrap();
    let absolute = directory.path().join("lib/8002.1P.dxf");
    library.changed(absolute.to_str().unwrap()).unwrap();
    assert_eq!(library.paths(&[]).unwrap().paths.len(), 2);
}

#[test]
fn unknown_edits_are_seen_after_a_refresh() {
    let directory = on_disk();
    let library = Library::open(directory.path()).unwrap();
    assert_eq!(library.check(&[]).unwrap().findings, []);
    fs::write(directory.path().join("lib/8001.1P.dxf"), "no drawing").unwrap();
    library.refresh().unwrap();
    assert!(library.check(&[]).unwrap().findings.iter().any(pathbuild_api::Finding::is_error));
}

/// The first report covers everything, the second one the results of an edit; then watching is stopped. Without a configuration, the library is the
/// directory.
#[test]
fn a_library_is_watched() {
    for is_configured in [true, false] {
        let directory = on_disk();
        if !is_configured {
            fs::remove_file(directory.path().join("pathbuild.toml")).unwrap();
        }
        let drawing = directory.path().join("lib/8001.1P.dxf");
        let library = Library::open(directory.path()).unwrap();
        let (reports, seen) = std::sync::mpsc::channel();
        let mut count = 0;
        let end = library.watch(move |report| {
            count += 1;
            reports.send(report).unwrap();
            if count == 1 {
                fs::write(&drawing, "no drawing").unwrap();
            }
            count < 2
        });
        assert_eq!(end, Ok(WatchEnd::Stopped));
        let [first, second] = &*seen.iter().collect::<Vec<WatchReport>>() else { panic!("two reports") };
        assert_eq!((&*first.changed, &*first.now), (&[][..], &[][..]));
        assert_eq!(second.changed, ["lib/8001.1P.dxf"]);
        assert!(second.before.is_empty() && second.now.iter().any(pathbuild_api::Finding::is_error));
        // After watching, earlier results are not reused.
        assert_eq!(library.check(&["lib/8001.1P.dxf"]).unwrap().findings, second.now);
    }
}

#[test]
fn a_scene_is_what_view_writes() {
    let scene = fixtures().scene("2050.1P").unwrap();
    assert!(scene.starts_with(r#"{"schema":"pathbuild-scene""#) && scene.contains(r#""name":"2050.1P""#));
}

#[test]
fn files_in_memory_are_a_library() {
    let files =
        [("pathbuild.toml", CONFIGURATION.as_bytes().to_vec()), ("lib/8001.1P.dxf", drawn("8001.1P", 40))];
    let library = LibraryOptions::new().open_files(files.clone()).unwrap();
    assert_eq!(library.check(&[]).unwrap().paths, 1);
    let directory = on_disk();
    let program = |library: &Library| library.program("8001.1P", &EmitOptions::new()).unwrap();
    assert_eq!(program(&library), program(&Library::open(directory.path()).unwrap()));
}

/// A relative directory is resolved when the library is opened, and names are relative to it.
#[test]
fn a_relative_directory_is_opened() {
    let library = Library::open("../../fixtures/library").unwrap();
    assert_eq!(library.path("2050.1P").unwrap(), fixtures().path("2050.1P").unwrap());
}

#[test]
fn settings_override_the_configuration() {
    let open = |name: &str, value: &str| {
        LibraryOptions::new().setting(name, value).open(project().join("fixtures/library"))
    };
    let minutes = |library: &Library| library.path("8001.1P").unwrap().statistics.unwrap().minutes.unwrap();
    assert!(minutes(&open("rapid", "10").unwrap()) > minutes(&fixtures()));
    assert!(refusal(open("rapids", "10")).contains("rapids"));
    assert!(refusal(open("compatible", "1")).contains("compatible"));
    open("compatible", "true").unwrap();
    assert_eq!(codes(open("rapid", "fast")), ["PB003"]);
    // Directories are added to those of the configuration, from which projects embed paths.
    let added = LibraryOptions::new().setting("search", "components").setting("search", "mistakes");
    let added = added.open(project().join("fixtures/library")).unwrap();
    assert_eq!(added.check(&["projects"]).unwrap(), fixtures().check(&["projects"]).unwrap());
    let missing = open("search", "none").unwrap().check(&["projects"]).unwrap();
    assert_eq!(missing.findings.iter().map(pathbuild_api::Finding::code).collect::<Vec<_>>(), ["PB003"]);
}

#[test]
fn what_is_no_path_is_an_error() {
    let library = fixtures();
    assert_eq!(codes(library.path("9999.1P")), ["PB503"]);
    assert_eq!(codes(library.path("components/2057.1-2057.2P.dxf")), ["PB512"]);
    assert!(refusal(library.path("components")).contains("directory"));
    assert!(refusal(library.path_in("components/2050.1P.dxf", "2051.1P")).contains("2051.1P"));
    assert_eq!(library.path_in("components/2050.1P.dxf", "2050.1P"), library.path("2050.1P"));
    assert!(!codes(library.path_in("components/none.dxf", "2051.1P")).is_empty());
    assert!(refusal(library.program("8003.1P", &EmitOptions::new())).contains("Z-probes"));
    assert!(!codes(library.program("8001.1P", &EmitOptions::new().post("no-such-post"))).is_empty());
}

#[test]
fn a_faulty_configuration_opens_nothing() {
    let files = [("pathbuild.toml", b"feed = \"fast\"\n".to_vec())];
    assert_eq!(codes(LibraryOptions::new().open_files(files)), ["PB003"]);
    assert_eq!(codes(LibraryOptions::new().config("none.toml").open(on_disk().path())), ["PB003"]);
}

#[test]
fn results_are_kept_in_the_cache() {
    let (directory, caches) = (on_disk(), TempDir::new().unwrap());
    let open = || LibraryOptions::new().cache(caches.path()).open(directory.path()).unwrap();
    let first = open().check(&[]).unwrap();
    assert_ne!(fs::read_dir(caches.path()).unwrap().count(), 0);
    assert_eq!(open().check(&[]).unwrap(), first);
}

#[test]
fn an_untrusted_library_stays_in_its_tree() {
    let directory = on_disk();
    let inside = directory.path().join("inside");
    fs::create_dir(&inside).unwrap();
    fs::create_dir(inside.join(".git")).unwrap();
    fs::write(inside.join("pathbuild.toml"), format!("out-dir = \"../outside\"\n{CONFIGURATION}")).unwrap();
    let open = |options: LibraryOptions| options.open(&inside);
    assert!(open(LibraryOptions::new()).is_ok());
    assert!(!codes(open(LibraryOptions::new().untrusted())).is_empty());
}

#[test]
fn threads_share_a_library() {
    let library = fixtures();
    let ask = |name: &'static str| {
        let library = &library;
        move || library.path(name).unwrap().moves.len()
    };
    let counts = std::thread::scope(|scope| {
        let asked = ["2050.1P", "2051.1P", "2050.1P"].map(|name| scope.spawn(ask(name)));
        asked.map(|thread| thread.join().unwrap())
    });
    assert_eq!(counts[0], counts[2]);
    assert_ne!(counts[0], counts[1]);
}

/// A misspelt directory is an error, not a library without findings.
#[test]
fn a_missing_directory_is_no_library() {
    let directory = on_disk();
    for name in ["none", "pathbuild.toml"] {
        assert!(refusal(Library::open(directory.path().join(name))).contains(name));
    }
    let in_german = LibraryOptions::new().lang(Lang::De).open(directory.path().join("none"));
    assert!(refusal(in_german).starts_with("es gibt kein Verzeichnis"));
}

#[test]
fn without_a_configuration_the_directory_is_the_library() {
    let directory = on_disk();
    let library = || Library::open(directory.path().join("lib")).unwrap();
    // The configuration in the directory above applies, with its library.
    assert_eq!(library().paths(&[]).unwrap().paths[0].file, "8001.1P.dxf");
    fs::remove_file(directory.path().join("pathbuild.toml")).unwrap();
    assert_eq!(library().check(&[]).unwrap().paths, 1);
    fs::remove_file(directory.path().join("lib/8001.1P.dxf")).unwrap();
    assert!(library().check(&[]).unwrap().findings.iter().any(pathbuild_api::Finding::is_error));
}
