//! Tests checks during which files change, disappear or cannot be read, at moments chosen by a [`System`]. Later runs with the cache must find the
//! same as runs without it. `PATHBUILD_STEPS` sets the number of steps for each of two libraries (default: 60). (docs/reliability.md)

#![expect(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

mod arrivals;
mod bugs;
mod emitting;
mod keeping;
mod mischief;
mod on_disk;
mod watched_programs;
mod watching;

use std::sync::Arc;
use std::sync::atomic::AtomicI64;

use pathbuild_db::system::OsSystem;
use pathbuild_testkit::RandomLibrary;

use mischief::{Event, Mischief};
use on_disk::OnDisk;

/// A generator of pseudorandom numbers (xorshift) that yields the same numbers in every run.
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % bound as u64).unwrap()
    }

    fn pick<'t, T>(&mut self, all: &'t [T]) -> &'t T {
        &all[self.below(all.len())]
    }
}

fn steps() -> usize {
    std::env::var("PATHBUILD_STEPS").map_or(60, |steps| steps.parse().unwrap())
}

/// Tests one library. Each step is an edit, a run during which an event happens, and two runs that must find the same as one without a cache.
fn library(seed: u64) {
    let mut workshop = RandomLibrary::new(seed);
    let place = OnDisk::new(&workshop);
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15 ^ seed);
    let mut spoilt: Option<String> = None;
    for step in 0..steps() {
        // The victim of the event is restored either at once or only now, so that both cases are tested.
        for path in workshop.edit().into_iter().chain(spoilt.take()) {
            place.put(&workshop, &path);
        }
        let files: Vec<String> = workshop.files().keys().cloned().collect();
        let victim = chance.pick(&files).clone();
        let trigger = match chance.below(3) {
            0 => victim.clone(),
            1 => chance.pick(&["lib", "lib/parts", "lib/projects", "spare"]).to_string(),
            _ => chance.pick(&files).clone(),
        };
        let mischief = Mischief {
            trigger,
            countdown: AtomicI64::new(1 + i64::try_from(chance.below(3)).unwrap()),
            lasts: false,
            is_before: chance.below(2) == 0,
            event: *chance.pick(&[Event::Vanish, Event::Change, Event::Replace, Event::Fail]),
            victim: place.path().join(&victim),
            bytes: workshop.files()[chance.pick(&files)].clone(),
        };
        let said = format!("library {seed}, step {step}: {mischief:?}");
        let jobs = [None, Some(1)][chance.below(2)];
        place.check(Arc::new(mischief), true, jobs);
        if chance.below(2) == 0 {
            place.put(&workshop, &victim);
        } else {
            spoilt = Some(victim);
        }
        let expected = place.check(Arc::new(OsSystem), false, None);
        for jobs in [None, Some(1)] {
            let kept = place.check(Arc::new(OsSystem), true, jobs);
            let differing = kept.iter().zip(&expected).find(|(kept, expected)| kept != expected);
            assert!(kept == expected, "{said}\n{differing:#?}\n{} and {}", kept.len(), expected.len());
        }
    }
}

#[test]
fn nothing_wrong_is_kept_of_a_library_that_changes_meanwhile() {
    library(1);
}

#[test]
fn nothing_wrong_is_kept_of_another() {
    library(2);
}
