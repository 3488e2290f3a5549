//! The configuration: `pathbuild.toml` and the options that say the same. (book: reference/configuration)
//!
//! ```text
//! file ---------> Options --\
//!                            over --> Settings
//! command line -> Options --/
//! ```
//!
//! Each key is declared once, in [`sections`]: its type, its default, its description, and the option that overrides it. The reader,
//! the file that `init` writes, the JSON schema, `config show`, the cache keys, the option and its help in both languages are derived
//! from that, so they all know the same keys.

mod arguments;
mod discover;
mod key_index;
mod kind;
mod kinds;
mod load;
mod options;
mod origin;
mod reader;
mod result_kind;
mod schema;
pub mod sections;
mod settings;
mod show;
mod source;
mod template;
pub mod types;
mod user;

pub use arguments::{GivenOptions, OptionValues, Overrides, SettingOption, number, positive, regex};
pub use load::{faults, load};
pub use options::Options;
pub use origin::{Origin, SourcedValue};
pub use result_kind::ResultKind;
pub use schema::schema;
pub use settings::Settings;
pub use show::{Setting, settings, show};
pub use template::template;
pub use user::User;

pub use discover::{FILE_NAME, repository};
pub use kinds::table::nearest_code;
pub use pathbuild_db::system::clean;
