//! G-code of any kind is read, interpreted, summed up and checked without a panic; the first byte chooses the dialect.

#![no_main]

use libfuzzer_sys::fuzz_target;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::estimate::{Kinematics, seconds};
use pathbuild_gcode::interpret::{Options, guess, interpret};
use pathbuild_gcode::summary::Summary;
use pathbuild_gcode::verify::{Checks, verify};

fuzz_target!(|data: &[u8]| {
    let Some((choice, text)) = data.split_first() else { return };
    let dialect = Dialect::ALL[usize::from(*choice) % Dialect::ALL.len()];
    let result = interpret(text, dialect, &Options::default());
    assert!(result.moves().iter().all(|(_, it)| it.to.at.iter().all(|at| at.is_finite())));
    guess(text);
    Summary::of(&result.steps, dialect == Dialect::Xpertmill);
    verify(&result.steps, &Checks::default());
    let machine = Kinematics { rates: [3000.0; 3], accelerations: [200.0; 3], junction_deviation: 0.01 };
    assert!(seconds(&result.steps, &machine) >= 0.0);
});
