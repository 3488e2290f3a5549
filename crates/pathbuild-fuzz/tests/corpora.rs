//! Runs each target on its corpus, which contains seeds and earlier discoveries. `PATHBUILD_FUZZ_INPUTS` sets the number of additional inputs,
//! which are deterministic mutations of the corpus.
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot read its files has failed"
)]

use std::fs;
use std::path::Path;

use pathbuild_fuzz::TARGETS;

/// Returns the inputs of a target, sorted by file name.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let mut files: Vec<_> = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.into_iter().map(|file| fs::read(file).unwrap()).collect()
}

/// Deterministic pseudo-random numbers (xorshift).
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) as usize % end.max(1)
    }
}

/// Returns an input of the corpus with bytes changed, inserted, removed, repeated, or taken from another input.
fn changed(corpus: &[Vec<u8>], chance: &mut Chance) -> Vec<u8> {
    let mut input = corpus[chance.below(corpus.len())].clone();
    for _ in 0..=chance.below(6) {
        let at = chance.below(input.len());
        let end = (at + 1 + chance.below(12)).min(input.len());
        let byte = u8::try_from(chance.below(256)).unwrap();
        match chance.below(6) {
            0 if !input.is_empty() => input[at] = byte,
            1 => input.insert(at, byte),
            2 => _ = input.drain(at.min(end)..end),
            3 => {
                let part = input[at.min(end)..end].to_vec();
                input.splice(at..at, part);
            }
            4 => {
                let other = &corpus[chance.below(corpus.len())];
                let from = chance.below(other.len());
                let part = other[from..(from + chance.below(40)).min(other.len())].to_vec();
                input.splice(at..at, part);
            }
            _ if !input.is_empty() => {
                input[at] = *b"0-9.=~:>{}[]\\\n \xff".get(chance.below(17)).unwrap_or(&0);
            }
            _ => {}
        }
    }
    input
}

#[test]
fn corpora_show_no_bug() {
    let more = std::env::var("PATHBUILD_FUZZ_INPUTS").map_or(200, |count| count.parse().unwrap());
    for (name, run) in TARGETS {
        let corpus = corpus(name);
        assert!(!corpus.is_empty(), "{name} has no corpus");
        for input in &corpus {
            run(input);
        }
        let mut chance = Chance(0x2545_f491_4f6c_dd1d);
        for _ in 0..more {
            run(&changed(&corpus, &mut chance));
        }
    }
}
