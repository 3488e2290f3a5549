//! Tests the output and the files of `watch` as drawings change.

#[cfg(unix)]
mod links;
#[cfg(unix)]
mod replaced;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::io::{BufRead, BufReader};
#[cfg(target_os = "linux")]
use std::os::unix::fs::PermissionsExt;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::support::{Place, StderrLines, program};
use pathbuild_testkit::sheet;
use serde_json::{Value, json};

const CONFIGURATION: &str = "spindle = \"manual\"\nfeed = 150\nrapid = 1000\nsweep-height = 20\nlibrary = [\"library\"]\nsearch = [\"library/parts\"]\n\n[emit]\ntargets = [\"8*\"]\n";

/// Returns a drawing of one path with this T, which mills, or embeds other paths.
fn dxf(name: &str, thickness: u32, embeds: &[&str]) -> Vec<u8> {
    let cut = if embeds.is_empty() { " I1 B0" } else { "" };
    let mut text = format!("layer {name}\nstart 0,0 \"T{thickness} O2{cut} MPlate\"\n");
    if embeds.is_empty() {
        text.push_str("mill 0,0 40,0\n");
    }
    for (index, embedded) in embeds.iter().enumerate() {
        writeln!(text, "subpath {},0 {},0 \">{embedded}\"", 40 * index, 40 * index + 40).unwrap();
    }
    writeln!(text, "end {},0", 40 * embeds.len().max(1)).unwrap();
    sheet(&text).unwrap().to_dxf()
}

fn library() -> Place {
    Place::new()
        .file("pathbuild.toml", CONFIGURATION)
        .file("library/parts/1001.dxf", dxf("1001.1P", 5, &[]))
        .file("library/parts/1002.dxf", dxf("1002.1P", 5, &[]))
        .file("library/projects/8001.dxf", dxf("8001.1P", 5, &["1001.1P"]))
        .file("library/projects/8002.dxf", dxf("8002.1P", 5, &["1002.1P"]))
}

/// A running process, which ends when this value is dropped.
struct Watch<'a> {
    place: &'a Place,
    child: Child,
    lines: StderrLines,
    /// The output up to the line that reports that `watch` has begun to watch.
    beginning: Vec<String>,
}

impl<'a> Watch<'a> {
    fn begin(place: &'a Place, arguments: &str) -> Self {
        Self::begin_in(place, ".", program(), arguments)
    }

    /// Starts `watch` in a subdirectory.
    fn begin_in(place: &'a Place, directory: &str, mut command: Command, arguments: &str) -> Self {
        command.args(arguments.split_whitespace()).current_dir(place.path().join(directory));
        let mut child = command.stderr(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let lines = StderrLines::by(&mut child);
        let mut watch = Self { place, child, lines, beginning: Vec::new() };
        watch.beginning = watch.until("watching ");
        watch
    }

    /// Reads lines up to one that contains a text, and returns them.
    #[track_caller]
    fn until(&self, text: &str) -> Vec<String> {
        self.lines.until(text)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.place.path().join(name), bytes).unwrap();
    }

    fn rename(&self, from: &str, to: &str) {
        fs::rename(self.place.path().join(from), self.place.path().join(to)).unwrap();
    }
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        _ = self.child.kill();
        _ = self.child.wait();
    }
}

#[test]
fn an_edit_asks_again_what_depends_on_it_and_writes_its_programs() {
    let place = library();
    let watch = Watch::begin(&place, "watch --emit --format concise");
    let other = place.read("library/projects/8002_Milling.gcode");
    assert!(place.read("library/projects/8001_Milling.gcode").contains("1001.1P"));

    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506") && line.contains("8001.dxf")), "{said:#?}");
    assert!(
        said.last().unwrap().starts_with("[1] library/parts/1001.dxf: changed; 2 drawings checked"),
        "{said:#?}"
    );

    watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(said.last().unwrap().contains(" 0 new findings, "), "{said:#?}");
    assert_eq!(place.read("library/projects/8002_Milling.gcode"), other);

    watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &["1001.1P"]));
    let said = watch.until("1002.dxf: changed");
    assert!(said.iter().any(|line| line.contains("8002_Milling.gcode: written")), "{said:#?}");
    assert_ne!(place.read("library/projects/8002_Milling.gcode"), other);

    // The drawing that embedded the edited one no longer embeds it.
    watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &[]));
    watch.until("1002.dxf: changed");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(said.last().unwrap().contains(": changed; 2 drawings checked"), "{said:#?}");
}

