//! Results that outlive a process. A result is kept with everything that it was made from: the files that were read, and the names that were
//! looked for in directories, found or not. A later run takes it if all of that is as it was (a *verifying trace*), and makes it anew
//! otherwise. Whether a file is as it was is told by its stamp, as Git does it; only where that is in doubt is the file read and hashed.
//!
//! Rules: a kept result may be missing, but never wrong. What is damaged, of another build or of another format is not used, and replaced. A run
//! never fails because of the cache. Everything in it can be deleted at any time. (book: reference/configuration: no configuration, no cache)

mod facts;
mod flat;
mod format;
mod listing;
mod names;
mod payload;
mod private;
mod reasons;
mod snapshot;
mod stamp;
mod tree_store;
mod upkeep;
mod verify;

pub use facts::{Catalogue, DirectoryFact, FileFact, Lookup, Record};
pub use format::{Key, Unusable};
pub use listing::{Listing, Listings};
pub use names::Names;
pub use payload::{Corrupt, decode, encode};
pub use reasons::{Reason, reasons};
pub use snapshot::{KeptDirectory, KeptFile, KeptRecord, Snapshot};
pub use stamp::{Clock, Stamp};
pub use tree_store::{Home, TreeStore};
pub use upkeep::{Entry, NotRemoved};
pub use verify::{Covers, FileState, Looking, Stamped, Verdict, verify};
