//! What is computed again after an edit, and what must not be. (ARCHITECTURE.md, "Queries")

mod embedding;
mod incremental;
mod library;
mod one_file;
mod settings;
mod world;