/// Targets that name drawings and directories instead of paths are reported: a user would wait for programs that never come.
#[test]
fn targets_that_mean_no_path_are_told_at_the_beginning() {
    let unmet = |targets: &str, arguments: &str| {
        let place = library().file("pathbuild.toml", CONFIGURATION.replace("\"8*\"", targets));
        let watch = Watch::begin(&place, arguments);
        watch.beginning.iter().filter(|line| line.contains("matches the target")).count()
    };
    assert_eq!(unmet("\"8*\", \"projects\", \"800?.dxf\"", "watch --emit --format concise"), 2);
    assert_eq!(unmet("\"8001*\", \"*2.1P\"", "watch --emit --format concise"), 0);
    assert_eq!(unmet("\"projects\"", "watch --format concise"), 0);
}

/// `watch parts` and `watch ./parts` watch the same directory.
#[test]
fn a_directory_without_a_separator_is_watched() {
    let place = Place::new().file("pathbuild.toml", "feed = 150\n");
    let place = place.file("parts/1001.dxf", dxf("1001.1P", 5, &[]));
    let watch = Watch::begin(&place, "watch parts --format concise");
    watch.write("parts/1001.dxf", dxf("1001.1P", 5, &["1009.1P"]));
    assert!(watch.until("1001.dxf: changed").iter().any(|line| line.contains("PB503")));
}

#[test]
fn drawings_that_come_go_and_are_renamed_are_noticed() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    fs::remove_file(place.path().join("library/parts/1001.dxf")).unwrap();
    let said = watch.until("1001.dxf: removed");
    assert!(said.iter().any(|line| line.contains("PB503")), "{said:#?}");

    watch.write("library/parts/1001 again.dxf", dxf("1001.1P", 5, &[]));
    let said = watch.until("again.dxf: changed");
    assert!(
        said.last().unwrap().contains("2 drawings checked, 0 new findings, 1 fixed")
            || said.last().unwrap().contains("2 drawings checked, 0 new findings, 2 fixed"),
        "{said:#?}"
    );

    watch.write("library/projects/1001.dxf", dxf("1001.1P", 5, &[]));
    let said = watch.until("projects/1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB504")), "{said:#?}");

    let from = place.path().join("library/projects/1001.dxf");
    fs::rename(from, place.path().join("library/projects/7001.dxf")).unwrap();
    let said = watch.until("7001.dxf: changed");
    // The directory is no longer searched.
    assert!(said.last().unwrap().contains(" 1 new finding,"), "{said:#?}");
    assert!(said.iter().any(|line| line.contains("7001.dxf: warning[PB521]")), "{said:#?}");
}

/// Two projects give a component the same wrong value. The finding is fixed only when the second one is corrected.
#[test]
fn a_finding_counts_as_fixed_once_no_drawing_leads_to_it() {
    let component =
        "layer 1003.1P\nstart 0,0 \":B?0123456789 T5 O2 I1 B=B MPlate\"\nmill 0,0 40,0\nend 40,0\n";
    let place = library()
        .file("library/parts/1003.dxf", sheet(component).unwrap().to_dxf())
        .file("library/projects/8003.dxf", dxf("8003.1P", 5, &["1003.1P :B9"]))
        .file("library/projects/8004.dxf", dxf("8004.1P", 5, &["1003.1P :B9"]));
    let watch = Watch::begin(&place, "watch --format concise");
    let counts: Vec<String> = ["8004", "8003"]
        .map(|name| {
            fs::remove_file(place.path().join(format!("library/projects/{name}.dxf"))).unwrap();
            watch.until(&format!("{name}.dxf: removed")).pop().unwrap()
        })
        .into();
    assert!(counts[0].contains(" 0 new findings, 1 fixed"), "{counts:#?}");
    assert!(counts[1].contains(" 0 new findings, 2 fixed"), "{counts:#?}");

    // A further project with the same mistake adds only its own error.
    for (name, new) in [("8003", 2), ("8004", 1)] {
        watch.write(&format!("library/projects/{name}.dxf"), dxf(&format!("{name}.1P"), 5, &["1003.1P :B9"]));
        let said = watch.until(&format!("{name}.dxf: changed")).pop().unwrap();
        assert!(said.contains(&format!(" {new} new finding")), "{said}");
    }
}

/// Without a separator, the argument could also be the name of a path.
#[test]
fn a_directory_by_its_name_is_watched() {
    let place = library().file("aside/1003.dxf", dxf("1003.1P", 5, &[]));
    let watch = Watch::begin(&place, "watch aside --format concise");
    watch.write("aside/1004.dxf", dxf("1004.1P", 5, &["1999.1P"]));
    let said = watch.until("1004.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB503")), "{said:#?}");
}

/// A hidden drawing is part of the library if a rule includes it.
#[test]
fn a_hidden_drawing_that_counts_is_watched() {
    let place = library()
        .file("library/parts/.ignore", "!.1003.dxf\n")
        .file("library/parts/.1003.dxf", dxf("1003.1P", 5, &[]))
        .file("library/parts/.1004.dxf", dxf("1004.1P", 5, &[]));
    let watch = Watch::begin(&place, "watch --format concise");
    watch.write("library/parts/.1004.dxf", dxf("1004.1P", 5, &["1999.1P"]));
    watch.write("library/parts/.1003.dxf", dxf("1003.1P", 5, &["1999.1P"]));
    let said = watch.until(".1003.dxf: changed");
    assert!(said.iter().any(|line| line.contains(".1003.dxf") && line.contains("PB503")), "{said:#?}");
    assert!(!said.iter().any(|line| line.contains(".1004.dxf") && line.contains("PB503")), "{said:#?}");
}

