//! The words accepted by each dialect. (book: program/reading)

/// The words of a dialect. G and M codes are multiplied by ten: `G38.2` is 382.
#[derive(Debug)]
pub struct Words {
    /// The letters of accepted words, in upper case.
    pub letters: Letters,
    /// Accepted G codes, in ascending order.
    pub g: &'static [u16],
    /// Accepted G codes whose meaning differs from that in RS274; the interpreter reports them and does not execute them.
    pub g_own: &'static [u16],
    /// Accepted M codes, in ascending order.
    pub m: &'static [u16],
    /// Accepted M codes that move the machine or jump, with a meaning of their own; the interpreter reports them and does not execute them.
    pub m_own: &'static [u16],
    /// M codes that the control accepts but ignores.
    pub m_ignored: &'static [u16],
    /// Accepted words that change neither the tool's path nor the order of lines.
    pub inert: &'static [InertWord],
    /// Whether M100 to M199 run programs of the user.
    pub own_m_codes: bool,
    /// Whether the control ignores unknown words, so that they only cause a warning; other controls stop.
    pub lenient: bool,
}

/// A word that changes neither the tool's path nor the order of lines: it controls look-ahead, outputs or overrides.
#[derive(Debug)]
pub struct InertWord {
    /// `G` or `M`.
    pub letter: char,
    /// The number after the letter, times ten.
    pub code: u16,
    /// The letters of the values that the word takes, in upper case.
    pub values: &'static [u8],
    /// Harmless values of the first letter in `values`; empty if every value is harmless.
    pub harmless: &'static [f64],
    /// Letters, at least one of which the word needs; empty if it needs none.
    pub needs: &'static [u8],
}

/// A set of letters, with one bit for each ASCII character.
#[derive(Clone, Copy, Debug)]
pub struct Letters(u128);

impl Letters {
    /// Creates a set of these letters, which must be in upper case.
    pub const fn new(letters: &[u8]) -> Self {
        let (mut bits, mut index) = (0, 0);
        while index < letters.len() {
            bits |= 1 << letters[index];
            index += 1;
        }
        Self(bits)
    }

    /// Whether the set contains a letter.
    pub fn contains(self, letter: u8) -> bool {
        letter.is_ascii() && self.0 >> letter & 1 == 1
    }
}

impl Words {
    /// Whether the dialect accepts a G code.
    pub fn has_g(&self, code: u16) -> bool {
        self.g.binary_search(&code).is_ok()
    }

    /// Returns the entry of an inert word; `None` if the dialect has no such word.
    pub fn inert(&self, letter: char, code: u16) -> Option<&'static InertWord> {
        self.inert.iter().find(|word| (word.letter, word.code) == (letter, code))
    }

    /// Whether the dialect accepts an M code.
    pub fn has_m(&self, code: u16) -> bool {
        self.own_m_codes && (1000..2000).contains(&code) || self.m.binary_search(&code).is_ok()
    }
}

/// Creates an inert word that is harmless with all values of these letters.
const fn inert(letter: char, code: u16, values: &'static [u8]) -> InertWord {
    InertWord { letter, code, values, harmless: &[], needs: &[] }
}

const fn inert_requiring(letter: char, code: u16, values: &'static [u8], needs: &'static [u8]) -> InertWord {
    InertWord { letter, code, values, harmless: &[], needs }
}

/// Defaults for the fields: no words, as in most dialects for most fields. Each dialect overrides some of them.
const COMMON_WORDS: Words = Words {
    letters: Letters(0),
    g: &[],
    g_own: &[],
    m: &[],
    m_own: &[],
    m_ignored: &[],
    inert: &[],
    own_m_codes: false,
    lenient: false,
};

