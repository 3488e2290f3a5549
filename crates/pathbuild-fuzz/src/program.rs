//! Targets for G-code, post definitions and measured values.

use camino::Utf8Path;
use pathbuild_gcode::adjust::{Inputs, Source, adjust};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::estimate::{Kinematics, seconds};
use pathbuild_gcode::interpret::{Options, guess, interpret};
use pathbuild_gcode::summary::Summary;
use pathbuild_post::{Job, Post, PostOptions, native_remark};

const PROGRAM: &[u8] = b"%\n(P 1)\nF100\nG00 Z20.000\nG00 X0.000 Y0.000\nG01 F100.000 Z0.000\nG01 X40.000 Y0.000\nG02 F100.000 X40.000 Y-10.000 I0.000 J-5.000\nG00 Z20.000\nM30\n%\n";

/// A post definition: if it can be read, a program is written with it.
pub(crate) fn post(data: &[u8]) {
    for file in ["post.cbpp", "post.toml"] {
        let Ok(post) = Post::read(data, Utf8Path::new(file)) else { continue };
        let steps = interpret(PROGRAM, Dialect::Native, &Options::default()).steps;
        if let Ok(job) = Job::from_steps("1001", &steps, Dialect::Native, &native_remark) {
            _ = post.write(&job, &PostOptions::default());
        }
    }
}

/// A G-code program; the first byte selects the dialect.
pub(crate) fn gcode(data: &[u8]) {
    let Some((choice, text)) = data.split_first() else { return };
    let dialect = Dialect::ALL[usize::from(*choice) % Dialect::ALL.len()];
    let result = interpret(text, dialect, &Options::default());
    assert!(
        result.moves().iter().all(|(_, motion)| motion.to.at.iter().all(|at| at.is_finite())),
        "a move leads nowhere"
    );
    guess(text);
    Summary::of(&result.steps, dialect == Dialect::Xpertmill);
    let machine = Kinematics { rates: [3000.0; 3], accelerations: [200.0; 3], junction_deviation: 0.01 };
    assert!(seconds(&result.steps, &machine) >= 0.0, "a program takes less than no time");
    if let Ok(job) = Job::from_steps("1001", &result.steps, dialect, &native_remark)
        && let Ok(post) = pathbuild_post::load("linuxcnc")
    {
        _ = post.write(&job, &PostOptions::default());
    }
}

const CLEAN: &[u8] = b"%\n([0.000 0.000]/T=5.000 #51)\nG00 Z20.000\nG01 F150.000 X1.000 Y0.000 Z1.000(=1.000+1.000*[#51-5.000])\nM30\n%\n";

/// Measured values, followed by a program and a log, separated by lines of dashes.
pub(crate) fn values(data: &[u8]) {
    let mut parts = Vec::new();
    let mut rest = data;
    while let Some(at) = rest.windows(5).position(|part| part == b"\n---\n") {
        parts.push(&rest[..at]);
        rest = &rest[at + 5..];
    }
    parts.push(rest);
    let part = |number: usize, file: &'static str| {
        parts.get(number).map(|bytes| Source { file: Utf8Path::new(file), bytes })
    };
    let clean = Source { file: Utf8Path::new("a_Clean.gcode"), bytes: CLEAN };
    let inputs = Inputs {
        values: part(0, "a_Z.txt").unwrap_or(Source { file: Utf8Path::new("a_Z.txt"), bytes: b"" }),
        program: part(1, "a_Clean.gcode").unwrap_or(clean),
        log: part(2, "log"),
        max_correction: 1.0,
    };
    if let Ok(adjusted) = adjust(&inputs) {
        let (least, most) = adjusted.corrections;
        // Weights are rounded to three decimals, for which `adjust` has a tolerance.
        let limit = 1.002 + 0.002 + 1e-9;
        assert!(least.abs() <= limit && most.abs() <= limit, "a correction is too large");
    }
}