/// If only projects are watched, components are not checked on their own.
#[test]
fn an_edit_of_what_is_not_watched_asks_only_what_is() {
    let place = library();
    let watch = Watch::begin(&place, "watch library/projects --format concise");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506") && line.contains("8001.dxf")), "{said:#?}");
    assert!(said.last().unwrap().contains(": changed; 1 drawing checked"), "{said:#?}");
}

#[test]
fn a_drawing_that_is_being_written_is_waited_for() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    let whole = dxf("1001.1P", 4, &[]);
    watch.write("library/parts/1001.dxf", &whole[..whole.len() / 2]);
    std::thread::sleep(Duration::from_millis(700));
    watch.write("library/parts/1001.dxf", &whole);
    let said = watch.until("1001.dxf: changed");
    assert!(!said.iter().any(|line| line.contains("PB002")), "{said:#?}");
    assert!(said.iter().any(|line| line.contains("PB506")), "{said:#?}");
}

#[test]
fn a_drawing_that_never_ends_is_taken_as_it_is() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.write("library/parts/1001.dxf", "no drawing at all");
    let said = watch.until("1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB002")), "{said:#?}");
}

#[test]
fn polling_notices_the_same() {
    let place = library();
    let watch = Watch::begin(&place, "watch --poll --format concise");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506")), "{said:#?}");
}

/// Polling sees only later modification times, in whole seconds. A drawing that has other contents under the same time, or an earlier one, is noticed
/// all the same; one with the same contents under an earlier time is not reported.
#[test]
fn polling_notices_a_drawing_without_a_later_time() {
    let place = library();
    let file = |name: &str| place.path().join(name);
    let time = |name: &str| fs::metadata(file(name)).unwrap().modified().unwrap();
    let set = |name: &str, time| {
        fs::File::options().append(true).open(file(name)).unwrap().set_modified(time).unwrap();
    };
    let (same, unchanged) = ("library/parts/1001.dxf", "library/parts/1002.dxf");
    let before = time(same);
    let watch = Watch::begin(&place, "watch --poll --format concise");
    set(unchanged, before - Duration::from_secs(100));
    watch.write(same, dxf("1001.1P", 4, &[]));
    set(same, before);
    let said = watch.until("1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506")), "{said:#?}");
    assert!(!said.iter().any(|line| line.contains("1002.dxf: changed")), "{said:#?}");

    watch.write(same, dxf("1001.1P", 5, &[]));
    set(same, before - Duration::from_secs(100));
    let said = watch.until("1001.dxf: changed");
    assert!(said.last().unwrap().contains(" 0 new findings, "), "{said:#?}");
}

#[test]
fn another_configuration_begins_anew() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.write("pathbuild.toml", format!("restrict = [\"8001*:9\"]\n{CONFIGURATION}"));
    let said = watch.until("watching ");
    assert!(said.iter().any(|line| line.contains("PB507")), "{said:#?}");
}

/// Findings that the baseline accepts are counted, as by `check`. A baseline that changes, disappears or is faulty is noticed.
#[test]
fn the_baseline_applies_while_watching() {
    let place = library().file("library/projects/8003.dxf", dxf("8003.1P", 4, &["1001.1P"]));
    let accepted = place.run("check --baseline pathbuild-baseline.txt --update-baseline");
    assert_eq!(accepted.status, Some(0), "{accepted}");
    let baseline = place.read("pathbuild-baseline.txt");
    let watch = Watch::begin(&place, "watch --format concise");
    let said = &watch.beginning;
    assert!(said.last().unwrap().contains(": 0 errors, 0 warnings, 1 known ("), "{said:#?}");
    assert!(!said.iter().any(|line| line.contains("PB506")), "{said:#?}");

    watch.write("library/projects/8004.dxf", dxf("8004.1P", 4, &["1001.1P"]));
    let said = watch.until("8004.dxf: changed");
    assert!(said.last().unwrap().contains(" 1 new finding, 0 fixed"), "{said:#?}");
    assert!(said.iter().all(|line| !line.contains("PB506") || line.contains("8004.dxf")), "{said:#?}");
    fs::remove_file(place.path().join("library/projects/8004.dxf")).unwrap();
    assert!(watch.until("8004.dxf: removed").last().unwrap().contains(" 0 new findings, 1 fixed"));

    watch.write("pathbuild-baseline.txt", "no fingerprint\n");
    let said = watch.until("until this is fixed");
    assert!(said.iter().any(|line| line.contains("pathbuild-baseline.txt:1")), "{said:#?}");
    fs::remove_file(place.path().join("pathbuild-baseline.txt")).unwrap();
    let said = watch.until("watching ");
    assert!(said.last().unwrap().contains(": 1 error, 0 warnings ("), "{said:#?}");
    watch.write("pathbuild-baseline.txt", baseline);
    let said = watch.until("watching ");
    assert!(said.last().unwrap().contains(": 0 errors, 0 warnings, 1 known ("), "{said:#?}");
}