pub(super) static RS274: Words = Words {
    letters: Letters::new(b"ABCDFGHIJKLMNPQRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 100, 170, 180, 190, 200, 210, 280, 300, 382, 400, 410, 420, 430, 490, 530, 540,
        550, 560, 570, 580, 590, 591, 592, 593, 610, 611, 640, 800, 810, 820, 830, 840, 850, 860, 870, 880,
        890, 900, 910, 920, 921, 922, 923, 930, 940, 980, 990,
    ],
    m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 300, 480, 490, 600],
    ..COMMON_WORDS
};

pub(super) static LINUXCNC: Words = Words {
    letters: Letters::new(b"ABCDEFGHIJKLMNOPQRSTUVWXYZ@^$"),
    g: &[
        0, 10, 20, 30, 40, 50, 51, 52, 53, 70, 80, 100, 170, 171, 180, 181, 190, 191, 200, 210, 280, 281,
        300, 301, 330, 331, 382, 383, 384, 385, 400, 410, 411, 420, 421, 430, 431, 432, 490, 520, 530, 540,
        550, 560, 570, 580, 590, 591, 592, 593, 610, 611, 640, 700, 710, 711, 712, 720, 721, 722, 730, 740,
        760, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 900, 901, 910, 911, 920, 921, 922, 923, 930,
        940, 950, 960, 970, 980, 990,
    ],
    m: &[
        0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 190, 300, 480, 490, 500, 510, 520, 530, 600, 610, 620, 630,
        640, 650, 660, 670, 680, 700, 710, 720, 730, 980, 990,
    ],
    // From memory of LinuxCNC's page "M-Codes": M19 R Q P orients the spindle; M50 to M53 P switch overrides, adaptive feed and feed stop;
    // M62 to M65 P switch digital outputs, M67 and M68 E Q set analogue ones; M66 P or E, L, Q waits for an input.
    // The interpreter refuses M62 to M68 without P or E.
    inert: &[
        inert('M', 190, b"RQP"),
        inert('M', 500, b"P"),
        inert('M', 510, b"P"),
        inert('M', 520, b"P"),
        inert('M', 530, b"P"),
        inert_requiring('M', 620, b"P", b"P"),
        inert_requiring('M', 630, b"P", b"P"),
        inert_requiring('M', 640, b"P", b"P"),
        inert_requiring('M', 650, b"P", b"P"),
        inert_requiring('M', 660, b"PELQ", b"PE"),
        inert_requiring('M', 670, b"EQ", b"E"),
        inert_requiring('M', 680, b"EQ", b"E"),
    ],
    own_m_codes: true,
    ..COMMON_WORDS
};

pub(super) static GRBL: Words = Words {
    letters: Letters::new(b"FGIJKLMNPRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 100, 170, 180, 190, 200, 210, 280, 281, 300, 301, 382, 383, 384, 385, 400, 431,
        490, 530, 540, 550, 560, 570, 580, 590, 610, 800, 900, 910, 911, 920, 921, 930, 940,
    ],
    m: &[0, 20, 30, 40, 50, 80, 90, 300],
    m_ignored: &[10],
    ..COMMON_WORDS
};

pub(super) static XPERTMILL: Words = Words {
    letters: Letters::new(b"FGIJMRSXYZ"),
    g: &[0, 10, 20, 30, 700, 710],
    m: &[60, 300],
    m_ignored: &[30, 40, 50, 70, 80, 90],
    lenient: true,
    ..COMMON_WORDS
};

/// The words of GRBL and of RS274/NGC, with G73 and G90.1: native programs are written for senders that expect either of the two.
pub(super) static NATIVE: Words = Words {
    letters: Letters::new(b"ABCDFGHIJKLMNPQRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 100, 170, 180, 190, 200, 210, 280, 281, 300, 301, 382, 383, 384, 385, 400, 410,
        420, 430, 431, 490, 530, 540, 550, 560, 570, 580, 590, 591, 592, 593, 610, 611, 640, 730, 800, 810,
        820, 830, 840, 850, 860, 870, 880, 890, 900, 901, 910, 911, 920, 921, 922, 923, 930, 940, 980, 990,
    ],
    m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 300, 480, 490, 600],
    ..COMMON_WORDS
};

