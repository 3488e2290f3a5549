//! Widths of texts, and texts on several lines.

/// Wraps a text to a width, at spaces or, in long words, anywhere.
pub(super) fn wrapped(text: &str, width: f64, size: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last_mut().expect("there is a line always");
        if last.is_empty() || breadth(last, size) + breadth(word, size) + 0.32 * size > width {
            if !last.is_empty() {
                lines.push(String::new());
            }
        } else {
            last.push(' ');
        }
        for letter in word.chars() {
            let last = lines.last_mut().expect("there is a line always");
            if !last.is_empty() && breadth(last, size) + advance(letter) * size > width {
                lines.push(String::new());
            }
            lines.last_mut().expect("there is a line always").push(letter);
        }
    }
    lines
}

/// Upper estimate of the width of a text.
pub(super) fn breadth(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

/// The width of a character relative to the letter size. A few classes are precise enough for wrapping lines.
fn advance(letter: char) -> f64 {
    match letter {
        ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | 'i' | 'j' | 'l' | 'I' => 0.34,
        '(' | ')' | '[' | ']' | 'f' | 't' | 'r' | '-' | '/' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '→' | '×' => 1.0,
        '0'..='9' | 'a'..='z' | '_' | 'ä' | 'ö' | 'ü' | 'ß' => 0.64,
        'A'..='Z' | 'Ä' | 'Ö' | 'Ü' | '#' | 'Ø' | '…' | '<' | '>' => 0.84,
        _ => 1.0,
    }
}