/// Each change ends with a line that counts all findings: a reader that adds new findings and removes fixed ones has the same number.
#[test]
fn lines_of_json_tell_the_findings_after_each_change() {
    let schema: Value = serde_json::from_str(include_str!("../../../docs/schemas/output.json")).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let place = library();
    let mut watch = Watch::begin(&place, "watch --format json");
    let mut lines = BufReader::new(watch.child.stdout.take().unwrap()).lines();
    let mut findings: Vec<Value> = Vec::new();
    let mut change = || loop {
        let mut line: Value = serde_json::from_str(&lines.next().unwrap().unwrap()).unwrap();
        let faults: Vec<String> = schema.iter_errors(&line).map(|fault| fault.to_string()).collect();
        assert!(faults.is_empty(), "{line}: {faults:?}");
        match line["type"].as_str().unwrap() {
            "finding" => findings.push(line),
            "fixed" => {
                line["type"] = "finding".into();
                let found = findings.iter().position(|finding| *finding == line).unwrap();
                findings.remove(found);
            }
            "watch_change" => {
                assert_eq!(line["errors"], findings.len());
                return line;
            }
            "watch_restart" => findings.clear(),
            kind => assert_eq!(kind, "header"),
        }
    };
    let first = change();
    assert_eq!((&first["number"], &first["paths"], &first["errors"]), (&0.into(), &4.into(), &0.into()));
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let second = change();
    assert_eq!((&second["number"], &second["new"], &second["errors"]), (&1.into(), &1.into(), &1.into()));
    assert_eq!(second["changed"], json!(["library/parts/1001.dxf"]));
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
    let third = change();
    assert_eq!((&third["number"], &third["fixed"], &third["errors"]), (&2.into(), &1.into(), &0.into()));
    fs::remove_file(place.path().join("library/projects/8002.dxf")).unwrap();
    assert_eq!(change()["removed"], json!(["library/projects/8002.dxf"]));
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    assert_eq!(change()["errors"], 1);
    // The error of the configuration and the findings before it are void when watching starts again.
    watch.write("pathbuild.toml", format!("typo = 1\n{CONFIGURATION}"));
    watch.lines.until("nothing is checked until this is fixed");
    watch.write("pathbuild.toml", CONFIGURATION);
    let again = change();
    assert_eq!((&again["number"], &again["new"], &again["errors"]), (&0.into(), &1.into(), &1.into()));
}

/// An editor's plug-in may end without ending `watch`.
#[cfg(unix)]
#[test]
fn watch_ends_when_its_output_is_read_no_more() {
    let place = library();
    let mut watch = Watch::begin(&place, "watch --format json");
    drop(watch.child.stdout.take());
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let until = std::time::Instant::now() + Duration::from_mins(1);
    while watch.child.try_wait().unwrap().is_none() {
        assert!(std::time::Instant::now() < until, "it still runs");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// The drawing that contained the path with a similar name now contains another one, so the note about it is wrong.
#[test]
fn a_finding_with_other_notes_is_reported_again() {
    let place = library().file("library/projects/8002.dxf", dxf("8002.1P", 5, &["1002.01P"]));
    let watch = Watch::begin(&place, "watch");
    assert!(
        watch.beginning.iter().any(|line| line.contains("similar names: 1002.1P")),
        "{:#?}",
        watch.beginning
    );
    watch.write("library/parts/1002.dxf", dxf("1002.3P", 5, &[]));
    let said = watch.until("1002.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB503")), "{said:#?}");
    assert!(said.last().unwrap().contains(", 1 fixed"), "{said:#?}");
}

#[test]
fn an_edited_post_begins_anew() {
    let post = |who: &str| format!("<PostProcessor><PostFile>({who})\n{{$mops}}</PostFile></PostProcessor>");
    let place = library()
        .file("pathbuild.toml", format!("post = \"posts/my.cbpp\"\n{CONFIGURATION}"))
        .file("posts/my.cbpp", post("bert"));
    let watch = Watch::begin(&place, "watch --emit");
    let program = "library/projects/8001_Milling.nc";
    assert!(place.read(program).starts_with("(bert)"));
    watch.write("posts/my.cbpp", post("anna"));
    watch.until("its post-processor or its baseline has changed");
    watch.until("watching ");
    assert!(place.read(program).starts_with("(anna)"));
}

