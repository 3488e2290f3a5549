//! Tests that the page's script escapes the same characters as the program.
#![allow(clippy::unwrap_used, reason = "a test that cannot set up has failed")]

use pathbuild_diagnostic::escaping;
use regex::Regex;

const SCRIPT: &str = include_str!("../page/src/visible.ts");

#[test]
fn the_page_escapes_what_the_program_escapes() {
    let class = SCRIPT.split_once("/[").unwrap().1.split_once("]/gu").unwrap().0;
    let escaped = Regex::new(&format!("^[{class}]$")).unwrap();
    for character in (0..=0x10_ffff).filter_map(char::from_u32) {
        // The script leaves line breaks as they are.
        let is_meant = character != '\n' && escaping::is_active(character);
        assert_eq!(escaped.is_match(character.encode_utf8(&mut [0; 4])), is_meant, "{character:?}");
    }
}
