//! The catalogue of messages, with a module for each subject. The texts in both languages and the help of a message are next to each
//! other, so that none is changed without the others.

/// Declares the messages of a subject: a static for each, and a list of all of them. `CODE as Warning` or `CODE as Error` declares a message with
/// another severity than its code.
macro_rules! messages {
    ($($(#[$doc:meta])* $key:ident: $code:ident $(as $severity:ident)? {
        en: $en:literal, de: $de:literal $(, help_en: $help_en:literal, help_de: $help_de:literal)? $(,)?
    })*) => {
        $($(#[$doc])* pub static $key: crate::Message = crate::Message {
            code: crate::Code::$code,
            severity: severity!($code $($severity)?),
            key: concat!(module_path!(), "::", stringify!($key)),
            text: crate::Text { en: $en, de: $de },
            help: crate::Text { en: concat!($($help_en)?), de: concat!($($help_de)?) },
        };)*

        pub(crate) static ALL: &[&crate::Message] = &[$(&$key),*];
    };
}

macro_rules! severity {
    ($code:ident) => {
        crate::Code::$code.severity()
    };
    ($code:ident $severity:ident) => {
        crate::Severity::$severity
    };
}

pub mod configuration;
pub mod drawing;
pub mod files;
mod following;
pub mod gcode;
pub mod import;
pub mod outputs;
pub mod parameters;
pub mod part;
pub mod paths;
mod posting;
pub mod posts;
pub mod probes;
mod verify;

/// Returns all messages, for tests and for deserializing cached results.
pub fn all() -> impl Iterator<Item = &'static crate::Message> {
    [
        files::ALL,
        configuration::ALL,
        drawing::ALL,
        parameters::ALL,
        part::ALL,
        paths::ALL,
        outputs::ALL,
        probes::ALL,
        import::ALL,
        gcode::ALL,
        following::ALL,
        verify::ALL,
        posts::ALL,
        posting::ALL,
    ]
    .into_iter()
    .flatten()
    .copied()
}