/// A drawing changes while two hundred others are being checked because of an earlier change. That check does not start again: the
/// remaining drawings are checked together with the changed one. The pauses put the second change before, between and after the batches.
#[test]
fn changes_that_come_while_others_are_worked_on_are_not_lost() {
    const PROJECTS: usize = 200;
    let place = (0..PROJECTS).fold(library(), |place, index| {
        let name = format!("{}.1P", 8100 + index);
        place.file(&format!("library/projects/{name}.dxf"), dxf(&name, 5, &["1001.1P"]))
    });
    let watch = Watch::begin(&place, "watch --emit --format concise");
    // Each project is wrong, including 8001. In addition, 1002 lacks a path, and so does 8002, which embeds it. The programs of all projects are out
    // of date.
    let projects = i64::try_from(PROJECTS).unwrap() + 2;
    let wrong = projects + 1 + projects;
    for pause in [65, 90, 120, 180, 260, 400] {
        watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
        std::thread::sleep(Duration::from_millis(pause));
        watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &["1999.1P"]));
        let said = watch.until("1002.dxf: changed");
        assert_eq!(difference(&said), wrong, "after {pause} ms: {said:#?}");
        assert!(are_named_again(&said), "after {pause} ms: {said:#?}");

        watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
        std::thread::sleep(Duration::from_millis(pause));
        watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &[]));
        let said = watch.until("1002.dxf: changed");
        assert_eq!(difference(&said), -wrong, "mended after {pause} ms: {said:#?}");
    }
}

/// A drawing that is removed while it waits to be checked is not checked.
#[test]
fn a_drawing_that_goes_while_it_waits_is_not_asked() {
    const PROJECTS: usize = 200;
    let name = |index: usize| format!("library/projects/{}.1P.dxf", 8100 + index);
    let place = (0..PROJECTS).fold(library(), |place, index| {
        place.file(&name(index), dxf(&format!("{}.1P", 8100 + index), 5, &["1001.1P"]))
    });
    let watch = Watch::begin(&place, "watch --format concise");
    for (index, pause) in [65, 90, 120, 180, 260].into_iter().enumerate() {
        // Remove the last of the drawings that still wait, by name; 8001 and others before it are then wrong.
        let wrong = i64::try_from(PROJECTS - index).unwrap();
        watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
        std::thread::sleep(Duration::from_millis(pause));
        let last = name(PROJECTS - 1 - index);
        fs::remove_file(place.path().join(&last)).unwrap();
        let said = watch.until(&format!("{last}: removed"));
        assert_eq!(difference(&said), wrong, "after {pause} ms: {said:#?}");

        watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
        let said = watch.until("1001.dxf: changed");
        assert_eq!(difference(&said), -wrong, "mended after {pause} ms: {said:#?}");
    }
}

/// Returns the increase in the number of findings. Asserts that each changed file has a line, and that the lines of one revision agree.
fn difference(said: &[String]) -> i64 {
    let counts = said.iter().filter_map(|line| {
        let revision = line.strip_prefix('[')?.split(']').next()?;
        let (new, gone) = line.split_once(" new findings, ")?;
        let number = |text: &str| text.parse::<i64>().unwrap();
        Some((revision, number(new.rsplit(' ').next()?) - number(gone.split(' ').next()?)))
    });
    counts.collect::<BTreeMap<_, _>>().values().sum()
}

