//! Messages are told apart by their keys.

use std::collections::BTreeSet;

use pathbuild_diagnostic::messages;

#[test]
fn each_message_has_a_key_of_its_own() {
    let mut keys = BTreeSet::new();
    let twice: Vec<&str> =
        messages::all().map(|message| message.key).filter(|key| !keys.insert(*key)).collect();
    assert!(twice.is_empty(), "{twice:?}");
    assert!(keys.len() > 100, "all of them are looked at");
}

/// A file that is missing is not a parameter that is missing.
#[test]
fn messages_of_one_name_in_two_subjects_are_not_the_same() {
    assert_ne!(messages::files::MISSING, messages::parameters::MISSING);
    assert_ne!(messages::reading::NOT_POSITIVE, messages::parameters::NOT_POSITIVE);
}
