//! The keys of all tables, each with its type, default and description.

/// Declares a table of the configuration. Each key has: a description and a field, its name in the file, its [`ValueType`], its default, a
/// TOML value for the file that `init` writes, and the cached results that depend on it ([`ResultKind`]).
///
/// [`ValueType`]: super::kind::Kind
macro_rules! section {
    ($(
        $(#[doc = $meaning:literal])+
        $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident;
    )*) => {
        /// The values that a source sets.
        #[derive(Clone, Debug, Default)]
        pub struct Options {
            $($(#[doc = $meaning])+ pub $field: Option<SourcedValue<$type>>,)*
        }

        /// The values after applying defaults.
        #[derive(Clone, Debug)]
        pub struct Settings {
            $($(#[doc = $meaning])+ pub $field: SourcedValue<$type>,)*
        }

        impl Options {
            pub(in crate::config) fn read(table: &mut Table<'_, '_, '_>) -> Self {
                Self { $($field: table.take($name, &$kind),)* }
            }

            pub(in crate::config) fn over(self, below: Self) -> Self {
                Self { $($field: self.$field.or(below.$field),)* }
            }

            pub(in crate::config) fn resolve(self) -> Settings {
                Settings { $($field: self.$field.unwrap_or_else(|| SourcedValue::default($default)),)* }
            }
        }

        impl Settings {
            /// The keys with their values as TOML.
            pub(in crate::config) fn shown(&self) -> Vec<ShownSetting> {
                vec![$(ShownSetting { name: $name, value: ($kind.show)(&self.$field.value), origin: self.$field.origin },)*]
            }
        }

        impl Settings {
            /// Passes the values that cached results of the command `result_kind` depend on to `add`.
            pub(in crate::config) fn visit_inputs(&self, result_kind: ResultKind, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
                $(if ResultKind::$results.is_part_of(result_kind) {
                    add($name, &self.$field.value);
                })*
            }
        }

        /// Descriptions of the keys.
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