/// If the link of a drawing leads through a directory without access for others, the system does not report when the drawing can be read again.
#[cfg(target_os = "linux")]
#[test]
fn what_may_have_passed_is_tried_again_with_the_next_change() {
    let Some(command) = as_nobody() else { return };
    let place = library().file("closed/elsewhere/1003.dxf", dxf("1003.1P", 5, &[]));
    let allow = |name: &str, mode| {
        fs::set_permissions(place.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    allow(".", 0o755);
    allow("closed", 0o700);
    let link = place.path().join("library/parts/1003.dxf");
    std::os::unix::fs::symlink("../../closed/elsewhere/1003.dxf", link).unwrap();
    let watch = Watch::begin_in(&place, ".", command, "watch --no-cache --format concise");
    assert!(watch.beginning.iter().any(|line| line.contains("1003.dxf: error[PB001]")));
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    watch.until("1001.dxf: changed");
    // The change has no effect yet, and nothing is reported.
    std::thread::sleep(Duration::from_millis(500));
    allow("closed", 0o755);
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
    let said = [watch.until("1001.dxf: changed"), watch.until("checked again")].concat();
    assert_eq!(said.iter().filter(|line| line.contains("checked again")).count(), 1, "{said:#?}");
    let line = said.last().unwrap();
    let expected = "[2] library/parts/1003.dxf: checked again; 1 drawing checked, 0 new findings, 1 fixed (";
    assert!(line.starts_with(expected), "{line}");
}

/// Whether each revision also names the files because of which the previous revision left drawings unchecked.
fn are_named_again(said: &[String]) -> bool {
    let mut revisions: BTreeMap<u32, (BTreeSet<&str>, bool)> = BTreeMap::new();
    for line in said.iter().filter_map(|line| line.strip_prefix('[')) {
        let (revision, change) = line.split_once("] ").unwrap();
        let (files, is_behind) = revisions.entry(revision.parse().unwrap()).or_default();
        files.insert(change.split(": ").next().unwrap());
        *is_behind = change.contains(" still to check, ");
    }
    let revisions: Vec<_> = revisions.into_values().collect();
    revisions.windows(2).all(|pair| !pair[0].1 || pair[0].0.is_subset(&pair[1].0))
}

#[test]
fn what_cannot_be_watched_is_wrong_usage() {
    let run = Place::new().run("watch");
    assert_eq!(run.status, Some(2), "{run}");
    let run = Place::new()
        .file("pathbuild.toml", "library = [\"library\"]\n")
        .file("library/a.txt", "")
        .run("watch --emit");
    assert_eq!(run.status, Some(2), "{run}");
}

/// Editors write a configuration in pieces, or remove it first, so it may be invalid for a moment.
#[test]
fn a_configuration_that_is_wrong_for_a_moment_ends_nothing() {
    let place = library();
    let watch = Watch::begin(&place, "watch --emit --format concise");
    for wrong in [
        "feed = \n",
        "[emit]\ntargets = 5\n",
        "post = \"nowhere.toml\"\nfeed = 150\nlibrary = [\"library\"]\n",
    ] {
        watch.write("pathbuild.toml", wrong);
        let said = watch.until("until this is fixed");
        assert!(said.iter().any(|line| line.contains("error[PB")), "{said:#?}");
        watch.write("pathbuild.toml", CONFIGURATION);
        watch.until("watching ");
    }
    fs::remove_file(place.path().join("pathbuild.toml")).unwrap();
    watch.until("until this is fixed");
    watch.write("pathbuild.toml", CONFIGURATION);
    watch.until("watching ");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    watch.until("1001.dxf: changed");
}

const REPLACED: &str = "a watched directory appeared, disappeared or was replaced";

/// The system watches a directory, not its name, but Git and synchronisation programs replace directories.
#[test]
fn a_directory_that_takes_the_place_of_one_is_watched() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.rename("library", "aside");
    watch.until(REPLACED);
    assert!(watch.until("watching ").iter().any(|line| line.contains("[PB003]")));
    watch.rename("aside", "library");
    watch.until("watching 4 paths");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    assert!(watch.until("parts/1001.dxf: changed").iter().any(|line| line.contains("PB506")));

    fs::remove_dir_all(place.path().join("library")).unwrap();
    watch.until("watching 0 paths");
    fs::create_dir_all(place.path().join("library/parts")).unwrap();
    watch.until(REPLACED);
    watch.until("watching ");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &["1999.1P"]));
    assert!(watch.until("parts/1001.dxf: changed").iter().any(|line| line.contains("PB503")));
}

/// The replacement appears at once, and is a link.
#[cfg(unix)]
#[test]
fn a_link_that_takes_the_place_of_a_directory_is_watched() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.rename("library", "aside");
    std::os::unix::fs::symlink("aside", place.path().join("library")).unwrap();
    watch.until(REPLACED);
    watch.until("watching 4 paths");
    watch.write("aside/projects/8001.dxf", dxf("8001.1P", 5, &["1999.1P"]));
    let said = watch.until("library/projects/8001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB503")), "{said:#?}");
}

/// Only a parent of a watched directory is replaced.
#[test]
fn what_leads_to_a_directory_may_be_replaced() {
    let configuration = CONFIGURATION.replace("library", "all/library").replace("all/library =", "library =");
    let place = Place::new().file("pathbuild.toml", configuration);
    let place = place.file("all/library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
    let watch = Watch::begin(&place, "watch --format concise");
    watch.rename("all", "aside");
    watch.until("watching 0 paths");
    watch.rename("aside", "all");
    watch.until("watching 1 path");
    watch.write("all/library/parts/1001.dxf", dxf("1001.1P", 5, &["1999.1P"]));
    watch.until("parts/1001.dxf: changed");
}

/// Other directories may come and go, including output directories, without a restart.
#[test]
fn other_directories_begin_nothing_anew() {
    let place = library().file("pathbuild.toml", format!("out-dir = \"gcode\"\n{CONFIGURATION}"));
    let watch = Watch::begin(&place, "watch --emit --format concise");
    watch.write("notes", "");
    fs::create_dir(place.path().join("other")).unwrap();
    fs::create_dir(place.path().join("library/parts/new")).unwrap();
    std::thread::sleep(Duration::from_millis(500));
    watch.write("library/parts/new/1003.dxf", dxf("1003.1P", 5, &["1999.1P"]));
    let mut said = watch.until("1003.dxf: changed");
    watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &["1001.1P"]));
    said.extend(watch.until("1002.dxf: changed"));
    fs::remove_dir_all(place.path().join("gcode")).unwrap();
    watch.write("library/parts/new/1003.dxf", dxf("1003.1P", 5, &[]));
    said.extend(watch.until("1003.dxf: changed"));
    assert!(!said.iter().any(|line| line.contains(REPLACED) || line.contains("watching ")), "{said:#?}");
}

