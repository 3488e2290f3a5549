//! A cache of results that outlives a process. A result is stored together with all its inputs: the files that were read, and the names
//! that were looked up in directories, whether found or not. A later run reuses the result if none of the inputs has changed (a *verifying
//! trace*) and recomputes it otherwise. Changes are detected by file stamps, as in Git; a file is read and hashed only if its stamp leaves
//! doubt.
//!
//! Rules: a cached result may be missing, but never wrong. A file that is damaged, or written by another build or in another format, is
//! ignored and replaced. A run never fails because of the cache. Everything in it can be deleted at any time. (book:
//! reference/configuration: no configuration, no cache)

mod catalogue;
mod store;
mod verify;

pub use catalogue::{
    CacheFault, Catalogue, CorruptPayload, DirectoryFact, FileFact, Key, Lookup, Record, decode, encode,
};
pub use store::{CacheLocation, Entry, RemoveError, TreeStore};
pub use verify::{CoversFn, FileState, Reason, StampedBytes, Verdict, VerifyContext, reasons, verify};
pub use verify::{Listing, Listings};
