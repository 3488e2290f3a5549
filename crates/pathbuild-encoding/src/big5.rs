//! Decodes Big5 pair by pair, because browsers deviate from the standard: for an undefined pair, the standard replaces both bytes, Chromium
//! only the first; and for the four pairs that decode to two characters, Chromium 156 produces half a surrogate pair.

/// Decodes a text with `pair`, which gives the meaning of a pair of bytes, if any. Also returns whether every pair had a meaning.
pub(crate) fn decode(mut bytes: &[u8], pair: impl Fn([u8; 2]) -> Option<String>) -> (String, bool) {
    let (mut text, mut all_known) = (String::with_capacity(bytes.len() * 2), true);
    while let [first, rest @ ..] = bytes {
        bytes = rest;
        if first.is_ascii() {
            text.push(char::from(*first));
            continue;
        }
        let known = match rest {
            [second, others @ ..] if (0x81..=0xFE).contains(first) => {
                let known = two_characters([*first, *second]).or_else(|| pair([*first, *second]));
                // An ASCII byte that does not form a pair with the byte before it is not consumed: it is decoded on its own.
                if known.is_some() || !second.is_ascii() {
                    bytes = others;
                }
                known
            }
            _ => None,
        };
        all_known &= known.is_some();
        text.push_str(known.as_deref().unwrap_or("\u{fffd}"));
    }
    (text, all_known)
}

/// Returns the letter and the combining accent of a pair that decodes to two characters; `None` for other pairs.
fn two_characters(pair: [u8; 2]) -> Option<String> {
    let text = match pair {
        [0x88, 0x62] => "\u{CA}\u{304}",
        [0x88, 0x64] => "\u{CA}\u{30C}",
        [0x88, 0xA3] => "\u{EA}\u{304}",
        [0x88, 0xA5] => "\u{EA}\u{30C}",
        _ => return None,
    };
    Some(text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BIG5;

    fn decode_by_standard(bytes: &[u8]) -> (String, bool) {
        let (text, had_errors) = BIG5.decode_without_bom_handling(bytes);
        (text.into_owned(), !had_errors)
    }

    fn decode_by_pairs(bytes: &[u8]) -> (String, bool) {
        decode(bytes, |pair| {
            let known = BIG5.decode_without_bom_handling_and_without_replacement(&pair);
            known.map(std::borrow::Cow::into_owned)
        })
    }

    #[test]
    fn all_pairs_and_what_follows_them_are_those_of_the_standard() {
        for first in 0..=u8::MAX {
            assert_eq!(decode_by_pairs(&[first]), decode_by_standard(&[first]), "{first:02x}");
            for second in 0..=u8::MAX {
                for third in [0x20, 0x41, 0x7F, 0x80, 0x81, 0xA4, 0xFE, 0xFF] {
                    let bytes = [first, second, third];
                    assert_eq!(decode_by_pairs(&bytes), decode_by_standard(&bytes), "{bytes:02x?}");
                }
            }
        }
    }
}