#[test]
fn a_library_that_is_missing_at_the_beginning_is_watched_once_it_comes() {
    let place = Place::new().file("pathbuild.toml", CONFIGURATION);
    let watch = Watch::begin(&place, "watch --format concise");
    assert!(watch.beginning.iter().any(|line| line.contains("[PB003]")), "{:#?}", watch.beginning);
    fs::create_dir_all(place.path().join("library/parts")).unwrap();
    watch.until("watching ");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
    watch.until("1001.dxf: changed");
    // An argument in a tree without a configuration is also watched once it exists.
    let place = Place::new();
    let watch = Watch::begin(&place, "watch parts --format concise");
    fs::create_dir(place.path().join("parts")).unwrap();
    watch.until("watching ");
    watch.write("parts/1001.dxf", dxf("1001.1P", 5, &["1999.1P"]));
    watch.until("1001.dxf: changed");
}

/// The argument begins with `..`, but the paths in events do not.
#[test]
fn a_directory_above_is_watched() {
    for arguments in ["watch ../library --format concise", "watch ../library/parts/1001.dxf --format concise"]
    {
        let place = library().file("beside/a.txt", "");
        let watch = Watch::begin_in(&place, "beside", program(), arguments);
        watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &["1999.1P"]));
        let said = watch.until("1001.dxf: changed");
        assert!(said.iter().any(|line| line.contains("PB503")), "{said:#?}");
    }
}

#[test]
fn a_post_whose_directory_is_exchanged_begins_anew() {
    let post = |who: &str| format!("<PostProcessor><PostFile>({who})\n{{$mops}}</PostFile></PostProcessor>");
    let place = library()
        .file("pathbuild.toml", format!("post = \"posts/my.cbpp\"\n{CONFIGURATION}"))
        .file("posts/my.cbpp", post("bert"))
        .file("others/my.cbpp", post("anna"));
    let watch = Watch::begin(&place, "watch --emit");
    watch.rename("posts", "before");
    watch.rename("others", "posts");
    watch.until("watching ");
    assert!(place.read("library/projects/8001_Milling.nc").starts_with("(anna)"));
}

/// The program of a path that is no target is compared again when its drawing or a drawing that it embeds changes.
#[test]
fn the_old_program_of_a_path_that_is_no_target_is_compared_after_each_change() {
    let place = library().file("library/projects/7001.dxf", dxf("7001.1P", 5, &["1001.1P"]));
    assert_eq!(place.run("emit 7001.1P").status, Some(0));
    let watch = Watch::begin(&place, "watch --emit --format concise");
    let expect = |drawing: &str, bytes: Vec<u8>, told: Option<&str>| {
        watch.write(drawing, bytes);
        let said = watch.until(".dxf: changed");
        let findings = said.iter().filter(|line| line.contains("[PB520]"));
        let findings: Vec<bool> = findings.map(|line| told.is_some_and(|told| line.contains(told))).collect();
        assert_eq!(findings, vec![true; usize::from(told.is_some())], "{said:#?}");
    };
    let (project, component) = ("library/projects/7001.dxf", "library/parts/1001.dxf");
    expect(project, dxf("7001.1P", 5, &["1002.1P", "1001.1P"]), Some("7001_Milling.gcode is out of date"));
    expect(project, dxf("7001.1P", 5, &["1001.1P"]), None);
    expect(component, dxf("1001.1P", 4, &[]), Some("its path 7001.1P has errors now"));
    expect("library/parts/1002.dxf", dxf("1002.1P", 5, &["1001.1P"]), None);
    expect(component, dxf("1001.1P", 5, &[]), None);
    expect(component, dxf("1001.1P", 4, &[]), Some("its path 7001.1P has errors now"));
}

/// A program that cannot be written is reported once, retried after each change, and counted once it succeeds.
#[test]
fn a_program_that_could_not_be_written_is_written_later() {
    let place = library().file("library/projects/8001_Milling.gcode/x.txt", "");
    let watch = Watch::begin(&place, "watch --emit --format concise");
    assert!(watch.beginning.iter().any(|line| line.contains("[PB004]")), "{:#?}", watch.beginning);
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 5, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(said.last().unwrap().contains(" 0 new findings, 0 fixed"), "{said:#?}");
    watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &["1001.1P"]));
    let said = watch.until("1002.dxf: changed");
    assert!(said.last().unwrap().contains(" 0 new findings, 0 fixed"), "{said:#?}");

    fs::remove_dir_all(place.path().join("library/projects/8001_Milling.gcode")).unwrap();
    watch.write("library/parts/1002.dxf", dxf("1002.1P", 5, &[]));
    let said = watch.until("8001.dxf: checked again");
    assert!(said.iter().any(|line| line.contains("8001_Milling.gcode: written")), "{said:#?}");
    assert!(said.last().unwrap().contains(" 0 new findings, 1 fixed"), "{said:#?}");
}

