//! Bytes that GRBL obeys as soon as they arrive, regardless of their context. (book: program/reading)

use pathbuild_diagnostic::Text;

/// The first byte of a line that acts immediately, and its effect. Other bytes above 127 are only removed.
pub(super) fn first(line: &[u8]) -> Option<(usize, &'static Text)> {
    line.iter().enumerate().find_map(|(at, &byte)| effect(byte).map(|effect| (at, effect)))
}

fn effect(byte: u8) -> Option<&'static Text> {
    Some(match byte {
        0x18 => &Text { en: "reset", de: "Zurücksetzen" },
        b'!' => &Text { en: "feed hold", de: "Vorschub anhalten" },
        b'~' => &Text { en: "go on after a hold", de: "nach einem Halt weiterfahren" },
        b'?' => &Text { en: "report the state", de: "Zustand melden" },
        0x84 => &Text { en: "safety door", de: "Schutztür" },
        0x85 => &Text { en: "cancel jogging", de: "Handfahrt abbrechen" },
        0x90..=0x94 => &Text { en: "change the feed", de: "Vorschub ändern" },
        0x95..=0x97 => &Text { en: "change the rapid speed", de: "Eilganggeschwindigkeit ändern" },
        0x99..=0x9E => &Text {
            en: "change the spindle's speed, or stop it",
            de: "Drehzahl der Spindel ändern, oder sie anhalten",
        },
        0xA0 | 0xA1 => &Text { en: "switch the coolant", de: "Kühlung schalten" },
        _ => return None,
    })
}
