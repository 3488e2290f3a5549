//! The keys, table by table: each with its type, its default and its meaning.

/// Declares a table of the configuration. For each key: its field with its meaning, its name in the file, its [`ValueType`], the value when
/// nobody gives one, a value as TOML for the file that `init` writes, and whose results depend on it ([`Concerns`]).
///
/// [`ValueType`]: super::kind::Kind
macro_rules! section {
    ($(
        $(#[doc = $meaning:literal])+
        $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $concerns:ident;
    )*) => {
        /// What the configuration, or the command line, gives.
        #[derive(Clone, Debug, Default)]
        pub struct Options {
            $($(#[doc = $meaning])+ pub $field: Option<Sourced<$type>>,)*
        }

        /// What holds.
        #[derive(Clone, Debug)]
        pub struct Settings {
            $($(#[doc = $meaning])+ pub $field: Sourced<$type>,)*
        }

        impl Options {
            pub(in crate::config) fn read(table: &mut Table<'_, '_, '_>) -> Self {
                Self { $($field: table.take($name, &$kind),)* }
            }

            pub(in crate::config) fn over(self, below: Self) -> Self {
                Self { $($field: self.$field.or(below.$field),)* }
            }

            pub(in crate::config) fn resolve(self) -> Settings {
                Settings { $($field: self.$field.unwrap_or_else(|| Sourced::default($default)),)* }
            }
        }

        impl Settings {
            /// Each key with its value as TOML, where there is one.
            pub(in crate::config) fn shown(&self) -> Vec<Shown> {
                vec![$(Shown { name: $name, value: ($kind.show)(&self.$field.value), origin: self.$field.origin },)*]
            }
        }

        impl Settings {
            /// Each key with its value, where results depend on it.
            pub(in crate::config) fn concerning(&self, whose: Concerns, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
                $(if Concerns::$concerns.is_part_of(whose) {
                    add($name, &self.$field.value);
                })*
            }
        }

        /// What is known of each key.
        pub(in crate::config) const KEYS: &[Key] = &[
            $(Key { name: $name, meaning: &[$($meaning),+], example: $example, schema: $kind.schema },)*
        ];
    };
}

pub mod emit;
pub mod general;
pub mod limits;
pub mod machine;
pub mod tables;
pub mod warnings;
pub mod watch;
