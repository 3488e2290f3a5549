//! The targets that are no dialects of the reader. Their words are those of the makers' manuals for mills.

use super::{Comments, Target};
use pathbuild_gcode::dialect::{Dialect, Letters, Words};

const ROUND: Comments = Comments { round: true, nested: false, semicolon: false, slashes: false };

const NO_WORDS: Words = Words {
    letters: Letters::new(b""),
    g: &[],
    g_ignored: &[],
    m: &[],
    m_ignored: &[],
    own_m_codes: false,
    lenient: false,
};

const TARGET: Target = Target {
    name: "",
    words: &NO_WORDS,
    comments: ROUND,
    has_real_time_bytes: false,
    percent: true,
    longest: None,
    bare_tool_number: false,
    line_numbers: true,
    reader: Dialect::LinuxCnc,
};

pub(super) static TARGETS: &[Target] = &[
    Target {
        name: "mach3",
        words: &Words {
            letters: Letters::new(b"ABCDFGHIJKLMNOPQRSTXYZ"),
            g: &[
                0, 10, 20, 30, 40, 100, 120, 130, 150, 160, 170, 180, 190, 200, 210, 280, 281, 300, 310, 400,
                410, 420, 430, 490, 500, 510, 520, 530, 540, 550, 560, 570, 580, 590, 610, 640, 680, 690,
                700, 710, 730, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 900, 901, 910, 911, 920,
                921, 922, 923, 930, 940, 950, 980, 990,
            ],
            m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 300, 470, 480, 490, 980, 990],
            ..NO_WORDS
        },
        ..TARGET
    },
    Target {
        name: "fanuc",
        words: &Words {
            letters: Letters::new(b"ABCDFGHIJKLMNOPQRSTXYZ"),
            g: &[
                0, 10, 20, 30, 40, 90, 100, 110, 150, 160, 170, 180, 190, 200, 210, 270, 280, 290, 300, 310,
                400, 410, 420, 430, 440, 490, 500, 510, 520, 530, 540, 541, 550, 560, 570, 580, 590, 610,
                620, 630, 640, 650, 660, 670, 680, 690, 730, 740, 760, 800, 810, 820, 830, 840, 850, 860,
                870, 880, 890, 900, 910, 920, 940, 950, 960, 970, 980, 990,
            ],
            m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 190, 290, 300, 980, 990],
            ..NO_WORDS
        },
        ..TARGET
    },
    Target {
        name: "haas",
        words: &Words {
            letters: Letters::new(b"ABCDEFGHIJKLMNOPQRSTUVWXYZ"),
            g: &[
                0, 10, 20, 30, 40, 90, 100, 120, 130, 170, 180, 190, 200, 210, 280, 290, 310, 350, 360, 370,
                400, 410, 420, 430, 440, 490, 500, 510, 520, 530, 540, 550, 560, 570, 580, 590, 600, 610,
                640, 650, 680, 690, 700, 710, 720, 730, 740, 760, 770, 800, 810, 820, 830, 840, 850, 860,
                870, 880, 890, 900, 910, 920, 930, 940, 950, 980, 990,
            ],
            m: &[
                0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 190, 290, 300, 310, 330, 410, 420, 830, 840, 880, 890,
                970, 980, 990,
            ],
            ..NO_WORDS
        },
        ..TARGET
    },
    Target {
        name: "marlin",
        words: &Words {
            letters: Letters::new(b"ABCEFGIJKLMNPQRSTXYZ"),
            g: &[
                0, 10, 20, 30, 40, 50, 60, 170, 180, 190, 200, 210, 270, 280, 382, 383, 384, 385, 530, 540,
                550, 560, 570, 580, 590, 591, 592, 593, 600, 610, 800, 900, 910, 920,
            ],
            m: &[
                0, 10, 30, 40, 50, 70, 80, 90, 170, 180, 420, 820, 830, 840, 850, 1050, 1100, 1140, 1170,
                1180, 2010, 2030, 2040, 2050, 2200, 2260, 2800, 3000, 4000, 4100,
            ],
            ..NO_WORDS
        },
        comments: Comments { round: false, nested: false, semicolon: true, slashes: false },
        percent: false,
        reader: Dialect::Grbl,
        ..TARGET
    },
];
