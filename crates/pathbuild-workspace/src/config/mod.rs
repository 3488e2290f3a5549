//! The configuration: `pathbuild.toml` and the command-line options that override it. (book: reference/configuration)
//!
//! ```text
//! file --read--> Options --apply (command line)--> Options --resolve (defaults)--> Settings
//! ```
//!
//! Each key is declared once, in [`sections`]: its type, its default, its description, and the option that overrides it. The reader,
//! the file that `init` writes, the JSON schema, `config show`, the cache keys, the option and its help in both languages are derived
//! from that, so they all know the same keys.

mod arguments;
mod describe;
mod kinds;
mod load;
mod origin;
mod reader;
pub mod sections;
mod settings;
mod table_kinds;
pub mod types;

pub use arguments::{GivenOptions, OptionValues, Overrides, SettingOption, number, positive, regex};
pub use describe::{german_rows, schema, settings, show, template};
pub use load::{UserSettings, check_text, load, repository};
pub use origin::{Origin, ResultKind, ShownSetting, SourcedValue};
pub use pathbuild_db::system::clean;
pub use settings::{Options, Settings};
pub(crate) use table_kinds::is_file_name;
#[cfg(not(target_family = "wasm"))]
pub(crate) use table_kinds::is_too_round;
pub use table_kinds::nearest_code;
