//! Tests the library as another program uses it.
#![expect(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

mod examples;
mod library;
mod public_items;