pub(super) static MACH3: Words = Words {
    letters: Letters::new(b"ABCDFGHIJKLMNOPQRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 100, 120, 130, 150, 160, 170, 180, 190, 200, 210, 280, 281, 300, 310, 400, 410,
        420, 430, 490, 500, 510, 520, 530, 540, 550, 560, 570, 580, 590, 610, 640, 680, 690, 700, 710, 730,
        800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 900, 901, 910, 911, 920, 921, 922, 923, 930, 940,
        950, 980, 990,
    ],
    m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 300, 470, 480, 490, 980, 990],
    ..COMMON_WORDS
};

pub(super) static FANUC: Words = Words {
    letters: Letters::new(b"ABCDFGHIJKLMNOPQRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 50, 51, 71, 80, 90, 100, 110, 150, 160, 170, 180, 190, 200, 210, 220, 230, 270,
        280, 290, 300, 310, 330, 390, 400, 410, 420, 430, 440, 450, 460, 470, 480, 490, 500, 501, 510, 511,
        520, 530, 540, 541, 550, 560, 570, 580, 590, 600, 610, 620, 630, 640, 650, 660, 670, 680, 690, 730,
        740, 760, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 900, 910, 920, 930, 940, 950, 960, 970,
        980, 990,
    ],
    m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 190, 290, 300, 980, 990],
    // From memory of the list of G codes of the 16/18/0i-M: G22 and G23 switch the stored stroke check, G50.1 switches the mirroring of G51.1 off.
    // Look-ahead: G05 P10000 and P0 (P10001 and up run stored data), G05.1 Q1 and Q0 (Q2 and Q3 smooth the path), G08 P1 and P0. Sources: the table
    // of codes of the 30i at cncschool.pl, and blog.csdn.net/sinat_26528193, article 126620736.
    inert: &[
        InertWord { letter: 'G', code: 50, values: b"P", harmless: &[0.0, 10_000.0], needs: &[] },
        InertWord { letter: 'G', code: 51, values: b"Q", harmless: &[0.0, 1.0], needs: &[] },
        InertWord { letter: 'G', code: 80, values: b"P", harmless: &[0.0, 1.0], needs: &[] },
        inert('G', 220, b"XYZIJK"),
        inert('G', 230, b""),
        inert('G', 501, b"XYZ"),
    ],
    ..COMMON_WORDS
};

pub(super) static HAAS: Words = Words {
    letters: Letters::new(b"ABCDEFGHIJKLMNOPQRSTUVWXYZ"),
    g: &[
        0, 10, 20, 30, 40, 90, 100, 120, 130, 170, 180, 190, 200, 210, 280, 290, 310, 350, 360, 370, 400,
        410, 420, 430, 440, 470, 490, 500, 510, 520, 530, 540, 550, 560, 570, 580, 590, 600, 610, 640, 650,
        680, 690, 700, 710, 720, 730, 740, 760, 770, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 900,
        910, 920, 930, 940, 950, 980, 990, 1000, 1010, 1030, 1070, 1100, 1110, 1120, 1130, 1140, 1150, 1160,
        1170, 1180, 1190, 1200, 1210, 1220, 1230, 1240, 1250, 1260, 1270, 1280, 1290, 1360, 1410, 1430, 1500,
        1530, 1540, 1550, 1610, 1620, 1630, 1640, 1650, 1660, 1690, 1740, 1840, 1870, 1880, 2340, 2540, 2550,
    ],
    // G103 P limits the look-ahead (gcodes.net/haas-g103-limit-block-buffering). From memory: G187 P E sets the accuracy at corners.
    // From memory: G100 switches the mirroring of G101 off, G255 the work offset of G254.
    inert: &[
        inert('G', 1000, b"XYZ"),
        inert('G', 1030, b"P"),
        inert('G', 1870, b"PE"),
        inert('G', 2550, b""),
        inert('M', 590, b"P"),
        inert('M', 610, b""),
        inert('M', 690, b"P"),
        inert('M', 730, b""),
        inert('M', 1380, b"PE"),
    ],
    // M16 changes the tool, M96 jumps.
    m_own: &[160, 960],
    // Haas Mill Operator's Manual, list of M codes: M10 to M13 brakes of rotary axes, M21 to M28 and M51 to M69 outputs and user functions, M34 and
    // M35 coolant nozzle, M73, M74, M83 and M84 air, M80 and M81 door, M130 and M131 media, M138 and M139 variation of the spindle speed.
    m: &[
        0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120, 130, 160, 190, 210, 220, 230, 240, 250, 260,
        270, 280, 290, 300, 310, 330, 340, 350, 360, 390, 410, 420, 510, 520, 530, 540, 550, 560, 570, 580,
        590, 610, 620, 630, 640, 650, 660, 670, 680, 690, 730, 740, 750, 780, 790, 800, 810, 820, 830, 840,
        860, 880, 890, 950, 960, 970, 980, 990, 1090, 1300, 1310, 1380, 1390,
    ],
    ..COMMON_WORDS
};

