//! Bytes that GRBL obeys the moment they arrive, whatever they stand in. (book: program/reading)

use pathbuild_diagnostic::Word;

/// The first byte of a line that acts at once, and what it does. Other bytes above 127 are merely removed.
pub(super) fn first(line: &[u8]) -> Option<(usize, &'static Word)> {
    line.iter().enumerate().find_map(|(at, &byte)| effect(byte).map(|effect| (at, effect)))
}

fn effect(byte: u8) -> Option<&'static Word> {
    Some(match byte {
        0x18 => &Word { en: "reset", de: "Zurücksetzen" },
        b'!' => &Word { en: "feed hold", de: "Vorschub anhalten" },
        b'~' => &Word { en: "go on after a hold", de: "nach einem Halt weiterfahren" },
        b'?' => &Word { en: "report the state", de: "Zustand melden" },
        0x84 => &Word { en: "safety door", de: "Schutztür" },
        0x85 => &Word { en: "cancel jogging", de: "Handfahrt abbrechen" },
        0x90..=0x94 => &Word { en: "change the feed", de: "Vorschub ändern" },
        0x95..=0x97 => &Word { en: "change the rapid speed", de: "Eilganggeschwindigkeit ändern" },
        0x99..=0x9E => &Word {
            en: "change the spindle's speed, or stop it",
            de: "Drehzahl der Spindel ändern, oder sie anhalten",
        },
        0xA0 | 0xA1 => &Word { en: "switch the coolant", de: "Kühlung schalten" },
        _ => return None,
    })
}
