//! Deserializes statics of the program from caches: messages by their keys, and names of arguments and words as one leaked copy each. There
//! are only a few dozen.

use std::collections::{HashMap, HashSet};
use std::sync::{LazyLock, Mutex, PoisonError};

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::message::Arguments;
use crate::{Message, Text, Value, messages};

impl Serialize for Message {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key)
    }
}

/// The message with a key; an error if this version has no such message.
pub(crate) fn message<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Message, D::Error> {
    static BY_KEY: LazyLock<HashMap<&str, &Message>> =
        LazyLock::new(|| messages::all().map(|message| (message.key, message)).collect());
    let key = <&str>::deserialize(deserializer)?;
    BY_KEY.get(key).copied().ok_or_else(|| D::Error::custom("no message of this program"))
}

/// The values in a message.
pub(crate) fn arguments<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arguments, D::Error> {
    let arguments = Vec::<(&str, Value)>::deserialize(deserializer)?;
    Ok(arguments.into_iter().map(|(name, value)| (name_of(name), value)).collect())
}

/// Prose in both languages.
pub(crate) fn text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Text, D::Error> {
    static KEPT: LazyLock<Mutex<HashMap<(&'static str, &'static str), &'static Text>>> =
        LazyLock::new(Mutex::default);
    let (en, de) = <(&str, &str)>::deserialize(deserializer)?;
    let (en, de) = (name_of(en), name_of(de));
    let mut all = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    Ok(all.entry((en, de)).or_insert_with(|| Box::leak(Box::new(Text { en, de }))))
}

/// A single copy of a text that lives until the process ends.
fn name_of(text: &str) -> &'static str {
    static KEPT: LazyLock<Mutex<HashSet<&'static str>>> = LazyLock::new(Mutex::default);
    let mut all = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all.get(text) {
        return known;
    }
    let leaked: &'static str = Box::leak(text.to_owned().into_boxed_str());
    all.insert(leaked);
    leaked
}
