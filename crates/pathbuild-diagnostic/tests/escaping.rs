//! Displayed text contains no characters that affect the display.

use pathbuild_diagnostic::{Lang, Value, escaping};

/// Tests all special characters, and the neighbours of each of their ranges.
#[test]
fn what_acts_is_known() {
    for acting in
        "\0\u{1}\u{8}\t\n\r\u{1b}\u{1f}\u{7f}\u{80}\u{85}\u{9b}\u{9f}\u{ad}\u{34f}\u{61c}\u{115f}\u{1160}\u{17b4}\u{17b5}\u{180b}\u{180f}\u{200b}\u{200f}\u{2028}\u{202a}\u{202e}\u{2060}\u{2066}\u{2069}\u{206f}\u{3164}\u{fe00}\u{fe0f}\u{feff}\u{ffa0}\u{fff0}\u{fff9}\u{fffb}\u{fffe}\u{ffff}\u{13430}\u{1343f}\u{1bca0}\u{1bca3}\u{1d173}\u{1d17a}\u{e0000}\u{e0001}\u{e007f}\u{e0fff}"
            .chars()
    {
        assert!(escaping::is_active(acting), "{acting:?}");
        assert_eq!(escaping::line(&acting.to_string()), acting.escape_default().to_string());
    }
    for seen in " ~\u{a0}äßØ°²→…·\u{200a}\u{2010}\u{2027}\u{202f}\u{205f}\u{2070}\u{34e}\u{350}\u{115e}\u{1161}\u{17b3}\u{17b6}\u{180a}\u{1810}\u{3163}\u{3165}\u{fe10}\u{ff9f}\u{ffef}\u{fffc}\u{1342f}\u{13440}\u{1bc9f}\u{1bca4}\u{1d172}\u{1d17b}漢🦀".chars()
    {
        assert!(!escaping::is_active(seen), "{seen:?}");
        assert_eq!(escaping::line(&seen.to_string()), seen.to_string());
    }
    for control in (0..=0x10_ffff).filter_map(char::from_u32).filter(|character| character.is_control()) {
        assert!(escaping::is_active(control), "{control:?}");
    }
}

#[test]
fn a_name_stays_on_its_line() {
    assert_eq!(escaping::line("d\n::add-mask::e"), "d\\n::add-mask::e");
    assert_eq!(escaping::framed("d\n\u{1b}e"), "d\n\\u{1b}e");
}

#[test]
fn no_line_is_a_command_of_a_runner() {
    let broken = |text: &str| escaping::lines(text).into_owned();
    assert_eq!(broken("::stop-commands::x\n"), "\\u{3a}:stop-commands::x\n");
    assert_eq!(broken("a\n \u{3000}::x\n"), "a\n \u{3000}\\u{3a}:x\n");
    assert_eq!(broken("a ::x\n"), "a ::x\n");
    assert_eq!(broken("a ##[add-mask]b"), "a #\\u{23}[add-mask]b");
    assert_eq!(broken("###vso[task]##[x]"), "##\\u{23}vso[task]#\\u{23}[x]");
    assert_eq!(broken("## Causes\n##\n[###---] [#####]"), "## Causes\n##\n[###---] [#####]");
    assert_eq!(broken("## [a]"), "## [a]");
}

#[test]
fn colours_stay_and_hide_no_command() {
    let colored = |text: &str| escaping::colored_lines(text).into_owned();
    assert_eq!(colored("\u{1b}[31;1mred\u{1b}[0m\u{1b}[m"), "\u{1b}[31;1mred\u{1b}[0m\u{1b}[m");
    assert_eq!(colored("\u{1b}[2J\u{1b}]0;x\u{7}\u{1b}"), "\\u{1b}[2J\\u{1b}]0;x\\u{7}\\u{1b}");
    assert_eq!(colored("\u{1b}[31m::x"), "\u{1b}[31m\\u{3a}:x");
    assert_eq!(colored("\u{1b}[31"), "\\u{1b}[31");
}

#[test]
fn json_means_the_same() {
    let value = serde_json::json!({ "a": "\0\n\u{7f}\u{9b}\u{202e}\u{e0001}##[x]###[y]ä", "b": [1] });
    for text in [value.to_string(), format!("{value:#}")] {
        let shown = escaping::json(&text);
        assert!(!shown.contains(|character| character != '\n' && escaping::is_active(character)), "{shown}");
        assert!(!shown.contains("##["), "{shown}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&shown).expect("JSON"), value);
    }
}

#[test]
fn values_of_messages_are_shown_on_one_line() {
    let list: Value = ["a\nb", "\u{1b}"].into_iter().collect();
    assert_eq!(list.render(Lang::En), "a\\nb, \\u{1b}");
    assert_eq!(Value::quoted("\r\u{9b}").render(Lang::En), "\\r\\u{9b}");
}
