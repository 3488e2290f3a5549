//! Tests which results are cached, when, and for which bytes.

use std::fs::{self, File};
use std::sync::Arc;
use std::sync::atomic::AtomicI64;
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use pathbuild_db::system::OsSystem;
use pathbuild_testkit::sheet;

use crate::mischief::{Event, Mischief};
use crate::on_disk::OnDisk;

const COMPONENT: &str = "layer 1001.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0";
const PROJECT: &str = "layer 8001.1P\nstart 0,0 \"T5 O2 MX\"\nsubpath 0,0 40,0 \">1001.1P\"\nend 40,0";
const PLACES: [&str; 2] = ["lib/1001.1P.dxf", "lib/8001.1P.dxf"];

fn place() -> OnDisk {
    OnDisk::of(&[(PLACES[0], COMPONENT), (PLACES[1], PROJECT)])
}

fn check(place: &OnDisk) -> Vec<String> {
    place.check(Arc::new(OsSystem), true, Some(1))
}

fn is_as_without_cache(place: &OnDisk) {
    let expected = place.check(Arc::new(OsSystem), false, Some(1));
    assert_eq!(check(place), expected);
}

/// A file that changed shortly before it was read may change again without a new stamp. Therefore it is cached without a stamp, and every
/// run reads it until it has been unchanged for a while.
#[test]
fn no_stamp_is_kept_of_what_has_not_rested() {
    const REST: Duration = Duration::from_millis(3_500);
    let place = place();
    check(&place);
    let drawn_just_now = place.kept();
    check(&place);
    assert_ne!(place.kept(), drawn_just_now, "it had not rested");
    sleep(REST);
    check(&place);
    let rested = place.kept();
    check(&place);
    assert_eq!(place.kept(), rested, "all has rested: there is nothing to write");
    // Setting the modification time does not help: the system's own change time is compared.
    for modified in [SystemTime::now(), SystemTime::now() - Duration::from_hours(1)] {
        let drawing = place.path().join(PLACES[0]);
        File::options().write(true).open(drawing).unwrap().set_modified(modified).unwrap();
        // File systems record times in steps of up to two seconds.
        sleep(Duration::from_millis(1_200));
        check(&place);
        let touched = place.kept();
        check(&place);
        assert_ne!(place.kept(), touched, "it had not rested");
        sleep(REST);
        check(&place);
        let rested = place.kept();
        check(&place);
        assert_eq!(place.kept(), rested);
    }
}

/// A component changes between the verification of the cache and the reading of the project that embeds it, and is then changed back.
#[test]
fn what_is_made_of_other_bytes_is_not_kept_under_those_that_were_compared() {
    let place = place();
    check(&place);
    sleep(Duration::from_millis(3_500));
    check(&place);
    place.draw(PLACES[1], &PROJECT.replace("MX", "MX F90"));
    let other = sheet(&COMPONENT.replace("T5", "T6")).unwrap().to_dxf();
    let changing = Mischief {
        trigger: PLACES[0].to_owned(),
        countdown: AtomicI64::new(1),
        lasts: false,
        is_before: true,
        event: Event::Change,
        victim: place.path().join(PLACES[0]),
        bytes: other,
    };
    let found = place.check(Arc::new(changing), true, Some(1));
    assert!(found.iter().any(|it| it.contains("8001.1P") && it.contains("Error")), "{found:#?}");
    place.draw(PLACES[0], COMPONENT);
    is_as_without_cache(&place);
}

/// A drawing is added after its directory was listed, but before the results are cached.
#[test]
fn a_directory_in_which_a_drawing_came_meanwhile_is_asked_again() {
    let found = |time| {
        let place = OnDisk::of(&[(PLACES[1], PROJECT)]);
        let coming = Mischief {
            trigger: "lib".to_owned(),
            countdown: AtomicI64::new(time),
            lasts: false,
            is_before: false,
            event: Event::Change,
            victim: place.path().join(PLACES[0]),
            bytes: sheet(COMPONENT).unwrap().to_dxf(),
        };
        let found = place.check(Arc::new(coming), true, Some(1));
        let is_there = place.path().join(PLACES[0]).exists();
        is_as_without_cache(&place);
        is_there && found.iter().any(|it| it.contains("PathNotFound"))
    };
    assert!((1..4).any(found), "it came too early to be missed");
}

#[test]
fn results_of_drawings_that_are_gone_go() {
    let place = place();
    let size = |place: &OnDisk| place.kept().iter().map(|(_, _, size)| size).sum::<u64>();
    check(&place);
    fs::remove_file(place.path().join(PLACES[1])).unwrap();
    check(&place);
    let alone = OnDisk::of(&[(PLACES[0], COMPONENT)]);
    check(&alone);
    assert_eq!(size(&place), size(&alone));
}

/// Two names mean the same drawing if their directories have the same real path. If a link now points to copies with the same names and bytes, one
/// drawing becomes two.
#[cfg(unix)]
#[test]
fn a_link_that_leads_to_a_copy_makes_drawings_ambiguous() {
    use std::os::unix::fs::symlink;

    let place = place();
    let configuration = "library = [\"lib\"]\nsearch = [\"other\"]\nfeed = 100\n";
    fs::write(place.path().join("pathbuild.toml"), configuration).unwrap();
    let link = place.path().join("other");
    symlink("lib", &link).unwrap();
    check(&place);
    is_as_without_cache(&place);
    fs::create_dir(place.path().join("copy")).unwrap();
    for file in PLACES {
        let name = file.strip_prefix("lib/").unwrap();
        fs::copy(place.path().join(file), place.path().join("copy").join(name)).unwrap();
    }
    fs::remove_file(&link).unwrap();
    symlink("copy", &link).unwrap();
    assert!(check(&place).iter().any(|it| it.contains("1001.1P") && it.contains("Error")));
    is_as_without_cache(&place);
}