/// Two drawings yield the same program. As long as both do, neither writes it, whichever of them was saved last; the remaining one writes it as soon
/// as the other is gone.
#[test]
fn a_program_of_two_drawings_is_written_once_one_of_them_is_gone() {
    let two = |depth: u32| {
        let path = |name: &str, y: u32| {
            format!("layer {name}\nstart 0,{y} \"T5 O2 I1 B{depth} MPlate\"\nmill 0,{y} 40,{y}\nend 40,{y}\n")
        };
        sheet(&(path("8010.1P", 0) + &path("8011.1P", 20))).unwrap().to_dxf()
    };
    let (both, own) = ("library/projects/8010-8012 x.dxf", "library/projects/8010.1P.dxf");
    let place = library().file(both, two(1)).file(own, dxf("8010.1P", 5, &[]));
    let program = place.path().join("library/projects/8010.1P_Milling.gcode");
    let watch = Watch::begin(&place, "watch --emit --format concise");
    assert!(watch.beginning.iter().any(|line| line.contains("[PB514]")), "{:#?}", watch.beginning);

    watch.write(both, two(2));
    watch.until("x.dxf: changed");
    assert!(!program.exists());
    watch.write(own, dxf("8010.1P", 6, &[]));
    watch.until("8010.1P.dxf: changed");
    assert!(!program.exists());

    fs::remove_file(place.path().join(own)).unwrap();
    let said = watch.until("8010.1P.dxf: removed");
    assert!(said.iter().any(|line| line.contains("8010.1P_Milling.gcode: written")), "{said:#?}");
    assert!(place.read("library/projects/8010.1P_Milling.gcode").contains("Z2"));
}

/// Returns a command that runs the program as an unprivileged user; `None` if that is impossible.
#[cfg(target_os = "linux")]
fn as_nobody() -> Option<Command> {
    let nobody = || {
        let mut command = Command::new("setpriv");
        command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]).env("LC_ALL", "C");
        command.arg(program().get_program()).stdin(Stdio::null());
        command
    };
    let version = nobody().arg("--version").output();
    version.is_ok_and(|run| run.status.success()).then(nobody)
}

/// A directory that cannot be listed is reported, and watched as soon as it can be listed. All other directories are watched meanwhile.
#[cfg(target_os = "linux")]
#[test]
fn a_directory_that_cannot_be_listed_keeps_nothing_else_from_being_watched() {
    let Some(command) = as_nobody() else { return };
    let place = library().file("library/closed/1003.dxf", dxf("1003.1P", 5, &[]));
    let allow = |name: &str, mode| {
        fs::set_permissions(place.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    allow(".", 0o755);
    allow("library/closed", 0o700);
    let watch = Watch::begin_in(&place, ".", command, "watch --no-cache --format concise");
    assert!(
        watch.beginning.iter().any(|line| line.contains("closed: error[PB001]")),
        "{:#?}",
        watch.beginning
    );
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    watch.until("1001.dxf: changed");
    fs::create_dir(place.path().join("library/new")).unwrap();
    std::thread::sleep(Duration::from_millis(500));
    watch.write("library/new/1004.dxf", dxf("1004.1P", 5, &[]));
    watch.until("1004.dxf: changed");

    allow("library/closed", 0o755);
    watch.until("watching 6 paths");
    watch.write("library/closed/1003.dxf", dxf("1003.1P", 5, &["1999.1P"]));
    watch.until("1003.dxf: changed");
}

#[test]
fn drawings_that_a_rule_hides_have_their_line() {
    let place = library();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.write("library/projects/.ignore", "8002.dxf\n");
    watch.until("8002.dxf: removed");
    fs::remove_file(place.path().join("library/projects/.ignore")).unwrap();
    watch.until("8002.dxf: changed; 1 drawing checked");
}

/// The fault may be in the user's own configuration.
#[cfg(unix)]
#[test]
fn a_users_configuration_that_is_put_right_is_noticed() {
    let place = library().users("lang = \"en\"\n");
    let mut command = program();
    command.env("XDG_CONFIG_HOME", place.configurations());
    let watch = Watch::begin_in(&place, ".", command, "watch --format concise");
    let own = place.configurations().join("pathbuild/config.toml");
    fs::write(&own, "lang = \n").unwrap();
    watch.write("pathbuild.toml", CONFIGURATION);
    watch.until("until this is fixed");
    fs::write(&own, "lang = \"en\"\n").unwrap();
    watch.until("watching ");
}