pub(super) static MARLIN: Words = Words {
    letters: Letters::new(b"ABCEFGIJKLMNPQRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 50, 60, 170, 180, 190, 200, 210, 270, 280, 290, 300, 382, 383, 384, 385, 530, 540,
        550, 560, 570, 580, 590, 591, 592, 593, 600, 610, 800, 900, 910, 920,
    ],
    // G29 probes the bed and G30 one place. G60 stores the position, and G61 returns to it.
    g_own: &[290, 300, 600, 610],
    // marlinfw.org, "G-code index": motors, displays, timers, outputs, heaters, fans, limits and settings.
    m: &[
        0, 10, 30, 40, 50, 70, 80, 90, 170, 180, 420, 730, 750, 760, 770, 780, 800, 820, 830, 840, 850, 920,
        1040, 1050, 1060, 1070, 1090, 1100, 1110, 1130, 1140, 1150, 1170, 1180, 1190, 1200, 1210, 1250, 1400,
        1450, 1500, 1550, 1900, 2010, 2030, 2040, 2050, 2060, 2110, 2200, 2210, 2260, 2500, 2800, 2900, 3000,
        3020, 3550, 4000, 4100, 4120, 4130, 4200, 4280, 5000, 5010, 5030, 5690, 5930, 6000, 8510, 9000, 9060,
    ],
    // M125 and M600 park the tool; M206 and M428 move the zero of the machine, M290 the tool.
    m_own: &[1250, 2060, 2900, 4280, 6000],
    // M73 shows how much of the program is done.
    inert: &[inert('M', 730, b"PR")],
    ..COMMON_WORDS
};

/// The words of Estlcam, which has neither coordinate systems nor cycles. M10 and M11 switch an output.
pub(super) static ESTLCAM: Words = Words {
    letters: Letters::new(b"FGIJKMNRSTXYZ"),
    g: &[0, 10, 20, 30, 170, 200, 210, 900, 910],
    m: &[0, 10, 30, 40, 50, 60, 80, 90, 100, 110, 300],
    ..COMMON_WORDS
};

pub(super) static DIN: Words = Words {
    letters: Letters::new(b"ABCDFGHIJKLMNPQRSTXYZ"),
    g: &[
        0, 10, 20, 30, 40, 90, 170, 180, 190, 400, 410, 420, 430, 440, 530, 540, 550, 560, 570, 580, 590,
        700, 710, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 900, 910, 920, 930, 940, 950, 960, 970,
    ],
    // G53 removes the offsets permanently, and G92 may limit the spindle speed.
    g_own: &[530, 920],
    m: &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 190, 300],
    ..COMMON_WORDS
};
