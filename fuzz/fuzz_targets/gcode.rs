//! G-code of any kind is read and interpreted without a panic; the first byte chooses the dialect.

#![no_main]

use libfuzzer_sys::fuzz_target;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, guess, interpret};

fuzz_target!(|data: &[u8]| {
    let Some((choice, text)) = data.split_first() else { return };
    let dialect = Dialect::ALL[usize::from(*choice) % Dialect::ALL.len()];
    let result = interpret(text, dialect, &Options::default());
    assert!(result.moves().iter().all(|(_, it)| it.to.at.iter().all(|at| at.is_finite())));
    guess(text);
});
